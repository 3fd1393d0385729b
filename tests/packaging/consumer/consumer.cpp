// Refines a tetrahedron once and prints what came out.
#include <cstdio>
#include <utility>

#include "core/loop/refine.h"

int main() {
    namespace lc = loopcheck::core;
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
    return level.positions.size() == 10 && level.triangles.size() == 16 && level.positions[0] == expected ? 0
                                                                                                          : 1;
}
