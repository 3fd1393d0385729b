// The split of every triangle into four: the topology and order of the next level.
#pragma once

#include <vector>

#include "core/mesh/refinement.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The topology of the next level.  With V, E, F vertices, edges and faces of the parent:
///
///   * vertices: the vertex point of vertex v is v; the edge point of edge e is V + e;
///   * faces: 4f + i cuts off corner i of face f; 4f + 3 joins its three edge points.  With the edge points
///   E0, E1,
///     E2 of face (v0, v1, v2):  (v0, E0, E2)  (E0, v1, E1)  (E2, E1, v2)  (E1, E2, E0);
///   * edges: 3f + i cuts corner i off face f, from Ei to the edge point before it; 3F + 2e + i is the half
///   of
///     edge e towards its end i, from the edge point;
///   * rings: a vertex point keeps its parent's ring; the ring of an edge point starts with the half along
///   which
///     the lower-numbered face of the edge runs.
///
/// Source  OpenSubdiv's default order, observed and tested.
/// Errors  TooLarge, before anything is allocated.
Result<Topology> split(const Topology& parent);

/// The ancestor of the point of edge e.
inline Ancestor edge_ancestor(const Topology& parent, Index e) {
    const Index f = parent.edge_faces[e][0];
    return {Ancestor::Kind::Edge, 3 * f + parent.corner_of_edge(f, e)};
}

/// Where each vertex of the next level comes from, in its order.
std::vector<Ancestor> ancestors_of_split(const Topology& parent);

/// The child of edge e of the parent towards its end i.
inline Index half_edge(const Topology& parent, Index e, int i) {
    return 3 * parent.face_count() + 2 * e + i;
}

}  // namespace loopcheck::core
