#include "core/loop/tessellation/surface_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/loop/evaluate.h"
#include "tests/support/meshes.h"

namespace loopcheck::core {
namespace {

// How far a cloud of points reaches in a direction.
double reach_of(const std::vector<glm::dvec3>& points, const glm::dvec3& direction) {
    double reach = -std::numeric_limits<double>::infinity();
    for (const glm::dvec3& p : points) reach = std::max(reach, glm::dot(p, direction));
    return reach;
}

// Wheels and fans with the given edges at vertex 0 sharp.
MeshData with_spokes(MeshData data, const std::vector<Index>& to, float sharpness) {
    for (const Index v : to) data.creases.push_back({0, v, sharpness});
    return data;
}

std::vector<glm::dvec3> hull_over(const TriangleMesh& mesh, Index face) {
    const SchemeLevel control = control_level(mesh, BoundaryRule::EdgeAndCorner);
    std::vector<glm::dvec3> hull;
    SurfacePiece(control, mesh.positions(), face, Creasing::Uniform).add_hull(kWholeTriangle, hull);
    return hull;
}

TEST(SurfacePiece, LiesInItsHull) {
    std::vector<MeshData> meshes{tests::wheel(3), tests::wheel(7), tests::bipyramid(6), tests::open_fan(4)};
    for (const float sharpness : {0.5F, 2.5F, 10.0F})
        for (const auto& spokes : std::vector<std::vector<Index>>{{1}, {1, 4}, {2, 3}, {1, 3, 6}}) {
            meshes.push_back(with_spokes(tests::wheel(7), spokes, sharpness));
            meshes.push_back(with_spokes(tests::open_fan(6), spokes, sharpness));
        }
    const auto directions = tests::scattered(60);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const TriangleMesh mesh = tests::mesh_of(meshes[m]);
        LimitSurface<double> surface(mesh, {});
        for (Index f = 0; f < mesh.face_count(); ++f) {
            std::vector<glm::dvec3> samples;
            for (int i = 0; i <= 4; ++i)
                for (int j = 0; i + j <= 4; ++j) {
                    const auto stencil = surface.stencil(f, i / 4.0, j / 4.0).value();
                    samples.push_back(apply<double>(stencil, mesh.positions()).at(Derivative::Position));
                }
            const auto hull = hull_over(mesh, f);
            for (const glm::dvec3& direction : directions)
                EXPECT_LE(reach_of(samples, direction), reach_of(hull, direction) + 1e-13)
                    << "mesh " << m << " face " << f;
        }
    }
}

// Edges 0-1 and 0-4 of the wheel part the faces 0, 1, 2 from 3, ..., 6.
TEST(SurfacePiece, IsEnclosedByItsOwnSideOfACrease) {
    const TriangleMesh mesh = tests::mesh_of(with_spokes(tests::wheel(7), {1, 4}, 10));
    const auto hull = hull_over(mesh, 1);
    const auto has = [&](Index v) {
        return std::find(hull.begin(), hull.end(), mesh.positions()[v]) != hull.end();
    };
    for (const Index v : {0, 1, 2, 3, 4}) EXPECT_TRUE(has(v)) << v;
    for (const Index v : {5, 6, 7}) EXPECT_FALSE(has(v)) << v;
}

TEST(SurfacePiece, HasTheCornersOfTheLimit) {
    const TriangleMesh mesh =
        tests::mesh_of(with_spokes(with_spokes(tests::wheel(7), {1, 4}, 10), {2}, 1.5F));
    const SchemeOptions options;
    const SchemeLevel control = control_level(mesh, options.boundary);
    CornerLimits limits(options);
    LimitSurface<double> surface(mesh, options);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const SurfacePiece piece(control, mesh.positions(), f, options.creasing);
        const auto children = piece.children(options);
        const auto expect_at = [&](const SurfacePiece& of, int corner, double u, double v) {
            const auto stencil = surface.stencil(f, u, v).value();
            const glm::dvec3 wanted = apply<double>(stencil, mesh.positions()).at(Derivative::Position);
            EXPECT_LE(glm::length(limits.at(of, corner) - wanted), 1e-14) << f << " " << u << " " << v;
        };
        expect_at(piece, 0, 0, 0);
        expect_at(piece, 1, 1, 0);
        expect_at(piece, 2, 0, 1);
        expect_at(children[0], 1, 0.5, 0);
        expect_at(children[1], 2, 0.5, 0.5);
        expect_at(children[2], 0, 0, 0.5);
        expect_at(children[3], 0, 0.5, 0.5);
        expect_at(children[3], 1, 0, 0.5);
    }
}

}  // namespace
}  // namespace loopcheck::core
