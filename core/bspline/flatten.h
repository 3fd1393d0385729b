// The fewest points that draw a curve within a tolerance.
#pragma once

#include <algorithm>
#include <array>
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

/// The Bezier points of the polynomial of interval s over its part [a, b], a < b: its blossoms at a, ..., a,
/// b, ..., b.  With a inserted as often as the degree the points on its right are the blossoms at a, ..., a,
/// k_(s+1), ..., k_(s+i); with b inserted as well those on its left are the result.  All combinations are
/// convex.
template <CurvePoint P>
std::array<P, kMaxDegree + 1> bezier_points(const Spline<P>& c, std::size_t s, double a, double b) {
    const auto d = static_cast<std::size_t>(c.degree);
    std::array<P, kMaxDegree + 1> left, right;
    std::copy_n(c.points.begin() + static_cast<std::ptrdiff_t>(s - d), d + 1, left.begin());
    right[d] = c.points[s];
    for (std::size_t r = 1; r <= d; ++r) {
        for (std::size_t j = d; j >= r; --j) {
            const double low = c.knots[s + j - d], high = c.knots[s + j + 1 - r];
            left[j] = (high - a) / (high - low) * left[j - 1] + (a - low) / (high - low) * left[j];
        }
        right[d - r] = left[d];
    }
    for (std::size_t r = 1; r <= d; ++r)
        for (std::size_t i = d; i >= r; --i) {
            const double high = c.knots[s + i + 1 - r];
            right[i] = (high - b) / (high - a) * right[i - 1] + (b - a) / (high - a) * right[i];
        }
    return right;
}

/// max |second derivative| over [a, b], inside interval s, a < b: the longest of its Bezier points there.
/// For cubics it is exact, as it is linear; for all it can only shrink when [a, b] does.  Infinite where
/// knots are so close that it has no value.
template <CurvePoint P>
double largest_second_derivative(const Spline<P>& second, std::size_t s, double a, double b) {
    const auto points = bezier_points(second, s, a, b);
    double largest = 0;
    for (int k = 0; k <= second.degree; ++k) {
        const double length = norm(points[k]);
        if (std::isnan(length)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, length);
    }
    return largest;
}

/// How many chords equal parts of every interval would take; not fewer than the fewest.
template <CurvePoint P>
double enough_chords(const Spline<P>& curve, const Spline<P>& second, double tolerance) {
    double chords = 0;
    for (auto s = static_cast<std::size_t>(curve.degree); s < curve.points.size(); ++s) {
        const double a = curve.knots[s], b = curve.knots[s + 1];
        if (a < b && curve.degree > 1)
            chords += (b - a) * std::sqrt(largest_second_derivative(second, s - 2, a, b) / 8 / tolerance);
        chords += 1;
    }
    return chords;
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
/// Errors  TooLarge where more than `most_points` could be needed: one a knot, and h sqrt(max |P''| /
///         (8 tolerance)) in every interval of length h; or where doubles are not as close as points must be.
///
/// Error   the points are rounded as `evaluate` says; the parameters are found to within 2 units in their
///         last place.
template <CurvePoint P>
Result<FlatCurve<P>> flatten(const Spline<P>& curve, double first, double last, double tolerance,
                             std::size_t most_points) {
    const Spline<P> second = detail::second_derivative(curve);
    if (!(detail::enough_chords(curve, second, tolerance) < static_cast<double>(most_points)))
        return fail(ErrorCode::TooLarge, "This tolerance may need more points than there is room for.");
    FlatCurve<P> out;
    double a = first, largest = 0;  // of the chord that is growing: where it began, and max |P''| so far
    const auto end_chord = [&](double t) {
        out.parameters.push_back(t);
        out.points.push_back(evaluate(curve, t));
        a = t;
        largest = 0;
    };
    end_chord(first);
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
        const auto fits = [&](double b, double bend) { return (b - a) * (b - a) / 8 * bend <= tolerance; };
        double bend = reach(high);
        for (; !fits(high, bend); bend = reach(high)) {
            // The chord that |P''| up to some b allows is too short where b is outside and too long where it
            // is inside, and close where |P''| hardly changes.  Every third step halves, whatever it does.
            double inside = std::max(a, low), outside = high, b = high;
            for (int step = 1;; ++step) {
                b = step % 3 == 0 ? outside : a + std::sqrt(8 * tolerance / bend);
                if (!(inside < b && b < outside)) b = std::midpoint(inside, outside);
                if (!(inside < b && b < outside)) break;
                bend = reach(b);
                (fits(b, bend) ? inside : outside) = b;
            }
            if (!(inside > a))
                return fail(ErrorCode::TooLarge, "This tolerance needs parameters closer than doubles are.");
            end_chord(inside);
        }
        largest = bend;
    }
    end_chord(last);
    return out;
}

}  // namespace loopcheck::core
