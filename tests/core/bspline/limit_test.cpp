#include "core/bspline/limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/bspline/subdivide.h"
#include "tests/support/curves.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::curve_of;
using tests::Observed;
using Fractions = std::vector<Rational>;
using High = HighPrecision;

Fractions over(std::initializer_list<int> numerators, int denominator) {
    Fractions out;
    for (const int n : numerators) out.push_back(Rational(n, denominator));
    return out;
}
std::vector<CurveShape> uniform_shapes(int least, int most) {
    auto out = tests::shapes(least, most);
    std::erase_if(out, [](const CurveShape& shape) { return shape.ends == Ends::Clamped; });
    return out;
}

// Few, and the highest: the mask of degree d takes d^3 fractions.
std::vector<CurveShape> low_and_high_shapes() {
    auto out = uniform_shapes(2, 6);
    for (const int degree : {10, kMaxDegree}) {
        const auto more = uniform_shapes(degree, degree);
        out.insert(out.end(), more.begin(), more.end());
    }
    return out;
}

TEST(LimitMask, IsTheOneOfTheDocumentation) {
    EXPECT_EQ(limit_mask<Rational>(1, 0), over({1}, 1));
    EXPECT_EQ(limit_mask<Rational>(2, 0), over({1, 6, 1}, 8));
    EXPECT_EQ(limit_mask<Rational>(3, 0), over({1, 4, 1}, 6));
    EXPECT_EQ(limit_mask<Rational>(3, 1), over({-1, 0, 1}, 2));
    EXPECT_EQ(limit_mask<Rational>(3, 2), over({1, -2, 1}, 1));
    EXPECT_EQ(limit_mask<Rational>(5, 0), over({1, 26, 66, 26, 1}, 120));
}

TEST(LimitMask, SumsToOneOrToNothing) {
    for (int degree = 1; degree <= 9; ++degree)
        for (int r = 0; r < degree; ++r) {
            const Fractions mask = limit_mask<Rational>(degree, r);
            EXPECT_EQ(mask.size(), 2 * static_cast<std::size_t>(degree / 2) + 1);
            Rational sum(0);
            for (const Rational& weight : mask) sum += weight;
            EXPECT_EQ(sum, r == 0 ? 1 : 0) << degree << " " << r;
        }
}

TEST(LimitMask, IsSymmetricOrTurnsItsSign) {
    for (int degree = 1; degree <= 8; ++degree)
        for (int r = 0; r < degree; ++r) {
            Fractions mask = limit_mask<Rational>(degree, r), turned = mask;
            std::reverse(turned.begin(), turned.end());
            if (r % 2 == 1)
                for (Rational& weight : turned) weight = -weight;
            EXPECT_EQ(mask, turned) << degree << " " << r;
        }
}

TEST(LimitMask, GivesTheDerivativesOfTheCurve) {
    for (const CurveShape& shape : uniform_shapes(1, 7)) {
        const auto curve = tests::curve_of_fractions(9, shape);
        const int m = shape.degree / 2;
        Spline<Rational> derived = spline_of(curve);
        for (int r = 0; r < shape.degree; ++r) {
            if (r > 0) derived = derivative(derived);
            const Fractions mask = limit_mask<Rational>(shape.degree, r);
            for (int i = m; i < 9 - m; ++i) {
                Rational sum(0);
                for (int k = -m; k <= m; ++k) sum += mask[k + m] * control_point(curve, i + k);
                EXPECT_EQ(sum, evaluate(derived, Rational(i))) << shape.degree << " " << r << " " << i;
            }
        }
    }
}

TEST(Limits, AreOnTheCurveWithItsTangents) {
    for (const CurveShape& shape : low_and_high_shapes())
        for (const std::size_t n : tests::sizes(shape)) {
            const auto curve = tests::curve_of_fractions(n, shape);
            const auto spline = spline_of(curve);
            const auto slope = derivative(spline);
            const auto limit = limits(curve);
            ASSERT_EQ(limit.positions.size(), n - 2 * limit.first);
            ASSERT_EQ(limit.tangents.size(), limit.positions.size());
            for (std::size_t j = 0; j < limit.positions.size(); ++j) {
                const Rational t(static_cast<std::int64_t>(limit.first + j));
                EXPECT_EQ(limit.positions[j], evaluate(spline, t)) << shape.degree << " " << t;
                EXPECT_EQ(limit.tangents[j], evaluate(slope, t)) << shape.degree << " " << t;
            }
        }
}

