// What the writers share.  Internal.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <glm/vec3.hpp>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "core/mesh/io/text_reader.h"

namespace loopcheck::core {

/// Appends "x y z".
inline void append_position(std::string& text, const glm::dvec3& position) {
    for (int i = 0; i < 3; ++i) {
        if (i > 0) text += ' ';
        text += shortest(position[i]);
    }
}

/// Appends " a b c", counted from `first`.
inline void append_corners(std::string& text, std::span<const Index> corners, long long first = 0) {
    for (const Index corner : corners) fmt::format_to(std::back_inserter(text), " {}", first + corner);
}

/// Appends a line "`keyword`x y z" for every vertex, after making room for these and for the faces: a text
/// that grows step by step is there twice.
inline void append_vertices(std::string& text, std::string_view keyword, const MeshData& data) {
    constexpr std::size_t kMostOfNumber = 25, kMostOfIndex = 11;  // with a blank before
    text.reserve(text.size() + data.positions.size() * (keyword.size() + 3 * kMostOfNumber) +
                 (data.face_sizes.size() + data.face_corners.size()) * kMostOfIndex);
    for (const glm::dvec3& position : data.positions) {
        text += keyword;
        append_position(text, position);
        text += '\n';
    }
}

/// Appends a line "n a b c ..." for every face.
inline void append_faces(std::string& text, const MeshData& data) {
    for_each_face(data, [&](std::size_t, std::span<const Index> corners) {
        text += std::to_string(corners.size());
        append_corners(text, corners);
        text += '\n';
    });
}

/// Appends a line "`keyword` `description`"; nothing where there is no description.  What would end the line
/// becomes a blank, and a backslash at the end, which some readers take for a continuation, is kept off it.
inline void append_description(std::string& text, std::string_view keyword, std::string_view description) {
    std::string line(description);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    const std::string_view words = Words(line).rest();
    if (words.empty()) return;
    text.append(keyword).append(" ").append(words).append(words.ends_with('\\') ? " \n" : "\n");
}

/// Warnings for the tags that a format without tags loses.
inline std::vector<std::string> lost_tags(const Model& model, std::string_view format) {
    std::vector<std::string> warnings;
    const auto lost = [&](std::size_t count, std::string_view what) {
        if (count > 0) warnings.push_back(fmt::format("{} cannot say {}: {} lost.", format, what, count));
    };
    lost(model.data.creases.size(), "which edges are creases");
    lost(model.data.corners.size(), "which vertices are sharp");
    lost(model.data.holes.size(), "which faces are holes");
    lost(model.boundary ? 1 : 0, "the boundary rule");
    lost(model.creasing ? 1 : 0, "the creasing method");
    return warnings;
}

}  // namespace loopcheck::core
