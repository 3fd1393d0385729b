// Reports of a curve.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "compare/curve/curve_comparison.h"
#include "core/bspline/flatten.h"

namespace loopcheck::compare {

/// What a drawing within a tolerance takes.
struct ToleranceReport {
    double tolerance = 0;
    std::optional<int> level = {};  ///< the first certified one; nothing for clamped knots
    double level_points = 0;        ///< and how many points it has
    double distance = 0;            ///< what is certified of it
    std::optional<std::size_t> flat_points =
        {};  ///< points of the curve itself that are enough; nothing: too many
};

struct CurveReport {
    std::string file;
    int dimension = 3;
    core::Curve<glm::dvec3> curve;
    CurveComparison comparison;
    std::optional<ToleranceReport> tolerance;
};

/// The curve, a line a level, the ways of evaluation, the peers, and the verdict in words.
std::string curve_as_text(const CurveReport& report);

/// The document of docs/report.schema.json.
std::string curve_as_json(const CurveReport& report, std::span<const Subject> subjects);

/// A line a point of every level: the point, the point of the curve at its parameter (empty outside the
/// domain), and how far they are apart.
std::string curve_as_csv(const CurveReport& report);

/// Levels that a picture shows: more than three look like the curve.
inline constexpr int kDrawnLevels = 3;

/// The two coordinates that vary most, ascending: those that a picture shows.  Requires a point.
std::array<int, 2> drawn_axes(const std::vector<glm::dvec3>& points);

/// Control polygon, refined polygons and the exact curve; the polygons drawn `magnify` times as far from the
/// curve as they are.  Of three coordinates the two that vary most.
std::string curve_as_svg(const CurveReport& report, double magnify);

}  // namespace loopcheck::compare