TEST(Limits, AreThoseOfEveryPointInTheDomain) {
    for (const CurveShape& shape : uniform_shapes(2, 8))
        for (const std::size_t n : tests::sizes(shape)) {
            const auto curve = tests::curve_of_fractions(n, shape);
            const auto limit = limits(curve);
            for (std::size_t i = 0; i < n; ++i) {
                const Rational t(static_cast<std::int64_t>(i));
                const bool has = i >= limit.first && i - limit.first < limit.positions.size();
                EXPECT_EQ(has, t >= curve.first() && t <= curve.last());
            }
        }
}

TEST(Limits, AreThoseOfTheVertexPointsOfTheNextLevel) {
    for (const int degree : {3, 5, 7})
        for (const Ends ends : {Ends::Natural, Ends::Closed, Ends::Open}) {
            auto curve = tests::curve_of_fractions(9, {degree, ends});
            auto before = limits(curve);
            for (int level = 0; level < 3; ++level) {
                curve = subdivide(curve);
                const auto after = limits(curve);
                // An open curve loses its first (degree - 1) / 2 points of the next level.
                const std::size_t lost = ends == Ends::Open ? static_cast<std::size_t>(degree - 1) / 2 : 0;
                for (std::size_t j = 0; j < before.positions.size(); ++j) {
                    const std::size_t i = 2 * (before.first + j) - lost - after.first;
                    EXPECT_EQ(after.positions[i], before.positions[j]) << degree << " " << name(ends);
                    EXPECT_EQ(2 * after.tangents[i], before.tangents[j]) << degree << " " << name(ends);
                }
                before = after;
            }
        }
}

TEST(Limits, OfANaturalEndAreThePointItself) {
    for (const int degree : {3, 5, 7})
        for (const std::size_t n : {2U, 3U, 9U}) {
            const auto curve = tests::curve_of_fractions(n, {degree, Ends::Natural});
            const auto& c = curve.points();
            const auto limit = limits(curve);
            EXPECT_EQ(limit.positions.front(), c.front());
            EXPECT_EQ(limit.positions.back(), c.back());
            if (degree > 3) continue;
            EXPECT_EQ(limit.tangents.front(), c[1] - c[0]);
            EXPECT_EQ(limit.tangents.back(), c[n - 1] - c[n - 2]);
        }
}

template <class Scalar>
void check_limits() {
    Observed use("Error of a limit or tangent over its bound", "degree", 1);
    for (const CurveShape& shape : low_and_high_shapes())
        for (const std::size_t n : tests::sizes(shape)) {
            const auto curve = curve_of(tests::scattered_points<Scalar>(n, n), shape);
            const auto exact_curve = curve_of(tests::coordinates<High>(curve.points(), 0), shape);
            const auto got = limits(curve);
            const auto wanted = limits(exact_curve);
            const double bound = rounding_of(2 * (shape.degree / 2) + 2, tests::precision_of<Scalar>()) *
                                 static_cast<double>(tests::largest_of(extended_points(exact_curve)));
            for (std::size_t i = 0; i < got.positions.size(); ++i)
                for (const auto member : {&CurveLimits<Scalar>::positions, &CurveLimits<Scalar>::tangents}) {
                    const bool position = member == &CurveLimits<Scalar>::positions;
                    const High exact = position ? wanted.positions[i] : wanted.tangents[i];
                    use.add(tests::share_of(tests::error_of_value((got.*member)[i], exact), bound),
                            shape.degree, static_cast<double>((got.*member)[i]), static_cast<double>(exact));
                }
        }
    use.check();
}

TEST(Limits, AreWithinTheirBound) {
    check_limits<double>();
    check_limits<float>();
}

