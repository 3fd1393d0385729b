#include "core/bspline/spline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/curves.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::curve_of;
using tests::Observed;
using High = HighPrecision;

constexpr Evaluation kMethods[] = {Evaluation::AllPoints, Evaluation::Local, Evaluation::DeBoor};

template <class P>
P evaluated(const Spline<P>& c, const ScalarOf<P>& t, Evaluation method) {
    return evaluate(c, t, {method, nullptr});
}

// Knots of all multiplicities that `check_knots` takes, clamped and not, with fractions as points.
Spline<Rational> random_spline(int degree, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto d = static_cast<std::size_t>(degree);
    const std::size_t count = d + 2 + random() % 6;
    for (;;) {
        Spline<Rational> out{degree, {Rational(-3)}, tests::scattered_fractions(count, seed), false};
        while (out.knots.size() < count + d + 1)
            out.knots.push_back(out.knots.back() + Rational(static_cast<int>(random() % 4), 4));
        std::vector<double> rounded;
        for (const Rational& k : out.knots) rounded.push_back(static_cast<double>(k));
        if (!check_knots(rounded, degree, count)) return out;
    }
}

std::vector<Spline<Rational>> exact_splines(int most_degree) {
    std::vector<Spline<Rational>> out;
    for (const CurveShape& shape : tests::shapes(1, most_degree))
        for (const std::size_t n : tests::sizes(shape))
            out.push_back(spline_of(curve_of(tests::scattered_fractions(n, n), shape)));
    for (int degree = 1; degree <= most_degree; ++degree)
        for (std::uint64_t seed = 1; seed <= 4; ++seed) out.push_back(random_spline(degree, seed));
    return out;
}

TEST(Evaluate, IsTheSameByThreeMethodsExactly) {
    for (const auto& spline : exact_splines(5))
        for (const Rational& t : tests::fractions_between(spline.first(), spline.last(), 10)) {
            const Rational wanted = evaluated(spline, t, Evaluation::DeBoor);
            EXPECT_EQ(evaluated(spline, t, Evaluation::Local), wanted) << spline.degree << " " << t;
            EXPECT_EQ(evaluated(spline, t, Evaluation::AllPoints), wanted) << spline.degree << " " << t;
        }
}

template <class P>
class EvaluateInRounded : public testing::Test {};
using PointTypes = testing::Types<float, double, glm::vec2, glm::vec3, glm::dvec2, glm::dvec3>;
TYPED_TEST_SUITE(EvaluateInRounded, PointTypes);

// Curves of every shape up to degree 8 and of the highest degrees, of few points and of more.
template <class P, class Visit>
void for_every_curve(Visit visit) {
    auto all = tests::shapes(1, 8);
    for (const CurveShape& shape : tests::shapes(kMaxDegree - 1, kMaxDegree)) all.push_back(shape);
    for (const CurveShape& shape : all)
        for (const std::size_t n : tests::sizes(shape))
            visit(curve_of(tests::scattered_points<P>(n, n + 100), shape));
}

TYPED_TEST(EvaluateInRounded, IsWithinItsBoundByEveryMethod) {
    using Scalar = ScalarOf<TypeParam>;
    Observed use("Error of a point over its bound", "degree", 1);
    for_every_curve<TypeParam>([&](const Curve<TypeParam>& curve) {
        const int degree = curve.shape().degree;
        const auto spline = spline_of(curve);
        const auto times = tests::parameters<Scalar>(curve.first(), curve.last());
        for (int axis = 0; axis < tests::kDimension<TypeParam>; ++axis) {
            const auto exact_curve = curve_of(tests::coordinates<High>(curve.points(), axis), curve.shape());
            const auto exact_spline = spline_of(exact_curve);
            // Of this coordinate alone: less than the largest of all.
            const double bound = rounding_of(evaluation_roundings(degree), tests::precision_of<TypeParam>()) *
                                 static_cast<double>(tests::largest_of(exact_spline.points));
            for (const Scalar t : times) {
                const High exact = evaluate(exact_spline, High(t));
                for (const Evaluation method : kMethods) {
                    const auto got = tests::coordinate(evaluated(spline, t, method), axis);
                    use.add(tests::share_of(tests::error_of_value(got, exact), bound), degree,
                            static_cast<double>(got), static_cast<double>(exact));
                }
            }
        }
    });
    use.check();
}

