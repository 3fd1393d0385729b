// Subdivision of curves: the cubic rules, refine-and-average for every degree, and the matrix that both are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/bspline/curve.h"
#include "core/mesh/sparse_matrix.h"

namespace loopcheck::core {

/// One step of the cubic rules, N points to 2N - 1 (closed: 2N):
///
///     c'_2i     = (c_(i-1) + 6 c_i + c_(i+1)) / 8      inside, or closed
///     c'_2i     = c_i                                  at an end
///     c'_(2i+1) = (c_i + c_(i+1)) / 2
///
/// Source  [Lane80]; the rules of creases and boundaries of Loop's scheme are the same.
///
/// Sums are taken from zero, in the order c_(i-1), c_(i+1), c_i, which is OpenSubdiv's: the bits are those of
/// its boundary vertices.
///
/// Range   one point or more.
///
/// Error   4 roundings of the largest |coordinate| a step.
///
/// Laws    1. the curve stays the same; 2. max |second difference| is divided by 4.
template <CurvePoint P>
std::vector<P> subdivide_cubic(const std::vector<P>& c, bool closed) {
    using Scalar = ScalarOf<P>;
    const Scalar eighth = Scalar(1) / 8, three_quarters = Scalar(3) / 4, half = Scalar(1) / 2;
    const std::size_t n = c.size();
    std::vector<P> out;
    out.reserve(closed ? 2 * n : 2 * n - 1);
    for (std::size_t i = 0; i < n; ++i) {
        const bool at_end = i == 0 || i + 1 == n;
        const P& next = c[i + 1 < n ? i + 1 : 0];
        if (at_end && !closed)
            out.push_back(P{} + c[i]);
        else
            out.push_back(P{} + eighth * c[i > 0 ? i - 1 : n - 1] + eighth * next + three_quarters * c[i]);
        if (i + 1 < n || closed) out.push_back(P{} + half * c[i] + half * next);
    }
    return out;
}

/// Refine and average: double every point, then replace all points by the midpoints of neighbours, `degree`
/// times.  A closed sequence of n becomes one of 2 n; an open one of 2 n - degree, those that need no point
/// beyond its ends.
///
/// The first of them belongs to t = (degree - 1) / 4, and closed, turned back by (degree - 1) / 2 whole
/// places, to 0 for odd degrees and 1/4 for even ones; neighbours are 1/2 apart.
///
/// Source  [Lane80].
/// Range   closed: not empty; open: 2 n > degree.
/// Error   `degree` roundings of the largest |coordinate|: halving is exact but for underflow.
/// Laws    1. the weights are binomials over 2^degree; 2. for closed cubics it is `subdivide_cubic`.
template <CurvePoint P>
std::vector<P> refine_and_average(const std::vector<P>& c, int degree, bool closed) {
    const ScalarOf<P> half = ScalarOf<P>(1) / 2;
    std::vector<P> q;
    q.reserve(2 * c.size());
    for (const P& p : c) q.insert(q.end(), 2, p);
    for (int d = 0; d < degree; ++d) {
        const P front = q.front();
        for (std::size_t j = 0; j + 1 < q.size(); ++j) q[j] = half * (q[j] + q[j + 1]);
        if (closed)
            q.back() = half * (q.back() + front);
        else
            q.pop_back();
    }
    if (closed) std::rotate(q.begin(), q.end() - ((degree - 1) / 2) % static_cast<int>(q.size()), q.end());
    return q;
}

/// The curve over half the knot spacing.  Natural and Closed keep their shape; an Open one is cut to the same
/// domain, 2 N - degree points.
///
/// Range   not Clamped: `refine_knots` is for those.
///
/// The largest points may become larger, by rounding, than `make` takes.
template <CurvePoint P>
Curve<P> subdivide(const Curve<P>& curve) {
    const auto [degree, ends] = curve.shape();
    std::vector<P> points;
    if (degree == 3 && ends != Ends::Open) {
        points = subdivide_cubic(curve.points(), ends == Ends::Closed);
    } else if (ends == Ends::Natural) {
        points = refine_and_average(extended_points(curve), degree, false);
        points.erase(points.begin(), points.begin() + phantom_count(curve.shape()));
        points.resize(2 * curve.size() - 1);
    } else {
        points = refine_and_average(curve.points(), degree, ends == Ends::Closed);
    }
    Curve<P> out;  // not checked: with phantoms a mean may be rounded beyond the largest
    out.points_ = std::move(points);
    out.shape_ = curve.shape();
    return out;
}

/// Where control point 0 of the subdivided curve belongs, in the parameter of the curve before.
inline Rational first_parameter(const CurveShape& shape) {
    if (shape.ends == Ends::Open) return Rational(shape.degree - 1, 4);
    return Rational(shape.degree % 2 == 0 ? 1 : 0, 4);
}

/// How many control points a level has, from those of level 0; in double, as no integer may hold it.
double point_count(const CurveShape& shape, std::size_t control_points, int level);

/// The control points of one level, and where they belong in the parameter of level 0.
template <CurvePoint P>
struct CurveLevel {
    std::vector<P> points;
    std::vector<ScalarOf<P>> parameters;
};

/// Levels 0 to `levels`.  Every interval of knots is halved in every step, whatever the shape.
template <CurvePoint P>
std::vector<CurveLevel<P>> curve_levels(const Curve<P>& curve, int levels) {
    using Scalar = ScalarOf<P>;
    std::vector<CurveLevel<P>> out(static_cast<std::size_t>(levels) + 1);
    if (curve.shape().ends == Ends::Clamped) {
        Spline<P> spline = spline_of(curve);
        for (CurveLevel<P>& level : out) {
            if (&level != &out.front()) spline = refine_knots(spline);
            level.points = spline.points;
            for (std::size_t i = 0; i < spline.points.size(); ++i)
                level.parameters.push_back(greville(spline, i));
        }
        return out;
    }
    const auto begin = static_cast<double>(first_parameter(curve.shape()));
    Curve<P> refined = curve;
    double first = 0, step = 1;  // exact: whole multiples of a power of 1/2
    for (CurveLevel<P>& level : out) {
        if (&level != &out.front()) {
            refined = subdivide(refined);
            first += begin * step;
            step /= 2;
        }
        level.points = refined.points();
        level.parameters.reserve(level.points.size());
        for (std::size_t i = 0; i < level.points.size(); ++i)
            level.parameters.push_back(Scalar(first + static_cast<double>(i) * step));
    }
    return out;
}

/// One step as a matrix S: the control points of the next level are S c.  A row of weights for each of them,
/// as `subdivide` (Clamped: `refine_knots`) makes them; exact but for the rounding of fractions that double
/// does not have.
///
/// Errors   those of `check_shape`.
/// Laws     1. every row sums to 1.
Result<SparseMatrix> subdivision_matrix(const CurveShape& shape, std::size_t point_count);

}  // namespace loopcheck::core
