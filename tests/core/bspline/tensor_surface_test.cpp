#include "core/bspline/tensor_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/mesh/rounding.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using namespace tests;

constexpr CurveShape kNatural{3, Ends::Natural};
constexpr CurveShape kClosed{3, Ends::Closed};

// Bicubic open, cylinders both ways and torus, then other degrees and end rules, each direction its own.
const std::vector<SurfaceShape> kShapes{
    {kNatural, kNatural},
    {kNatural, kClosed},
    {kClosed, kNatural},
    {kClosed, kClosed},
    {{1, Ends::Natural}, kNatural},
    {{2, Ends::Closed}, {5, Ends::Natural}},
    {{4, Ends::Open}, {3, Ends::Open}},
};

std::size_t fewest_points(const CurveShape& shape) {
    std::size_t count = 1;
    while (check_shape(shape, count)) ++count;
    return count;
}

// Whole numbers of both signs.
template <class Scalar>
Grid<Scalar> random_grid(std::size_t rows, std::size_t columns) {
    std::mt19937 random(1);
    Grid<Scalar> out{rows, columns, {}};
    for (std::size_t k = 0; k < rows * columns; ++k)
        out.points.push_back(Scalar(static_cast<int>(random() % 2001) - 1000));
    return out;
}

template <class P>
TensorSurface<P> surface_of(Grid<P> grid, const SurfaceShape& shape) {
    auto made = TensorSurface<P>::make(std::move(grid), shape);
    if (!made) throw std::runtime_error(to_string(made.error()));
    return std::move(*made);
}

// Over the smallest grid of a shape, or one that is some larger.
template <class Scalar>
TensorSurface<Scalar> random_surface(const SurfaceShape& shape, std::size_t larger) {
    const std::size_t rows = fewest_points(shape.v) + larger, columns = fewest_points(shape.u) + 2 * larger;
    return surface_of(random_grid<Scalar>(rows, columns), shape);
}

// One of coordinates whose last bits are as random as the first, and the same in 38 digits.
template <class Real>
struct Uneven {
    TensorSurface<Point<Real>> rounded;
    TensorSurface<Point<HighPrecision>> exact;
};
template <class Real>
Uneven<Real> uneven_surface(const SurfaceShape& shape, std::size_t larger) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-1000, 1000);
    Grid<Point<Real>> grid{fewest_points(shape.v) + larger, fewest_points(shape.u) + 2 * larger, {}};
    for (std::size_t k = 0; k < grid.rows * grid.columns; ++k) {
        const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
        grid.points.emplace_back(x, y, z);
    }
    return {surface_of(grid, shape),
            surface_of(Grid<Point<HighPrecision>>{grid.rows, grid.columns,
                                                  convert_points<HighPrecision>(grid.points)},
                       shape)};
}

// Parameters of the whole domain, its ends and knots among them.
template <class Scalar>
std::vector<Scalar> parameters(const Spline<Scalar>& direction, int count) {
    std::vector<Scalar> out;
    for (int k = 0; k <= count; ++k)
        out.push_back(direction.first() + (direction.last() - direction.first()) * k / count);
    return out;
}

template <class P>
std::array<P, 6> listed(const TensorPoint<P>& p) {
    return {p.position, p.du, p.dv, p.duu, p.duv, p.dvv};
}

TEST(TensorSurface, RefusesWhatIsNotAGrid) {
    const SurfaceShape open{kNatural, kNatural};
    const auto code = [](Grid<double> grid, const SurfaceShape& shape) {
        return error_of(TensorSurface<double>::make(std::move(grid), shape)).code;
    };
    EXPECT_EQ(code({1, 4, {1, 2, 3, 4}}, open), ErrorCode::TooFewPoints);
    EXPECT_EQ(code({2, 2, {1, 2, 3, 4}}, {kNatural, kClosed}), ErrorCode::TooFewPoints);
    EXPECT_EQ(code({0, 0, {}}, open), ErrorCode::TooFewPoints);
    EXPECT_EQ(code({2, 2, {1, 2, 3}}, open), ErrorCode::Unsupported);
    EXPECT_EQ(code({2, 2, {1, 2, 3, 4}}, {kNatural, {2, Ends::Natural}}), ErrorCode::Unsupported);
    const std::size_t huge = std::size_t{1} << 33;  // huge x huge is 4 modulo 2^64
    EXPECT_EQ(code({huge, huge, {1, 2, 3, 4}}, open), ErrorCode::Unsupported);
    for (const double bad : {std::nan(""), -HUGE_VAL, 1e300}) {
        const auto error = error_of(TensorSurface<double>::make({2, 2, {1, 2, bad, 4}}, open));
        EXPECT_EQ(error.code, ErrorCode::NotFinite);
        EXPECT_EQ(error.place, (Place{Place::Kind::Point, 2}));
    }
}

