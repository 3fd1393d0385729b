#include "core/mesh/io/obj_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>

namespace loopcheck::core {
namespace {

constexpr std::array kBoundaryNumbers{BoundaryRule::None, BoundaryRule::EdgeAndCorner,
                                      BoundaryRule::EdgeOnly};

/// One tag line.
struct Tag {
    std::string_view name;
    std::vector<long long> ints;
    std::vector<float> floats;
    std::vector<std::string_view> strings;
    Spot spot;
};

tl::unexpected<Error> bad_syntax(const Tag& tag, std::string_view what) {
    return fail_at(tag.spot, ErrorCode::BadSyntax, fmt::format("The tag {} {}.", in_quotes(tag.name), what));
}

tl::unexpected<Error> misshapen(const Tag& tag, std::string_view shape) {
    return bad_syntax(tag, fmt::format("needs {}, but has {} integers, {} numbers and {} strings", shape,
                                       tag.ints.size(), tag.floats.size(), tag.strings.size()));
}

/// The three counts in "2/1/0".
std::optional<std::array<std::size_t, 3>> parse_counts(std::string_view word) {
    std::array<std::size_t, 3> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::size_t end = i + 1 < counts.size() ? word.find('/') : word.size();
        const auto count = parse_integer(word.substr(0, end));
        if (!count || *count < 0 || end == std::string_view::npos) return std::nullopt;
        counts[i] = static_cast<std::size_t>(*count);
        word.remove_prefix(std::min(word.size(), end + 1));
    }
    return counts;
}

Result<void> read_ints(Tag& tag, Words& words, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = words.next();
        const auto value = parse_integer(word);
        if (!value) return bad_syntax(tag, fmt::format("has {} where an integer is due", in_quotes(word)));
        tag.ints.push_back(*value);
    }
    return {};
}

Result<void> read_floats(Tag& tag, Words& words, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view word = words.next();
        const auto value = parse_float(word);
        if (!value) return bad_syntax(tag, fmt::format("has {} where a number is due", in_quotes(word)));
        tag.floats.push_back(*value);
    }
    return {};
}

/// "2/1/0 4 5 1.5": how many integers, numbers and strings there are, then they themselves.
Result<Tag> read_arguments(std::string_view name, Words words, Spot spot) {
    Tag tag{name, {}, {}, {}, spot};
    const auto counts = parse_counts(words.next());
    if (!counts)
        return bad_syntax(tag, "does not say how many integers, numbers and strings it has, as in 2/1/0");
    const auto [ints, floats, strings] = *counts;
    const std::size_t given = words.count();
    if (ints > given || floats > given - ints || strings != given - ints - floats)
        return bad_syntax(
            tag, fmt::format("announces {} integers, {} numbers and {} strings, but {} words follow", ints,
                             floats, strings, given));
    if (auto done = read_ints(tag, words, ints); !done) return hand_on(done);
    if (auto done = read_floats(tag, words, floats); !done) return hand_on(done);
    while (!words.empty()) tag.strings.push_back(words.next());
    return tag;
}

/// The code for a tag that names what is not there.
ErrorCode out_of_range(std::string_view tag) {
    return tag == "hole" ? ErrorCode::HoleOutOfRange : ErrorCode::IndexOutOfRange;
}

/// Integer i as an index.  Whether it is too large is known at the end of the file.
Result<Index> index_of(const Tag& tag, std::size_t i) {
    const long long index = tag.ints[i];
    if (index >= 0 && index <= static_cast<long long>(kMostItems)) return static_cast<Index>(index);
    return fail_at(
        tag.spot, out_of_range(tag.name),
        fmt::format("The tag {} has the index {}; tags count from 0.", in_quotes(tag.name), index));
}

bool has_sharpness_for(const Tag& tag, std::size_t things) {
    return (tag.floats.size() == 1 || tag.floats.size() == things) && tag.strings.empty();
}

/// The sharpness of thing i: there is one for all or one each.
Result<float> sharpness_of(const Tag& tag, std::size_t i) {
    const float sharpness = tag.floats[tag.floats.size() == 1 ? 0 : i];
    if (sharpness >= 0) return sharpness;
    return fail_at(tag.spot, ErrorCode::BadSharpness,
                   fmt::format("The tag {} has the sharpness {}.", in_quotes(tag.name), shortest(sharpness)));
}

Result<void> read_creases(const Tag& tag, Model& model) {
    const std::size_t pairs = tag.ints.size() / 2;
    if (tag.ints.size() % 2 != 0 || !has_sharpness_for(tag, pairs))
        return misshapen(tag, "pairs of vertices, and one sharpness or one a pair");
    for (std::size_t i = 0; i < pairs; ++i) {
        const auto a = index_of(tag, 2 * i);
        const auto b = index_of(tag, 2 * i + 1);
        const auto sharpness = sharpness_of(tag, i);
        if (!a || !b) return tl::unexpected(a ? b.error() : a.error());
        if (!sharpness) return tl::unexpected(sharpness.error());
        model.data.creases.push_back({*a, *b, *sharpness});
    }
    return {};
}

