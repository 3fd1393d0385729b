// How far a correct implementation can be from the exact result: proven bounds on rounding.
#pragma once

#include <span>

#include "core/loop/rows.h"
#include "core/mesh/refinement.h"
#include "core/mesh/rounding.h"

namespace loopcheck::core {

/// A bound for each coordinate of each vertex, in model units.
using Bounds = Points<double>;

/// Level 0: what rounding the control positions to `precision` moves them; zero for double.
Bounds control_bounds(std::span<const glm::dvec3> positions, Precision precision);

/// What a row of weights w_j is applied to: exact positions x_j, and implementations that are off by E_j.
struct RowBase {
    std::span<const Index> columns;
    std::span<const glm::dvec3> exact;  ///< x, rounded to double
    const Bounds& bounds;               ///< E
};

/// The bound of one row,
///
///     E' = sum_j |w_j| E_j + g(m + c) sum_j s_j (|x_j| + E_j) + m t,     g(k) = k u / (1 - k u),
///
/// where m is the number of terms, t the smallest subnormal, and an implementation's weight is off by at most
/// c u s_j, with s_j >= |w_j|: s_j = |w_j| where the weights have a relative error.  Valid for any order of
/// summation, with or without fused multiply-add.
///
/// Shapes  `weights` and `sizes` (the s_j) of the length of `base.columns`, which is not 0.
/// Source  the standard model of floating-point arithmetic; [Higham02], section 3.1.
glm::dvec3 row_bound(std::span<const double> weights, std::span<const double> sizes, int ulps,
                     const RowBase& base, Precision precision);

/// The bound of a level from that of its parent: `row_bound` of every row, c being its `weight_ulps` and s_j
/// = |w_j|; a row of one term copies the vertex and E'(i) = E(i).
///
/// Two results a and b of implementations whose weights are as accurate as `weight_ulps` says satisfy
/// |a - b| <= E_a + E_b in every coordinate, and a violation proves that the masks differ.
Bounds next_bounds(const Rows& rows, Weights weights, std::span<const glm::dvec3> exact_parent,
                   const Bounds& parent, Precision precision);

}  // namespace loopcheck::core