template <class P>
bool same_bits(const P& a, const P& b) {
    for (int axis = 0; axis < tests::kDimension<P>; ++axis) {
        const auto x = tests::coordinate(a, axis), y = tests::coordinate(b, axis);
        if (!(x == y && std::signbit(x) == std::signbit(y))) return false;
    }
    return true;
}

TYPED_TEST(EvaluateInRounded, HasTheSameBitsOverAllPointsAndOverTheLocalOnes) {
    using Scalar = ScalarOf<TypeParam>;
    int compared = 0;
    for_every_curve<TypeParam>([&](const Curve<TypeParam>& curve) {
        // And with zeros of both signs among the points.
        auto zeros = curve.points();
        for (std::size_t i = 0; i < zeros.size(); ++i)
            if (i % 3 != 2) zeros[i] = Scalar(i % 3 == 0 ? -0.0 : 0.0) * zeros[i];
        for (const auto& points : {curve.points(), zeros}) {
            const auto spline = spline_of(curve_of(points, curve.shape()));
            for (const Scalar t : tests::parameters<Scalar>(curve.first(), curve.last())) {
                ++compared;
                EXPECT_TRUE(same_bits(evaluated(spline, t, Evaluation::AllPoints),
                                      evaluated(spline, t, Evaluation::Local)))
                    << "degree " << spline.degree << ", " << name(curve.shape().ends) << ", t " << t;
            }
        }
    });
    EXPECT_GT(compared, 1000);
}

TEST(Evaluate, TakesPointsInHighPrecision) {
    const auto points = tests::scattered_points<glm::dvec3>(6, 2);
    const CurveShape shape{3, Ends::Natural};
    const auto spline = spline_of(curve_of(convert_points<High>(points), shape));
    for (const Evaluation method : kMethods) {
        const Point<High> p = evaluated(spline, High(2.3), method);
        const auto expect_axis = [&](const High& got, int axis) {
            const auto one = spline_of(curve_of(tests::coordinates<High>(points, axis), shape));
            EXPECT_EQ(got, evaluated(one, High(2.3), method)) << axis;
        };
        expect_axis(p.x, 0);
        expect_axis(p.y, 1);
        expect_axis(p.z, 2);
    }
}

TEST(Evaluate, GoesOnBeyondTheDomainAndTakesAnyParameter) {
    const auto spline = spline_of(curve_of(tests::report_points(), {3, Ends::Natural}));
    using Limits = std::numeric_limits<double>;
    for (const double t : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                           Limits::lowest(), -1.0, 8.0, Limits::denorm_min()})
        for (const Evaluation method : kMethods) evaluated(spline, t, method);
    EXPECT_TRUE(std::isnan(evaluate(spline, Limits::quiet_NaN()).x));
    // The polynomials at the ends: four values give a cubic.
    const auto fractions = spline_of(curve_of(tests::scattered_fractions(6, 1), {3, Ends::Natural}));
    const auto p = [&](const Rational& t) { return evaluate(fractions, t); };
    for (const int end : {0, 5}) {
        const int inward = end == 0 ? 1 : -1;
        const auto at = [&](int quarters) { return p(Rational(end) + Rational(inward * quarters, 4)); };
        EXPECT_EQ(at(-1), 4 * at(0) - 6 * at(1) + 4 * at(2) - at(3)) << end;
    }
}

// The number of basis functions that are evaluated for many parameters.
struct Counts {
    std::int64_t samples = 0, all = 0, local = 0, de_boor = 0;
    bool operator==(const Counts&) const = default;
};
template <class P>
Counts counts_of(const Spline<P>& spline, const std::vector<ScalarOf<P>>& times) {
    Counts out{static_cast<std::int64_t>(times.size())};
    for (const auto t : times) {
        const P all = evaluate(spline, t, {Evaluation::AllPoints, &out.all});
        EXPECT_TRUE(same_bits(all, evaluate(spline, t, {Evaluation::Local, &out.local}))) << t;
        evaluate(spline, t, {Evaluation::DeBoor, &out.de_boor});
    }
    return out;
}

