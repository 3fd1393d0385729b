// Any bytes give a model or an error: no crash, no hang, no memory without bound.  Meant to run under
// sanitizers too.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/mesh/io/bytes.h"
#include "core/mesh/io/model.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::value_of;

struct Sample {
    const char* name;
    FileFormat format;
    std::string bytes;
};
void PrintTo(const Sample& sample, std::ostream* out) {
    *out << sample.name;
}

std::string obj_sample() {
    return "# A tetrahedron\nv 1 1 1\nv -1 -1 1.5e0 1\nv -1 1 -1 .1 .2 .3\nv 1 -1 -1\nvt 0 0\nf 1 2/1 "
           "3//1\nf -4 4 \\\n 2\n"
           "f 1 3 4\nf 2 4 3\nt crease 4/2/0 0 1 1 2 1.5 inf\nt corner 1/1/0 3 2\nt hole 1/0/0 2\n"
           "t interpolateboundary 1/0/0 1\nt creasemethod 0/0/1 chaikin\nt other 0/0/0\nfoo\n";
}

std::string off_sample() {
    return "CNOFF # A tetrahedron\n4 4 6\n1 1 1 0 0 1 1 0 0\n-1 -1 1 0 0 1 1 0 0 1\n-1 1 -1 0 0 1 1 0 0\n"
           "1 -1 -1 0 0 1 1 0 0\n3 0 1 2 255 0 0\n3 0 3 1\n3 0 2 3 9\n3 1 3 2\n";
}

std::string ply_header(const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\ncomment A triangle\nelement camera 1\nproperty list uchar int view\nelement vertex 3\n"
           "property float x\nproperty double y\nproperty short z\nproperty uchar red\nelement face 1\n"
           "property list uchar int vertex_indices\nproperty list uint char flags\nend_header\n";
}

std::string ply_text_sample() {
    return ply_header("ascii") + "2 7 8\n0 0 0 255\n1 0 0 255\n0 1 0 255\n3 0 1 2 1 5\n";
}

std::string ply_binary_sample(std::endian order) {
    std::string bytes =
        ply_header(order == std::endian::little ? "binary_little_endian" : "binary_big_endian");
    append(bytes, std::uint8_t{2}, order);
    for (const int number : {7, 8}) append(bytes, number, order);
    for (const float number : {0.f, 1.f, 2.f}) {
        append(bytes, number, order);
        append(bytes, 0.5, order);
        append(bytes, std::int16_t{-1}, order);
        append(bytes, std::uint8_t{255}, order);
    }
    append(bytes, std::uint8_t{3}, order);
    for (const int number : {0, 1, 2}) append(bytes, number, order);
    append(bytes, std::uint32_t{1}, order);
    append(bytes, std::int8_t{5}, order);
    return bytes;
}

std::string stl_text_sample() {
    return "solid A triangle\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
           "0\nendloop\nendfacet\n"
           "endsolid\n";
}

std::string stl_binary_sample() {
    std::string bytes(80, ' ');
    append(bytes, std::uint32_t{2}, std::endian::little);
    for (int f = 0; f < 2; ++f) {
        for (int i = 0; i < 12; ++i) append(bytes, static_cast<float>(i % 5), std::endian::little);
        bytes.append(2, '\0');
    }
    return bytes;
}

/// What every model that a reader returns has.
void expect_sound(const Model& model) {
    ASSERT_TRUE(sizes_match(model.data));
    const auto vertices = static_cast<Index>(model.data.positions.size());
    for (const glm::dvec3& p : model.data.positions)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    for (const Index corner : model.data.face_corners) ASSERT_TRUE(corner >= 0 && corner < vertices);
    for (const EdgeSharpness& crease : model.data.creases) {
        ASSERT_TRUE(crease.a >= 0 && crease.a < vertices && crease.b >= 0 && crease.b < vertices);
        ASSERT_GE(crease.sharpness, 0);
    }
    for (const VertexSharpness& corner : model.data.corners) {
        ASSERT_TRUE(corner.vertex >= 0 && corner.vertex < vertices);
        ASSERT_GE(corner.sharpness, 0);
    }
    for (const Index hole : model.data.holes)
        ASSERT_TRUE(hole >= 0 && static_cast<std::size_t>(hole) < model.data.face_sizes.size());
    const std::size_t vertex_lines = model.vertex_lines.size();
    const std::size_t face_lines = model.face_lines.size();
    ASSERT_TRUE(vertex_lines == 0 || vertex_lines == model.data.positions.size());
    ASSERT_TRUE(face_lines == 0 || face_lines == model.data.face_sizes.size());
}

/// Reads bytes of any kind.
void expect_sound_or_error(FileFormat format, const std::string& bytes) {
    const Result<Model> result = parse_model(format, bytes);
    if (result) return expect_sound(*result);
    ASSERT_TRUE(result.error().sentence.ends_with('.')) << result.error().sentence;
    ASSERT_FALSE(code_name(result.error().code).empty());
}

class Mutation : public ::testing::TestWithParam<Sample> {};

TEST_P(Mutation, TheSampleItselfIsRead) {
    expect_sound(value_of(parse_model(GetParam().format, GetParam().bytes)));
}

TEST_P(Mutation, EveryBeginningIsReadOrRefused) {
    for (std::size_t size = 0; size < GetParam().bytes.size(); ++size)
        expect_sound_or_error(GetParam().format, GetParam().bytes.substr(0, size));
}

TEST_P(Mutation, ChangedBytesAreReadOrRefused) {
    std::mt19937 random(1);
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = GetParam().bytes;
        for (std::uint32_t changes = 1 + random() % 4; changes > 0; --changes)
            bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
        expect_sound_or_error(GetParam().format, bytes);
    }
}

TEST_P(Mutation, WildNumbersAreReadOrRefused) {
    const std::string wild[] = {"-1",          "0",
                                "2147483647",  "2147483648",
                                "4294967295",  "9223372036854775807",
                                "-2147483649", "nan",
                                "-inf",        "1e999",
                                "1e-999",      "/",
                                "\\",          "#",
                                "\n",          "\r",
                                " ",           "-0",
                                "list",        "9999999999999999999999"};
    std::mt19937 random(2);
    for (int i = 0; i < 4000; ++i) {
        std::string bytes = GetParam().bytes;
        for (std::uint32_t changes = 1 + random() % 2; changes > 0; --changes) {
            const std::size_t at = random() % bytes.size();
            const std::size_t length = random() % 4;
            bytes.replace(at, length, wild[random() % std::size(wild)]);
        }
        expect_sound_or_error(GetParam().format, bytes);
    }
}

TEST_P(Mutation, IsReadOrRefusedAsAnyFormat) {
    for (const FileFormat format : {FileFormat::Obj, FileFormat::Off, FileFormat::Ply, FileFormat::Stl})
        expect_sound_or_error(format, GetParam().bytes);
}

INSTANTIATE_TEST_SUITE_P(
    EveryFormat, Mutation,
    ::testing::Values(Sample{"Obj", FileFormat::Obj, obj_sample()},
                      Sample{"Off", FileFormat::Off, off_sample()},
                      Sample{"PlyText", FileFormat::Ply, ply_text_sample()},
                      Sample{"PlyLittle", FileFormat::Ply, ply_binary_sample(std::endian::little)},
                      Sample{"PlyBig", FileFormat::Ply, ply_binary_sample(std::endian::big)},
                      Sample{"StlText", FileFormat::Stl, stl_text_sample()},
                      Sample{"StlBinary", FileFormat::Stl, stl_binary_sample()}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace loopcheck::core
