// A curve over any knots: evaluation three ways, derivatives, and refinement by blossoming.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/bspline/basis.h"
#include "core/bspline/curve_point.h"
#include "core/mesh/error.h"

namespace loopcheck::core {

/// BadKnots, with a sentence, unless 1 <= degree <= kMaxDegree and `point_count` > degree; there are
/// point_count + degree + 1 knots, ascending and not beyond the largest double over 2^24; none is inside the
/// domain more than `degree` times; and the first and last interval of the domain are not empty.
///
/// Then the curve is continuous, every control point has a say, and sums of knots are finite.
std::optional<Error> check_knots(std::span<const double> knots, int degree, std::size_t point_count);

/// P(t) = sum_i N_i(t) c_i over knots k, for t in [k_d, k_n]; d the degree, n the number of points.
///
/// Made from a `Curve` by `spline_of`, or from knots of one's own that pass `check_knots`.
template <CurvePoint P>
struct Spline {
    using Scalar = ScalarOf<P>;
    int degree = 3;
    std::vector<Scalar> knots;
    std::vector<P> points;
    bool one_apart = false;  ///< the knots are: cubics are then summed in closed form

    const Scalar& first() const { return knots[degree]; }
    const Scalar& last() const { return knots[points.size()]; }
};

/// The interval of t: the largest s with k_s <= t, within those of the domain that are not empty.  Beyond the
/// domain it is the first or last of them, so that evaluation goes on along the polynomials at the ends.
///
/// Cost    a binary search; a subtraction where the knots are one apart and Scalar is a built-in type.
template <CurvePoint P>
std::size_t span_of(const Spline<P>& c, const ScalarOf<P>& t) {
    if constexpr (std::floating_point<ScalarOf<P>>) {
        if (c.one_apart) {
            const std::size_t d = static_cast<std::size_t>(c.degree), last = c.points.size() - 1;
            const ScalarOf<P> steps = t - c.knots[d];
            if (!(steps >= 1)) return d;
            const std::size_t s =
                steps < static_cast<ScalarOf<P>>(last - d) ? d + static_cast<std::size_t>(steps) : last;
            return t < c.knots[s] ? s - 1 : s;  // the difference may have been rounded up to s - d
        }
    }
    const auto begin = c.knots.begin() + c.degree + 1, end = c.knots.begin() + c.points.size();
    auto s = std::upper_bound(begin, end, t) - c.knots.begin() - 1;
    while (c.knots[s] == c.knots[s + 1]) --s;
    return static_cast<std::size_t>(s);
}

/// The blossom of the polynomial of interval s at the `degree` arguments a_1, ..., a_d: symmetric, affine in
/// each, and the polynomial itself where all are t.  The arguments k_(i+1), ..., k_(i+d) give c_i, and any
/// other knots the control points over those.
///
///     b_j,0 = c_j,   b_j,r = ((k_(j+d+1-r) - a_r) b_j-1,r-1 + (a_r - k_j) b_j,r-1) / (k_(j+d+1-r) - k_j)
///
/// Source  [Ramshaw89]; with equal arguments it is de Boor's algorithm.
///
/// Error   at most kBasisRoundingsPerDegree * degree roundings of the largest |coordinate| in use, where
///         every argument is in the interval and nothing underflows.
template <CurvePoint P, class Argument>
P blossom(const Spline<P>& c, std::size_t s, Argument argument) {
    using Scalar = ScalarOf<P>;
    const auto d = static_cast<std::size_t>(c.degree);
    std::array<P, kMaxDegree + 1> b;
    std::copy_n(c.points.begin() + static_cast<std::ptrdiff_t>(s - d), d + 1, b.begin());
    for (std::size_t r = 1; r <= d; ++r) {
        const Scalar a = argument(r - 1);
        for (std::size_t j = s; j > s - d + r - 1; --j) {
            const Scalar &low = c.knots[j], &high = c.knots[j + d + 1 - r];
            const Scalar width = high - low;
            P& point = b[j + d - s];
            point = Scalar((high - a) / width) * b[j + d - s - 1] + Scalar((a - low) / width) * point;
        }
    }
    return b[d];
}

/// How a point of a curve is found.
enum class Evaluation : std::uint8_t {
    AllPoints,  ///< sum N_i(t) c_i over every control point
    Local,      ///< over the degree + 1 that reach the interval of t; one fewer at the knot that begins it
    DeBoor,     ///< affine combinations of degree + 1 control points; no basis function is evaluated
};

struct EvaluationOptions {
    Evaluation method = Evaluation::DeBoor;
    std::int64_t* basis_evaluations = nullptr;  ///< where given, the number of basis functions is added to it
};

namespace detail {

template <CurvePoint P>
P basis_sum(const Spline<P>& c, const ScalarOf<P>& t, std::size_t first, std::size_t end,
            std::int64_t* count) {
    using Scalar = ScalarOf<P>;
    const bool closed_form = c.one_apart && c.degree == 3;
    P sum{};
    for (std::size_t i = first; i < end; ++i) {
        const Scalar weight = closed_form ? cubic_basis(Scalar(t - c.knots[i + 2]))
                                          : basis_function<Scalar>(c.knots, c.degree, i, t);
        sum = sum + weight * c.points[i];
    }
    if (count != nullptr) *count += static_cast<std::int64_t>(end - first);
    return sum;
}

}  // namespace detail

/// P(t).
///
/// Range   t in [first(), last()].  Beyond, DeBoor follows the polynomial at the end; the sums lose weight.
///
/// Error   by each of the three methods, at most `evaluation_roundings(degree)` roundings of the largest
///         |coordinate| of the control points, and as many smallest subnormals where products underflow.
///
/// Laws    1. AllPoints and Local give the same bits: what they differ in are terms that are zero.
template <CurvePoint P>
P evaluate(const Spline<P>& c, const ScalarOf<P>& t, const EvaluationOptions& options = {}) {
    if (options.method == Evaluation::AllPoints)
        return detail::basis_sum(c, t, 0, c.points.size(), options.basis_evaluations);
    const std::size_t s = span_of(c, t);
    if (options.method == Evaluation::DeBoor) return blossom(c, s, [&](std::size_t) { return t; });
    const std::size_t last_is_zero = t == c.knots[s] ? 1 : 0;
    return detail::basis_sum(c, t, s - c.degree, s + 1 - last_is_zero, options.basis_evaluations);
}

/// Of a sum of degree + 1 products with basis functions in closed form or by the recursion, or of de Boor's
/// algorithm; and of control points that are phantoms.
constexpr int evaluation_roundings(int degree) {
    return (kBasisRoundingsPerDegree + 2) * degree + 3;
}

/// The derivative, a curve of one degree less over the knots without the first and the last:
///
///     c'_i = d (c_(i+1) - c_i) / (k_(i+d+1) - k_(i+1))
///
/// Range   degree >= 1; degree 0 is a step function, right-continuous.
/// Error   4 roundings of the same with |c_i| and |c_(i+1)| added.
template <CurvePoint P>
Spline<P> derivative(const Spline<P>& c) {
    using Scalar = ScalarOf<P>;
    Spline<P> out{c.degree - 1, {c.knots.begin() + 1, c.knots.end() - 1}, {}, c.one_apart};
    for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
        const Scalar width = c.knots[i + c.degree + 1] - c.knots[i + 1];
        out.points.push_back(width == 0 ? P{} : Scalar(c.degree / width) * (c.points[i + 1] - c.points[i]));
    }
    return out;
}