TEST(Evaluate, CountsTheBasisFunctionsOfTheDocumentation) {
    const auto points = tests::report_points();
    std::vector<glm::vec2> rounded(points.begin(), points.end());
    const auto in_float = spline_of(curve_of(rounded, {3, Ends::Open}));
    const auto in_double = spline_of(curve_of(points, {3, Ends::Open}));
    std::vector<float> accumulated;
    for (float t = 1; t < 6; t += 0.01F) accumulated.push_back(t);
    EXPECT_EQ(counts_of(in_float, accumulated), (Counts{500, 4000, 1999, 0}));
    std::vector<double> even, accumulated_in_double;
    for (int k = 0; k < 500; ++k) even.push_back(1 + k / 100.0);
    EXPECT_EQ(counts_of(in_double, even), (Counts{500, 4000, 1995, 0}));
    for (double t = 1; t < 6; t += 0.01) accumulated_in_double.push_back(t);
    EXPECT_EQ(counts_of(in_double, accumulated_in_double), (Counts{501, 4008, 2003, 0}));
}

TEST(Evaluate, CountsDegreeAndOneAndOneFewerAtAKnot) {
    for (const CurveShape& shape : tests::shapes(1, 6)) {
        const auto curve = curve_of(tests::scattered_points<double>(10, 1), shape);
        const auto spline = spline_of(curve);
        for (std::size_t s = static_cast<std::size_t>(shape.degree); s < spline.points.size(); ++s) {
            std::int64_t at_knot = 0, between = 0, all = 0;
            evaluate(spline, spline.knots[s], {Evaluation::Local, &at_knot});
            evaluate(spline, spline.knots[s] + 0.25, {Evaluation::Local, &between});
            evaluate(spline, spline.knots[s], {Evaluation::AllPoints, &all});
            EXPECT_EQ(at_knot, shape.degree);
            EXPECT_EQ(between, shape.degree + 1);
            EXPECT_EQ(all, static_cast<std::int64_t>(spline.points.size()));
        }
    }
}

TEST(SpanOf, IsTheLargestNonEmptyIntervalOfTheDomain) {
    const Spline<double> c{2, {0, 0, 0, 1, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}, false};
    EXPECT_EQ(check_knots(c.knots, c.degree, c.points.size()), std::nullopt);
    EXPECT_EQ(span_of(c, -1.0), 2U);
    EXPECT_EQ(span_of(c, 0.0), 2U);
    EXPECT_EQ(span_of(c, std::nextafter(1.0, 0.0)), 2U);
    EXPECT_EQ(span_of(c, 1.0), 4U);
    EXPECT_EQ(span_of(c, 2.0), 5U);
    EXPECT_EQ(span_of(c, 3.0), 5U);
    EXPECT_EQ(span_of(c, 9.0), 5U);
    EXPECT_EQ(span_of(c, std::numeric_limits<double>::quiet_NaN()), 5U);
}

TEST(Blossom, IsSymmetricAffineAndTheCurveOnTheDiagonal) {
    for (const auto& spline : exact_splines(5)) {
        const auto d = static_cast<std::size_t>(spline.degree);
        for (std::size_t s = d; s < spline.points.size(); ++s) {
            if (spline.knots[s] == spline.knots[s + 1]) continue;
            auto a = tests::scattered_fractions(d, s);
            const auto value = [&] { return blossom(spline, s, [&](std::size_t r) { return a[r]; }); };
            const Rational before = value();
            std::reverse(a.begin(), a.end());
            EXPECT_EQ(value(), before);
            if (d > 1) std::swap(a[0], a[d / 2]);
            EXPECT_EQ(value(), before);
            const Rational kept = a[0];
            std::vector<Rational> values;
            for (const int x : {0, 1, 4}) {
                a[0] = x;
                values.push_back(value());
            }
            EXPECT_EQ(values[2], 4 * values[1] - 3 * values[0]);
            const Rational t = (spline.knots[s] + 2 * spline.knots[s + 1]) / 3;
            a.assign(d, t);
            EXPECT_EQ(value(), evaluated(spline, t, Evaluation::AllPoints));
        }
    }
}

