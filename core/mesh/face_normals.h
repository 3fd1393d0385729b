// Normals of faces, and the angles between them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/point.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The unit normal of the triangle (a, b, c), counter-clockwise seen from its tip; nothing where the triangle
/// is degenerate: |ab x ac| <= 8 u |ab| |ac|, which rounding alone can make.
///
/// Range   all finite coordinates with finite differences: edges are scaled first, so nothing over- or
/// underflows. Error   about 4 u / sin(angle at a).
std::optional<glm::dvec3> unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// `unit_normal` of every face.
std::vector<std::optional<glm::dvec3>> face_normals(const Topology& topology,
                                                    std::span<const glm::dvec3> positions);

/// The angle between two unit vectors, in [0, pi]; right to a few u also near 0 and pi:
///
///     2 atan2(|m - n|, |m + n|)
///
/// Source  [Kahan06].
double angle_between(const glm::dvec3& m, const glm::dvec3& n);

/// Two angles that differ by less count as equal, so that a decision does not hang on rounding: whoever
/// numbers the vertices of a symmetric mesh anew gets the same one.  In radians; far above the error of an
/// angle in a triangle that is not a sliver, far below what a user can mean.
inline constexpr double kAngleSlack = 1e-9;

}  // namespace loopcheck::core
