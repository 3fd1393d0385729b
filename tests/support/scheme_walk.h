// The scheme taken step by step: rows first, then positions in any scalar type, then bounds.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/loop/error_bound.h"
#include "core/loop/refine.h"
#include "core/mesh/high_precision.h"
#include "tests/support/observed.h"

namespace loopcheck::tests {

/// The steps from level 0 to `levels`.  Throws where there are none, which fails the test.
inline std::vector<core::Step> steps_of(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                        int levels) {
    std::vector<core::Step> steps;
    const core::SchemeLevel control = core::control_level(mesh, options.boundary);
    for (int l = 0; l < levels; ++l) {
        auto step = core::next_level(l == 0 ? control : steps.back().child, options);
        if (!step) throw std::runtime_error(core::to_string(step.error()));
        steps.push_back(std::move(*step));
    }
    return steps;
}

/// True where every weight of a mask is a fraction of integers.
inline bool is_fraction(const core::Mask& mask, core::Weights weights) {
    const bool smooth = mask.point == core::Mask::Point::Vertex &&
                        (core::detail::is_smooth(mask.parent) || core::detail::is_smooth(mask.child));
    return !smooth || weights == core::Weights::Warren || core::is_rational_loop_weight(mask.ring);
}
inline bool are_fractions(const std::vector<core::Step>& steps, core::Weights weights) {
    return std::all_of(steps.begin(), steps.end(), [&](const core::Step& step) {
        return std::all_of(step.rows.masks.begin(), step.rows.masks.end(),
                           [&](const core::Mask& mask) { return is_fraction(mask, weights); });
    });
}

/// Positions of every level, from those of level 0.
template <class Scalar>
std::vector<core::Points<Scalar>> positions_of(const std::vector<core::Step>& steps, core::Weights weights,
                                               core::Points<Scalar> control) {
    std::vector<core::Points<Scalar>> levels{std::move(control)};
    for (const auto& step : steps) levels.push_back(core::apply<Scalar>(step.rows, weights, levels.back()));
    return levels;
}

template <class Scalar>
std::vector<core::Points<Scalar>> positions_of(const std::vector<core::Step>& steps, core::Weights weights,
                                               const core::TriangleMesh& mesh) {
    return positions_of<Scalar>(steps, weights, core::convert_points<Scalar>(mesh.positions()));
}

using ExactLevels = std::vector<core::Points<core::HighPrecision>>;

/// Bounds of every level, from those of level 0.
inline std::vector<core::Bounds> bounds_of(const std::vector<core::Step>& steps, core::Weights weights,
                                           const ExactLevels& exact, core::Bounds control,
                                           core::Precision precision) {
    std::vector<core::Bounds> levels{std::move(control)};
    for (std::size_t l = 0; l < steps.size(); ++l)
        levels.push_back(core::next_bounds(steps[l].rows, weights, core::convert_points<double>(exact[l]),
                                           levels.back(), precision));
    return levels;
}

inline std::vector<core::Bounds> bounds_of(const std::vector<core::Step>& steps, core::Weights weights,
                                           const ExactLevels& exact, const core::TriangleMesh& mesh,
                                           core::Precision precision) {
    return bounds_of(steps, weights, exact, core::control_bounds(mesh.positions(), precision), precision);
}

/// Adds to `use`, for every coordinate, which share of the bound its error takes.
template <class Points>
void add_use(Observed& use, const Points& points, const core::Points<core::HighPrecision>& exact,
             const core::Bounds& bounds) {
    ASSERT_EQ(points.size(), exact.size());
    ASSERT_EQ(points.size(), bounds.size());
    const auto add = [&](std::size_t v, auto x, const core::HighPrecision& wanted, double bound) {
        use.add(share_of(error_of_value(x, wanted), bound), static_cast<std::int64_t>(v),
                static_cast<double>(x), static_cast<double>(wanted));
    };
    for (std::size_t v = 0; v < points.size(); ++v) {
        add(v, points[v].x, exact[v].x, bounds[v].x);
        add(v, points[v].y, exact[v].y, bounds[v].y);
        add(v, points[v].z, exact[v].z, bounds[v].z);
    }
}

}  // namespace loopcheck::tests