TEST(Blossom, IsAControlPointAtItsKnots) {
    for (const auto& spline : exact_splines(6)) {
        const auto d = static_cast<std::size_t>(spline.degree);
        for (std::size_t i = 0; i < spline.points.size(); ++i)
            for (std::size_t s = std::max(i, d); s <= std::min(i + d, spline.points.size() - 1); ++s) {
                if (spline.knots[s] == spline.knots[s + 1]) continue;
                const Rational got =
                    blossom(spline, s, [&](std::size_t r) { return spline.knots[i + 1 + r]; });
                EXPECT_EQ(got, spline.points[i]) << "degree " << d << ", point " << i << ", interval " << s;
            }
    }
}

TEST(Blossom, IsWithinItsBoundInsideTheInterval) {
    Observed use("Error of a blossom over its bound", "degree", 1);
    for (int degree = 1; degree <= 8; ++degree) {
        const auto d = static_cast<std::size_t>(degree);
        const auto c =
            spline_of(curve_of(tests::scattered_points<double>(d + 4, 3), {degree, Ends::Clamped}));
        Spline<High> exact{
            degree, {c.knots.begin(), c.knots.end()}, {c.points.begin(), c.points.end()}, false};
        std::mt19937_64 random(9);
        for (std::size_t s = d; s < c.points.size(); ++s)
            for (int sample = 0; sample < 50; ++sample) {
                std::vector<double> a(d);
                for (double& x : a) x = c.knots[s] + std::ldexp(static_cast<double>(random() >> 11), -53);
                const double got = blossom(c, s, [&](std::size_t r) { return a[r]; });
                const High wanted = blossom(exact, s, [&](std::size_t r) { return High(a[r]); });
                double largest = 0;
                for (std::size_t i = s - d; i <= s; ++i) largest = std::max(largest, std::abs(c.points[i]));
                const double bound =
                    rounding_of(kBasisRoundingsPerDegree * degree, Precision::Double) * largest;
                use.add(tests::share_of(tests::error_of_value(got, wanted), bound), degree, got,
                        static_cast<double>(wanted));
            }
    }
    use.check();
}

TEST(Derivative, IsTheSumOfTheDerivativesOfTheBasis) {
    for (const auto& spline : exact_splines(5)) {
        Spline<Rational> derived = spline;
        for (int r = 1; r <= std::min(spline.degree, 3); ++r) {
            derived = derivative(derived);
            EXPECT_EQ(derived.degree, spline.degree - r);
            for (const Rational& t : tests::fractions_between(spline.first(), spline.last(), 7)) {
                if (t == spline.last()) continue;  // the other side, where it jumps there
                Rational wanted(0);
                for (std::size_t i = 0; i < spline.points.size(); ++i)
                    wanted +=
                        basis_derivative<Rational>(spline.knots, spline.degree, i, t, r) * spline.points[i];
                EXPECT_EQ(evaluate(derived, t), wanted) << "degree " << spline.degree << ", r " << r;
            }
        }
    }
}

TEST(Derivative, IsWithinItsBound) {
    Observed use("Error of a derived control point over its bound", "degree", 1);
    for (int degree = 1; degree <= 8; ++degree) {
        auto exact = random_spline(degree, 7);
        Spline<double> c{degree, {}, tests::scattered_points<double>(exact.points.size(), 2), false};
        for (const Rational& k : exact.knots) c.knots.push_back(static_cast<double>(k) / 3);
        Spline<High> widened{
            degree, {c.knots.begin(), c.knots.end()}, {c.points.begin(), c.points.end()}, false};
        const auto got = derivative(c);
        const auto wanted = derivative(widened);
        for (std::size_t i = 0; i < got.points.size(); ++i) {
            const double width = c.knots[i + 1 + static_cast<std::size_t>(degree)] - c.knots[i + 1];
            if (width == 0) continue;
            const double size = degree / width * (std::abs(c.points[i]) + std::abs(c.points[i + 1]));
            use.add(tests::share_of(tests::error_of_value(got.points[i], wanted.points[i]),
                                    rounding_of(4, Precision::Double) * size),
                    degree, got.points[i], static_cast<double>(wanted.points[i]));
        }
    }
    use.check();
}

