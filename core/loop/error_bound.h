// How far a correct implementation can be from the exact result: proven bounds on rounding.
#pragma once

#include <span>

#include "core/loop/rows.h"
#include "core/mesh/refinement.h"

namespace loopcheck::core {

/// Unit roundoff u: 2^-53 for double, 2^-24 for float.
double unit_roundoff(Precision precision);

/// Smallest positive number t: 2^-1074 for double, 2^-149 for float.
double smallest_subnormal(Precision precision);

/// A bound for each coordinate of each vertex, in model units.
using Bounds = Points<double>;

/// Level 0: what rounding the control positions to `precision` moves them; zero for double.
Bounds control_bounds(std::span<const glm::dvec3> positions, Precision precision);

/// The bound of a level from that of its parent.
///
///     E'(i) = sum_j |w_ij| E(j) + g(m_i + c_i) sum_j |w_ij| (|x_j| + E(j)) + m_i t,     g(k) = k u / (1 - k
///     u),
///
/// where m_i is the number of terms of row i, c_i the error of its weights in units of roundoff
/// (`weight_ulps`), x_j the exact parent positions and t the smallest subnormal; where m_i = 1 the vertex is
/// copied and E'(i) = E(i). Valid for any order of summation, with or without fused multiply-add, for every
/// implementation whose weights are as accurate as `weight_ulps` says; so two results a and b of it that are
/// right satisfy |a - b| <= E_a + E_b in every coordinate, and a violation proves that the masks differ.
/// Source  the standard model of floating-point arithmetic; [Higham02], section 3.1.
Bounds next_bounds(const Rows& rows, Weights weights, std::span<const glm::dvec3> exact_parent,
                   const Bounds& parent, Precision precision);

}  // namespace loopcheck::core
