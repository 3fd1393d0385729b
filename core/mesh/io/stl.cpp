// Stereolithography: triangles that share nothing, in text or binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/mesh/io/bytes.h"
#include "core/mesh/io/formats.h"
#include "core/mesh/io/model_builder.h"
#include "core/mesh/io/writing.h"

namespace loopcheck::core {
namespace {

// A binary file: 80 bytes of anything, the number of triangles, then for each of them a normal, three corners
// (12 floats, little endian) and two more bytes.
constexpr std::size_t kCountAt = 80;
constexpr std::size_t kTrianglesAt = 84;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kNormalBytes = 12;

/// Triangles that share nothing: three corners each.
struct Soup {
    std::vector<glm::dvec3> corners;
    std::vector<Spot> spots;       ///< one a corner
    std::vector<Spot> face_spots;  ///< one a triangle
};

/// For every position the first one that is equal to it; -0 equals 0.
///
/// By sorting, so that the time is bounded whatever the positions are.
std::vector<std::size_t> first_equals(const std::vector<glm::dvec3>& positions) {
    const auto key = [&](std::size_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return key(i) < key(j) || (key(i) == key(j) && i < j); });
    std::vector<std::size_t> first(positions.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && key(order[k - 1]) == key(order[k]);
        first[order[k]] = same ? first[order[k - 1]] : order[k];
    }
    return first;
}

/// Vertices in the order in which they first occur, with the bits of that first time.
Result<void> merge(const Soup& soup, ModelBuilder& builder) {
    const std::size_t count = soup.corners.size();
    const std::vector<std::size_t> first = first_equals(soup.corners);
    std::vector<Index> vertex_of(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (first[i] == i) {
            vertex_of[i] = static_cast<Index>(builder.model.data.positions.size());
            if (auto done = builder.add_vertex(soup.corners[i], soup.spots[i]); !done) return done;
        } else {
            vertex_of[i] = vertex_of[first[i]];
        }
    }
    for (std::size_t f = 0; f < soup.face_spots.size(); ++f)
        if (auto done = builder.add_face(std::span(vertex_of).subspan(3 * f, 3), soup.face_spots[f]); !done)
            return done;
    const std::size_t vertices = builder.model.data.positions.size();
    builder.warn(
        fmt::format("STL repeats the vertices of every face: {} corners with equal coordinates were merged "
                    "into {} vertices, {} fewer.",
                    count, vertices, count - vertices));
    return {};
}

Result<Model> make_model(const Soup& soup, std::string_view description) {
    ModelBuilder builder;
    if (auto done = merge(soup, builder); !done) return hand_on(done);
    builder.model.description = description;
    return std::move(builder.model);
}

/// Keywords may be written in capitals.
bool is_keyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b); });
}

class TextReader {
  public:
    explicit TextReader(std::string_view bytes) : lines_(bytes) {}

    Result<Model> read() {
        while (lines_.next_with_words())
            if (auto done = read_solid(); !done) return hand_on(done);
        return make_model(soup_, description_);
    }

  private:
    /// From the line "solid name", which is at hand, to "endsolid name".
    Result<void> read_solid() {
        Words words(lines_.text());
        if (!is_keyword(words.next(), "solid")) return not_expected("solid");
        if (description_.empty()) description_ = words.rest();
        while (true) {
            if (auto done = next_line(); !done) return done;
            const std::string_view keyword = Words(lines_.text()).next();
            if (is_keyword(keyword, "endsolid")) return {};
            if (!is_keyword(keyword, "facet")) return not_expected("facet or endsolid");
            if (auto done = read_facet(); !done) return done;
        }
    }

    /// From the line "facet normal x y z", which is at hand, to "endfacet".  The normal is ignored.
    Result<void> read_facet() {
        soup_.face_spots.push_back(spot());
        if (auto done = expect("outer", "loop"); !done) return done;
        for (int i = 0; i < 3; ++i)
            if (auto done = read_vertex(); !done) return done;
        if (auto done = expect("endloop", ""); !done) return done;
        return expect("endfacet", "");
    }

    Result<void> read_vertex() {
        if (auto done = next_line(); !done) return done;
        Words words(lines_.text());
        if (!is_keyword(words.next(), "vertex")) return not_expected("vertex");
        const auto position = parse_position(words, spot());
        if (!position) return tl::unexpected(position.error());
        if (!words.empty()) return bad_syntax("A vertex has more than three coordinates.");
        soup_.corners.push_back(*position);
        soup_.spots.push_back(spot());
        return check_finite(*position, spot());
    }

    /// The next line has these words and no others.
    Result<void> expect(std::string_view first, std::string_view second) {
        if (auto done = next_line(); !done) return done;
        Words words(lines_.text());
        if (is_keyword(words.next(), first) && is_keyword(words.next(), second) && words.empty()) return {};
        return not_expected(fmt::format("{}{}{}", first, second.empty() ? "" : " ", second));
    }

    Result<void> next_line() {
        if (lines_.next_with_words()) return {};
        return bad_syntax("The file ends before \"endsolid\".");
    }

    tl::unexpected<Error> not_expected(std::string_view expected) const {
        return bad_syntax(
            fmt::format("The line is {} where {} is due.", in_quotes(Words(lines_.text()).rest()), expected));
    }
    tl::unexpected<Error> bad_syntax(std::string sentence) const {
        return fail_at(spot(), ErrorCode::BadSyntax, std::move(sentence));
    }
    Spot spot() const { return {std::max(1LL, lines_.number()), 0}; }

    LineReader lines_;
    Soup soup_;
    std::string description_;
};

/// The number of triangles of a binary file.  Requires kTrianglesAt bytes.
std::uint32_t triangle_count(std::string_view bytes) {
    return load<std::uint32_t>(bytes.substr(kCountAt), std::endian::little);
}

