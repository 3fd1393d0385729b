// Tangent planes and the angles between them.
#pragma once

#include <glm/vec3.hpp>

#include "compare/limit/double_double.h"

namespace loopcheck::compare {

/// A tangent plane by its unit normal, and how far that of a right implementation can be from it.
struct Plane {
    glm::dvec3 normal{0};  ///< zero where the tangents span no plane or are not finite
    double bound = 0;      ///< of the angle, in radians; infinite where rounding alone can turn it anywhere

    bool exists() const { return normal != glm::dvec3(0); }
};

/// The plane of two tangents that an implementation may have wrong by e_1 and e_2 in each coordinate.
///
/// With |d_1| <= |e_1| and |d_2| <= |e_2| the normal is (t_1 + d_1) x (t_2 + d_2), off from t_1 x t_2 by at
/// most
///
///     D = |e_1| |t_2| + |e_2| |t_1| + |e_1| |e_2|,
///
/// so the angle between the two is at most asin(D / |t_1 x t_2|); where D >= |t_1 x t_2| the geometry does
/// not determine a normal.  kAngleSlack is added for our own roundings.
Plane plane_of(const DoubleDouble3& t1, const DoubleDouble3& t2, const glm::dvec3& e1, const glm::dvec3& e2);

/// The plane of two tangents as given, without a bound.
Plane plane_of(const glm::dvec3& t1, const glm::dvec3& t2);

/// The angle between two planes, in [0, pi/2] radians; infinite where one does not exist.
///
///     atan2(|n_1 x n_2|, |n_1 . n_2|)
///
/// Error  at most kAngleSlack, also for tiny angles: each normal is a unit vector rounded to double, 2 u off,
///        and the three coordinates of their product are 2 u off each.
double angle_between(const Plane& a, const Plane& b);
inline constexpr double kAngleSlack = 0x1p-49;

}  // namespace loopcheck::compare
