// A proven bound on rounding, by doing with magnitudes what is done to points.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "core/mesh/rounding.h"

namespace loopcheck::core {

/// A point of a curve whose coordinates are: a magnitude that the exact value does not exceed, and how far a
/// value computed in `precision` by the same operations can be from it.
///
///     a + b, a - b   m = m_a + m_b,    e = e_a + e_b + u (m + e_a + e_b) + t
///     s a            m = |s| m_a,      e = |s| e_a + 4 u |s| (m_a + e_a) + t
///
/// u the roundoff, t the smallest subnormal: a weight s may carry 3 roundings of its own.  Every curve
/// function takes it for a point, so `subdivide` and `evaluate` give bounds of themselves.
///
/// Source  running error analysis; [Higham02], section 3.3.
///
/// Laws    1. a sum of m >= 2 products, begun at zero, is allowed 5 roundings of every term or more: it stays
///         within in any order of summation, with weights that carry 2.
template <Precision precision>
struct RunningError {
    using value_type = double;
    glm::dvec3 magnitude{0};
    glm::dvec3 error{0};

    friend RunningError operator+(const RunningError& a, const RunningError& b) {
        const glm::dvec3 m = a.magnitude + b.magnitude, e = a.error + b.error;
        return {m * kUp, (e + unit_roundoff(precision) * (m + e)) * kUp + smallest_subnormal(precision)};
    }
    friend RunningError operator-(const RunningError& a, const RunningError& b) { return a + b; }
    friend RunningError operator*(double s, const RunningError& a) {
        const double size = std::abs(s);
        const glm::dvec3 m = size * a.magnitude, e = size * a.error;
        return {m * kUp, (e + 4 * unit_roundoff(precision) * (m + e)) * kUp + smallest_subnormal(precision)};
    }

  private:
    static constexpr double kUp = 1 + 0x1p-49;  // the bound is rounded itself, five times an operation
};

/// A control point in double: nothing is lost in double, and rounded to float what that loses.
template <Precision precision>
RunningError<precision> with_running_error(const glm::dvec3& p) {
    const glm::dvec3 lost = precision == Precision::Float ? p - glm::dvec3(glm::vec3(p)) : glm::dvec3(0);
    return {glm::abs(p), glm::abs(lost)};
}

}  // namespace loopcheck::core
