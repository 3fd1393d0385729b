// Boost.Math's cardinal B-splines: uniform basis functions and curves that share nothing with core/bspline.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/error.h"

namespace loopcheck::reference {

/// Highest degree that is compiled: with Boost it is a template argument.
inline constexpr int kBoostMaxDegree = 10;

/// Version of the Boost headers this was compiled with, "1.74".
std::string boost_version();

/// B_d(x), the uniform B-spline of degree d centred at 0 with knots 1 apart, or its derivative of order 1 or
/// 2: boost::math::cardinal_b_spline, _prime and _double_prime.
///
/// Range    x finite (where d - order < 2, Boost makes a number of a NaN).
///
/// Errors   Unsupported where 1 <= degree <= kBoostMaxDegree does not hold, and what Boost does not have:
///          orders other than 0, 1 and 2, and order 2 for degrees 1 and 2.
///
/// Error    2^order boost_cardinal_roundings(d) roundings of 1 (see there); relative ones say nothing near
/// the
///          end of the support.
///
/// Boost's ways (1.74): the slope of degree 1 is the mean of both sides at 0 and +-1, where core/bspline
/// takes the right one, and goes on as -1 for x > 1 and +1 for x < -1, where it should be 0.  Degree 0, which
/// this leaves out, is 1/2 at its jumps, with an infinite derivative.  Odd derivatives of -x are exact
/// negatives, and all others the same bits.
core::Result<double> boost_cardinal(int degree, double x, int derivative_order);

/// (d + 1)^3: what the error of Boost's value counts at most.
///
/// Proof   Boost starts with the hat function at d places 1 apart, each after at most d + 1 roundings of
///         numbers up to d + 1; only those within the hat are not 0, and they are off by ((d+1)^2 + 1) u.
///         Step j combines two neighbours with a and b over j, a + b = j + 1 and both positive where what is
///         not 0 is combined, so that the error grows by (j + 1)/j; a and b are off by d (d + 1) u and their
///         neighbours sum to 1 at most; three more roundings.  So E_j / (j + 1) sums up to
///
///             ((d+1)^2 + 1)/2 + d (d-1)/2 + (d - 1) = d^2 + 3/2 d
///
///         and (d + 1) times that is less than (d + 1)^3.  A derivative of order r is a difference of order r
///         of values of degree d - r on the way there.
constexpr int boost_cardinal_roundings(int degree) {
    return (degree + 1) * (degree + 1) * (degree + 1);
}

/// sum_i B_d(t - i) c_i at each of the parameters, over the d + 1 points that reach t, in the order of i;
/// points[k] is c_(first + k), phantoms included.  Coordinates are double; P is double, glm::dvec2 or dvec3.
///
/// Errors   Unsupported as above; OutsideDomain where some of the points that reach t are not given, which is
///          outside [first + (d-1)/2, last - (d-1)/2].
///
/// Error    boost_curve_roundings(d) roundings of the largest |coordinate| of the points.
template <class P>
core::Result<std::vector<P>> boost_curve_points(int degree, std::span<const P> points, std::int64_t first,
                                                std::span<const double> parameters);

/// d + 1 weights with the error of Boost and that of t - i, a rounding of (d + 1)/2 with slopes up to 1;
/// products and sums.
constexpr int boost_curve_roundings(int degree) {
    return (degree + 1) * boost_cardinal_roundings(degree) + (degree + 2) * (degree + 2);
}

}  // namespace loopcheck::reference