std::uint64_t binary_size(std::uint32_t triangles) {
    return kTrianglesAt + std::uint64_t{kTriangleBytes} * triangles;
}

/// True where the size is exactly what the number of triangles asks for.  No text passes: its four characters
/// there would ask for gigabytes.  Binary files may well begin with "solid".
bool is_binary(std::string_view bytes) {
    return bytes.size() >= kTrianglesAt && bytes.size() == binary_size(triangle_count(bytes));
}

bool is_text(std::string_view bytes) {
    LineReader lines(bytes);
    if (!lines.next_with_words()) return false;
    return is_keyword(Words(lines.text()).next(), "solid") &&
           bytes.substr(0, kTrianglesAt).find('\0') == std::string_view::npos;
}

Result<Model> parse_binary(std::string_view bytes) {
    const std::size_t triangles = triangle_count(bytes);
    Soup soup;
    for (std::size_t f = 0; f < triangles; ++f) {
        const std::size_t face = kTrianglesAt + kTriangleBytes * f;
        soup.face_spots.push_back({0, face});
        for (std::size_t i = 0; i < 3; ++i) {
            const Spot spot{0, face + kNormalBytes * (i + 1)};
            glm::dvec3 position;
            for (int k = 0; k < 3; ++k)
                position[k] = static_cast<double>(load<float>(
                    bytes.substr(spot.byte + 4 * static_cast<std::size_t>(k)), std::endian::little));
            if (auto good = check_finite(position, spot); !good) return hand_on(good);
            soup.corners.push_back(position);
            soup.spots.push_back(spot);
        }
    }
    return make_model(soup, {});
}

/// Why this is neither a text nor a binary file.
tl::unexpected<Error> neither(std::string_view bytes) {
    if (bytes.size() < kTrianglesAt)
        return fail(
            ErrorCode::BadSyntax,
            fmt::format("The file neither begins with \"solid\" nor has the {} bytes of a binary header.",
                        kTrianglesAt));
    return fail(ErrorCode::BadSyntax,
                fmt::format("A binary file of {} triangles has {} bytes, but this one has {}.",
                            triangle_count(bytes), binary_size(triangle_count(bytes)), bytes.size()));
}

/// The unit normal of a triangle, counter-clockwise; 0 where it has none.  Scaled first, so that nothing
/// overflows and little underflows.
glm::dvec3 unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto scaled = [](const glm::dvec3& v, double scale) { return scale > 0 ? v / scale : v; };
    const auto largest = [](const glm::dvec3& v) {
        return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    };
    const double scale = std::max({largest(a), largest(b), largest(c)});
    const glm::dvec3 ab = scaled(b, scale) - scaled(a, scale);
    const glm::dvec3 ac = scaled(c, scale) - scaled(a, scale);
    const glm::dvec3 normal = glm::cross(scaled(ab, largest(ab)), scaled(ac, largest(ac)));
    const double length = glm::length(scaled(normal, largest(normal)));
    return length > 0 ? scaled(normal, largest(normal)) / length + 0.0 : glm::dvec3(0);
}

std::vector<std::string> warnings_of(const MeshData& data) {
    std::vector<std::string> warnings;
    std::vector<bool> used(data.positions.size());
    for (const Index corner : data.face_corners) used[static_cast<std::size_t>(corner)] = true;
    if (const auto isolated = std::count(used.begin(), used.end(), false); isolated > 0)
        warnings.push_back(fmt::format("STL has no vertices without a face: {} lost.", isolated));
    warnings.push_back(fmt::format(
        "STL cannot say which faces share a vertex: a reader has to merge the {} corners by their "
        "coordinates.",
        data.face_corners.size()));
    const std::vector<std::size_t> first = first_equals(data.positions);
    std::size_t repeated = 0;
    for (std::size_t v = 0; v < first.size(); ++v) repeated += first[v] != v ? 1 : 0;
    if (repeated > 0)
        warnings.push_back(
            fmt::format("STL makes one vertex of those with equal coordinates: {} lost.", repeated));
    return warnings;
}

void append_facet(std::string& text, const std::array<glm::dvec3, 3>& corners) {
    text += "facet normal ";
    append_position(text, unit_normal(corners[0], corners[1], corners[2]));
    text += "\n  outer loop\n";
    for (const glm::dvec3& corner : corners) {
        text += "    vertex ";
        append_position(text, corner);
        text += '\n';
    }
    text += "  endloop\nendfacet\n";
}

}  // namespace

Result<Model> parse_stl(std::string_view bytes) {
    if (is_binary(bytes)) return parse_binary(bytes);
    if (is_text(bytes)) return TextReader(bytes).read();
    return neither(bytes);
}

Result<Written> format_stl(const Model& model) {
    const MeshData& data = model.data;
    for (std::size_t f = 0; f < data.face_sizes.size(); ++f)
        if (data.face_sizes[f] != 3)
            return fail(
                ErrorCode::Unsupported,
                fmt::format("STL has triangles only, but the face has {} corners.", data.face_sizes[f]),
                {Place::Kind::Face, static_cast<Index>(f)});
    Written written{"", lost_tags(model, "STL")};
    append_description(written.bytes, "solid", model.description);
    if (written.bytes.empty()) written.bytes = "solid\n";
    for_each_face(data, [&](std::size_t, std::span<const Index> corners) {
        const auto position = [&](std::size_t i) {
            return data.positions[static_cast<std::size_t>(corners[i])];
        };
        append_facet(written.bytes, {position(0), position(1), position(2)});
    });
    written.bytes += "endsolid\n";
    for (std::string& warning : warnings_of(data)) written.warnings.push_back(std::move(warning));
    return written;
}

}  // namespace loopcheck::core
