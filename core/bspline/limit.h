// Where the control points of a curve go when subdivision goes on for ever, and how far they are from there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/bspline/curve.h"

namespace loopcheck::core {

/// Weights of the neighbours -m, ..., m of a control point, m = degree / 2 rounded down, at the parameter
/// where it belongs, uniform knots: of the curve there (r = 0), or of its derivative of order r.
///
///     degree 3: (1, 4, 1)/6, (-1, 0, 1)/2 and (1, -2, 1);  2: (1, 6, 1)/8;  5: (1, 26, 66, 26, 1)/120
///
/// Source  basis functions at whole numbers.
/// Range   0 <= r < degree: the derivative of order `degree` jumps.
/// Laws    1. sums to 1, or 0 for r > 0; 2. symmetric for even r, its sign turned for odd r.
///
/// Error   each weight 3 roundings; Rational exact.  Scalar is float, double, HighPrecision or Rational.
template <class Scalar>
std::vector<Scalar> limit_mask(int degree, int r);

/// The first control point that has a limit: the others of an Open curve are outside its domain.
inline std::size_t first_with_limit(const CurveShape& shape) {
    return shape.ends == Ends::Open ? static_cast<std::size_t>(shape.degree / 2) : 0;
}

/// Where the control points from `first` on go: those that have a limit, and the derivative of the curve
/// there with respect to its own parameter.
template <CurvePoint P>
struct CurveLimits {
    std::size_t first = 0;
    std::vector<P> positions;
    std::vector<P> tangents;
};

namespace detail {

/// sum_k mask_k c_(i+k), k = -m, ..., m, for every control point i that has a limit.
template <CurvePoint P>
std::vector<P> masked(const Curve<P>& curve, const std::vector<ScalarOf<P>>& mask) {
    const auto m = static_cast<std::int64_t>(mask.size() / 2);
    const std::size_t first = first_with_limit(curve.shape());
    std::vector<P> out;
    for (std::size_t i = first; i + first < curve.size(); ++i) {
        P sum{};
        for (std::int64_t k = -m; k <= m; ++k)
            sum = sum + mask[static_cast<std::size_t>(k + m)] *
                            control_point(curve, static_cast<std::int64_t>(i) + k);
        out.push_back(sum);
    }
    return out;
}

}  // namespace detail

/// Every control point of a Natural or Closed curve has a limit; of an Open one, those in its domain.  At a
/// natural end it is the point itself; for cubics with the tangent along the polygon.
///
/// Range   not Clamped, and degree >= 2: a polygon has no tangent.
///
/// Error   2 m + 5 roundings of the largest |coordinate|, phantoms included.
///
/// Laws    1. it is on the curve; 2. for odd degrees it is that of the vertex point in the next level.
template <CurvePoint P>
CurveLimits<P> limits(const Curve<P>& curve) {
    using Scalar = ScalarOf<P>;
    const CurveShape& shape = curve.shape();
    return {first_with_limit(shape), detail::masked(curve, limit_mask<Scalar>(shape.degree, 0)),
            detail::masked(curve, limit_mask<Scalar>(shape.degree, 1))};
}

/// The second differences c_(i-1) - 2 c_i + c_(i+1) that the curve depends on, the largest length of one.
///
/// Closed: all.  Else those inside: of a Natural curve's phantoms they are zero or as long as inner ones.
template <CurvePoint P>
double largest_second_difference(const Curve<P>& curve) {
    const auto n = static_cast<std::int64_t>(curve.size());
    const std::int64_t skip = curve.shape().ends == Ends::Closed ? 0 : 1;
    double largest = 0;
    for (std::int64_t i = skip; i < n - skip; ++i) {
        const P d = (control_point(curve, i - 1) - control_point(curve, i)) +
                    (control_point(curve, i + 1) - control_point(curve, i));
        largest = std::max(largest, static_cast<double>(norm(d)));
    }
    return largest;
}

/// How far the control polygon of level k can be from the curve at the same parameter,
///
///     4^-k (d + 1)/24 max_i |c_(i-1) - 2 c_i + c_(i+1)|
///
/// and, for cubics with natural ends or closed, how far it is: the vertex point of that i is exactly so far.
///
/// Proof   The difference is sum_i K_i(t) (second difference i) with K_i >= 0.  For c_i = i^2 / 2 all second
///         differences are 1, and it is (d + 1)/24 at whole t and less between.  Second differences of the
///         next level are averages of a quarter of these.
///
/// Range   uniform knots, d >= 2; 0 for d = 1.
///
/// Error   at most kPolygonDistanceRoundings roundings of the largest |coordinate|.
template <CurvePoint P>
double polygon_distance(const Curve<P>& curve, int level) {
    if (curve.shape().degree == 1) return 0;
    return std::ldexp((curve.shape().degree + 1) / 24.0 * largest_second_difference(curve), -2 * level);
}
/// A second difference is at most 4 a coordinate, 4 sqrt(3) < 7 long.  It takes 8 a coordinate, 14 in length,
/// and kNormRoundings of 7 for `norm`; all that times 21/24 at most, and two of the quotient and the product.
inline constexpr int kPolygonDistanceRoundings = 56;

/// The first level whose polygon is within `tolerance` of the curve, by `polygon_distance`; uniform knots.
///
/// Range   tolerance > 0.
template <CurvePoint P>
int level_for_tolerance(const Curve<P>& curve, double tolerance) {
    int level = 0;
    while (polygon_distance(curve, level) > tolerance) ++level;
    return level;
}

}  // namespace loopcheck::core
