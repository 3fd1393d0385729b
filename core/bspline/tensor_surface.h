// Tensor-product B-spline surfaces: a grid of control points, and a curve's shape in each direction.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/bspline/limit.h"
#include "core/bspline/subdivide.h"

namespace loopcheck::core {

/// Rows of points, one row after the other.
template <class P>
struct Grid {
    std::size_t rows = 0, columns = 0;
    std::vector<P> points;

    const P& at(std::size_t i, std::size_t j) const { return points[i * columns + j]; }
    P& at(std::size_t i, std::size_t j) { return points[i * columns + j]; }
    std::vector<P> row(std::size_t i) const {
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i * columns);
        return {begin, begin + static_cast<std::ptrdiff_t>(columns)};
    }

    bool operator==(const Grid&) const = default;
};

/// Rows become columns.
template <class P>
Grid<P> transposed(const Grid<P>& grid) {
    Grid<P> out{grid.columns, grid.rows, {}};
    out.points.reserve(grid.points.size());
    for (std::size_t j = 0; j < grid.columns; ++j)
        for (std::size_t i = 0; i < grid.rows; ++i) out.points.push_back(grid.at(i, j));
    return out;
}

/// The rows change(row 0), change(row 1), ..., all as long as each other.
template <class P, class Change>
Grid<P> with_rows(const Grid<P>& grid, Change change) {
    Grid<P> out{grid.rows, 0, {}};
    for (std::size_t i = 0; i < grid.rows; ++i) {
        const std::vector<P> row = change(grid.row(i));
        out.columns = row.size();
        out.points.insert(out.points.end(), row.begin(), row.end());
    }
    return out;
}

/// The same with columns.
template <class P, class Change>
Grid<P> with_columns(const Grid<P>& grid, Change change) {
    return transposed(with_rows(transposed(grid), change));
}

/// Every row is a curve of shape u, every column one of shape v.
struct SurfaceShape {
    CurveShape u, v;

    bool operator==(const SurfaceShape&) const = default;
};

/// What `check_shape` says of a row or of a column; Unsupported where the grid is not rows x columns points.
std::optional<Error> check_surface(const SurfaceShape& shape, std::size_t rows, std::size_t columns,
                                   std::size_t point_count);

/// A grid of control points and a shape, known to fit together; finite.
///
///     P(u, v) = sum_i sum_j N_i(v) N_j(u) c_ij
///
/// i the row, j the column, each direction with the functions, phantoms and domain of its `Curve`: u runs
/// along the rows.
template <CurvePoint P>
class TensorSurface {
  public:
    using Scalar = ScalarOf<P>;

    /// Errors   those of `check_surface`; NotFinite, with the point, where a coordinate is NaN or beyond the
    ///          largest number over 2^30, so that a phantom of phantoms could overflow.
    static Result<TensorSurface> make(Grid<P> grid, const SurfaceShape& shape) {
        if (auto error = check_surface(shape, grid.rows, grid.columns, grid.points.size()))
            return tl::unexpected(std::move(*error));
        if (auto error = check_magnitudes(grid.points, 30)) return tl::unexpected(std::move(*error));
        TensorSurface out;
        out.grid_ = std::move(grid);
        out.shape_ = shape;
        return out;
    }

    const Grid<P>& grid() const { return grid_; }
    const SurfaceShape& shape() const { return shape_; }

  private:
    TensorSurface() = default;

    Grid<P> grid_;
    SurfaceShape shape_;
};

namespace detail {

// A row or a column of a surface, whose points and shape are known to be right.
template <CurvePoint P>
Curve<P> curve_of(std::vector<P> points, const CurveShape& shape) {
    return Curve<P>::make(std::move(points), shape).value();
}

}  // namespace detail