/// Where control point i belongs on the parameter line: the mean of k_(i+1), ..., k_(i+d).  The curve with
/// the control points (xi_i, y_i) has the graph of y over t.
template <CurvePoint P>
ScalarOf<P> greville(const Spline<P>& c, std::size_t i) {
    ScalarOf<P> sum(0);
    for (int k = 1; k <= c.degree; ++k) sum += c.knots[i + k];
    return sum / c.degree;
}

namespace detail {

/// Puts knot u after the last knot of `c` and lets its last degree + 1 points, which are all that reach u,
/// become degree + 2.  `right` begins the knots that are still to come.  All combinations are convex.
///
/// Source  [Boehm80].
template <CurvePoint P>
void insert_knot(Spline<P>& c, const ScalarOf<P>& u, std::span<const ScalarOf<P>> right) {
    using Scalar = ScalarOf<P>;
    const auto d = static_cast<std::size_t>(c.degree);
    const P last = c.points.back();
    c.points.push_back(last);
    const auto p = c.points.end() - static_cast<std::ptrdiff_t>(d + 2);
    for (std::size_t j = d; j > 0; --j) {
        const Scalar &low = c.knots[c.knots.size() - 1 - (d - j)], &high = right[j - 1];
        const Scalar width = high - low;
        p[j] = Scalar((high - u) / width) * p[j - 1] + Scalar((u - low) / width) * p[j];
    }
    c.knots.push_back(u);
}

}  // namespace detail

/// The same curve with a knot put into the middle of every interval of the domain that is not empty.
///
/// Error   at most kBasisRoundingsPerDegree * degree roundings of the largest |coordinate|: a control point
///         comes from at most `degree` convex combinations, one after the other.
///
/// Laws    1. evaluation is unchanged; 2. the control polygon comes 4 times closer where the curve is smooth.
template <CurvePoint P>
Spline<P> refine_knots(const Spline<P>& c) {
    using Scalar = ScalarOf<P>;
    const auto d = static_cast<std::ptrdiff_t>(c.degree);
    const std::size_t n = c.points.size();
    Spline<P> out{c.degree,
                  {c.knots.begin(), c.knots.begin() + d + 1},
                  {c.points.begin(), c.points.begin() + d + 1},
                  false};
    for (auto s = static_cast<std::size_t>(d); s < n; ++s) {
        const Scalar &low = c.knots[s], &high = c.knots[s + 1];
        if (low < high)
            detail::insert_knot<P>(out, Scalar((low + high) / 2), std::span(c.knots).subspan(s + 1));
        out.knots.push_back(high);
        if (s + 1 < n) out.points.push_back(c.points[s + 1]);
    }
    out.knots.insert(out.knots.end(), c.knots.begin() + static_cast<std::ptrdiff_t>(n) + 1, c.knots.end());
    return out;
}

}  // namespace loopcheck::core