Result<void> read_corners(const Tag& tag, Model& model) {
    if (!has_sharpness_for(tag, tag.ints.size()))
        return misshapen(tag, "vertices, and one sharpness or one a vertex");
    for (std::size_t i = 0; i < tag.ints.size(); ++i) {
        const auto vertex = index_of(tag, i);
        const auto sharpness = sharpness_of(tag, i);
        if (!vertex) return tl::unexpected(vertex.error());
        if (!sharpness) return tl::unexpected(sharpness.error());
        model.data.corners.push_back({*vertex, *sharpness});
    }
    return {};
}

Result<void> read_holes(const Tag& tag, Model& model) {
    if (!tag.floats.empty() || !tag.strings.empty()) return misshapen(tag, "faces and nothing else");
    for (std::size_t i = 0; i < tag.ints.size(); ++i) {
        const auto face = index_of(tag, i);
        if (!face) return tl::unexpected(face.error());
        model.data.holes.push_back(*face);
    }
    return {};
}

Result<void> read_boundary(const Tag& tag, Model& model) {
    if (tag.ints.size() != 1 || !tag.floats.empty() || !tag.strings.empty())
        return misshapen(tag, "one integer");
    const long long number = tag.ints[0];
    if (number < 0 || number >= static_cast<long long>(kBoundaryNumbers.size()))
        return bad_syntax(tag, fmt::format("is {}; 0 is none, 1 edge-and-corner and 2 edge-only", number));
    model.boundary = kBoundaryNumbers[static_cast<std::size_t>(number)];
    return {};
}

Result<void> read_creasing(const Tag& tag, Model& model) {
    if (!tag.ints.empty() || !tag.floats.empty() || tag.strings.size() != 1)
        return misshapen(tag, "one string");
    const std::string_view method = tag.strings[0];
    if (method != "normal" && method != "uniform" && method != "chaikin")
        return bad_syntax(
            tag, fmt::format("is {}; it can be normal (the same as uniform) or chaikin", in_quotes(method)));
    model.creasing = method == "chaikin" ? Creasing::Chaikin : Creasing::Uniform;
    return {};
}

using ReadTag = Result<void> (*)(const Tag&, Model&);
struct KnownTag {
    std::string_view name;
    ReadTag read;
};
constexpr std::array kKnownTags{KnownTag{"crease", read_creases}, KnownTag{"corner", read_corners},
                                KnownTag{"hole", read_holes}, KnownTag{"interpolateboundary", read_boundary},
                                KnownTag{"creasemethod", read_creasing}};

/// What a tag of this name names is there.
Result<void> check_index(std::string_view tag, Index index, std::size_t count, long long line) {
    if (static_cast<std::size_t>(index) < count) return {};
    return fail(out_of_range(tag),
                fmt::format("The tag {} has the index {}, but there are {} {}, counted from 0.",
                            in_quotes(tag), index, count, tag == "hole" ? "faces" : "vertices"),
                {Place::Kind::Line, line});
}

}  // namespace

Result<void> ObjTags::read(Words words, Spot spot, Model& model) {
    if (words.empty()) return fail_at(spot, ErrorCode::BadSyntax, "A tag line has no name.");
    const std::string_view name = words.next();
    const auto known = std::find_if(kKnownTags.begin(), kKnownTags.end(),
                                    [name](const KnownTag& row) { return row.name == name; });
    if (known == kKnownTags.end()) {
        unknown_.add(name, spot.line);
        return {};
    }
    auto tag = read_arguments(name, words, spot);
    if (!tag) return hand_on(tag);
    auto done = known->read(*tag, model);
    crease_lines_.resize(model.data.creases.size(), spot.line);
    corner_lines_.resize(model.data.corners.size(), spot.line);
    hole_lines_.resize(model.data.holes.size(), spot.line);
    return done;
}

Result<void> ObjTags::check(const MeshData& data) const {
    const std::size_t vertices = data.positions.size();
    for (std::size_t i = 0; i < data.creases.size(); ++i)
        for (const Index end : {data.creases[i].a, data.creases[i].b})
            if (auto good = check_index("crease", end, vertices, crease_lines_[i]); !good) return good;
    for (std::size_t i = 0; i < data.corners.size(); ++i)
        if (auto good = check_index("corner", data.corners[i].vertex, vertices, corner_lines_[i]); !good)
            return good;
    for (std::size_t i = 0; i < data.holes.size(); ++i)
        if (auto good = check_index("hole", data.holes[i], data.face_sizes.size(), hole_lines_[i]); !good)
            return good;
    return {};
}

void append_obj_tags(std::string& text, const Model& model) {
    const auto out = std::back_inserter(text);
    for (const EdgeSharpness& crease : model.data.creases)
        fmt::format_to(out, "t crease 2/1/0 {} {} {}\n", crease.a, crease.b, shortest(crease.sharpness));
    for (const VertexSharpness& corner : model.data.corners)
        fmt::format_to(out, "t corner 1/1/0 {} {}\n", corner.vertex, shortest(corner.sharpness));
    for (const Index hole : model.data.holes) fmt::format_to(out, "t hole 1/0/0 {}\n", hole);
    if (model.boundary) {
        const auto number = std::find(kBoundaryNumbers.begin(), kBoundaryNumbers.end(), *model.boundary);
        fmt::format_to(out, "t interpolateboundary 1/0/0 {}\n", number - kBoundaryNumbers.begin());
    }
    if (model.creasing)
        fmt::format_to(out, "t creasemethod 0/0/1 {}\n",
                       *model.creasing == Creasing::Chaikin ? "chaikin" : "normal");
}

}  // namespace loopcheck::core
