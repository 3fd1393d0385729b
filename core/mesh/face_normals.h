// Normals of faces, and the angles between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/point.h"
#include "core/mesh/rounding.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The unit normal of the triangle (a, b, c), counter-clockwise seen from its tip; nothing where the triangle
/// is degenerate: at the corner with the largest angle, |side x side| <= 8 u |side| |side|, which rounding
/// alone can make.
///
/// Range   all finite coordinates with finite differences: sides are scaled first, so nothing over- or
///         underflows.
/// Error   at most `unit_normal_error` of the sine of the largest angle.
/// Laws    1. turning the corners, to (b, c, a), changes no bit; 2. swapping two corners only negates it.
std::optional<glm::dvec3> unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Length of the error of `unit_normal`: 7 u / sine + 5 u.
constexpr double unit_normal_error(double sine) {
    return (7 / sine + 5) * unit_roundoff(Precision::Double);
}

/// `unit_normal` of every face.
std::vector<std::optional<glm::dvec3>> face_normals(const Topology& topology,
                                                    std::span<const glm::dvec3> positions);

/// The angle between two unit vectors, in [0, pi]:
///
///     2 atan2(|m - n|, |m + n|)
///
/// Source  W. Kahan; the arc cosine of m . n would lose half of the digits near 0 and pi.
/// Error   at most kAngleError where the lengths of m and n are within 4 u of 1, also near 0 and pi.
double angle_between(const glm::dvec3& m, const glm::dvec3& n);

/// 20 u: 8 u for the lengths, 7 u sin(angle) for |m - n| and |m + n|, 2 u angle for the arc tangent.
inline constexpr double kAngleError = 20 * unit_roundoff(Precision::Double);

/// Two angles that differ by less count as equal, so that a decision does not hang on rounding: whoever
/// numbers the vertices of a symmetric mesh anew gets the same one.  In radians; far above the error of an
/// angle between triangles that are not slivers, far below what a user can mean.
inline constexpr double kAngleSlack = 1e-9;

}  // namespace loopcheck::core
