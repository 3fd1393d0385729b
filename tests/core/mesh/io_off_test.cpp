#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/io/model.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::line;
using tests::value_of;
using Indices = std::vector<Index>;

Result<Model> parse(std::string_view text) {
    return parse_model(FileFormat::Off, text);
}
Model read(std::string_view text) {
    return value_of(parse(text));
}
void expect_error(const std::string& text, ErrorCode code, std::int64_t number,
                  const std::string& part = "") {
    const Error error = error_of(parse(text));
    EXPECT_EQ(error.code, code) << text;
    EXPECT_EQ(error.place, line(number)) << text << error.sentence;
    EXPECT_TRUE(contains(error.sentence, part)) << error.sentence;
}

TEST(OffReader, ReadsVerticesAndFaces) {
    const Model model = read("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1e-1 0\n3 0 1 2\n0\n");
    ASSERT_EQ(model.data.positions.size(), 3u);
    EXPECT_EQ(model.data.positions[2], glm::dvec3(0, 0.1, 0));
    EXPECT_EQ(model.data.face_sizes, (Indices{3, 0}));
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2}));
    EXPECT_EQ(model.vertex_lines, (Indices{3, 4, 5}));
    EXPECT_EQ(model.face_lines, (Indices{6, 7}));
    EXPECT_TRUE(model.warnings.empty());
}

TEST(OffReader, PassesOverCommentsAndEmptyLines) {
    const Model model =
        read("\xEF\xBB\xBF# A point\r\nOFF # header\r\n\r\n1 0 0 # counts\r\n# here\r\n0 0 0 # it is");
    EXPECT_EQ(model.data.positions.size(), 1u);
    EXPECT_EQ(model.description, "A point");
    EXPECT_EQ(model.vertex_lines, Indices{6});
}

TEST(OffReader, TakesTheCountsFromTheHeaderLineAndDoesWithoutEdges) {
    EXPECT_EQ(read("OFF 1 0 0\n0 0 0\n").data.positions.size(), 1u);
    EXPECT_EQ(read("OFF\n1 0\n0 0 0\n").data.positions.size(), 1u);
}

TEST(OffReader, IgnoresWhatTheHeaderLettersAnnounce) {
    const struct {
        const char* header;
        const char* numbers;
    } variants[] = {{"COFF", " 9 9 9"},        {"COFF", " 9 9 9 9"}, {"NOFF", " 9 9 9"},
                    {"CNOFF", " 9 9 9 9 9 9"}, {"STOFF", " 9 9"},    {"STCNOFF", " 9 9 9 9 9 9 9 9 9"}};
    for (const auto& [header, numbers] : variants) {
        const Model model = read(std::string(header) + "\n1 0 0\n1 2 3" + numbers + "\n");
        ASSERT_EQ(model.data.positions.size(), 1u) << header;
        EXPECT_EQ(model.data.positions[0], glm::dvec3(1, 2, 3));
        ASSERT_EQ(model.warnings.size(), 1u);
        EXPECT_TRUE(contains(model.warnings[0], "once, in line 3"));
    }
}

TEST(OffReader, RefusesNumbersThatTheHeaderDoesNotAnnounce) {
    expect_error("OFF\n1 0 0\n1 2 3 4\n", ErrorCode::BadSyntax, 3, "4 numbers, but the header asks for 3.");
    expect_error("OFF\n2 0 0\n1 2 3 4 5 6\n", ErrorCode::BadSyntax, 3);
    expect_error("COFF\n1 0 0\n1 2 3\n", ErrorCode::BadSyntax, 3, "asks for 6 or 7");
    expect_error("NOFF\n1 0 0\n1 2 3 4 5\n", ErrorCode::BadSyntax, 3);
    expect_error("COFF\n1 0 0\n1 2 3 4 5 x\n", ErrorCode::BadSyntax, 3);
}