TEST(LargestSecondDifference, IsThatOfThePhantomsToo) {
    for (const CurveShape& shape : uniform_shapes(1, 7))
        for (const std::size_t n : tests::sizes(shape)) {
            const auto c = tests::scattered_fractions(n, 8);
            const auto exact = curve_of(c, shape);
            Fractions all{Rational(0)};
            const std::int64_t m = phantom_count(shape), count = static_cast<std::int64_t>(n);
            for (std::int64_t i = 1 - m; i < count + m - 1; ++i)
                all.push_back(control_point(exact, i - 1) - 2 * control_point(exact, i) +
                              control_point(exact, i + 1));
            // In whole numbers the same in double.
            std::vector<glm::dvec2> whole;
            for (const Rational& p : c) whole.push_back(glm::dvec2(0, static_cast<double>(Rational(60 * p))));
            const double got = largest_second_difference(curve_of(whole, shape));
            const Rational wanted = 60 * tests::largest_of(all);
            if (shape.ends == Ends::Closed) {
                EXPECT_GE(Rational(got), wanted) << shape.degree;  // no phantom has one of its own
            } else {
                EXPECT_EQ(Rational(got), wanted) << name(shape.ends) << shape.degree;
            }
        }
}

// The polygon of a level at parameter t.
Rational on_polygon(const CurveLevel<Rational>& level, const Rational& t) {
    const auto next = std::upper_bound(level.parameters.begin() + 1, level.parameters.end() - 1, t);
    const auto i = static_cast<std::size_t>(next - level.parameters.begin());
    const Rational u = (t - level.parameters[i - 1]) / (level.parameters[i] - level.parameters[i - 1]);
    return (1 - u) * level.points[i - 1] + u * level.points[i];
}

TEST(PolygonDistance, IsNeverLessThanMeasuredAndIsReachedByCubics) {
    Observed use("Distance of a polygon over its bound", "degree", 1);
    for (const CurveShape& shape : uniform_shapes(2, 7)) {
        const auto whole = tests::scattered_fractions(9, 21);
        std::vector<double> scaled;
        for (const Rational& p : whole) scaled.push_back(static_cast<double>(Rational(60 * p)));
        const auto curve = curve_of(scaled, shape);
        const auto exact = curve_of(Fractions(scaled.begin(), scaled.end()), shape);
        const auto spline = spline_of(exact);
        const auto levels = curve_levels(exact, 4);
        const Rational difference(largest_second_difference(curve));
        for (int k = 0; k <= 4; ++k) {
            const auto& level = levels[static_cast<std::size_t>(k)];
            const Rational bound = Rational(shape.degree + 1, 24) * difference / (1 << (2 * k));
            EXPECT_NEAR(polygon_distance(curve, k), static_cast<double>(bound),
                        4 * unit_roundoff(Precision::Double) * static_cast<double>(bound));
            Rational farthest(0);
            const Rational first = std::max(level.parameters.front(), exact.first()),
                           last = std::min(level.parameters.back(), exact.last());
            const auto steps = static_cast<int>(level.points.size()) * 4;
            for (const Rational& t : tests::fractions_between(first, last, steps))
                farthest = std::max(farthest, Rational(abs(on_polygon(level, t) - evaluate(spline, t))));
            for (std::size_t i = 0; i < level.points.size(); ++i)
                if (level.parameters[i] >= first && level.parameters[i] <= last)
                    farthest = std::max(
                        farthest, Rational(abs(level.points[i] - evaluate(spline, level.parameters[i]))));
            EXPECT_LE(farthest, bound) << name(shape.ends) << shape.degree << ", level " << k;
            use.add(static_cast<double>(Rational(farthest / bound)), shape.degree);
            if (shape.degree == 3 && shape.ends != Ends::Open) {
                EXPECT_EQ(farthest, bound) << name(shape.ends) << ", level " << k;
            }
        }
    }
    use.check();
}

TEST(PolygonDistance, OfACubicIsASixthOfTheSecondDifferenceAtEveryPoint) {
    for (const Ends ends : {Ends::Natural, Ends::Closed}) {
        const auto curve = tests::curve_of_fractions(7, {3, ends});
        const auto spline = spline_of(curve);
        const auto levels = curve_levels(curve, 4);
        for (int k = 0; k <= 4; ++k)
            for (int i = 0; i < 7; ++i) {
                const auto index = static_cast<std::size_t>(i) << k;
                const Rational away =
                    evaluate(spline, Rational(i)) - levels[static_cast<std::size_t>(k)].points[index];
                const Rational difference =
                    control_point(curve, i - 1) - 2 * control_point(curve, i) + control_point(curve, i + 1);
                EXPECT_EQ(away, difference / 6 / (1 << (2 * k))) << k << " " << i;
            }
    }
}

