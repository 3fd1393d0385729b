// Why this project has readers of its own: OpenMesh's round every coordinate to float, also for a mesh of
// doubles.
//
// Observed with OpenMesh 9.0 for every format that both read, in text and binary: none keeps the bits of a
// double. Only OM does, which is OpenMesh's own.  If a test here fails, OpenMesh has learned to and the
// reason is gone.
#define _USE_MATH_DEFINES
#include <gtest/gtest.h>

// The readers register themselves when this header is included, which must be before that of a mesh.
#include <OpenMesh/Core/IO/MeshIO.hh>
// The mesh.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "tests/support/random_doubles.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::bits;
using tests::value_of;

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// Triangles that share no vertex, with coordinates in [0, 1) that need all bits of a double.
Model random_triangles() {
    std::mt19937_64 random(1);
    const auto coordinate = [&] { return static_cast<double>(random() >> 11 | 1) * 0x1p-53; };
    Model model;
    for (Index v = 0; v < 300; v += 3) {
        for (int i = 0; i < 3; ++i) {
            const double x = coordinate();
            const double y = coordinate();
            model.data.positions.emplace_back(x, y, coordinate());
        }
        model.data.add_face(std::array{v, v + 1, v + 2});
    }
    return model;
}

/// What OpenMesh reads from our file of the model.
std::vector<glm::dvec3> read_by_openmesh(const Model& model, FileFormat format, const char* extension,
                                         Encoding encoding) {
    std::istringstream stream(value_of(format_model(format, model, encoding)).bytes);
    OpenMesh::IO::Options options;
    if (encoding == Encoding::Binary) options += OpenMesh::IO::Options::Binary;
    DoubleMesh mesh;
    EXPECT_TRUE(OpenMesh::IO::read_mesh(mesh, stream, extension, options));
    std::vector<glm::dvec3> positions;
    for (const auto vertex : mesh.vertices()) {
        const auto& p = mesh.point(vertex);
        positions.emplace_back(p[0], p[1], p[2]);
    }
    return positions;
}

/// Every coordinate comes back as the float nearest to it, and so as another double.
void expect_rounded_to_float(FileFormat format, const char* extension, Encoding encoding = Encoding::Text) {
    const Model model = random_triangles();
    const std::vector<glm::dvec3> read = read_by_openmesh(model, format, extension, encoding);
    ASSERT_EQ(read.size(), model.data.positions.size());
    for (std::size_t v = 0; v < read.size(); ++v)
        for (int i = 0; i < 3; ++i) {
            const double written = model.data.positions[v][i];
            EXPECT_NE(bits(read[v][i]), bits(written)) << "the promise is kept for " << hexfloat(written);
            EXPECT_EQ(read[v][i], static_cast<double>(static_cast<float>(written)));
        }
}

TEST(OpenMeshReader, RoundsObjToFloat) {
    expect_rounded_to_float(FileFormat::Obj, ".OBJ");
}
TEST(OpenMeshReader, RoundsOffToFloat) {
    expect_rounded_to_float(FileFormat::Off, ".OFF");
}
TEST(OpenMeshReader, RoundsPlyTextToFloat) {
    expect_rounded_to_float(FileFormat::Ply, ".PLY");
}
TEST(OpenMeshReader, RoundsPlyBinaryToFloatAlthoughTheFileHasDoubles) {
    expect_rounded_to_float(FileFormat::Ply, ".PLY", Encoding::Binary);
}
TEST(OpenMeshReader, RoundsStlTextToFloat) {
    expect_rounded_to_float(FileFormat::Stl, ".STL");
}

TEST(OpenMeshReader, KeepsDoublesOnlyInItsOwnFormat) {
    DoubleMesh mesh;
    const auto a = mesh.add_vertex({0.1, 1.0 / 3, 1e300});
    mesh.add_face(a, mesh.add_vertex({1, 0, 0}), mesh.add_vertex({0, 1, 0}));
    std::stringstream stream;
    OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, stream, ".OM", options));
    DoubleMesh back;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(back, stream, ".OM", options));
    EXPECT_EQ(back.point(a), mesh.point(a));
}

}  // namespace
}  // namespace loopcheck::core
