#include "core/loop/tessellation/surface_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/loop/evaluate.h"
#include "core/mesh/rounding.h"
#include "tests/support/meshes.h"
#include "tests/support/observed.h"
#include "tests/support/surface_errors.h"

namespace loopcheck::core {
namespace {

using tests::Observed;

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

SurfacePiece piece_over(const TriangleMesh& mesh, Index face, const SchemeOptions& options = {}) {
    return {control_level(mesh, options.boundary), mesh.positions(), face, options.creasing};
}

std::vector<glm::dvec3> hull_of(const SurfacePiece& piece) {
    std::vector<glm::dvec3> hull;
    piece.add_hull(kWholeTriangle, hull);
    return hull;
}

// Points of the surface over a triangle within a face, and the largest error of a coordinate of theirs.
struct Samples {
    std::vector<glm::dvec3> points;
    double error = 0;
};
Samples samples_of(LimitSurface<double>& surface, const TriangleMesh& mesh, Index face,
                   const SubTriangle& within) {
    Samples out;
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; i + j <= 4; ++j) {
            const auto at = [&](int axis) {
                return ((4 - i - j) * within[0][axis] + i * within[1][axis] + j * within[2][axis]) / 4;
            };
            const auto stencil = surface.stencil(face, at(1), at(2)).value();
            out.points.push_back(apply<double>(stencil, mesh.positions()).at(Derivative::Position));
            out.error = std::max(out.error, tests::evaluated_error(stencil, mesh.largest_coordinate()));
        }
    return out;
}

// How far the samples reach beyond the hull, over what rounding allows: an error of each coordinate, and 3 u
// M for each of 3 products and their sums.
double excess(const Samples& samples, const SurfacePiece& piece, double point_error, double M) {
    const double u = unit_roundoff(Precision::Double);
    const auto hull = hull_of(piece);
    double largest = 0;
    for (const glm::dvec3& d : tests::scattered(60)) {
        const double size = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
        const double beyond = reach_of(samples.points, d) - reach_of(hull, d);
        largest = std::max(largest, beyond / (size * (samples.error + point_error + 2 * 9 * u * M)));
    }
    return largest;
}

TEST(SurfacePiece, LiesInItsHullAndInThoseOfItsChildren) {
    std::vector<MeshData> meshes{tests::wheel(3), tests::wheel(7), tests::bipyramid(6), tests::open_fan(4)};
    for (const float sharpness : {0.5F, 2.5F, 10.0F})
        for (const auto& spokes : std::vector<std::vector<Index>>{{1}, {1, 4}, {2, 3}, {1, 3, 6}}) {
            meshes.push_back(with_spokes(tests::wheel(7), spokes, sharpness));
            meshes.push_back(with_spokes(tests::open_fan(6), spokes, sharpness));
        }
    Observed observed("reach of the surface beyond its hull over what rounding allows", "mesh", 1);
    for (const SchemeOptions& options : {SchemeOptions{}, SchemeOptions{.creasing = Creasing::Chaikin},
                                         SchemeOptions{.weights = Weights::Warren}})
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            const TriangleMesh mesh = tests::mesh_of(meshes[m]);
            LimitSurface<double> surface(mesh, options);
            // Hulls are of points two levels below a piece at most.
            const double error = tests::vertex_error(mesh, 3), M = mesh.largest_coordinate();
            for (Index f = 0; f < mesh.face_count(); ++f) {
                const SurfacePiece piece = piece_over(mesh, f, options);
                const auto add = [&](const SurfacePiece& of, const SubTriangle& within) {
                    observed.add(excess(samples_of(surface, mesh, f, within), of, error, M),
                                 static_cast<std::int64_t>(m));
                };
                add(piece, kWholeTriangle);
                const auto children = piece.children(options);
                for (int k = 0; k < 4; ++k) add(children[k], kChildTriangles[k]);
            }
        }
    observed.check();
}

// Edges 0-1 and 0-4 of the wheel part the faces 0, 1, 2 from 3, ..., 6.
TEST(SurfacePiece, IsEnclosedByItsOwnSideOfACrease) {
    const TriangleMesh mesh = tests::mesh_of(with_spokes(tests::wheel(7), {1, 4}, 10));
    const auto hull = hull_of(piece_over(mesh, 1));
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
    CornerLimits limits(options);
    LimitSurface<double> surface(mesh, options);
    Observed observed("error of a corner over its bound", "face", 1);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const SurfacePiece piece = piece_over(mesh, f, options);
        const auto children = piece.children(options);
        const auto expect_at = [&](const SurfacePiece& of, int corner, double u, double v) {
            const auto stencil = surface.stencil(f, u, v).value();
            const glm::dvec3 off =
                limits.at(of, corner) - apply<double>(stencil, mesh.positions()).at(Derivative::Position);
            const double allowed =
                tests::vertex_error(mesh, 1) + tests::evaluated_error(stencil, mesh.largest_coordinate());
            for (int axis = 0; axis < 3; ++axis) observed.add(std::abs(off[axis]) / allowed, f);
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
    observed.check();
}

}  // namespace
}  // namespace loopcheck::core
