#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/bytes.h"
#include "core/mesh/io/model.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::kNoPlace;
using tests::line;
using tests::value_of;
using Indices = std::vector<Index>;

Result<Model> parse(std::string_view bytes) {
    return parse_model(FileFormat::Ply, bytes);
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

/// A header whose element lines are given; the data begin in the line after `end_header`.
std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}
/// The element lines of vertices and triangles in the usual types.
std::string usual(int vertices, int faces) {
    return "element vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\n";
}

TEST(PlyReader, ReadsText) {
    const Model model = read(header("ascii", usual(3, 2)) + "0 0 0\n1 0 0\n\n0 0.1 0\n3 0 1 2\n0\n");
    ASSERT_EQ(model.data.positions.size(), 3u);
    EXPECT_EQ(model.data.positions[2].y, 0.1) << "the nearest double, although the property is a float";
    EXPECT_EQ(model.data.face_sizes, (Indices{3, 0}));
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2}));
    EXPECT_EQ(model.vertex_lines, (Indices{10, 11, 13}));
    EXPECT_EQ(model.face_lines, (Indices{14, 15}));
    EXPECT_TRUE(model.warnings.empty());
}

template <class... Numbers>
std::string packed(std::endian order, Numbers... numbers) {
    std::string bytes;
    (append(bytes, numbers, order), ...);
    return bytes;
}

TEST(PlyReader, ReadsBinaryOfBothByteOrders) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        const char* format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
        const Model model =
            read(header(format, usual(2, 1)) + packed(order, 0.1f, -0.0f, 1e30f, 1.f, 2.f, 3.f) +
                 packed(order, std::uint8_t{3}, 0, 1, 0));
        ASSERT_EQ(model.data.positions.size(), 2u);
        EXPECT_EQ(model.data.positions[0].x, static_cast<double>(0.1f));
        EXPECT_TRUE(std::signbit(model.data.positions[0].y));
        EXPECT_EQ(model.data.positions[1], glm::dvec3(1, 2, 3));
        EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 0}));
        EXPECT_TRUE(model.vertex_lines.empty());
        EXPECT_TRUE(model.face_lines.empty());
    }
}

TEST(PlyReader, ReadsEveryTypeOfNumber) {
    const std::string elements =
        "element vertex 3\nproperty int8 x\nproperty ushort y\nproperty float64 z\n"
        "element face 1\nproperty list int16 uint32 vertex_index\n";
    constexpr std::endian kBig = std::endian::big;
    const Model model = read(
        header("binary_big_endian", elements) + packed(kBig, std::int8_t{-3}, std::uint16_t{65535}, 0.1) +
        packed(kBig, std::int8_t{0}, std::uint16_t{0}, 5e-324) +
        packed(kBig, std::int8_t{1}, std::uint16_t{2}, -0.0) +
        packed(kBig, std::int16_t{3}, std::uint32_t{2}, std::uint32_t{1}, std::uint32_t{0}));
    ASSERT_EQ(model.data.positions.size(), 3u);
    EXPECT_EQ(model.data.positions[0], glm::dvec3(-3, 65535, 0.1));
    EXPECT_EQ(model.data.positions[1].z, 5e-324);
    EXPECT_EQ(model.data.face_corners, (Indices{2, 1, 0}));
}

TEST(PlyReader, SkipsOtherPropertiesAndElements) {
    const std::string elements =
        "comment First\ncomment Second\nobj_info none\nelement nothing 4000000000000\nelement camera 1\n"
        "property list uchar float view\nproperty int id\nelement vertex 2\nproperty uchar red\nproperty "
        "float z\n"
        "property float y\nproperty list uchar short neighbours\nproperty float x\nelement face 1\nproperty "
        "float q\n"
        "property list uchar int vertex_indices\nproperty list uint double weights\nelement edge 1\nproperty "
        "int a\n";
    const Model text =
        read(header("ascii", elements) + "2 .5 .5 7\n255 3 2 2 8 9 1\n0 3 2 0 1\n.5 2 0 1 1 .5\n7\n");
    constexpr std::endian kLittle = std::endian::little;
    const Model binary = read(
        header("binary_little_endian", elements) + packed(kLittle, std::uint8_t{2}, .5f, .5f, 7) +
        packed(kLittle, std::uint8_t{255}, 3.f, 2.f, std::uint8_t{2}, std::int16_t{8}, std::int16_t{9}, 1.f) +
        packed(kLittle, std::uint8_t{0}, 3.f, 2.f, std::uint8_t{0}, 1.f) +
        packed(kLittle, .5f, std::uint8_t{2}, 0, 1, std::uint32_t{1}, .5, 7));
    for (const Model* model : {&text, &binary}) {
        ASSERT_EQ(model->data.positions.size(), 2u);
        EXPECT_EQ(model->data.positions[0], glm::dvec3(1, 2, 3));
        EXPECT_EQ(model->data.face_corners, (Indices{0, 1}));
        EXPECT_EQ(model->description, "First");
        ASSERT_EQ(model->warnings.size(), 2u);
        EXPECT_TRUE(contains(model->warnings[0], "\"red\", \"neighbours\", \"q\", \"weights\""))
            << model->warnings[0];
        EXPECT_TRUE(contains(model->warnings[1], "\"nothing\", \"camera\", \"edge\"")) << model->warnings[1];
    }
}

