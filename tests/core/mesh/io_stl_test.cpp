#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/bytes.h"
#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::kNoPlace;
using tests::line;
using tests::value_of;
using Indices = std::vector<Index>;
using Corners = std::vector<std::array<float, 3>>;

Result<Model> parse(std::string_view bytes) {
    return parse_model(FileFormat::Stl, bytes);
}
Model read(std::string_view bytes) {
    return value_of(parse(bytes));
}
void expect_error(const std::string& bytes, ErrorCode code, Place place, const std::string& part = "") {
    const Error error = error_of(parse(bytes));
    EXPECT_EQ(error.code, code) << bytes;
    EXPECT_EQ(error.place, place) << bytes << error.sentence;
    EXPECT_TRUE(contains(error.sentence, part)) << error.sentence;
}

/// A facet of seven lines.
std::string facet(const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
}
const std::string kSquare = "solid A square\n" + facet("0 0 0", "1 0 0", "1 1 0") +
                            facet("1 1 0", "0 1 0", "0 0 -0") + "endsolid A square\n";

std::string binary(const std::string& name, const Corners& corners) {
    std::string bytes = name;
    bytes.resize(80, ' ');
    append(bytes, static_cast<std::uint32_t>(corners.size() / 3), std::endian::little);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (i % 3 == 0) bytes.append(12, '\0');
        for (const float coordinate : corners[i]) append(bytes, coordinate, std::endian::little);
        if (i % 3 == 2) bytes.append(2, '\0');
    }
    return bytes;
}
const Corners kBinarySquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -0.0f}};

TEST(StlReader, MergesEqualCornersInTheOrderOfTheirFirstUse) {
    const Model model = read(kSquare);
    EXPECT_EQ(model.data.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_FALSE(std::signbit(model.data.positions[0].z)) << "-0 equals 0, and the first use counts";
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2, 2, 3, 0}));
    EXPECT_EQ(model.data.face_sizes, (Indices{3, 3}));
    EXPECT_EQ(model.vertex_lines, (Indices{4, 5, 6, 12}));
    EXPECT_EQ(model.face_lines, (Indices{2, 9}));
    EXPECT_EQ(model.description, "A square");
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_TRUE(
        contains(model.warnings[0], "6 corners with equal coordinates were merged into 4 vertices, 2 fewer"));
}

TEST(StlReader, DoesNotMergeNeighbours) {
    const double next = std::nextafter(1.0, 2.0);
    EXPECT_EQ(read("solid\n" + facet("1 0 0", shortest(next) + " 0 0", "5e-324 0 0") + "endsolid\n")
                  .data.positions.size(),
              3u);
}

TEST(StlReader, ReadsBinary) {
    const Model model = read(binary("name", kBinarySquare));
    EXPECT_EQ(model.data.positions.size(), 4u);
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2, 2, 3, 0}));
    EXPECT_TRUE(model.vertex_lines.empty());
}

TEST(StlReader, ReadsBinaryThatBeginsWithSolid) {
    EXPECT_EQ(read(binary("solid name", kBinarySquare)).data.positions.size(), 4u);
}

TEST(StlReader, ReadsSeveralSolidsAndCapitals) {
    const std::string capitals =
        "  SOLID\r\n FACET NORMAL 0 0 1\r\n OUTER LOOP\r\n VERTEX 0 0 0\r\n VERTEX 1 0 0\r\n VERTEX 5 1 "
        "0\r\n ENDLOOP\r\n"
        "ENDFACET\r\nENDSOLID\r\n\r\n";
    const Model model = read(capitals + kSquare);
    EXPECT_EQ(model.data.face_sizes.size(), 3u);
    EXPECT_EQ(model.data.positions.size(), 5u);
    EXPECT_EQ(model.description, "A square") << "the first name there is";
}

TEST(StlReader, ReadsSolidsOfNothing) {
    EXPECT_TRUE(read("solid\nendsolid\n").data.face_sizes.empty());
    EXPECT_TRUE(read(binary("", {})).data.face_sizes.empty());
}

TEST(StlReader, RefusesBinaryOfTheWrongSize) {
    const std::string bytes = binary("", kBinarySquare);
    expect_error(bytes.substr(0, bytes.size() - 1), ErrorCode::BadSyntax, kNoPlace,
                 "2 triangles has 184 bytes, but this one has 183");
    expect_error(bytes + '\0', ErrorCode::BadSyntax, kNoPlace, "has 185");
    expect_error(binary("solid", kBinarySquare) + '\0', ErrorCode::BadSyntax, kNoPlace);
    expect_error("", ErrorCode::BadSyntax, kNoPlace);
    expect_error("v 0 0 0\n", ErrorCode::BadSyntax, kNoPlace, "neither");
    std::string huge(84, '\0');
    huge.replace(80, 4, "\xFF\xFF\xFF\xFF");
    expect_error(huge, ErrorCode::BadSyntax, kNoPlace, "4294967295 triangles");
}