TEST(OffReader, IgnoresColoursOfFaces) {
    const std::string head = "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n";
    const Model model = read(head + "3 0 1 2 7\n3 0 1 2\n3 0 1 2 .1 .2 .3 1\n");
    EXPECT_EQ(model.data.face_sizes, (Indices{3, 3, 3}));
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_TRUE(contains(model.warnings[0], "2 times, first in line 6")) << model.warnings[0];
    expect_error(head + "3 0 1 2 1 2 3 4 5\n", ErrorCode::BadSyntax, 6);
    expect_error(head + "3 0 1 2 red\n", ErrorCode::BadSyntax, 6);
}

TEST(OffReader, RefusesOtherHeaders) {
    for (const char* header : {"4OFF", "nOFF", "NCOFF", "OFFX", "off", "OBJ", "3"})
        expect_error(std::string(header) + "\n0 0 0\n", ErrorCode::BadSyntax, 1);
    expect_error("", ErrorCode::BadSyntax, 1);
    expect_error("OFF BINARY\n", ErrorCode::BadSyntax, 1, "Binary OFF");
    expect_error("OFF\n", ErrorCode::BadSyntax, 1);
}

TEST(OffReader, RefusesBadCounts) {
    for (const char* counts : {"3", "x 1 0", "-1 1 0", "1 -1 0", "1.0 1 0", "1 1 x", "1 1 0 0"})
        expect_error(std::string("OFF\n") + counts + "\n", ErrorCode::BadSyntax, 2);
    expect_error("OFF\n2147483648 0 0\n0 0 0\n", ErrorCode::TooLarge, 2);
    expect_error("OFF\n0 2147483648 0\n", ErrorCode::TooLarge, 2);
    expect_error("OFF\n2147483647 2147483647 0\n0 0 0\n", ErrorCode::BadSyntax, 3, "ends after 1 and 0");
}

TEST(OffReader, SaysBothNumbersWhereACountIsWrong) {
    expect_error("OFF\n2 1 0\n0 0 0\n1 0 0\n", ErrorCode::BadSyntax, 4,
                 "announces 2 vertices and 1 faces, but ends after 2 and 0");
    expect_error("OFF\n1 1 0\n0 0 0\n1 0\n1 0\n1 0\n", ErrorCode::BadSyntax, 5,
                 "2 lines together, but has 4");
}

TEST(OffReader, RefusesBadFaces) {
    const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
    for (const char* face : {"x", "-1 0 1 2", "4 0 1 2", "99999999999 0 1 2", "3 0 1 x", "3 0 1 1.5"})
        expect_error(head + face + "\n", ErrorCode::BadSyntax, 6);
    expect_error(head + "3 0 1 3\n", ErrorCode::IndexOutOfRange, 6, "index 3, but there are 3 vertices");
    expect_error(head + "3 0 1 -1\n", ErrorCode::IndexOutOfRange, 6);
}

TEST(OffReader, RefusesBadCoordinates) {
    expect_error("OFF\n1 0 0\n0 1e999 0\n", ErrorCode::NotFinite, 3);
    expect_error("OFF\n1 0 0\n0 0 nan\n", ErrorCode::NotFinite, 3);
    expect_error("OFF\n1 0 0\n0 0\n", ErrorCode::BadSyntax, 3);
    expect_error("OFF\n1 0 0\n0 0 z\n", ErrorCode::BadSyntax, 3);
}

TEST(OffWriter, WarnsOfTagsAndWritesTheRest) {
    Model model = read("OFF\n3 2 0\n0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n2 1 0\n");
    EXPECT_EQ(value_of(format_model(FileFormat::Off, model)).warnings.size(), 0u);
    model.description = "Three\npoints";
    model.data.creases = {{0, 1, 1.0f}, {1, 2, 1.0f}};
    model.data.corners = {{0, 1.0f}};
    model.data.holes = {1};
    model.boundary = BoundaryRule::None;
    model.creasing = Creasing::Uniform;
    const Written written = value_of(format_model(FileFormat::Off, model));
    EXPECT_EQ(written.bytes, "OFF\n# Three points\n3 2 0\n0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n2 1 0\n");
    ASSERT_EQ(written.warnings.size(), 5u);
    EXPECT_EQ(written.warnings[0], "OFF cannot say which edges are creases: 2 lost.");
    EXPECT_EQ(read(written.bytes).description, "Three points");
}

}  // namespace
}  // namespace loopcheck::core