TEST(PlyReader, ReadsFacesBeforeVertices) {
    const std::string elements =
        "element face 1\nproperty list uchar int vertex_indices\nelement vertex 1\nproperty int x\nproperty "
        "int y\n"
        "property int z\n";
    EXPECT_EQ(read(header("ascii", elements) + "2 0 0\n1 2 3\n").data.face_corners, (Indices{0, 0}));
    expect_error(header("ascii", elements) + "2 0 1\n1 2 3\n", ErrorCode::IndexOutOfRange, line(10));
}

TEST(PlyReader, ReadsAFileWithoutFaces) {
    const std::string elements = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_EQ(read(header("ascii", elements) + "1 2 3").data.positions.size(), 1u);
}

TEST(PlyReader, ReadsHeadersWithOtherLineEnds) {
    std::string head = header("binary_little_endian", usual(1, 0));
    for (std::size_t at = 0; (at = head.find('\n', at)) != std::string::npos; at += 2) head.insert(at, "\r");
    const Model model = read(head + packed(std::endian::little, 1.f, 2.f, 3.f) + "\n");
    ASSERT_EQ(model.data.positions.size(), 1u);
    EXPECT_EQ(model.data.positions[0], glm::dvec3(1, 2, 3));
}

TEST(PlyReader, RefusesBadHeaders) {
    const std::string format = "ply\nformat ascii 1.0\n";
    const std::string vertex = "element vertex 0\nproperty int x\nproperty int y\nproperty int z\n";
    const struct {
        std::string text;
        int number;
    } headers[] = {
        {"", 1},
        {"plx\n", 1},
        {"ply", 1},
        {format, 2},
        {"ply\nformat ascii 1.1\n", 2},
        {"ply\nformat ebcdic 1.0\n", 2},
        {"ply\n" + vertex + "end_header\n", 6},
        {format + "end_header\n", 3},
        {format + "color 1\n", 3},
        {format + "property int x\n", 3},
        {format + "element vertex\n", 3},
        {format + "element vertex 1 2\n", 3},
        {format + "element vertex -1\n", 3},
        {format + "element edge x\n", 3},
        {format + "element edge -1\n", 3},
        {format + vertex + "element vertex 0\n", 7},
        {format + vertex + "property int64 w\n", 7},
        {format + vertex + "property int\n", 7},
        {format + vertex + "property int a b\n", 7},
        {format + vertex + "property list float int a\n", 7},
        {format + vertex + "property list int a\n", 7},
        {format + "element vertex 0\nproperty int x\nproperty int y\nend_header\n", 6},
        {format + "element vertex 0\nproperty list int int x\nend_header\n", 5},
        {format + vertex + "element face 0\nend_header\n", 8},
        {format + vertex + "element face 0\nproperty int vertex_indices\nend_header\n", 9},
        {format + vertex + "element face 0\nproperty list int float vertex_indices\nend_header\n", 9}};
    for (const auto& [text, number] : headers) expect_error(text, ErrorCode::BadSyntax, line(number));
    expect_error(format + "element vertex 2147483648\n", ErrorCode::TooLarge, line(3));
    expect_error(format + "element face 2147483648\n", ErrorCode::TooLarge, line(3));
}

TEST(PlyReader, RefusesTextThatDoesNotFitTheHeader) {
    const std::string head = header("ascii", usual(1, 1));
    expect_error(head, ErrorCode::BadSyntax, line(9),
                 "announces 1 of the element \"vertex\", but ends after 0");
    expect_error(head + "0 0 0\n", ErrorCode::BadSyntax, line(10), "\"face\"");
    expect_error(head + "0 0\n", ErrorCode::BadSyntax, line(10));
    expect_error(head + "0 0 x\n", ErrorCode::BadSyntax, line(10));
    expect_error(head + "0 0 0 0\n", ErrorCode::BadSyntax, line(10));
    for (const char* face : {"3 0 0", "x", "-1", "1 0 0", "1 0.5", "1.0 0", "99999999999999 0"})
        expect_error(head + "0 0 0\n" + face + "\n", ErrorCode::BadSyntax, line(11));
    expect_error(head + "0 0 0\n1 0\n1 0\n", ErrorCode::BadSyntax, line(12));
    expect_error(head + "0 0 0\n1 1\n", ErrorCode::IndexOutOfRange, line(11));
    expect_error(head + "0 0 0\n1 -1\n", ErrorCode::IndexOutOfRange, line(11));
    expect_error(head + "0 nan 0\n", ErrorCode::NotFinite, line(10));
    expect_error(head + "0 1e999 0\n", ErrorCode::NotFinite, line(10));
}