/// The surface over half the knot spacing: `subdivide` of every row, then of every column.
///
/// For bicubics this is Catmull and Clark's scheme, a face point being a quarter of each of four points and a
/// vertex point (1, 6, 1)/8 times (1, 6, 1)/8; naturally ended, its boundary edges are creases and its
/// corners are kept.
///
/// Source  [Catmull78].
///
/// Errors   Unsupported where a direction is Clamped: `refine_knots` is for those.
///
/// Error    the roundings of both directions' `subdivide` together, of the largest |coordinate|; for bicubics
///          kBicubicStepRoundings.
///
/// Laws     1. the surface stays the same; 2. columns first gives the same, but for rounding.
template <CurvePoint P>
Result<TensorSurface<P>> subdivide(const TensorSurface<P>& surface) {
    const SurfaceShape& shape = surface.shape();
    if (shape.u.ends == Ends::Clamped || shape.v.ends == Ends::Clamped)
        return fail(ErrorCode::Unsupported,
                    "A surface with clamped ends is not uniform; it is not subdivided.");
    const auto refined = [](const CurveShape& direction) {
        return [&direction](std::vector<P> points) {
            return subdivide(detail::curve_of(std::move(points), direction)).points();
        };
    };
    return TensorSurface<P>::make(with_columns(with_rows(surface.grid(), refined(shape.u)), refined(shape.v)),
                                  shape);
}
/// Two in each direction: an eighth and a half are exact, three quarters one rounding, and each of the three
/// terms of a sum from zero goes through at most two that are not.
inline constexpr int kBicubicStepRoundings = 4;

/// A surface over plain knots, phantoms included: what a `Spline` is for curves.
template <CurvePoint P>
struct TensorSpline {
    Spline<ScalarOf<P>> u, v;  ///< degree and knots of each direction; all their points are zero
    Grid<P> points;
};

/// The same surface over plain knots.
template <CurvePoint P>
TensorSpline<P> spline_of(const TensorSurface<P>& surface) {
    using Scalar = ScalarOf<P>;
    const Grid<P>& grid = surface.grid();
    const auto knots = [](std::size_t count, const CurveShape& shape) {
        return spline_of(detail::curve_of(std::vector<Scalar>(count, Scalar(0)), shape));
    };
    const auto extended = [](const CurveShape& shape) {
        return [&shape](std::vector<P> points) {
            return extended_points(detail::curve_of(std::move(points), shape));
        };
    };
    const auto& [u, v] = surface.shape();
    return {knots(grid.columns, u), knots(grid.rows, v),
            with_columns(with_rows(grid, extended(u)), extended(v))};
}

/// The functions of one direction that reach a parameter, and their first two derivatives.
template <class Scalar>
struct BasisAt {
    std::size_t first = 0;  ///< of degree + 1
    std::array<std::array<Scalar, kMaxDegree + 1>, 3> derivative;
};

/// Those of `u` or `v` of a `TensorSpline`.
template <class Scalar>
BasisAt<Scalar> basis_at(const Spline<Scalar>& direction, const Scalar& t) {
    const std::size_t s = span_of(direction, t);
    BasisAt<Scalar> out{s - static_cast<std::size_t>(direction.degree), {}};
    for (int r = 0; r < 3; ++r)
        out.derivative[r] = interval_basis<Scalar>(direction.knots, direction.degree, s, t, r);
    return out;
}

/// A point of a surface and its derivatives.
template <CurvePoint P>
struct TensorPoint {
    P position{}, du{}, dv{}, duu{}, duv{}, dvv{};

    bool operator==(const TensorPoint&) const = default;
};

/// P(u, v) and its derivatives, where the functions of u and v are known: for many points of a lattice.
template <CurvePoint P>
TensorPoint<P> evaluate(const TensorSpline<P>& surface, const BasisAt<ScalarOf<P>>& u,
                        const BasisAt<ScalarOf<P>>& v) {
    TensorPoint<P> out;
    for (int i = 0; i <= surface.v.degree; ++i) {
        std::array<P, 3> row{};
        for (int j = 0; j <= surface.u.degree; ++j) {
            const P& c = surface.points.at(v.first + i, u.first + j);
            for (int r = 0; r < 3; ++r) row[r] = row[r] + u.derivative[r][j] * c;
        }
        out.position = out.position + v.derivative[0][i] * row[0];
        out.du = out.du + v.derivative[0][i] * row[1];
        out.dv = out.dv + v.derivative[1][i] * row[0];
        out.duu = out.duu + v.derivative[0][i] * row[2];
        out.duv = out.duv + v.derivative[1][i] * row[1];
        out.dvv = out.dvv + v.derivative[2][i] * row[0];
    }
    return out;
}