// The same sums, differences and lengths in 38 digits.
TEST(PolygonDistance, IsWithinItsRoundings) {
    Observed use("Rounding of the distance of a polygon over its bound", "degree", 1);
    for (const CurveShape& shape : uniform_shapes(2, kMaxDegree)) {
        const auto curve = curve_of(tests::scattered_points<glm::dvec3>(24, 5), shape);
        const auto exact = curve_of(convert_points<High>(curve.points()), shape);
        const std::int64_t skip = shape.ends == Ends::Closed ? 0 : 1;
        High longest = 0;
        for (std::int64_t i = skip; i < 24 - skip; ++i) {
            const auto d =
                control_point(exact, i - 1) - High(2) * control_point(exact, i) + control_point(exact, i + 1);
            longest = std::max(longest, High(sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
        }
        const double bound =
            rounding_of(kPolygonDistanceRoundings, Precision::Double) * largest_coordinate(curve.points());
        use.add(tests::share_of(tests::error_of_value(polygon_distance(curve, 0),
                                                      High(longest * (shape.degree + 1) / 24)),
                                bound),
                shape.degree);
    }
    use.check();
}

TEST(PolygonDistance, HasTheValuesOfTheDocumentation) {
    const auto curve = curve_of(tests::report_points(), {3, Ends::Natural});
    const double printed[] = {0.23570226, 0.0589255651, 0.0147313913, 0.00368284782};
    const double places[] = {1e-8, 1e-10, 1e-10, 1e-11};
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(polygon_distance(curve, k), printed[k], places[k] / 2);
        EXPECT_EQ(polygon_distance(curve, k), 4 * polygon_distance(curve, k + 1));
    }
    EXPECT_EQ(polygon_distance(curve_of(tests::report_points(), {1, Ends::Natural}), 0), 0);
}

TEST(LevelForTolerance, IsTheFirstThatIsEnough) {
    const auto curve = curve_of(tests::report_points(), {3, Ends::Natural});
    const auto spline = spline_of(curve);
    const auto levels = curve_levels(curve, 12);
    const auto measured = [&](int k) {
        const auto& level = levels[static_cast<std::size_t>(k)];
        double farthest = 0;
        for (std::size_t i = 0; i < level.points.size(); ++i)
            farthest = std::max(farthest, norm(level.points[i] - evaluate(spline, level.parameters[i])));
        return farthest;
    };
    for (double tolerance = 0.3; tolerance > 1e-7; tolerance *= 0.77) {
        const int level = level_for_tolerance(curve, tolerance);
        EXPECT_LE(measured(level), tolerance);
        EXPECT_TRUE(level == 0 || measured(level - 1) > tolerance) << tolerance;
    }
}

TEST(LevelForTolerance, TakesATolerancePreciselyMet) {
    // Second difference 24: the distance is 4^(1-k).
    const auto curve = curve_of(std::vector<double>{0, 0, 24, 48}, {3, Ends::Natural});
    for (int k = 0; k < 40; ++k) {
        const double tolerance = std::ldexp(1.0, 2 - 2 * k);
        EXPECT_EQ(level_for_tolerance(curve, tolerance), k);
        EXPECT_EQ(level_for_tolerance(curve, std::nextafter(tolerance, 0.0)), k + 1);
        EXPECT_EQ(level_for_tolerance(curve, std::nextafter(tolerance, 9.0)), k);
    }
}

TEST(LevelForTolerance, EndsForTinyTolerancesAndHugeCurves) {
    const double largest = std::numeric_limits<double>::max() * 0x1p-24;
    const auto curve = curve_of(std::vector<double>{largest, -largest, largest, -largest}, {3, Ends::Closed});
    const int level = level_for_tolerance(curve, std::numeric_limits<double>::denorm_min());
    EXPECT_LE(level, 1100);
    EXPECT_GT(level, 900);
    EXPECT_EQ(level_for_tolerance(curve_of(std::vector<double>{1, 1, 1}, {3, Ends::Natural}), 1e-300), 0);
    EXPECT_EQ(level_for_tolerance(curve_of(std::vector<double>{1, 5, 1}, {1, Ends::Natural}), 1e-300), 0);
}

}  // namespace
}  // namespace loopcheck::core