TEST(TensorSurface, SaysWhichDirectionIsTooShort) {
    const auto error =
        error_of(TensorSurface<double>::make({2, 4, std::vector<double>(8)}, {kNatural, kClosed}));
    EXPECT_TRUE(contains(error.sentence, "columns (v)")) << error.sentence;
}

TEST(TensorSubdivide, OfAClampedSurfaceIsRefused) {
    for (const SurfaceShape& shape :
         {SurfaceShape{{3, Ends::Clamped}, kClosed}, {kClosed, {3, Ends::Clamped}}}) {
        const auto clamped = surface_of(random_grid<double>(4, 4), shape);
        EXPECT_EQ(error_of(subdivide(clamped)).code, ErrorCode::Unsupported);
        EXPECT_EQ(error_of(limits(clamped)).code, ErrorCode::Unsupported);
    }
}

// The masks of Catmull and Clark written out in sixty-fourths, one control point after the other being 64 and
// the others 0.
TEST(TensorSubdivide, OfABicubicHasCatmullAndClarksMasks) {
    const auto level = [](std::size_t unit) {
        Grid<double> grid{3, 3, std::vector<double>(9)};
        grid.points[unit] = 64;
        return subdivide(surface_of(std::move(grid), {kNatural, kNatural}))->grid();
    };
    const std::array<double, 9> vertex{1, 6, 1, 6, 36, 6, 1, 6, 1}, edge{0, 4, 4, 0, 24, 24, 0, 4, 4},
        face{0, 0, 0, 0, 16, 16, 0, 16, 16}, rim{8, 48, 8}, corner{64}, rim_edge{32, 32};
    for (std::size_t unit = 0; unit < 9; ++unit) {
        const auto grid = level(unit);
        ASSERT_EQ(grid.rows, 5U);
        ASSERT_EQ(grid.columns, 5U);
        EXPECT_EQ(grid.at(2, 2), vertex[unit]);
        EXPECT_EQ(grid.at(2, 3), edge[unit]);
        EXPECT_EQ(grid.at(3, 3), face[unit]);
        EXPECT_EQ(grid.at(0, 2), rim[unit]);
        EXPECT_EQ(grid.at(0, 1), rim_edge[unit]);
        EXPECT_EQ(grid.at(0, 0), corner[unit]);
    }
}

TEST(TensorSubdivide, KeepsTheSurfaceExactly) {
    for (const SurfaceShape& shape : kShapes)
        for (const std::size_t larger : {0U, 2U}) {
            const auto coarse = random_surface<Rational>(shape, larger);
            const auto fine = *subdivide(coarse);
            const auto before = spline_of(coarse), after = spline_of(fine);
            const Rational u0 = first_parameter(shape.u), v0 = first_parameter(shape.v);
            // t of the level before is the first parameter and half of t here.
            const auto place = [](const Rational& t, const Rational& first) {
                return Rational(first + t / 2);
            };
            for (const Rational& u : parameters(after.u, 5))
                for (const Rational& v : parameters(after.v, 3)) {
                    const auto a = evaluate(before, place(u, u0), place(v, v0)), b = evaluate(after, u, v);
                    EXPECT_EQ(a.position, b.position);
                    EXPECT_EQ(a.du, 2 * b.du);
                    EXPECT_EQ(a.duv, 4 * b.duv);
                }
        }
}

TEST(TensorSubdivide, RowsFirstOrColumnsFirstIsTheSame) {
    for (const SurfaceShape& shape : kShapes) {
        const auto surface = random_surface<Rational>(shape, 1);
        const auto turned = surface_of(transposed(surface.grid()), {shape.v, shape.u});
        EXPECT_EQ(transposed(subdivide(surface)->grid()), subdivide(turned)->grid());
    }
}

