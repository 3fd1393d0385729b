// Where a refined vertex lies on the control mesh, and the order of refined vertices and faces that follows
// from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/mesh/topology.h"

namespace loopcheck::core {

/// A vertex of level L: a vertex, a point of an edge or a point inside a face of the control mesh.  N = 2^L.
///
///   * Vertex: `index`.
///   * Edge `index`, from its end 0 to its end 1: point i of N, 0 < i < N.
///   * Face `index` with corners c0, c1, c2: the point that is at c0 + i/N (c1 - c0) + j/N (c2 - c0) before
///     refinement moves it; 0 < i, 0 < j, i + j < N.
struct LatticeAddress {
    enum class Kind : std::uint8_t { Vertex, Edge, Face };
    Kind kind = Kind::Vertex;
    Index index = 0;
    Index i = 0, j = 0;

    bool operator==(const LatticeAddress&) const = default;
};

/// The order of vertices by address: the control vertices, the points of edge 0, of edge 1, ..., the points
/// of face 0 row by row (j ascending, then i), of face 1, ...  And of faces: N^2 a control face, row by row.
class LatticeOrder {
  public:
    /// Requires a level whose vertices and faces can be counted in 62 bits.
    LatticeOrder(const Topology& topology, int level);

    int level() const { return level_; }
    /// N.
    Index segments() const { return segments_; }
    std::int64_t vertex_count() const;
    std::int64_t face_count() const { return faces_ * segments_ * segments_; }

    /// Whether an Index can number the vertices, and the corners of the faces.
    bool fits_index() const {
        constexpr std::int64_t kMost = std::numeric_limits<Index>::max();
        return vertex_count() <= kMost && 3 * face_count() <= kMost;
    }

    /// The two are inverse.
    std::int64_t index_of(const LatticeAddress& address) const;
    LatticeAddress address_of(std::int64_t vertex) const;

    /// First point of an edge or a face.
    std::int64_t first_of_edge(Index e) const { return vertices_ + e * (segments_ - std::int64_t{1}); }
    std::int64_t first_of_face(Index f) const;
    /// Points inside a face: (N - 1)(N - 2)/2.
    std::int64_t inside_of_face() const { return inside_; }

    /// The vertex at (i, j) of a face, on its boundary or inside: 0 <= i, 0 <= j, i + j <= N.
    std::int64_t vertex_at(const Topology& topology, Index f, Index i, Index j) const;

  private:
    int level_;
    Index segments_;
    std::int64_t vertices_, edges_, faces_, inside_;
};

/// Number of (i, j) in the closed lattice of a face, row by row: 0 <= i, 0 <= j, i + j <= N.
constexpr std::int64_t lattice_place(Index segments, Index i, Index j) {
    return std::int64_t{j} * (segments + 1) - std::int64_t{j} * (j - 1) / 2 + i;
}

/// The point of edge c of a face that is k segments from corner c, as (i, j).
constexpr std::array<Index, 2> on_face_edge(Index segments, int c, Index k) {
    const std::array<std::array<Index, 2>, 3> place{{{k, 0}, {segments - k, k}, {0, segments - k}}};
    return place[static_cast<std::size_t>(c)];
}

/// A lattice triangle of a face: upright with corners (i, j), (i + 1, j), (i, j + 1), or inverted with
/// corners (i + 1, j + 1), (i, j + 1), (i + 1, j), in the order in which `split` has them.
struct LatticeTriangle {
    bool upright = true;
    Index i = 0, j = 0;

    bool operator==(const LatticeTriangle&) const = default;
};

/// Triangle number t, 0 <= t < N^2, of a face: row j has 2 (N - j) - 1, upright and inverted in turn.
LatticeTriangle triangle_at(Index segments, std::int64_t t);

/// Its corners as (i, j).
std::array<std::array<Index, 2>, 3> corners_of(const LatticeTriangle& triangle);

}  // namespace loopcheck::core
