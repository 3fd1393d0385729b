// What an HTML report shows of a curve.
#pragma once

#include <span>
#include <string>

#include "compare/report/curve.h"

namespace loopcheck::compare {

/// Peak memory of the HTML report of a curve, in bytes per point of the last level shown.  A test measures
/// it.
inline constexpr double kShownBytesPerPoint = 100;

/// The HTML file of a curve, with levels of at most so many points.  Requires a build that has the page.
std::string curve_as_html(const CurveReport& report, std::size_t most_points,
                          std::span<const Subject> subjects);

}  // namespace loopcheck::compare
