// What every reader does with the words and numbers it meets: check, add to the model, complain.  Internal.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "core/mesh/io/text_reader.h"

namespace loopcheck::core {

/// Where the reader is: at a line of text or at a byte of binary data.
struct Spot {
    long long line = 0;    ///< from 1; 0 in binary data
    std::size_t byte = 0;  ///< from 0; only in binary data
};

/// An error at a spot.  A byte has no Place, so the sentence says it.
inline tl::unexpected<Error> fail_at(Spot spot, ErrorCode code, std::string sentence) {
    if (spot.line > 0) return fail(code, std::move(sentence), {Place::Kind::Line, spot.line});
    return fail(code, fmt::format("Byte {}: {}", spot.byte, sentence));
}

/// Hands the error of a result on from a function with another result.
template <class T>
tl::unexpected<Error> hand_on(Result<T>& result) {
    return tl::unexpected<Error>(std::move(result.error()));
}

/// A word of the file as it may stand in a sentence: in quotes, short, printable ASCII.
inline std::string in_quotes(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string text = "\"";
    for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (word.size() > kLongest ? "...\"" : "\"");
}

/// The most vertices, faces, corners or lines that an Index can count.
inline constexpr std::size_t kMostItems = std::numeric_limits<Index>::max();

/// How many of `what` a file announces.  Errors: BadSyntax, TooLarge.
inline Result<Index> parse_count(std::string_view word, std::string_view what, Spot spot) {
    const auto count = parse_integer(word);
    if (!count || *count < 0)
        return fail_at(spot, ErrorCode::BadSyntax,
                       fmt::format("The number of {} is {}.", what, in_quotes(word)));
    if (static_cast<unsigned long long>(*count) > kMostItems)
        return fail_at(
            spot, ErrorCode::TooLarge,
            fmt::format("The file announces {} {}; no more than 2^31 - 1 can be held.", *count, what));
    return static_cast<Index>(*count);
}

/// A position from the next three words.
inline Result<glm::dvec3> parse_position(Words& words, Spot spot) {
    glm::dvec3 position;
    for (int i = 0; i < 3; ++i) {
        if (words.empty())
            return fail_at(spot, ErrorCode::BadSyntax,
                           fmt::format("A vertex has {} coordinates, but 3 are needed.", i));
        const std::string_view word = words.next();
        const auto coordinate = parse_double(word);
        if (!coordinate)
            return fail_at(spot, ErrorCode::BadSyntax,
                           fmt::format("The coordinate {} is not a number.", in_quotes(word)));
        position[i] = *coordinate;
    }
    return position;
}

/// The words that are left are numbers, and nothing is done with them.
inline Result<void> skip_numbers(Words& words, Spot spot) {
    while (!words.empty())
        if (const std::string_view word = words.next(); !parse_double(word))
            return fail_at(spot, ErrorCode::BadSyntax, fmt::format("{} is not a number.", in_quotes(word)));
    return {};
}

/// A corner that is the vertex `index` of `vertices`, counted from 0.
inline Result<Index> check_corner(long long index, std::size_t vertices, Spot spot) {
    if (index >= 0 && static_cast<unsigned long long>(index) < vertices) return static_cast<Index>(index);
    return fail_at(
        spot, ErrorCode::IndexOutOfRange,
        fmt::format("A face has the index {}, but there are {} vertices, counted from 0.", index, vertices));
}
inline Result<Index> parse_corner(std::string_view word, std::size_t vertices, Spot spot) {
    if (const auto index = parse_integer(word)) return check_corner(*index, vertices, spot);
    return fail_at(spot, ErrorCode::BadSyntax,
                   fmt::format("The corner {} is no index of a vertex.", in_quotes(word)));
}

inline Result<void> check_finite(const glm::dvec3& position, Spot spot) {
    if (std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z)) return {};
    return fail_at(spot, ErrorCode::NotFinite,
                   fmt::format("A vertex has the coordinates ({}, {}, {}), which are not all finite.",
                               shortest(position.x), shortest(position.y), shortest(position.z)));
}

/// There is room for `more` after `items` of something.
inline Result<void> check_room(std::size_t items, std::size_t more, std::string_view what, Spot spot) {
    if (items <= kMostItems && more <= kMostItems - items) return {};
    return fail_at(spot, ErrorCode::TooLarge, fmt::format("The file has more than 2^31 - 1 {}.", what));
}

/// A model that grows while its file is read.
class ModelBuilder {
  public:
    Model model;

    Result<void> add_vertex(const glm::dvec3& position, Spot spot) {
        if (auto finite = check_finite(position, spot); !finite) return finite;
        if (auto room = check_room(model.data.positions.size(), 1, "vertices", spot); !room) return room;
        model.data.positions.push_back(position);
        return add_line(model.vertex_lines, spot);
    }

    Result<void> add_face(std::span<const Index> corners, Spot spot) {
        const MeshData& data = model.data;
        if (auto room = check_room(data.face_sizes.size(), 1, "faces", spot); !room) return room;
        if (auto room = check_room(data.face_corners.size(), corners.size(), "corners of faces", spot); !room)
            return room;
        model.data.add_face(corners);
        return add_line(model.face_lines, spot);
    }

    void warn(std::string sentence) { model.warnings.push_back(std::move(sentence)); }

  private:
    static Result<void> add_line(std::vector<Index>& lines, Spot spot) {
        if (spot.line <= 0) return {};
        if (auto room = check_room(static_cast<std::size_t>(spot.line), 0, "lines", spot); !room) return room;
        lines.push_back(static_cast<Index>(spot.line));
        return {};
    }
};

/// How often something was met, and where first.
struct Tally {
    long long count = 0;
    long long first_line = 0;

    void add(long long line) {
        if (count++ == 0) first_line = line;
    }
};

/// "once, in line 7" or "3 times, first in line 7".
inline std::string to_string(Tally tally) {
    if (tally.count == 1) return fmt::format("once, in line {}", tally.first_line);
    return fmt::format("{} times, first in line {}", tally.count, tally.first_line);
}

/// Tallies by name.  Only the first names are kept apart: a file of garbage has millions.
class NameTally {
  public:
    void add(std::string_view name, long long line) {
        const auto same = [name](const Row& row) { return row.name == name; };
        const auto row = std::find_if(rows_.begin(), rows_.end(), same);
        if (row != rows_.end())
            row->tally.add(line);
        else if (rows_.size() < kMostNames)
            rows_.emplace_back(std::string(name)).tally.add(line);
        else
            others_.add(line);
    }

    /// Adds a warning for each name: "The `what` "name" is unknown and was skipped (once, in line 7)."
    void warn(std::string_view what, std::vector<std::string>& warnings) const {
        for (const Row& row : rows_)
            warnings.push_back(fmt::format("The {} {} is unknown and was skipped ({}).", what,
                                           in_quotes(row.name), to_string(row.tally)));
        if (others_.count > 0)
            warnings.push_back(
                fmt::format("Every other unknown {} was skipped too ({}).", what, to_string(others_)));
    }

  private:
    static constexpr std::size_t kMostNames = 20;
    struct Row {
        explicit Row(std::string n) : name(std::move(n)) {}
        std::string name;
        Tally tally;
    };
    std::vector<Row> rows_;
    Tally others_;
};

}  // namespace loopcheck::core