TEST(Derivative, OfDegreeZeroIsAStepFunctionContinuousFromTheRight) {
    const auto steps = derivative(spline_of(curve_of(std::vector<double>{1, 3, 2, 7}, {1, Ends::Open})));
    EXPECT_EQ(steps.degree, 0);
    EXPECT_EQ(evaluate(steps, 0.0), 2);
    EXPECT_EQ(evaluate(steps, std::nextafter(1.0, 0.0)), 2);
    EXPECT_EQ(evaluate(steps, 1.0), -1);
    EXPECT_EQ(evaluate(steps, 2.0), 5);
    EXPECT_EQ(evaluate(steps, 3.0), 5);
}

TEST(Greville, IsWhereTheCurveIsTheParameter) {
    for (auto spline : exact_splines(6)) {
        for (std::size_t i = 0; i < spline.points.size(); ++i) spline.points[i] = greville(spline, i);
        for (const Rational& t : tests::fractions_between(spline.first(), spline.last(), 9))
            EXPECT_EQ(evaluate(spline, t), t) << spline.degree;
    }
}

TEST(RefineKnots, LeavesTheCurveAsItIs) {
    for (const auto& spline : exact_splines(6)) {
        const auto refined = refine_knots(spline);
        EXPECT_EQ(refined.points.size() + static_cast<std::size_t>(refined.degree) + 1, refined.knots.size());
        EXPECT_EQ(refined.first(), spline.first());
        EXPECT_EQ(refined.last(), spline.last());
        for (const Rational& t : tests::fractions_between(spline.first(), spline.last(), 14))
            EXPECT_EQ(evaluated(refined, t, Evaluation::AllPoints), evaluate(spline, t))
                << "degree " << spline.degree << ", t " << t;
    }
}

TEST(RefineKnots, HalvesEveryIntervalOfTheDomainOnce) {
    const Spline<double> c{2, {0, 0, 0, 1, 1, 3, 3, 3}, {1, 2, 3, 4, 5}, false};
    EXPECT_EQ(refine_knots(c).knots, (std::vector<double>{0, 0, 0, 0.5, 1, 1, 2, 3, 3, 3}));
}

TEST(RefineKnots, IsWithinTheBoundOfABlossom) {
    Observed use("Error of a refined control point over its bound", "degree", 1);
    for (int degree = 1; degree <= 8; ++degree)
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const auto exact = random_spline(degree, seed);
            Spline<double> c{degree, {}, tests::scattered_points<double>(exact.points.size(), seed), false};
            for (const Rational& k : exact.knots) c.knots.push_back(static_cast<double>(k));
            Spline<High> widened{
                degree, {c.knots.begin(), c.knots.end()}, {c.points.begin(), c.points.end()}, false};
            const auto got = refine_knots(c).points;
            const auto wanted = refine_knots(widened).points;
            const double bound = rounding_of(kBasisRoundingsPerDegree * degree, Precision::Double) *
                                 tests::largest_of(c.points);
            for (std::size_t i = 0; i < got.size(); ++i)
                use.add(tests::share_of(tests::error_of_value(got[i], wanted[i]), bound), degree, got[i],
                        static_cast<double>(wanted[i]));
        }
    use.check();
}

