#include "core/mesh/creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include "core/mesh/face_normals.h"
#include "tests/support/angles.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/renumbered.h"

namespace loopcheck::core {
namespace {

using tests::cube;
using tests::kDegree;
using tests::mesh_of;

constexpr double kPi = std::numbers::pi;

// The sharp edges by their ends, and how sharp.
using Sharp = std::set<std::pair<std::set<Index>, float>>;
Sharp sharp_edges(const TriangleMesh& mesh) {
    Sharp out;
    for (Index e = 0; e < mesh.topology().edge_count(); ++e)
        if (const float s = mesh.edge_sharpness()[e]; s > 0)
            out.insert({{mesh.topology().edge_ends[e][0], mesh.topology().edge_ends[e][1]}, s});
    return out;
}

Index edge_between(const TriangleMesh& mesh, Index a, Index b) {
    for (const Index e : mesh.topology().ring(a))
        if (mesh.topology().other_end(e, a) == b) return e;
    return kNone;
}

// Two faces at an edge, folded by this angle: 0 is flat.
MeshData folded(double angle) {
    return tests::data_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -std::cos(angle), -std::sin(angle)}},
                          {{0, 1, 2}, {1, 0, 3}});
}

TEST(Creases, AreTheTwelveEdgesOfACubeAndNotItsDiagonals) {
    const auto mesh = mesh_of(cube());
    for (const double degrees : {0.0, 60.0, 89.9}) {
        const auto creased = with_creases(mesh, degrees * kDegree);
        EXPECT_EQ(creased.edges, 12U) << degrees;
        const auto sharp = sharp_edges(creased.mesh);
        EXPECT_EQ(sharp.size(), 12U);
        for (const auto& [ends, sharpness] : sharp) {
            const Index differ = *ends.begin() ^ *ends.rbegin();
            EXPECT_TRUE(differ == 1 || differ == 2 || differ == 4) << *ends.begin() << " " << *ends.rbegin();
            EXPECT_EQ(sharpness, kInfiniteSharpness);
        }
    }
    EXPECT_EQ(with_creases(mesh, -1).edges, 18U) << "the flat diagonals too";
}

TEST(Creases, AreNotWhereTheAngleIsEqual) {
    EXPECT_EQ(with_creases(mesh_of(cube()), 90 * kDegree).edges, 0U);
    for (const double angle : {0.3, 1.0, kPi / 3, 2.0, 3.0}) {
        const auto mesh = mesh_of(folded(angle));
        EXPECT_EQ(with_creases(mesh, angle).edges, 0U) << angle;
        EXPECT_EQ(with_creases(mesh, angle - 0.9 * kAngleSlack).edges, 0U) << angle;
        EXPECT_EQ(with_creases(mesh, angle - 1.1 * kAngleSlack).edges, 1U) << angle;
    }
}

TEST(Creases, AreNowhereFromPiOn) {
    for (const std::string& file : tests::model_files()) {
        const auto mesh = tests::load_model(file).mesh;
        for (const double angle :
             {kPi, 4.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
            const auto creased = with_creases(mesh, angle);
            EXPECT_EQ(creased.edges, 0U) << file << " " << angle;
            EXPECT_EQ(sharp_edges(creased.mesh), sharp_edges(mesh)) << file << " " << angle;
        }
    }
    EXPECT_EQ(with_creases(tests::load_model(tests::model_path("pillow")).mesh, 3.14).edges, 3U);
}

TEST(Creases, OfALargerAngleAreASubset) {
    const auto mesh = tests::load_model(tests::model_path("cow")).mesh;
    Sharp smaller = sharp_edges(with_creases(mesh, 0).mesh);
    for (int degrees = 5; degrees <= 180; degrees += 5) {
        const auto creased = with_creases(mesh, degrees * kDegree);
        const Sharp larger = sharp_edges(creased.mesh);
        EXPECT_EQ(larger.size(), creased.edges);
        EXPECT_TRUE(std::includes(smaller.begin(), smaller.end(), larger.begin(), larger.end())) << degrees;
        smaller = larger;
    }
}

TEST(Creases, KeepWhatIsTaggedAlready) {
    MeshData data = cube();
    data.creases = {{0, 1, 2.5F}, {1, 3, 10}, {0, 3, 1.5F}};
    data.corners = {{7, 3}};
    data.holes = {4};
    const auto mesh = mesh_of(data);
    const auto creased = with_creases(mesh, kPi / 3);
    EXPECT_EQ(creased.edges, 12U) << "those that were sharp before count too";
    const auto sharpness = [&](Index a, Index b) {
        return creased.mesh.edge_sharpness()[edge_between(creased.mesh, a, b)];
    };
    EXPECT_EQ(sharpness(0, 1), kInfiniteSharpness) << "raised";
    EXPECT_EQ(sharpness(1, 3), kInfiniteSharpness);
    EXPECT_EQ(sharpness(0, 3), 1.5F) << "flat, as it was";
    EXPECT_EQ(creased.mesh.vertex_sharpness()[7], 3);
    EXPECT_EQ(creased.mesh.holes()[4], 1);
    EXPECT_TRUE(std::ranges::equal(creased.mesh.positions(), mesh.positions()));
    EXPECT_EQ(creased.mesh.topology().triangles, mesh.topology().triangles);
}

// The face 0 1 4 has no area; its three edges would be as sharp as the others of the folded strip.
TEST(Creases, AreNotAtADegenerateFace) {
    const auto mesh = mesh_of(tests::data_of({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 0, 0}},
                                             {{0, 1, 2}, {1, 0, 4}, {0, 3, 4}, {4, 3, 1}}));
    ASSERT_EQ(face_normals(mesh.topology(), mesh.positions())[1], std::nullopt);
    const auto creased = with_creases(mesh, -1);
    EXPECT_EQ(creased.edges, 1U);
    EXPECT_EQ(sharp_edges(creased.mesh), (Sharp{{{3, 4}, kInfiniteSharpness}}));
}

TEST(Creases, AreTheSameWhateverTheNumbersOfVerticesAndTheFirstCorners) {
    std::mt19937 random(1);
    for (const char* model : {"cow", "icosahedron", "torus", "magnitude-mixed", "genus-2"}) {
        const MeshData data = read_model(tests::model_path(model))->data;
        const auto other = tests::renumbered(data, random);
        for (const double degrees :
             {0.0, 20.0, 30.0, 45.0, 60.0, 90.0, std::acos(std::sqrt(5.0) / 3) / kDegree}) {
            Sharp expected;
            for (const auto& [ends, sharpness] :
                 sharp_edges(with_creases(mesh_of(data), degrees * kDegree).mesh))
                expected.insert({{other.vertex[*ends.begin()], other.vertex[*ends.rbegin()]}, sharpness});
            EXPECT_EQ(sharp_edges(with_creases(mesh_of(other.data), degrees * kDegree).mesh), expected)
                << model << " " << degrees;
        }
    }
}

}  // namespace
}  // namespace loopcheck::core
