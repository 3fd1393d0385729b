// Angles for tests.
#pragma once

#include <numbers>

namespace loopcheck::tests {

/// A degree in radians.
inline constexpr double kDegree = std::numbers::pi / 180;

}  // namespace loopcheck::tests
