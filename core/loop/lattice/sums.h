// The regular masks as sums, in the order of `places_of`, and which neighbour that order begins with inside a
// face.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "core/loop/lattice/quad.h"
#include "core/mesh/ids.h"

namespace loopcheck::core {

/// 3/8 (a + b) + 1/8 (c + d), summed from the left.  a and b may be exchanged, c and d not.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> smooth_edge_point(const Quad<Real>& a, const Quad<Real>& b,
                                                           const Quad<Real>& c, const Quad<Real>& d) {
    constexpr Real end = Real(3) / 8, opposite = Real(1) / 8;
    Quad<Real> sum{};
    sum += end * a;
    sum += end * b;
    sum += opposite * c;
    sum += opposite * d;
    return sum;
}

/// 1/16 of six neighbours, in the order given, then 5/8 of the vertex.
template <class Real, class Neighbour>
[[gnu::always_inline]] inline Quad<Real> regular_vertex_point(const Quad<Real>& vertex,
                                                              const Neighbour& neighbour) {
    constexpr Real ring = Real(1) / 16, centre = Real(5) / 8;
    Quad<Real> sum{};
    for (int i = 0; i < 6; ++i) sum += ring * Quad<Real>(neighbour(i));
    sum += centre * vertex;
    return sum;
}

/// The midpoint of a segment of a crease, and 1/8 (a + b) + 3/4 of a vertex between a and b.
template <class Real>
inline Quad<Real> crease_edge_point(const Quad<Real>& a, const Quad<Real>& b) {
    constexpr Real half = Real(1) / 2;
    Quad<Real> sum{};
    sum += half * a;
    sum += half * b;
    return sum;
}
template <class Real>
inline Quad<Real> crease_vertex_point(const Quad<Real>& a, const Quad<Real>& b, const Quad<Real>& vertex) {
    constexpr Real side = Real(1) / 8, centre = Real(3) / 4;
    Quad<Real> sum{};
    sum += side * a;
    sum += side * b;
    sum += centre * vertex;
    return sum;
}

inline int trailing_zeros(Index i) {
    return std::countr_zero(static_cast<std::uint32_t>(i));
}

/// Of the two faces at a segment inside a control face, whether the upright one comes first.
///
/// `line` is the distance of the segment's line from the parallel edge (or, alike, from the opposite corner),
/// `at` its number along the line, from either end.  A line is born when its distance is odd, through faces
/// that are upright and inverted in turn; at a cut the face at the corner, which points the way its parent
/// does, comes before the middle one; and halves of an edge keep its order.
inline bool upright_first(Index line, Index at) {
    return (at >> trailing_zeros(line)) % 2 == 0;
}

/// The ring of the vertex (i, j) inside a control face begins in this direction, in sixths of a turn from
/// edge 0.
///
/// It was born as the middle of a segment and keeps the order it had then: from the end to which the first
/// face runs.
inline int ring_start(Index i, Index j) {
    const int shift = std::min(trailing_zeros(i), trailing_zeros(j));
    i >>= shift;
    j >>= shift;
    if (j % 2 == 0) return upright_first(j / 2, i / 2) ? 0 : 3;
    if (i % 2 == 1) return upright_first((i + j) / 2, j / 2) ? 2 : 5;
    return upright_first(i / 2, j / 2) ? 4 : 1;
}

}  // namespace loopcheck::core
