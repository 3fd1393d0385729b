// A comparison of limits in words.
#pragma once

#include <string>
#include <vector>

#include "compare/limit/comparison.h"

namespace loopcheck::compare {

/// The verdict as sentences: what was found, the known deviations that show or fail to, where it differs and
/// who is right, and whether each side agrees with itself from level to level.
std::vector<std::string> limits_in_words(const LimitComparison& comparison, const LimitSide& subject,
                                         const LimitSide& reference);

/// What was predicted of a deviation and what was seen: "predicted up to 0.0152 (0.51 % of M) and 7.16
/// degrees, observed up to 0.0152 (0.51 % of M) and 7.16 degrees".
std::string amounts_in_words(const DeviationSeen& seen, double largest_coordinate);

/// Why normals do not exist: "3 vertices: In a crease sector ..."; a sentence a reason.
std::vector<std::string> undefined_in_words(const LimitStats& stats);

/// All levels together.
LimitStats total(const LimitComparison& comparison);

/// Radians in degrees.
double in_degrees(double radians);

}  // namespace loopcheck::compare