// Levels 1 to 5, against the same in 38 digits: k levels of kBicubicStepRoundings each, of weights that are
// not negative and sum to 1.
template <class Real>
void check_rounding(Precision precision) {
    for (const SurfaceShape& shape :
         {SurfaceShape{kNatural, kNatural}, {kNatural, kClosed}, {kClosed, kClosed}}) {
        auto [rounded, exact] = uneven_surface<Real>(shape, 3);
        for (int k = 1; k <= 5; ++k) {
            rounded = *subdivide(rounded);
            exact = *subdivide(exact);
            Observed seen("rounding of level " + std::to_string(k), "point",
                          rounding_of(k * kBicubicStepRoundings, precision) * 1000);
            const auto& a = rounded.grid().points;
            const auto& b = exact.grid().points;
            ASSERT_EQ(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i) {
                seen.add(error_of_value(a[i].x, b[i].x), static_cast<std::int64_t>(i));
                seen.add(error_of_value(a[i].z, b[i].z), static_cast<std::int64_t>(i));
            }
            seen.check();
        }
    }
}
TEST(TensorSubdivide, StaysWithinItsRoundingsInDouble) {
    check_rounding<double>(Precision::Double);
}
TEST(TensorSubdivide, StaysWithinItsRoundingsInFloat) {
    check_rounding<float>(Precision::Float);
}

TEST(TensorEvaluate, OfBilinearPatchesIsBilinear) {
    const CurveShape linear{1, Ends::Natural};
    const auto surface = spline_of(surface_of(Grid<Rational>{2, 2, {1, 5, -2, 11}}, {linear, linear}));
    // 1 + 4 u - 3 v + 9 u v
    for (const Rational& u : parameters(surface.u, 4))
        for (const Rational& v : parameters(surface.v, 3))
            EXPECT_EQ(evaluate(surface, u, v),
                      (TensorPoint<Rational>{1 + 4 * u - 3 * v + 9 * u * v, 4 + 9 * v, -3 + 9 * u, 0, 9, 0}));
}

// Natural ends keep a line a line, so a bicubic over a bilinear grid is bilinear up to its corners.
TEST(TensorEvaluate, OfABicubicReproducesBilinearGrids) {
    for (const SurfaceShape& shape : {SurfaceShape{kNatural, kNatural}, {kNatural, {5, Ends::Natural}}}) {
        Grid<Rational> grid{4, 3, {}};
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 3; ++j) grid.points.push_back(1 + 4 * j - 3 * i + 9 * i * j);
        const auto surface = spline_of(surface_of(std::move(grid), shape));
        for (const Rational& u : parameters(surface.u, 5))
            for (const Rational& v : parameters(surface.v, 4))
                EXPECT_EQ(evaluate(surface, u, v), (TensorPoint<Rational>{1 + 4 * u - 3 * v + 9 * u * v,
                                                                          4 + 9 * v, -3 + 9 * u, 0, 9, 0}));
    }
}

// Control points that depend on u alone, then on v alone: the surface is the curve, and the curve's own
// algorithm (de Boor, and the derivative's control points) says where.
TEST(TensorEvaluate, OfACylinderOverACurveIsTheCurve) {
    for (SurfaceShape shape : kShapes) {
        const auto row = random_grid<Rational>(1, fewest_points(shape.u) + 1).points;
        Grid<Rational> grid{fewest_points(shape.v), row.size(), {}};
        for (std::size_t i = 0; i < grid.rows; ++i)
            grid.points.insert(grid.points.end(), row.begin(), row.end());
        const auto curve = spline_of(*Curve<Rational>::make(row, shape.u));
        const auto slope = derivative(curve);
        const auto surface = spline_of(surface_of(grid, shape));
        const auto turned = spline_of(surface_of(transposed(grid), {shape.v, shape.u}));
        for (const Rational& u : parameters(surface.u, 7))
            for (const Rational& v : parameters(surface.v, 2)) {
                const auto a = evaluate(surface, u, v), b = evaluate(turned, v, u);
                EXPECT_EQ(a.position, evaluate(curve, u));
                if (u < curve.last()) {
                    EXPECT_EQ(a.du, evaluate(slope, u));
                }
                EXPECT_EQ(a.dv, 0);
                EXPECT_EQ(a.duv, 0);
                EXPECT_EQ(a.dvv, 0);
                EXPECT_EQ(b, (TensorPoint<Rational>{a.position, 0, a.du, 0, 0, a.duu}));
            }
    }
}

