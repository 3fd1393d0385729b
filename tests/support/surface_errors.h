// What is promised of points of the limit surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/loop/evaluate.h"
#include "core/mesh/rounding.h"

namespace loopcheck::tests {

/// Of a coordinate of `apply` to a stencil, for |coordinates| up to M: see `evaluate`.
inline double evaluated_error(const core::SurfaceStencil<double>& stencil, double M) {
    constexpr int kPosition = static_cast<int>(core::Derivative::Position);
    double size = 0;
    for (const double w : stencil.weights[kPosition]) size += std::abs(w);
    const double m = static_cast<double>(stencil.columns.size());
    return core::unit_roundoff(core::Precision::Double) * M *
           (stencil.weight_error[kPosition] + (m + 1) * size);
}

/// E(level) of `tessellate`: of a coordinate of a vertex of that level.
inline double vertex_error(const core::TriangleMesh& mesh, int level) {
    const core::Topology& t = mesh.topology();
    std::size_t largest_ring = 6;
    for (core::Index v = 0; v < t.vertex_count; ++v) largest_ring = std::max(largest_ring, t.ring(v).size());
    return 3 * (level + 1) * static_cast<double>(largest_ring + 30) *
           core::unit_roundoff(core::Precision::Double) * mesh.largest_coordinate();
}

}  // namespace loopcheck::tests
