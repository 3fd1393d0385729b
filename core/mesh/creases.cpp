#include "core/mesh/creases.h"

#include <vector>

#include "core/mesh/face_normals.h"

namespace loopcheck::core {

CreasedMesh with_creases(const TriangleMesh& mesh, double angle) {
    const Topology& t = mesh.topology();
    const auto normals = face_normals(t, mesh.positions());
    std::vector<Index> edges;
    for (Index e = 0; e < t.edge_count(); ++e) {
        if (t.is_boundary_edge(e)) continue;
        const auto &m = normals[t.edge_faces[e][0]], &n = normals[t.edge_faces[e][1]];
        if (m && n && angle_between(*m, *n) > angle + kAngleSlack) edges.push_back(e);
    }
    return {mesh.with_infinite_sharpness(edges), edges.size()};
}

}  // namespace loopcheck::core