// The patch between knots is a polynomial: the exact interpolant of degree + 1 of its points, differentiated,
// has its derivatives.
TEST(TensorEvaluate, DerivativesAreThoseOfThePolynomialExactly) {
    for (const SurfaceShape& shape : kShapes) {
        const auto surface = spline_of(random_surface<Rational>(shape, 1));
        const Rational u0 = surface.u.first(), v0 = surface.v.last() - 1;  // corners of patches
        // From f(0), ..., f(d) to f'(0) by forward differences: f' = D - D^2/2 + D^3/3 - ...
        const auto slope = [](std::vector<Rational> f) {
            Rational out(0);
            for (int k = 1; f.size() > 1; ++k) {
                for (std::size_t i = 0; i + 1 < f.size(); ++i) f[i] = f[i + 1] - f[i];
                f.pop_back();
                out += (k % 2 == 1 ? f[0] : Rational(-f[0])) / k;
            }
            return out;
        };
        const int du = shape.u.degree, dv = shape.v.degree;
        const auto along = [&](auto value, int degree) {
            std::vector<Rational> f;
            for (int k = 0; k <= degree; ++k) f.push_back(value(Rational(k, degree)));
            return Rational(slope(f) * degree);
        };
        const auto at = [&](const Rational& u, const Rational& v) { return evaluate(surface, u, v); };
        const auto corner = at(u0, v0);
        EXPECT_EQ(corner.du, along([&](const Rational& s) { return at(u0 + s, v0).position; }, du));
        EXPECT_EQ(corner.dv, along([&](const Rational& s) { return at(u0, v0 + s).position; }, dv));
        EXPECT_EQ(corner.duv, along([&](const Rational& s) { return at(u0, v0 + s).du; }, dv));
        if (du > 1) {
            EXPECT_EQ(corner.duu, along([&](const Rational& s) { return at(u0 + s, v0).du; }, du));
        }
        if (dv > 1) {
            EXPECT_EQ(corner.dvv, along([&](const Rational& s) { return at(u0, v0 + s).dv; }, dv));
        }
    }
}

// One-sided derivatives at the end of a domain are those of its side, also where the degree makes them jump.
TEST(TensorEvaluate, AtTheEndOfTheDomainFollowsTheLastPatch) {
    const CurveShape linear{1, Ends::Natural};
    const auto surface = spline_of(surface_of(Grid<Rational>{2, 3, {0, 1, 5, 0, 1, 5}}, {linear, linear}));
    EXPECT_EQ(evaluate(surface, Rational(1), Rational(0)).du, 4);
    EXPECT_EQ(evaluate(surface, Rational(2), Rational(1)).du, 4);
    EXPECT_EQ(evaluate(surface, Rational(0), Rational(0)).du, 1);
}

TEST(IntervalBasis, IsTheBasisFunctionsAndTheirDerivatives) {
    for (const Ends ends : {Ends::Natural, Ends::Clamped})
        for (const int degree : {1, 3, 5}) {
            const auto zeros = Curve<Rational>::make(std::vector<Rational>(9), {degree, ends});
            const auto spline = spline_of(*zeros);
            for (int k = 0; k < 12; ++k) {
                const Rational t = spline.first() + (spline.last() - spline.first()) * k / 12;
                const auto s = span_of(spline, t);
                for (int r = 0; r <= degree + 1; ++r) {
                    const auto basis = interval_basis<Rational>(spline.knots, degree, s, t, r);
                    for (int j = 0; j <= degree; ++j)
                        EXPECT_EQ(basis[j],
                                  basis_derivative<Rational>(spline.knots, degree,
                                                             s - static_cast<std::size_t>(degree - j), t, r))
                            << degree << " " << r << " " << j;
                }
            }
        }
}

TEST(TensorEvaluate, AtNaturalEndsIsTheBoundaryCurveWithoutCurvatureAcrossIt) {
    const auto made = random_surface<Rational>({kNatural, kNatural}, 2);
    const auto surface = spline_of(made);
    const auto rim = spline_of(*Curve<Rational>::make(made.grid().row(0), kNatural));
    for (const Rational& u : parameters(surface.u, 6)) {
        const auto p = evaluate(surface, u, Rational(0));
        EXPECT_EQ(p.position, evaluate(rim, u));
        EXPECT_EQ(p.dvv, 0);
    }
    EXPECT_EQ(evaluate(surface, surface.u.last(), surface.v.last()).position, made.grid().points.back());
}

TEST(TensorEvaluate, IsClosedWhereTheShapeIs) {
    const auto surface = spline_of(random_surface<Rational>({kClosed, kClosed}, 1));
    const Rational n = surface.u.last(), m = surface.v.last(), third(1, 3);
    EXPECT_EQ(evaluate(surface, Rational(0), third), evaluate(surface, n, third));
    EXPECT_EQ(evaluate(surface, third, Rational(0)).dvv, evaluate(surface, third, m).dvv);
}

