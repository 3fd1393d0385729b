// Who is next to whom in one level of a triangle mesh, as flat arrays.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/ids.h"

namespace loopcheck::core {

/// The topology of one level.  Manifold, consistently oriented, with or without boundary; isolated vertices
/// have an empty ring.
///
/// Edges are identified by topology: two edges may join the same two vertices (two triangles glued along all
/// three edges have such pairs from level 1 on).
///
/// Orders, all equal to OpenSubdiv's so that a sum over them has the same bits:
///   * edges of a face: edge i joins corner i and the next corner;
///   * ends of an edge at level 0: as first met, in its lowest-numbered face;
///   * faces of an edge: ascending;
///   * ring of a vertex: counter-clockwise.  At level 0 it starts, inside, at the edge that leads out of the
///     vertex in its lowest-numbered face, and, on the boundary, at the boundary edge that leads out of it.
struct Topology {
    Index vertex_count = 0;
    std::vector<Triangle> triangles;
    std::vector<Triangle> face_edges;
    std::vector<std::array<Index, 2>> edge_ends;
    std::vector<std::array<Index, 2>> edge_faces;  ///< the second is kNone on the boundary
    std::vector<std::size_t> ring_offsets;         ///< vertex_count + 1 entries into ring_edges
    std::vector<Index> ring_edges;

    Index face_count() const { return static_cast<Index>(triangles.size()); }
    Index edge_count() const { return static_cast<Index>(edge_ends.size()); }

    /// The edges around v, counter-clockwise.
    std::span<const Index> ring(Index v) const {
        return {ring_edges.data() + ring_offsets[v], ring_offsets[v + 1] - ring_offsets[v]};
    }
    bool is_boundary_edge(Index e) const { return edge_faces[e][1] == kNone; }
    /// True where the ring of v is open.  Isolated vertices are not on the boundary.
    bool is_boundary_vertex(Index v) const {
        const auto edges = ring(v);
        return !edges.empty() && is_boundary_edge(edges.front());
    }
    bool is_isolated(Index v) const { return ring(v).empty(); }
    /// Number of faces around v: the valence inside, one less than the number of edges on the boundary.
    int face_count_at(Index v) const {
        return static_cast<int>(ring(v).size()) - (is_boundary_vertex(v) ? 1 : 0);
    }
    /// The end of e that is not v.
    Index other_end(Index e, Index v) const {
        return edge_ends[e][0] == v ? edge_ends[e][1] : edge_ends[e][0];
    }
    /// Which of the three edges of f is e.
    int corner_of_edge(Index f, Index e) const {
        return face_edges[f][0] == e ? 0 : face_edges[f][1] == e ? 1 : 2;
    }
};

/// Builds the topology of a control mesh and diagnoses what is not manifold.
///
/// Requires every index in [0, vertex_count) and no vertex twice in a face.
/// Errors   NonManifoldEdge, NonManifoldVertex, InconsistentWinding, DuplicateFace, TooLarge.
Result<Topology> make_topology(Index vertex_count, std::vector<Triangle> triangles);

}  // namespace loopcheck::core
