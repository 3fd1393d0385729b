#include <gtest/gtest.h>

#include <limits>
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
using Texts = std::vector<std::string>;

Result<Model> parse(std::string_view text) {
    return parse_model(FileFormat::Obj, text);
}
Model read(std::string_view text) {
    return value_of(parse(text));
}
/// After the three vertices in lines 1 to 3.
Result<Model> parse_after_triangle(const std::string& text) {
    return parse("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + text);
}
Model read_after_triangle(const std::string& text) {
    return value_of(parse_after_triangle(text));
}
/// The text is an error of that code at that line.
void expect_error(const std::string& text, ErrorCode code, std::int64_t number) {
    const Error error = error_of(parse_after_triangle(text));
    EXPECT_EQ(error.code, code) << text;
    EXPECT_EQ(error.place, line(number)) << text;
    EXPECT_TRUE(error.sentence.ends_with('.')) << error.sentence;
}

TEST(ObjReader, ReadsVerticesAndFaces) {
    const Model model = read("v 1 2 3\nv -0.5 1e2 .5\nv 0 0 +1\nf 1 2 3\n");
    ASSERT_EQ(model.data.positions.size(), 3u);
    EXPECT_EQ(model.data.positions[1], glm::dvec3(-0.5, 100, 0.5));
    EXPECT_EQ(model.data.face_sizes, Indices{3});
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2}));
    EXPECT_EQ(model.vertex_lines, (Indices{1, 2, 3}));
    EXPECT_EQ(model.face_lines, Indices{4});
    EXPECT_TRUE(model.warnings.empty());
}

TEST(ObjReader, CountsNegativeIndicesFromTheEnd) {
    const Model model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nf -1 -2 2\n");
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2, 3, 2, 1}));
}

