// What two ways to a surface differ by at one parameter, weight by weight.
#pragma once

#include <array>
#include <vector>

#include "core/loop/evaluate.h"
#include "core/mesh/surface.h"

namespace loopcheck::compare {

/// Per order of differentiation (0 position, 1 du dv, 2 duu duv dvv).
using ByOrder = std::array<double, 3>;
inline constexpr int kOrders = 3;
int order_of(core::Derivative derivative);

/// tested - exact over the control vertices that either names.
core::SurfaceRows difference(const core::SurfaceRows& tested, const core::SurfaceStencil<double>& exact);

/// sum_j |w_j|; NaN where a weight is.
double size_of(const std::vector<double>& weights);

/// |sum_j w_j|.
double unbalance_of(const std::vector<double>& weights);

/// The larger one; NaN where either is.
double larger(double a, double b);

/// What rounding explains of sum_j |tested - exact|: the error of our own weights, which is proven, and as
/// much thrice for the tested side, whose way to a regular patch is as long (the same refinement, a basis of
/// no more roundings) and may go through the control points of a patch in another basis.
double allowed_rounding(const core::SurfaceStencil<double>& exact, core::Derivative derivative);
inline constexpr double kRoundingShares = 4;

}  // namespace loopcheck::compare