// Against 38 digits, every derivative within its own bound.
template <class Real>
void check_evaluation(const SurfaceShape& shape, Precision precision) {
    const auto surface = uneven_surface<Real>(shape, 2);
    const auto rounded = spline_of(surface.rounded);
    const auto exact = spline_of(surface.exact);
    double largest = 0;
    for (const auto& p : rounded.points.points)
        largest = std::max(largest, static_cast<double>(magnitude(p)));
    constexpr std::array<std::array<int, 2>, 6> kOrders{{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
    for (std::size_t d = 0; d < kOrders.size(); ++d) {
        const auto [ru, rv] = kOrders[d];
        const double growth = derivative_growth(shape.u, ru) * derivative_growth(shape.v, rv);
        const int roundings = surface_roundings(shape.u.degree, shape.v.degree, ru + rv);
        Observed seen("derivative " + std::to_string(ru) + std::to_string(rv), "parameter",
                      rounding_of(roundings, precision) * growth * largest);
        std::int64_t count = 0;
        for (const Real u : parameters(rounded.u, 13))
            for (const Real v : parameters(rounded.v, 9)) {
                const auto a = listed(evaluate(rounded, u, v))[d];
                const auto b = listed(evaluate(exact, HighPrecision(u), HighPrecision(v)))[d];
                seen.add(error_of_value(a.x, b.x), count);
                seen.add(error_of_value(a.y, b.y), count++);
            }
        seen.check();
    }
}
TEST(TensorEvaluate, StaysWithinItsRoundings) {
    for (const SurfaceShape& shape : kShapes) check_evaluation<double>(shape, Precision::Double);
    check_evaluation<double>({{3, Ends::Clamped}, {5, Ends::Clamped}}, Precision::Double);
    check_evaluation<float>({kNatural, kClosed}, Precision::Float);
}

TEST(TensorLimits, AreTheSurfaceAndItsDerivativesExactly) {
    for (const SurfaceShape& shape : kShapes) {
        if (shape.u.degree < 2) continue;
        const auto surface = random_surface<Rational>(shape, 1);
        const auto spline = spline_of(surface);
        const auto limit = *limits(surface);
        // A control point of an even degree belongs to the middle of a knot interval, at its own index.
        for (std::size_t i = 0; i < limit.positions.rows; ++i)
            for (std::size_t j = 0; j < limit.positions.columns; ++j) {
                const auto p =
                    evaluate(spline, Rational(j + limit.first_column), Rational(i + limit.first_row));
                EXPECT_EQ(limit.positions.at(i, j), p.position);
                EXPECT_EQ(limit.du.at(i, j), p.du);
                EXPECT_EQ(limit.dv.at(i, j), p.dv);
            }
    }
}

TEST(TensorLimits, OfDegreeOneAreRefused) {
    EXPECT_EQ(error_of(limits(random_surface<double>({kNatural, {1, Ends::Natural}}, 0))).code,
              ErrorCode::Unsupported);
}

TEST(TensorLimits, AreThoseOfTheVertexPointsOfTheNextLevel) {
    for (const SurfaceShape& shape :
         {SurfaceShape{kNatural, kNatural}, {kNatural, kClosed}, {kClosed, kClosed}})
        for (const std::size_t larger : {0U, 1U}) {
            const auto surface = random_surface<Rational>(shape, larger);
            const auto coarse = *limits(surface), fine = *limits(*subdivide(surface));
            for (std::size_t i = 0; i < coarse.positions.rows; ++i)
                for (std::size_t j = 0; j < coarse.positions.columns; ++j) {
                    EXPECT_EQ(coarse.positions.at(i, j), fine.positions.at(2 * i, 2 * j));
                    EXPECT_EQ(coarse.du.at(i, j), 2 * fine.du.at(2 * i, 2 * j));
                    EXPECT_EQ(coarse.dv.at(i, j), 2 * fine.dv.at(2 * i, 2 * j));
                }
        }
}

TEST(TensorLimits, StayWithinTheirRoundings) {
    for (const SurfaceShape& shape : kShapes) {
        if (shape.u.degree < 2) continue;
        const auto surface = uneven_surface<double>(shape, 2);
        const auto rounded = *limits(surface.rounded);
        const auto exact = *limits(surface.exact);
        double largest = 0;
        for (const auto& p : spline_of(surface.rounded).points.points)
            largest = std::max(largest, magnitude(p));
        const int roundings = 2 * (shape.u.degree / 2 + shape.v.degree / 2) + 6;
        Observed seen("limits", "point", rounding_of(roundings, Precision::Double) * largest);
        for (std::size_t k = 0; k < exact.positions.points.size(); ++k) {
            const auto place = static_cast<std::int64_t>(k);
            seen.add(error_of_value(rounded.positions.points[k].x, exact.positions.points[k].x), place);
            seen.add(error_of_value(rounded.du.points[k].y, exact.du.points[k].y), place);
            seen.add(error_of_value(rounded.dv.points[k].z, exact.dv.points[k].z), place);
        }
        seen.check();
    }
}

}  // namespace
}  // namespace loopcheck::core