TEST(StlReader, RefusesTextOutOfOrder) {
    const std::string good = facet("0 0 0", "1 0 0", "0 1 0");
    expect_error("solid\n" + good, ErrorCode::BadSyntax, line(8), "ends before \"endsolid\"");
    expect_error("solid\nendsolid\nvertex\n", ErrorCode::BadSyntax, line(3));
    expect_error("solid\nvertex 0 0 0\nendsolid\n", ErrorCode::BadSyntax, line(2));
    expect_error("solid\nfacet\nouter\n", ErrorCode::BadSyntax, line(3), "outer loop");
    expect_error("solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nendloop\n", ErrorCode::BadSyntax,
                 line(6));
    expect_error("solid\nfacet\nouter loop\nvertex 0 0\n", ErrorCode::BadSyntax, line(4));
    expect_error("solid\nfacet\nouter loop\nvertex 0 0 0 0\n", ErrorCode::BadSyntax, line(4));
    expect_error("solid\nfacet\nouter loop\nvertex 0 0 x\n", ErrorCode::BadSyntax, line(4));
    const std::string four = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\n";
    expect_error("solid\nfacet\nouter loop\n" + four, ErrorCode::BadSyntax, line(7));
}

TEST(StlReader, RefusesCoordinatesThatAreNotFinite) {
    expect_error("solid\nfacet\nouter loop\nvertex 0 0 1e999\n", ErrorCode::NotFinite, line(4));
    Corners corners = kBinarySquare;
    corners[4][1] = std::numeric_limits<float>::quiet_NaN();
    expect_error(binary("", corners), ErrorCode::NotFinite, kNoPlace, "Byte 158:");
}

TEST(StlWriter, WritesNormalsOfEverySize) {
    const auto normal = [](const char* a, const char* b, const char* c) {
        const Model model = read("solid\n" + facet(a, b, c) + "endsolid\n");
        const std::string bytes = value_of(format_model(FileFormat::Stl, model)).bytes;
        const std::size_t begin = bytes.find("normal ") + 7;
        return bytes.substr(begin, bytes.find('\n', begin) - begin);
    };
    EXPECT_EQ(normal("0 0 0", "1 0 0", "0 1 0"), "0 0 1");
    EXPECT_EQ(normal("0 0 0", "0 1 0", "1 0 0"), "0 0 -1");
    EXPECT_EQ(normal("-1e308 0 0", "1e308 0 0", "0 0 1e308"), "0 -1 0");
    EXPECT_EQ(normal("0 0 0", "0 5e-324 0", "0 0 5e-324"), "1 0 0");
    EXPECT_EQ(normal("0 0 0", "1 0 0", "0 1e-300 0"), "0 0 1") << "a sliver";
    EXPECT_EQ(normal("0 0 0", "1 1 1", "2 2 2"), "0 0 0");
    EXPECT_EQ(normal("0 0 0", "0 0 0", "0 0 0"), "0 0 0");
}

TEST(StlWriter, RefusesOtherThanTriangles) {
    Model model = read(kSquare);
    model.data.add_face(Indices{0, 1, 2, 3});
    const Error error = error_of(format_model(FileFormat::Stl, model));
    EXPECT_EQ(error.code, ErrorCode::Unsupported);
    EXPECT_EQ(error.place, (Place{Place::Kind::Face, 2}));
}

TEST(StlWriter, WarnsOfWhatIsLost) {
    Model model = read(kSquare);
    EXPECT_EQ(value_of(format_model(FileFormat::Stl, model)).warnings,
              std::vector<std::string>{
                  "STL cannot say which faces share a vertex: a reader has to merge the 6 corners "
                  "by their coordinates."});
    model.data.positions.push_back(model.data.positions[0]);
    model.data.holes = {0};
    const std::vector<std::string> warnings = value_of(format_model(FileFormat::Stl, model)).warnings;
    ASSERT_EQ(warnings.size(), 4u);
    EXPECT_EQ(warnings[0], "STL cannot say which faces are holes: 1 lost.");
    EXPECT_EQ(warnings[1], "STL has no vertices without a face: 1 lost.");
    EXPECT_EQ(warnings[3], "STL makes one vertex of those with equal coordinates: 1 lost.");
}

TEST(StlWriter, IsReadBackWhole) {
    Model model = read(kSquare);
    model.description = "A\nname";
    const Model back = read(value_of(format_model(FileFormat::Stl, model)).bytes);
    EXPECT_EQ(back.data.positions, model.data.positions);
    EXPECT_EQ(back.data.face_corners, model.data.face_corners);
    EXPECT_EQ(back.description, "A name");
}

}  // namespace
}  // namespace loopcheck::core
