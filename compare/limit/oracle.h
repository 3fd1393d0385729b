// The exact limit of a vertex, and how far a right implementation can be from it.
#pragma once

#include <map>
#include <vector>

#include "compare/limit/plane.h"
#include "compare/witness.h"
#include "core/loop/limit.h"

namespace loopcheck::compare {

/// The limit of a vertex under a set of masks, with what an implementation in some precision may be off.
struct ExactLimit {
    glm::dvec3 position{0}, position_rest{0};  ///< the exact position as an unevaluated sum
    glm::dvec3 bound{0};                       ///< of the position
    /// Of the first sector.  Nothing else is meaningful where it has none.
    core::NoNormal no_normal = core::NoNormal::None;
    Plane plane;
    glm::dvec3 tangent2_bound{0};  ///< where the masks have tangents, also where they have no plane
};

/// |p - exact limit position|, per coordinate.
glm::dvec3 distance_from_exact(const ExactLimit& exact, const glm::dvec3& p);

/// The limits of the vertices of one level, from the witness's exact positions.
///
///     bound of a position   `core::row_bound` over the witness's bounds, c = kLimitWeightUlps, s_j = |w_j|;
///     a
///                           position that is one vertex's keeps that vertex's bound
///     bound of a tangent    the same, c = kTangentWeightUlps, s_j the largest weight of the tangent; where
///     all are
///                           0 in truth, of the other tangent
///     bound of the plane    `plane_of`
///
/// At a semi-sharp vertex the mask is a product of rows, rounded once: the bound is that of implementations
/// that do the same.
///
/// Error  weights and sums are right to 2^-100 of their terms, far below any of these bounds.
class LimitOracle {
  public:
    LimitOracle(const WitnessLevel& level, const core::SchemeOptions& options)
        : level_(level), table_(level.scheme, options) {}

    /// By the rules of the witness.
    ExactLimit limit(core::Index v, core::Precision precision) {
        return limit(v, table_.masks(v), precision);
    }

    /// By these masks, which must live as long as the oracle.
    ExactLimit limit(core::Index v, const core::LimitMasks<core::HighPrecision>& masks,
                     core::Precision precision);

    /// The position alone, by the rules of the witness.
    DoubleDouble3 position(core::Index v) { return sum(v, rows_for(table_.masks(v)).position); }

  private:
    struct Row {
        std::vector<int> places;  ///< ring positions, then the number of them for the vertex itself
        std::vector<DoubleDouble> weights;
        std::vector<double> rounded, sizes;
    };
    struct VertexRows {
        Row position, tangent1, tangent2;
        core::NoNormal no_normal = core::NoNormal::None;
    };

    const VertexRows& rows_for(const core::LimitMasks<core::HighPrecision>& masks);
    static VertexRows rows_of(const core::LimitMasks<core::HighPrecision>& masks);
    DoubleDouble3 sum(core::Index v, const Row& row);
    glm::dvec3 bound(const Row& row, int ulps, core::Precision precision) const;

    const WitnessLevel& level_;
    core::LimitTable<core::HighPrecision> table_;
    std::map<const void*, VertexRows> rows_;
    std::vector<core::Index> columns_;  ///< of the row that was summed last
};

}  // namespace loopcheck::compare
