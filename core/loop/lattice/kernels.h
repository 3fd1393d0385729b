// The sums that most of the points of a refined mesh are made by, for the instructions of this machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/loop/lattice/pattern.h"
#include "core/loop/lattice/quad.h"
#include "core/loop/lattice/quad_lattice.h"
#include "core/loop/lattice/smooth_weights.h"

namespace loopcheck::core {

/// The vertex point of a smooth vertex.
template <class Real>
PaddedPoint<Real> smooth_vertex_point(const PaddedPoint<Real>& centre,
                                      std::span<const PaddedPoint<Real>> ring,
                                      const typename SmoothWeights<Real>::Pair& weights);

/// The edge points around a smooth vertex.  `ring` has its last point before the first as well, and its first
/// after the last; the vertex is end `ends[i]` of edge i.
template <class Real>
void refine_smooth_ring(const PaddedPoint<Real>& centre, const PaddedPoint<Real>* ring,
                        std::span<const int> ends, PaddedPoint<Real>* next);

/// Of a smooth edge of n segments and the rows beside it, the points of the next level between its ends: 1 to
/// 2n - 1 of `next`.
template <class Real>
void refine_smooth_edge(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* left,
                        const PaddedPoint<Real>* right, Index n, PaddedPoint<Real>* next);

/// Of a row of n points beside an edge, those of the row nearest to it in the next level: 1 to 2n - 2 of
/// `next`.
template <class Real>
void refine_row_beside(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* row, Index n,
                       PaddedPoint<Real>* next);

/// The inside of the next level of a face: rows 1 to 2n - 2 of `next`, without their ends.
template <class Real>
void refine_inside(const QuadLattice<Real>& lattice, const LatticePattern& pattern, QuadLattice<Real>& next);

/// The same into packed points, one after the other, for the rows that come from rows `first` to `last` - 1:
/// of row j these are 2j, except for j = 0, and 2j + 1.  One real after them is overwritten.  Returns the
/// end.
template <class Real>
Real* refine_rows(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index first, Index last,
                  Real* packed);

/// The rows of one level as flat lists.
template <class Real>
struct GatherList {
    std::vector<std::uint32_t> offsets;       ///< rows + 1 entries into `columns`
    std::vector<Index> columns;               ///< in the order in which they are summed
    std::vector<std::uint32_t> first_weight;  ///< a row; into `weights`
    std::vector<Real> weights;
};

/// Rows `first` to `last` - 1 of a list over `points`: padded from `out` on, or packed.
template <class Real>
void gather(const GatherList<Real>& list, const PaddedPoint<Real>* points, Index first, Index last,
            PaddedPoint<Real>* out);
template <class Real>
void gather(const GatherList<Real>& list, const PaddedPoint<Real>* points, Index first, Index last,
            Real* out);

/// Weights of a limit position and two limit tangents over a ring of six in ring order, then the vertex.
template <class Real>
using RegularLimit = std::array<std::array<Real, 7>, 3>;

/// Limit positions and unit normals inside row `j` of a lattice, packed one after the other.  One real after
/// them is overwritten.
template <class Real>
void limits_of_row(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index j,
                   const RegularLimit<Real>& weights, Real* positions, Real* normals);

/// a x b over its length, or 0 where that is 0: the normal of two tangents.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> unit_normal(const Quad<Real>& a, const Quad<Real>& b) {
    const Quad<Real> n{a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1], 0};
    const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length > 0 ? n / length : Quad<Real>{};
}

/// The instructions that these use on this machine: "AVX2", or those that the build was made for.
std::string_view lattice_instructions();

}  // namespace loopcheck::core
