// Wavefront OBJ: vertices and faces.  The tag lines are in obj_tags.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/formats.h"
#include "core/mesh/io/model_builder.h"
#include "core/mesh/io/obj_tags.h"
#include "core/mesh/io/writing.h"

namespace loopcheck::core {
namespace {

/// Keywords of the format that say nothing about the surface we read.
constexpr std::array<std::string_view, 42> kSkipped{
    "vt",     "vn",     "vp",       "g",        "s",          "o",         "mg",    "usemtl", "mtllib",
    "usemap", "maplib", "l",        "p",        "curv",       "curv2",     "surf",  "cstype", "deg",
    "bmat",   "step",   "parm",     "trim",     "hole",       "scrv",      "sp",    "end",    "con",
    "bevel",  "lod",    "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech",  "call",
    "csh",    "bsp",    "bzp",      "cdc",      "cdp",        "res"};

/// The vertex of "v", "v/vt", "v//vn" or "v/vt/vn", where what follows a slash may be missing.
std::optional<long long> vertex_of(std::string_view entry) {
    std::size_t slash = entry.find('/');
    const auto vertex = parse_integer(entry.substr(0, slash));
    for (int more = 0; slash != std::string_view::npos; ++more) {
        entry.remove_prefix(slash + 1);
        slash = entry.find('/');
        const std::string_view index = entry.substr(0, slash);
        if (more == 2 || (!index.empty() && !parse_integer(index))) return std::nullopt;
    }
    return vertex;
}

class ObjReader {
  public:
    explicit ObjReader(std::string_view bytes) : lines_(bytes, {.comments = true, .continuation = true}) {}

    Result<Model> read() {
        while (lines_.next())
            if (auto done = read_line(Words(lines_.text())); !done) return hand_on(done);
        if (auto done = check_faces(); !done) return hand_on(done);
        if (auto done = tags_.check(builder_.model.data); !done) return hand_on(done);
        warn();
        builder_.model.description = lines_.description();
        return std::move(builder_.model);
    }

  private:
    Result<void> read_line(Words words) {
        if (words.empty()) return {};
        const std::string_view keyword = words.next();
        if (keyword == "v") return read_vertex(words);
        if (keyword == "f") return read_face(words);
        if (keyword == "t") return tags_.read(words, spot(), builder_.model);
        if (std::find(kSkipped.begin(), kSkipped.end(), keyword) == kSkipped.end())
            unknown_keywords_.add(keyword, spot().line);
        return {};
    }

    Result<void> read_vertex(Words words) {
        const auto position = parse_position(words, spot());
        if (!position) return tl::unexpected(position.error());
        if (!words.empty())
            if (auto done = read_extra_numbers(words); !done) return done;
        return builder_.add_vertex(*position, spot());
    }

    /// A weight w, a colour, or both.
    Result<void> read_extra_numbers(Words words) {
        const std::size_t count = words.count();
        if (count != 1 && count != 3 && count != 4)
            return bad_syntax(fmt::format("A vertex has {} numbers; 3, 4, 6 or 7 can be read.", 3 + count));
        const auto first = parse_double(Words(words).next());
        if (auto done = skip_numbers(words, spot()); !done) return done;
        (count == 1 && first != 1.0 ? other_weights_ : extra_numbers_).add(spot().line);
        return {};
    }

    Result<void> read_face(Words words) {
        corners_.clear();
        while (!words.empty()) {
            const auto corner = read_corner(words.next());
            if (!corner) return tl::unexpected(corner.error());
            corners_.push_back(*corner);
        }
        return builder_.add_face(corners_, spot());
    }

    /// Positive indices may name vertices that are yet to come: `check_faces` sees to them.
    Result<Index> read_corner(std::string_view entry) {
        const auto index = vertex_of(entry);
        const auto vertices = static_cast<long long>(builder_.model.data.positions.size());
        if (!index)
            return bad_syntax(fmt::format("The corner {} is no index of a vertex.", in_quotes(entry)));
        if (*index == 0)
            return fail_at(spot(), ErrorCode::IndexOutOfRange,
                           "A face has the index 0, but vertices are counted from 1.");
        if (*index < -vertices)
            return fail_at(spot(), ErrorCode::IndexOutOfRange,
                           fmt::format("A face has the index {}, but only {} vertices come before it.",
                                       *index, vertices));
        if (*index > static_cast<long long>(kMostItems))
            return fail_at(spot(), ErrorCode::IndexOutOfRange,
                           fmt::format("A face has the index {}, but no mesh has so many vertices.", *index));
        return static_cast<Index>(*index > 0 ? *index - 1 : vertices + *index);
    }

    Result<void> check_faces() const {
        const Model& model = builder_.model;
        const std::size_t vertices = model.data.positions.size();
        Result<void> result;
        for_each_face(model.data, [&](std::size_t f, std::span<const Index> corners) {
            const auto beyond = std::find_if(corners.begin(), corners.end(), [vertices](Index corner) {
                return static_cast<std::size_t>(corner) >= vertices;
            });
            if (beyond == corners.end() || !result) return;
            result = fail(ErrorCode::IndexOutOfRange,
                          fmt::format("A face has the index {}, but there are {} vertices.",
                                      static_cast<long long>(*beyond) + 1, vertices),
                          {Place::Kind::Line, model.face_lines[f]});
        });
        return result;
    }

    void warn() {
        if (other_weights_.count > 0)
            builder_.warn(
                fmt::format("A vertex has a weight w other than 1, which is ignored: x, y and z are taken "
                            "as they stand ({}).",
                            to_string(other_weights_)));
        if (extra_numbers_.count > 0)
            builder_.warn(fmt::format("A vertex has more than three numbers; the others are ignored ({}).",
                                      to_string(extra_numbers_)));
        unknown_keywords_.warn("keyword", builder_.model.warnings);
        tags_.warn(builder_.model.warnings);
    }

    Spot spot() const { return {lines_.number(), 0}; }
    tl::unexpected<Error> bad_syntax(std::string sentence) const {
        return fail_at(spot(), ErrorCode::BadSyntax, std::move(sentence));
    }

    LineReader lines_;
    ModelBuilder builder_;
    std::vector<Index> corners_;  ///< of the face at hand
    Tally other_weights_;
    Tally extra_numbers_;
    NameTally unknown_keywords_;
    ObjTags tags_;
};

}  // namespace

Result<Model> parse_obj(std::string_view bytes) {
    return ObjReader(bytes).read();
}

Written format_obj(const Model& model) {
    Written written;
    append_description(written.bytes, "#", model.description);
    append_vertices(written.bytes, "v ", model.data);
    for_each_face(model.data, [&](std::size_t, std::span<const Index> corners) {
        written.bytes += 'f';
        append_corners(written.bytes, corners, 1);
        written.bytes += '\n';
    });
    append_obj_tags(written.bytes, model);
    return written;
}

}  // namespace loopcheck::core
