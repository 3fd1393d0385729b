// The limit of a vertex: position and tangent plane as masks over its ring.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/loop/refine.h"
#include "core/loop/sectors.h"
#include "core/mesh/high_precision.h"
#include "core/mesh/point.h"
#include "core/mesh/surface.h"

namespace loopcheck::core {

/// Two tangents that span the limit tangent plane within one sector; tangent1 x tangent2 points outward.
/// Directions only: the length of each means nothing.  Weights over the ring, in ring order, then the vertex;
/// they sum to 0.  Empty where there is no plane.
template <class Scalar>
struct SectorMasks {
    Sector sector;
    NoNormal no_normal = NoNormal::None;
    std::vector<Scalar> tangent1, tangent2;
};

/// The limit of one vertex.  Weights over the ring, in ring order, then the vertex itself.
template <class Scalar>
struct LimitMasks {
    std::vector<Scalar> position;  ///< sums to 1
    std::vector<SectorMasks<Scalar>> sectors;
};

/// The limit masks of a vertex at which nothing is semi-sharp: left eigenvectors of the refinement of its
/// ring.  n edges or k faces; b is the neighbours' weight in refinement; c = cos(2 pi/n), theta = pi/k.
///
///     smooth   position  ring w = 1/(n + 3/(8b)), vertex 1 - n w
///              tangents  sum_i cos(2 pi i/n) e_i,  sum_i sin(2 pi i/n) e_i        (3/8 + c/4)
///
///     crease   position  1/6, 2/3, 1/6 along it, for every k
///              tangents  e_0 - e_k                                                (1/2)
///                        -v - cos(theta) (e_0 + e_k)
///                          + (1 + 2 cos(theta)) tan(theta/2) sum_i sin(i theta) e_i
///                                                                                 (3/8 + cos(theta)/4)
///                        k = 1: e_0 + e_1 - 2 v                                   (1/4)
///
///     corner   position  v
///              tangents  e_0 - v,  e_k - v                                        (1/2)
///
///     dart     ring counted from the sharp edge e_0;  q = (5 - sqrt 21)/2, that is q + 1/q = 5
///              position  v: 1,  e_i: (8b/3) (1 - (q^i + q^(n-i))/(1 + q^n)),
///                        e_0: 2b + (l_1 + l_(n-1))/4;  all over their sum
///              tangents  `dart_tangent`;  sum_i sin(2 pi i/n) e_i
///
/// with the eigenvalues of the tangents in brackets.
///
/// Source  [Loop87] and [Hoppe94] for smooth vertices; the others are derived in docs/limits.md.
///
/// Error   each weight is rounded once from 38 digits: half a unit of roundoff.
///
/// Laws    1. each is a left eigenvector of our own rows; 2. position sums to 1, tangents to 0.
template <class Scalar>
LimitMasks<Scalar> limit_masks(const Star& star, Weights weights);

extern template LimitMasks<float> limit_masks<float>(const Star&, Weights);
extern template LimitMasks<double> limit_masks<double>(const Star&, Weights);
extern template LimitMasks<HighPrecision> limit_masks<HighPrecision>(const Star&, Weights);

/// The even tangent of a dart of n >= 3 edges: the dominant even left eigenvector but for the position's.
///
/// With the eigenvalue mu = 3/8 + cos(phi)/4 it is, ring counted from the sharp edge e_0,
///
///     v: 1,   e_i: x_i = b/(mu - 5/8) (1 - cos(phi (i - n/2)) / cos(phi n/2)),  0 < i < n,
///     e_0: 2 (mu - 1 + n b - 3/8 sum_i x_i),
///
/// and phi is the only root in (pi/n, 2.99 pi/n) of
///
///     8 (mu - 1/2) (mu - 5/8 + n b) = b tan(n phi/2) / tan(phi/2).
///
/// n = 6: phi = pi/3, mu = 1/2.  Source  derived in docs/limits.md.
struct DartTangent {
    HighPrecision eigenvalue;
    std::vector<HighPrecision> weights;  ///< e_0, ..., e_(n-1), then the vertex
};
DartTangent dart_tangent(int n, Weights weights);

/// The sum of a mask: weights over the other ends of ring(v), in ring order, then v.  Zero where it is empty.
template <class Real>
Point<Real> sum_over_ring(const Topology& t, Index v, const std::vector<Real>& weights,
                          std::span<const Point<Real>> positions) {
    Point<Real> out{};
    if (weights.empty()) return out;
    const auto ring = t.ring(v);
    for (std::size_t i = 0; i < ring.size(); ++i) out += weights[i] * positions[t.other_end(ring[i], v)];
    return out + weights[ring.size()] * positions[v];
}

/// The limit masks of the vertices of a level.  A vertex at or next to a finite sharpness has no mask of its
/// own kind: its ring is refined until that sharpness is gone, at most 10 levels; the product is its mask.
///
/// What was made is kept, so one table serves many vertices.  Holds on to `level`.
template <class Scalar>
class LimitTable {
  public:
    LimitTable(const SchemeLevel& level, const SchemeOptions& options) : level_(level), options_(options) {}

    /// Over the other ends of ring(v), in ring order, then v.  Valid as long as the table.
    const LimitMasks<Scalar>& masks(Index v);

  private:
    const SchemeLevel& level_;
    SchemeOptions options_;
    std::map<Star, LimitMasks<Scalar>> by_star_;
    std::map<Index, LimitMasks<Scalar>> semi_sharp_;
};

extern template class LimitTable<float>;
extern template class LimitTable<double>;
extern template class LimitTable<HighPrecision>;

/// The limit of every vertex of levels 0 to `levels`, with the tangents of each vertex's first sector; zero
/// where it has no normal.
///
/// Real     float or double, as in `refine`.
/// Errors   as `refine`.
/// Laws     the position is the same at every level, up to rounding.
template <class Real>
Result<Limits> limits(const TriangleMesh& mesh, const SchemeOptions& options, int levels);

extern template Result<Limits> limits<float>(const TriangleMesh&, const SchemeOptions&, int);
extern template Result<Limits> limits<double>(const TriangleMesh&, const SchemeOptions&, int);

/// Relative error of a limit position's weights, in units of roundoff, for anybody's formula: with b right to
/// kLoopWeightUlps = 7, 3/(8b) is right to 8 and w = 1/(n + 3/(8b)) to 10 u; 1 - n w then to 1.7 times that
/// and one more, for n >= 2.
inline constexpr int kLimitWeightUlps = 20;

/// Error of a limit tangent's weights, in units of roundoff of the largest of them, for anybody's formula:
/// the angle 2 pi i/n < 2 pi is right to 3 u of itself, so its cosine and sine to 19 u and half of one more;
/// the crease's factors are smaller and right to a few u for k <= 5.
inline constexpr int kTangentWeightUlps = 32;

}  // namespace loopcheck::core
