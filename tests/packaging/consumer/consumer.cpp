// Refines a tetrahedron and a curve once and prints what came out.
#include <cstdio>
#include <utility>

#include "core/bspline/subdivide.h"
#include "core/loop/refine.h"

namespace lc = loopcheck::core;

// (1 0) (0 0) (0 1): the middle point becomes (0 + 6 * 0 + 1)/8 in both coordinates.
bool subdivides_a_curve() {
    const auto curve = lc::Curve<glm::dvec2>::make({{1, 0}, {0, 0}, {0, 1}}, {});
    return curve && lc::subdivide(*curve).points().at(2) == glm::dvec2(1. / 8, 1. / 8);
}

int main() {
    lc::MeshData data;
    data.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    for (const lc::Triangle& face : {lc::Triangle{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}})
        data.add_face(face);

    const auto mesh = lc::TriangleMesh::make(std::move(data));
    if (!mesh) return std::puts(lc::to_string(mesh.error()).c_str()), 1;
    const auto refined = lc::refine<double>(*mesh, {}, 1);
    if (!refined) return std::puts(lc::to_string(refined.error()).c_str()), 1;

    const lc::RefinedLevel& level = refined->levels.back();
    // At valence 3 the vertex point keeps 7/16 of the vertex, and the three others, which sum to its
    // opposite, have 3/16 each.
    const glm::dvec3 expected(7. / 16 - 3. / 16);
    std::printf("%zu vertices, %zu faces\n", level.positions.size(), level.triangles.size());
    const bool right = level.positions.size() == 10 && level.triangles.size() == 16 &&
                       level.positions[0] == expected && subdivides_a_curve();
    return right ? 0 : 1;
}