TEST(PlyReader, RefusesBinaryThatDoesNotFitTheHeader) {
    constexpr std::endian kLittle = std::endian::little;
    const std::string head = header("binary_little_endian", usual(1, 1));
    const std::string vertex = packed(kLittle, 0.f, 0.f, 0.f);
    const auto at = [](std::size_t byte) { return "Byte " + std::to_string(byte) + ":"; };
    expect_error(head + vertex.substr(1), ErrorCode::BadSyntax, kNoPlace, at(head.size()));
    const std::size_t face = head.size() + vertex.size();
    expect_error(head + vertex, ErrorCode::BadSyntax, kNoPlace, at(face));
    expect_error(head + vertex + packed(kLittle, std::uint8_t{2}, 0), ErrorCode::BadSyntax, kNoPlace,
                 at(face));
    expect_error(head + vertex + packed(kLittle, std::uint8_t{1}, 1), ErrorCode::IndexOutOfRange, kNoPlace,
                 at(face + 1));
    expect_error(head + vertex + packed(kLittle, std::uint8_t{1}, -1), ErrorCode::IndexOutOfRange, kNoPlace);
    expect_error(head + vertex + packed(kLittle, std::uint8_t{1}, 0, 9), ErrorCode::BadSyntax, kNoPlace,
                 at(face + 5));
    const float infinity = std::numeric_limits<float>::infinity();
    expect_error(head + packed(kLittle, 0.f, infinity, 0.f), ErrorCode::NotFinite, kNoPlace, at(head.size()));
}

TEST(PlyReader, DoesNotBelieveTheSizeOfAList) {
    constexpr std::endian kLittle = std::endian::little;
    const std::string elements =
        "element vertex 0\nproperty int x\nproperty int y\nproperty int z\nelement face 1\n";
    const std::string lists[] = {
        header("binary_little_endian", elements + "property list int int vertex_indices\n") +
            packed(kLittle, -1, 0, 0),
        header("binary_little_endian", elements + "property list uint int vertex_indices\n") +
            packed(kLittle, std::uint32_t{4294967295}, 0, 0),
        header("binary_little_endian",
               elements + "property list int double weights\nproperty list int int vertex_indices\n") +
            packed(kLittle, std::numeric_limits<std::int32_t>::max(), 0, 0)};
    for (const std::string& bytes : lists)
        expect_error(bytes, ErrorCode::BadSyntax, kNoPlace, "numbers, but there is room for");
}

TEST(PlyReader, DoesNotBelieveTheCountOfAnElement) {
    const std::string many = "element vertex 2147483647\nproperty int x\nproperty int y\nproperty int z\n";
    const std::string others = "element edge 9223372036854775807\nproperty list uchar int a\n";
    expect_error(header("binary_little_endian", many) + "xx", ErrorCode::BadSyntax, kNoPlace, "ends after 0");
    expect_error(header("binary_big_endian", others + many) + std::string(2, '\0'), ErrorCode::BadSyntax,
                 kNoPlace, "ends after 2");
    expect_error(header("ascii", many) + "0 0 0\n", ErrorCode::BadSyntax, line(8), "ends after 1");
}

Model small_model() {
    Model model = read(header("ascii", usual(3, 2)) + "0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n2 2 1\n");
    model.description = "A\nname";
    return model;
}

TEST(PlyWriter, WritesText) {
    EXPECT_EQ(
        value_of(format_model(FileFormat::Ply, small_model())).bytes,
        "ply\nformat ascii 1.0\ncomment A name\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n2 2 1\n");
}

TEST(PlyWriter, WritesBinaryThatIsReadBackWhole) {
    const Model model = small_model();
    const Model back = read(value_of(format_model(FileFormat::Ply, model, Encoding::Binary)).bytes);
    EXPECT_EQ(back.data.positions, model.data.positions);
    EXPECT_EQ(back.data.face_sizes, model.data.face_sizes);
    EXPECT_EQ(back.data.face_corners, model.data.face_corners);
    EXPECT_EQ(back.description, "A name");
}

TEST(PlyWriter, MakesRoomForFacesOfManyCorners) {
    Model model = small_model();
    model.data.add_face(Indices(300, 1));
    for (const Encoding encoding : {Encoding::Text, Encoding::Binary}) {
        const Model back = read(value_of(format_model(FileFormat::Ply, model, encoding)).bytes);
        EXPECT_EQ(back.data.face_sizes, (Indices{3, 2, 300}));
    }
}

TEST(PlyWriter, WarnsOfTags) {
    Model model = small_model();
    model.data.corners = {{0, 1.0f}};
    const Written written = value_of(format_model(FileFormat::Ply, model, Encoding::Binary));
    ASSERT_EQ(written.warnings.size(), 1u);
    EXPECT_EQ(written.warnings[0], "PLY cannot say which vertices are sharp: 1 lost.");
}

}  // namespace
}  // namespace loopcheck::core
