// One triangle with some of its edges split.
#pragma once

#include <array>
#include <span>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// The triangles that replace one triangle.
struct SplitPattern {
    std::array<Triangle, 4> pieces{};
    int count = 0;

    std::span<const Triangle> triangles() const& { return {pieces.data(), static_cast<std::size_t>(count)}; }
    std::span<const Triangle> triangles() const&& = delete;  // it would outlive the pieces
};

/// Replaces the triangle (a, b, c) where some of its edges have a midpoint; orientation kept.
///
/// `midpoints[i]` is on edge i, which joins corner i and the next; kNone where that edge is not split.  By
/// the number of edges that are not:
///
///   * 0: (a, ab, ca)  (ab, b, bc)  (ca, bc, c)  (bc, ca, ab), as in `split`;
///   * 1, ab: (a, b, bc)  (bc, c, ca)  (ca, a, bc);
///   * 2, all but ab: (a, ab, c)  (ab, b, c);
///   * 3: (a, b, c);
///
/// with ab for the midpoint of the edge from a to b.  A piece that is a child in `split` also starts with the
/// same vertex as there.
///
/// Source  the lab report's scheme; the same four cases as in red-green-blue refinement.
/// Law     both faces of an edge see the same midpoint, so no piece has a vertex inside an edge.
SplitPattern split_pattern(const Triangle& corners, const Triangle& midpoints);

}  // namespace loopcheck::core