TEST(RefineKnots, BringsThePolygonFourTimesCloser) {
    // The graph of t^2, whose control points are its blossom: (a_1 a_2 + ...) over the number of pairs.
    for (int degree = 2; degree <= 6; ++degree) {
        Spline<Rational> c = spline_of(
            curve_of(std::vector<Rational>(static_cast<std::size_t>(degree) + 3), {degree, Ends::Clamped}));
        for (std::size_t i = 0; i < c.points.size(); ++i) {
            Rational pairs(0);
            for (int j = 1; j <= degree; ++j)
                for (int k = 1; k < j; ++k) pairs += c.knots[i + j] * c.knots[i + k];
            c.points[i] = 2 * pairs / (degree * (degree - 1));
        }
        const auto farthest = [](const Spline<Rational>& spline) {
            Rational out(0);
            for (std::size_t i = 0; i < spline.points.size(); ++i)
                out = std::max(out, Rational(abs(spline.points[i] - evaluate(spline, greville(spline, i)))));
            return out;
        };
        Rational before = farthest(c);
        EXPECT_GT(before, 0);
        for (int level = 0; level < 3; ++level) {
            c = refine_knots(c);
            const Rational after = farthest(c);
            // Exactly as soon as there is an inner point that no knot of the ends reaches.
            if (level > 0) {
                EXPECT_EQ(after * 4, before) << degree << " " << level;
            }
            before = after;
        }
    }
}

TEST(CheckKnots, RefusesWhatHasNoContinuousCurve) {
    const auto refusal = [](std::vector<double> knots, int degree, std::size_t count) {
        const auto error = check_knots(knots, degree, count);
        if (!error) return std::string();
        EXPECT_EQ(error->code, ErrorCode::BadKnots);
        return error->sentence;
    };
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal({0, 0, 0, 1, 1, 2, 2, 2}, 2, 5), "");
    EXPECT_EQ(refusal({0, 0, 1, 1}, 1, 2), "");
    EXPECT_TRUE(contains(refusal({0, 1}, 0, 1), "degree is 0"));
    EXPECT_TRUE(contains(refusal({0, 1}, -1, 1), "degree is -1"));
    EXPECT_TRUE(contains(refusal({0, 1}, kMaxDegree + 1, 30), "degree is 21"));
    EXPECT_TRUE(contains(refusal({0, 0, 1, 1}, 2, 2), "2 points are too few"));
    EXPECT_TRUE(contains(refusal({}, 1, 0), "0 points are too few"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 1, 1}, 2, 3), "There are 5 knots"));
    EXPECT_TRUE(contains(refusal({}, 2, 3), "There are 0 knots"));
    EXPECT_TRUE(contains(refusal({0, 0, kNaN, 1, 1, 1}, 2, 3), "Knot 2 is not finite"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 1, 1, kInfinity}, 2, 3), "Knot 5 is not finite"));
    EXPECT_TRUE(contains(refusal({-kInfinity, 0, 0, 1, 1, 1}, 2, 3), "Knot 0 is not finite"));
    constexpr double kLargest = std::numeric_limits<double>::max() * 0x1p-24;
    EXPECT_EQ(refusal({-kLargest, -kLargest, kLargest, kLargest}, 1, 2), "");
    EXPECT_TRUE(contains(refusal({0, 0, 1, 1.01 * kLargest}, 1, 2), "Knot 3 is not finite, or too large"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 1, 0.5, 1}, 2, 3), "Knot 4 is smaller"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 0, 1, 1, 1}, 2, 4), "empty interval"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 1, 1, 1, 1}, 2, 4), "empty interval"));
    EXPECT_TRUE(contains(refusal({0, 0, 0, 1, 1, 1, 2, 2, 2}, 2, 6), "Knot 3 is repeated more than 2 times"));
    EXPECT_TRUE(contains(refusal({0, 0, 1, 1, 2, 2}, 1, 4), "Knot 2 is repeated more than 1 times"));
}

TEST(CheckKnots, GivesEveryControlPointASay) {
    for (int degree = 1; degree <= 6; ++degree)
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const auto spline = random_spline(degree, seed);
            for (std::size_t i = 0; i < spline.points.size(); ++i) {
                EXPECT_LT(spline.knots[i], spline.last());
                EXPECT_GT(spline.knots[i + static_cast<std::size_t>(degree) + 1], spline.first());
                EXPECT_LT(spline.knots[i], spline.knots[i + static_cast<std::size_t>(degree) + 1]);
            }
        }
}

}  // namespace
}  // namespace loopcheck::core
