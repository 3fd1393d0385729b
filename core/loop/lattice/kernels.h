// The sums that most of the points of a refined mesh are made by, for the instructions of this machine.
#pragma once

#include <array>
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

/// Of the limit of a regular vertex: the weight of a neighbour and that of the vertex in the position, and
/// sin(pi/3) in the second tangent; its other weights, and the first tangent's, are 0, +-1/2 and +-1.
template <class Real>
struct RegularLimit {
    Real side, centre, sine;
};

/// Limit positions and unit normals inside row `j` of a lattice, packed one after the other.  One real after
/// them is overwritten.
template <class Real>
void limits_of_row(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index j,
                   const RegularLimit<Real>& weights, Real* positions, Real* normals);

/// Weights of a limit position and two limit tangents over a ring and its vertex; the tangents' are empty
/// where there is no normal.
template <class Real>
struct LimitWeights {
    std::vector<Real> position, tangent1, tangent2;
};

/// A limit position and unit normal, from the points of a ring and its vertex.  The normal is 0 where there
/// is none.
template <class Real>
void limit_of_ring(const PaddedPoint<Real>* ring, const LimitWeights<Real>& weights,
                   PaddedPoint<Real>& position, PaddedPoint<Real>& normal);

/// The instructions that these use on this machine: "AVX2", or those that the build was made for.
std::string_view lattice_instructions();

/// For tests and benchmarks: whether they may use AVX2 where the build does not rely on it.
void allow_avx2(bool allowed);

}  // namespace loopcheck::core
