// The fewest points that draw a curve within a tolerance.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "core/bspline/spline.h"

namespace loopcheck::core {

/// Points of the curve at ascending parameters, from the first of the domain to the last.
template <CurvePoint P>
struct FlatCurve {
    std::vector<double> parameters;
    std::vector<P> points;
};

namespace detail {

template <CurvePoint P>
Spline<P> second_derivative(const Spline<P>& curve) {
    return curve.degree == 1 ? Spline<P>{} : derivative(derivative(curve));
}

/// max |second derivative| over [a, b], inside interval s: the longest of its Bezier points there.  For
/// cubics it is exact, as it is linear; for all it can only shrink when [a, b] does.  Infinite where knots
/// are so close that it has no value.
template <CurvePoint P>
double largest_second_derivative(const Spline<P>& second, std::size_t s, double a, double b) {
    double largest = 0;
    for (int k = 0; k <= second.degree; ++k) {
        const P point = blossom(second, s, [&](std::size_t r) { return static_cast<int>(r) < k ? b : a; });
        const double length = norm(point);
        if (std::isnan(length)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, length);
    }
    return largest;
}

}  // namespace detail

/// Chords of the curve, each as long as this allows:
///
///     (b - a)^2 / 8  max over [a, b] of |P''|  <=  tolerance
///
/// The left side bounds |P(t) - chord(t)| at every t.  It only grows with [a, b], so no choice of fewer
/// points satisfies it, and going on greedily from the left is the best there is.  At a knot that is as often
/// as the degree the curve may have a corner, and a point is put there.
///
/// Source  the remainder of linear interpolation.
///
/// Range   coordinates in double; tolerance > 0, not NaN; [first, last] inside the domain of the spline.
///
/// Errors  TooLarge where more than `most_points` points would be needed.
///
/// Error   the points are rounded as `evaluate` says; the parameters are found to within 2 units in their
///         last place.
template <CurvePoint P>
Result<FlatCurve<P>> flatten(const Spline<P>& curve, double first, double last, double tolerance,
                             std::size_t most_points) {
    FlatCurve<P> out;
    double a = first, largest = 0;  // of the chord that is growing: where it began, and max |P''| so far
    const auto end_chord = [&](double t) {
        out.parameters.push_back(t);
        out.points.push_back(evaluate(curve, t));
        a = t;
        largest = 0;
    };
    end_chord(first);
    const auto too_large = [] {
        return fail(ErrorCode::TooLarge, "More points are needed for this tolerance than there is room for.");
    };
    const Spline<P> second = detail::second_derivative(curve);
    const auto degree = static_cast<std::size_t>(curve.degree);
    for (std::size_t s = span_of(curve, first); s < curve.points.size() && curve.knots[s] < last; ++s) {
        const double low = std::max(first, curve.knots[s]), high = std::min(last, curve.knots[s + 1]);
        if (low >= high) continue;
        if (low > a && curve.knots[s + 1 - degree] == low) end_chord(low);
        const auto reach = [&](double b) {
            const double from = std::max(a, low);
            return curve.degree == 1
                       ? 0
                       : std::max(largest, detail::largest_second_derivative(second, s - 2, from, b));
        };
        const auto fits = [&](double b) { return (b - a) * (b - a) / 8 * reach(b) <= tolerance; };
        while (!fits(high)) {
            double inside = std::max(a, low), outside = high;
            for (double b = std::midpoint(inside, outside); inside < b && b < outside;
                 b = std::midpoint(inside, outside))
                (fits(b) ? inside : outside) = b;
            if (!(inside > a) || out.points.size() + 1 >= most_points) return too_large();
            end_chord(inside);
        }
        largest = reach(high);
    }
    end_chord(last);
    if (out.points.size() > most_points) return too_large();
    return out;
}

}  // namespace loopcheck::core