TEST(ObjReader, LetsAFaceNameAVertexThatComesLater) {
    EXPECT_EQ(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").data.face_corners, (Indices{0, 1, 2}));
}

TEST(ObjReader, TakesTheVertexOfEveryFormOfCorner) {
    EXPECT_EQ(read_after_triangle("f 1 2/5 3//7\n").data.face_corners, (Indices{0, 1, 2}));
    EXPECT_EQ(read_after_triangle("f 1/2/3 2/-1/-1 -1// 1/\n").data.face_corners, (Indices{0, 1, 2, 0}));
}

TEST(ObjReader, KeepsFacesOfEverySize) {
    const Model model = read_after_triangle("f 1 2 3 1 2\nf\nf 1\nf 1 2\n");
    EXPECT_EQ(model.data.face_sizes, (Indices{5, 0, 1, 2}));
}

TEST(ObjReader, RefusesIndicesOfVerticesThatAreNotThere) {
    expect_error("f 1 2 4\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("f 1 2 3\nf 1 2 3 9\nv 0 0 0\n", ErrorCode::IndexOutOfRange, 5);
    expect_error("f 0 1 2\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("f -4 1 2\nv 0 0 0\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("f 1 2 3000000000\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("f 1 2 -9223372036854775808\n", ErrorCode::IndexOutOfRange, 4);
    EXPECT_EQ(error_of(parse_after_triangle("f 1 2 9")).sentence,
              "A face has the index 9, but there are 3 vertices.");
}

TEST(ObjReader, RefusesCornersThatAreNoIndices) {
    for (const char* corner : {"x", "1.5", "/1", "1/2/3/4", "1/x", "1//y", "99999999999999999999"})
        expect_error(std::string("f 1 2 ") + corner + "\n", ErrorCode::BadSyntax, 4);
}

TEST(ObjReader, RefusesVerticesWithTooFewOrStrayNumbers) {
    expect_error("v 1 2\n", ErrorCode::BadSyntax, 4);
    expect_error("v\n", ErrorCode::BadSyntax, 4);
    expect_error("v 1 2 x\n", ErrorCode::BadSyntax, 4);
    expect_error("v 1 2 3 4 5\n", ErrorCode::BadSyntax, 4);
    expect_error("v 1 2 3 4 5 6 7 8\n", ErrorCode::BadSyntax, 4);
    expect_error("v 1 2 3 x\n", ErrorCode::BadSyntax, 4);
}

TEST(ObjReader, RefusesCoordinatesThatAreNotFinite) {
    for (const char* coordinate : {"nan", "inf", "-Infinity", "1e999", "-1e400"})
        expect_error(std::string("v 0 ") + coordinate + " 0\n", ErrorCode::NotFinite, 4);
}

TEST(ObjReader, WarnsOnceOfWeightsAndOfColours) {
    const Model model = read("v 1 0 0 1\nv 0 1 0 .1 .2 .3\nv 0 0 1 2\nv 1 1 1 1 .1 .2 .3\nv 0 0 0 0.5\n");
    EXPECT_EQ(model.data.positions[2], glm::dvec3(0, 0, 1)) << "not divided by the weight";
    ASSERT_EQ(model.warnings.size(), 2u);
    EXPECT_TRUE(contains(model.warnings[0], "weight w other than 1")) << model.warnings[0];
    EXPECT_TRUE(contains(model.warnings[0], "2 times, first in line 3")) << model.warnings[0];
    EXPECT_TRUE(contains(model.warnings[1], "3 times, first in line 1")) << model.warnings[1];
}

TEST(ObjReader, SkipsWhatIsNotTheSurface) {
    const Model model =
        read_after_triangle("vt 0 0\nvn 0 0 1\nvp 1\no x\ng a b\ns off\nusemtl m\nmtllib l\nl 1 2\np 1\n");
    EXPECT_EQ(model.data.positions.size(), 3u);
    EXPECT_TRUE(model.warnings.empty());
}

TEST(ObjReader, WarnsOncePerUnknownKeyword) {
    const Model model = read("foo 1\nbar\nfoo 2\n");
    EXPECT_EQ(model.warnings,
              (Texts{"The keyword \"foo\" is unknown and was skipped (2 times, first in line 1).",
                     "The keyword \"bar\" is unknown and was skipped (once, in line 2)."}));
}

TEST(ObjReader, KeepsTheWarningsOfGarbageShort) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "\x01word" + std::string(100, 'w') + std::to_string(i) + "\n";
    const Model model = read(text);
    EXPECT_EQ(model.warnings.size(), 21u);
    for (const std::string& warning : model.warnings) {
        EXPECT_LT(warning.size(), 150u);
        EXPECT_EQ(warning.find('\x01'), std::string::npos);
    }
}

TEST(ObjReader, ReadsEveryKindOfLine) {
    const Model model =
        read("\xEF\xBB\xBFv 0 0 0\r\n\tv\t1 0\v0  # a comment\r\n\r\n  v 0 1 \\\r\n 0\r\nf 1 2\\\n3");
    ASSERT_EQ(model.data.positions.size(), 3u);
    EXPECT_EQ(model.data.positions[2], glm::dvec3(0, 1, 0));
    EXPECT_EQ(model.data.face_corners, (Indices{0, 1, 2}));
    EXPECT_EQ(model.vertex_lines, (Indices{1, 2, 4}));
    EXPECT_EQ(model.face_lines, Indices{6});
    EXPECT_EQ(read("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").face_lines, Indices{4});
    EXPECT_EQ(read("v 0 0 0\\").data.positions.size(), 1u);
    EXPECT_EQ(read("# a comment \\\nv 0 0 0").data.positions.size(), 1u) << "a comment is not continued";
}

TEST(ObjReader, TakesTheFirstCommentLineAsTheDescription) {
    EXPECT_EQ(read("v 0 0 0 # no\n####\n#\n #  A cube, # 1. \n# More\n").description, "A cube, # 1.");
    EXPECT_EQ(read("v 0 0 0\n").description, "");
}

TEST(ObjReader, ReadsAnEmptyFile) {
    EXPECT_TRUE(read("").data.positions.empty());
    EXPECT_TRUE(read("\n\n").data.face_sizes.empty());
}

TEST(ObjTags, GivesOneSharpnessToAllPairsOrOneToEach) {
    const Model one = read_after_triangle("f 1 2 3\nt crease 4/1/0 0 1 1 2 1.5\n");
    ASSERT_EQ(one.data.creases.size(), 2u);
    EXPECT_EQ(one.data.creases[1].a, 1);
    EXPECT_EQ(one.data.creases[1].b, 2);
    EXPECT_EQ(one.data.creases[1].sharpness, 1.5f);
    const Model each = read_after_triangle("t crease 4/2/0 0 1 1 2 1.5 inf\n");
    EXPECT_EQ(each.data.creases[0].sharpness, 1.5f);
    EXPECT_EQ(each.data.creases[1].sharpness, std::numeric_limits<float>::infinity());
    EXPECT_TRUE(read_after_triangle("t crease 0/0/0\n").data.creases.empty());
}

TEST(ObjTags, ReadsCornersAndHolesCountedFromZero) {
    const Model model = read_after_triangle(
        "t corner 2/1/0 0 2 3\nt corner 2/2/0 0 1 .1 .2\nt hole 2/0/0 0 1\nf 1 2 3\nf 1 3 2");
    ASSERT_EQ(model.data.corners.size(), 4u);
    EXPECT_EQ(model.data.corners[1].vertex, 2);
    EXPECT_EQ(model.data.corners[1].sharpness, 3.0f);
    EXPECT_EQ(model.data.corners[3].sharpness, 0.2f) << "rounded once, to float";
    EXPECT_EQ(model.data.holes, (Indices{0, 1}));
}

TEST(ObjTags, ReadsTheBoundaryRuleAndTheCreasing) {
    EXPECT_EQ(read("t interpolateboundary 1/0/0 0").boundary, BoundaryRule::None);
    EXPECT_EQ(read("t interpolateboundary 1/0/0 1").boundary, BoundaryRule::EdgeAndCorner);
    EXPECT_EQ(read("t interpolateboundary 1/0/0 2").boundary, BoundaryRule::EdgeOnly);
    EXPECT_EQ(read("t creasemethod 0/0/1 normal").creasing, Creasing::Uniform);
    EXPECT_EQ(read("t creasemethod 0/0/1 uniform").creasing, Creasing::Uniform);
    EXPECT_EQ(read("t creasemethod 0/0/1 chaikin").creasing, Creasing::Chaikin);
    EXPECT_FALSE(read("").boundary);
    EXPECT_FALSE(read("").creasing);
}

TEST(ObjTags, RefusesTheWrongNumberOfArguments) {
    for (const char* tag : {"",
                            "crease",
                            "crease 2/1",
                            "crease 2/1/0",
                            "crease 2/1/0 0 1",
                            "crease 2/1/0 0 1 1 1",
                            "crease x/1/0 1",
                            "crease -2/1/0 1",
                            "crease 3/1/0 0 1 2 1",
                            "crease 2/0/0 0 1",
                            "crease 4/3/0 0 1 1 2 1 1 1",
                            "crease 2/1/1 0 1 1 x",
                            "crease 2/1/0 0 1.5 1",
                            "crease 2/1/0 0 1 x",
                            "corner 2/3/0 0 1 1 1 1",
                            "corner 1/0/0 0",
                            "hole 1/1/0 0 1",
                            "hole 0/0/1 x",
                            "interpolateboundary 2/0/0 1 1",
                            "interpolateboundary 0/0/0",
                            "interpolateboundary 1/0/0 3",
                            "interpolateboundary 1/0/0 -1",
                            "creasemethod 0/0/1 cubic",
                            "creasemethod 1/0/0 1",
                            "crease 9223372036854775807/9223372036854775807/9223372036854775807 0 1"})
        expect_error(std::string("t ") + tag + "\n", ErrorCode::BadSyntax, 4);
}

TEST(ObjTags, RefusesBadSharpness) {
    for (const char* sharpness : {"nan", "-1", "-inf", "-1e-9"}) {
        expect_error(std::string("t crease 2/1/0 0 1 ") + sharpness + "\n", ErrorCode::BadSharpness, 4);
        expect_error(std::string("t corner 1/1/0 0 ") + sharpness + "\n", ErrorCode::BadSharpness, 4);
    }
    EXPECT_EQ(read_after_triangle("t corner 1/1/0 0 1e39").data.corners[0].sharpness,
              std::numeric_limits<float>::infinity());
}

TEST(ObjTags, RefusesIndicesOfWhatIsNotThere) {
    expect_error("t crease 2/1/0 -1 1 1\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("t crease 2/1/0 0 3 1\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("\nt corner 1/1/0 3 1\n", ErrorCode::IndexOutOfRange, 5);
    expect_error("t corner 1/1/0 9000000000 1\n", ErrorCode::IndexOutOfRange, 4);
    expect_error("f 1 2 3\nt hole 1/0/0 1\n", ErrorCode::HoleOutOfRange, 5);
}

TEST(ObjTags, WarnsOncePerUnknownTag) {
    const Model model = read("t vertexedit 1/0/0 1\nt vertexedit\nt smoothtriangles 0/0/1 x\n");
    EXPECT_EQ(model.warnings,
              (Texts{"The tag \"vertexedit\" is unknown and was skipped (2 times, first in line 1).",
                     "The tag \"smoothtriangles\" is unknown and was skipped (once, in line 3)."}));
}

Model everything() {
    Model model = read_after_triangle("v 1 1 1\nf 1 2 3\nf 2 4 3\nf 1 2 3 4\n");
    model.data.creases = {{0, 1, 0.1f}, {1, 2, std::numeric_limits<float>::infinity()}};
    model.data.corners = {{3, 2.5f}};
    model.data.holes = {1, 2};
    model.boundary = BoundaryRule::EdgeOnly;
    model.creasing = Creasing::Chaikin;
    model.description = "A test";
    return model;
}

TEST(ObjWriter, SaysEverything) {
    const Written written = value_of(format_model(FileFormat::Obj, everything()));
    EXPECT_TRUE(written.warnings.empty());
    EXPECT_EQ(written.bytes,
              "# A test\n"
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n"
              "f 1 2 3\nf 2 4 3\nf 1 2 3 4\n"
              "t crease 2/1/0 0 1 0.1\nt crease 2/1/0 1 2 inf\n"
              "t corner 1/1/0 3 2.5\n"
              "t hole 1/0/0 1\nt hole 1/0/0 2\n"
              "t interpolateboundary 1/0/0 2\n"
              "t creasemethod 0/0/1 chaikin\n");
}

TEST(ObjWriter, IsReadBackWhole) {
    const Model model = everything();
    const Model back = read(value_of(format_model(FileFormat::Obj, model)).bytes);
    EXPECT_EQ(back.data.positions, model.data.positions);
    EXPECT_EQ(back.data.face_sizes, model.data.face_sizes);
    EXPECT_EQ(back.data.face_corners, model.data.face_corners);
    ASSERT_EQ(back.data.creases.size(), 2u);
    EXPECT_EQ(back.data.creases[0].sharpness, 0.1f);
    EXPECT_EQ(back.data.holes, model.data.holes);
    EXPECT_EQ(back.boundary, model.boundary);
    EXPECT_EQ(back.creasing, model.creasing);
    EXPECT_EQ(back.description, model.description);
}

TEST(ObjWriter, DoesNotLetADescriptionOutOfItsLine) {
    for (const char* description :
         {"a\nv 9 9 9", "a\r\nv 9 9 9", "a\rv 9 9 9", "a\\", "\\", "\n\n", "  a\t", "#"}) {
        Model model = everything();
        model.description = description;
        const Model back = read(value_of(format_model(FileFormat::Obj, model)).bytes);
        EXPECT_EQ(back.data.positions.size(), 4u) << description;
        EXPECT_EQ(back.description.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace loopcheck::core