/// P(u, v) and its derivatives.  Where one jumps it is that of the greater side, at the end of the domain
/// that of the smaller.
///
/// Range   u and v in [first(), last()] of their directions; beyond, the polynomials at the ends go on.
///
/// Error   at most `surface_roundings` of the largest |coordinate| of the points, phantoms included, times
///         `derivative_growth` of each direction.
template <CurvePoint P>
TensorPoint<P> evaluate(const TensorSpline<P>& surface, const ScalarOf<P>& u, const ScalarOf<P>& v) {
    return evaluate(surface, basis_at(surface.u, u), basis_at(surface.v, v));
}

/// Of a derivative of order r in all: the basis functions of both directions, their differences, the products
/// and sums, and the phantoms.
constexpr int surface_roundings(int degree_u, int degree_v, int r) {
    return evaluation_roundings(degree_u) + evaluation_roundings(degree_v) + 4 * r;
}

/// Bound on the sum of |derivative of order r| of all basis functions of a direction:
///
///     2^r                          for knots one apart
///     2^r d (d-1) ... (d-r+1)      Clamped: the narrowest differences are 1
constexpr double derivative_growth(const CurveShape& shape, int r) {
    double out = 1;
    for (int k = 0; k < r; ++k) out *= shape.ends == Ends::Clamped ? 2.0 * (shape.degree - k) : 2.0;
    return out;
}

/// Where the control points go when subdivision goes on for ever, and the derivatives of the surface there:
/// from (first_row, first_column) on those that have a limit.
template <CurvePoint P>
struct SurfaceLimits {
    std::size_t first_row = 0, first_column = 0;
    Grid<P> positions, du, dv;
};

/// `limits` of every row, then of every column.
///
///     bicubic, inside: (1, 4, 1)/6 x (1, 4, 1)/6 and (-1, 0, 1)/2 x (1, 4, 1)/6
///
/// Errors   Unsupported where a direction is Clamped or of degree 1.
///
/// Error    at most 2 (m_u + m_v) + 6 roundings of the largest |coordinate|, phantoms included, m the half of
///          the degree: in each direction a phantom, a weight, a product and 2 m sums, of weights whose
///          absolute values sum to 1 at most.
///
/// Laws     1. they are the surface and its derivatives; 2. those of the vertex points of the next level are
///          the same, with derivatives of half the length.
template <CurvePoint P>
Result<SurfaceLimits<P>> limits(const TensorSurface<P>& surface) {
    const auto& [u, v] = surface.shape();
    if (u.ends == Ends::Clamped || v.ends == Ends::Clamped || u.degree < 2 || v.degree < 2)
        return fail(ErrorCode::Unsupported,
                    "Limit masks are for uniform knots and degrees of 2 and more, in both directions.");
    const auto masked = [](const CurveShape& shape, int r) {
        return [&shape, mask = limit_mask<ScalarOf<P>>(shape.degree, r)](std::vector<P> points) {
            return detail::masked(detail::curve_of(std::move(points), shape), mask);
        };
    };
    const Grid<P> rows = with_rows(surface.grid(), masked(u, 0));
    return SurfaceLimits<P>{first_with_limit(v), first_with_limit(u), with_columns(rows, masked(v, 0)),
                            with_columns(with_rows(surface.grid(), masked(u, 1)), masked(v, 0)),
                            with_columns(rows, masked(v, 1))};
}

}  // namespace loopcheck::core
