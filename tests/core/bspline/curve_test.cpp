#include "core/bspline/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/curves.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::curve_of;
using tests::error_of;
using tests::Observed;
using High = HighPrecision;

Curve<Rational> fractions(std::size_t count, const CurveShape& shape) {
    return curve_of(tests::scattered_fractions(count, count + 50), shape);
}

// P(t) and its derivatives, exactly.
Rational derived(const Curve<Rational>& curve, const Rational& t, int r) {
    auto spline = spline_of(curve);
    for (int k = 0; k < r; ++k) spline = derivative(spline);
    return evaluate(spline, t);
}

TEST(Ends, HaveNamesThatAreReadBack) {
    for (const Ends ends : {Ends::Natural, Ends::Closed, Ends::Open, Ends::Clamped})
        EXPECT_EQ(parse_ends(name(ends)), ends);
    EXPECT_EQ(name(Ends::Natural), "natural");
    for (const char* text : {"", "Natural", "natural ", "periodic"})
        EXPECT_EQ(parse_ends(text), std::nullopt);
}

TEST(CheckShape, TakesExactlyTheCurvesThatExist) {
    for (int degree = -1; degree <= kMaxDegree + 2; ++degree)
        for (std::size_t count = 0; count <= 25; ++count) {
            const auto order = static_cast<std::size_t>(std::max(degree, 0)) + 1;
            const bool degree_exists = degree >= 1 && degree <= 20;
            const auto check = [&](Ends ends, bool fits, std::size_t least) {
                const auto error = check_shape({degree, ends}, count);
                EXPECT_EQ(!error, degree_exists && fits && count >= least)
                    << name(ends) << ", degree " << degree << ", " << count;
                if (!error) return;
                EXPECT_EQ(error->code,
                          degree_exists && fits ? ErrorCode::TooFewPoints : ErrorCode::Unsupported);
            };
            check(Ends::Natural, degree % 2 != 0, 2);
            check(Ends::Closed, true, 3);
            check(Ends::Open, true, order);
            check(Ends::Clamped, true, order);
        }
}

TEST(CheckShape, SaysWhatIsWrong) {
    EXPECT_TRUE(contains(check_shape({0, Ends::Open}, 9)->sentence, "degree is 0; it must be 1 to 20"));
    EXPECT_TRUE(contains(check_shape({4, Ends::Natural}, 9)->sentence, "odd degrees"));
    EXPECT_TRUE(contains(check_shape({3, Ends::Clamped}, 3)->sentence,
                         "degree 3 with clamped ends needs 4 points; there are 3"));
}

TEST(Curve, IsRefusedWithoutAShape) {
    EXPECT_EQ(error_of(Curve<double>::make({1, 2}, {2, Ends::Natural})).code, ErrorCode::Unsupported);
    EXPECT_EQ(error_of(Curve<double>::make({1, 2}, {2, Ends::Closed})).code, ErrorCode::TooFewPoints);
    EXPECT_EQ(error_of(Curve<double>::make({}, {})).code, ErrorCode::TooFewPoints);
}

template <class P>
void expect_refused(P bad, std::size_t at) {
    std::vector<P> points = tests::scattered_points<P>(5, 1);
    points[at] = bad;
    const Error error = error_of(Curve<P>::make(points, {}));
    EXPECT_EQ(error.code, ErrorCode::NotFinite);
    EXPECT_EQ(error.place, (Place{Place::Kind::Point, static_cast<std::int64_t>(at)}));
}

template <class P>
class CurveOf : public testing::Test {};
using VectorTypes = testing::Types<glm::vec2, glm::vec3, glm::dvec2, glm::dvec3>;
TYPED_TEST_SUITE(CurveOf, VectorTypes);

TYPED_TEST(CurveOf, PointsThatAreNotFiniteIsRefusedWithThePoint) {
    using Scalar = ScalarOf<TypeParam>;
    using Limits = std::numeric_limits<Scalar>;
    const Scalar largest = Limits::max() * Scalar(0x1p-24);
    for (int axis = 0; axis < TypeParam::length(); ++axis) {
        for (const Scalar bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                                 std::nextafter(largest, Limits::max()), Limits::lowest()}) {
            TypeParam point(1);
            point[axis] = bad;
            expect_refused(point, 0);
            expect_refused(point, 4);
        }
        TypeParam point(Limits::quiet_NaN());
        point[axis] = 1;
        expect_refused(point, 2);
    }
}

TYPED_TEST(CurveOf, TheLargestPointsHasFinitePointsAndPhantoms) {
    using Scalar = ScalarOf<TypeParam>;
    const Scalar largest = std::numeric_limits<Scalar>::max() * Scalar(0x1p-24);
    for (const CurveShape& shape : tests::shapes(1, kMaxDegree))
        for (const std::size_t n : tests::sizes(shape)) {
            std::vector<TypeParam> points(n);
            for (std::size_t i = 0; i < n; ++i) points[i] = TypeParam(i % 2 == 0 ? largest : -largest);
            const auto curve = curve_of(points, shape);
            const auto spline = spline_of(curve);
            for (const TypeParam& p : derivative(derivative(spline)).points)
                EXPECT_TRUE(shape.degree == 1 || std::isfinite(magnitude(p)));
            for (const Scalar t : tests::parameters<Scalar>(curve.first(), curve.last()))
                EXPECT_TRUE(std::isfinite(magnitude(evaluate(spline, t))));
        }
}

TEST(Curve, HasTheDomainItStates) {
    for (const CurveShape& shape : tests::shapes(1, 8))
        for (const std::size_t size : tests::sizes(shape)) {
            const auto curve = fractions(size, shape);
            const auto n = static_cast<int>(size);
            const int d = shape.degree;
            const auto expect_domain = [&](const Rational& first, const Rational& last) {
                EXPECT_EQ(curve.first(), first) << name(shape.ends) << d;
                EXPECT_EQ(curve.last(), last) << name(shape.ends) << d;
            };
            switch (shape.ends) {
                case Ends::Natural:
                    expect_domain(0, n - 1);
                    break;
                case Ends::Closed:
                    expect_domain(0, n);
                    break;
                case Ends::Open:
                    expect_domain(Rational(d - 1, 2), n - 1 - Rational(d - 1, 2));
                    break;
                case Ends::Clamped:
                    expect_domain(0, n - d);
                    break;
            }
            // That of its spline, but half an interval shorter on both sides where closed and even.
            const auto spline = spline_of(curve);
            const Rational more = shape.ends == Ends::Closed && d % 2 == 0 ? Rational(1, 2) : Rational(0);
            EXPECT_EQ(spline.first(), curve.first() - more);
            EXPECT_EQ(spline.last(), curve.last() + more);
        }
}

TEST(SplineOf, HasKnotsThatAreFoundGood) {
    for (const CurveShape& shape : tests::shapes(1, kMaxDegree))
        for (const std::size_t n : tests::sizes(shape)) {
            const auto spline = spline_of(curve_of(tests::scattered_points<double>(n, 1), shape));
            EXPECT_EQ(check_knots(spline.knots, spline.degree, spline.points.size()), std::nullopt);
            EXPECT_EQ(spline.one_apart, shape.ends != Ends::Clamped);
            for (std::size_t k = 0; spline.one_apart && k + 1 < spline.knots.size(); ++k)
                EXPECT_EQ(spline.knots[k + 1] - spline.knots[k], 1);
        }
}

TEST(SplineOf, CentresFunctionIAtI) {
    for (const CurveShape& shape : tests::shapes(1, 8)) {
        if (shape.ends == Ends::Clamped) continue;
        const auto curve = fractions(12, shape);
        const auto spline = spline_of(curve);
        const std::int64_t m = phantom_count(shape);
        for (std::int64_t i = -m; i < 12 + m; ++i) {
            const auto index = static_cast<std::size_t>(i + m);
            EXPECT_EQ(spline.points[index], control_point(curve, i));
            EXPECT_EQ(greville(spline, index), Rational(i));
        }
    }
}

TEST(Natural, PhantomsAreReflectedInTheEndsAgainAndAgain) {
    for (const int degree : {1, 3, 5, 7, 19})
        for (const std::size_t size : {2U, 3U, 5U, 24U}) {
            const auto curve = fractions(size, {degree, Ends::Natural});
            const auto c = [&](std::int64_t i) { return control_point(curve, i); };
            const auto last = static_cast<std::int64_t>(size) - 1;
            for (std::int64_t k = 0; k <= degree; ++k) {
                EXPECT_EQ(c(-k), 2 * c(0) - c(k));
                EXPECT_EQ(c(last + k), 2 * c(last) - c(last - k));
            }
        }
}

TEST(Natural, BeginsInTheFirstPointWithoutCurvature) {
    for (const int degree : {3, 5, 7})
        for (const std::size_t size : {2U, 3U, 4U, 9U}) {
            const auto curve = fractions(size, {degree, Ends::Natural});
            const auto& c = curve.points();
            const Rational end = curve.last();
            EXPECT_EQ(derived(curve, 0, 0), c.front());
            EXPECT_EQ(derived(curve, end, 0), c.back());
            EXPECT_EQ(derived(curve, 0, 2), 0);
            EXPECT_EQ(derived(curve, end, 2), 0);
            if (degree > 3) continue;
            EXPECT_EQ(derived(curve, 0, 1), c[1] - c[0]);
            EXPECT_EQ(derived(curve, end, 1), c[size - 1] - c[size - 2]);
        }
}

TEST(Natural, OfTwoPointsIsTheSegmentBetweenThem) {
    for (const int degree : {1, 3, 5, 7, 19}) {
        const auto curve = curve_of(std::vector<Rational>{3, 10}, {degree, Ends::Natural});
        for (const Rational& t : tests::fractions_between(0, 1, 6))
            EXPECT_EQ(derived(curve, t, 0), 3 + 7 * t) << degree;
    }
}

TEST(Closed, GoesAroundAndMeetsItselfSmoothly) {
    for (int degree = 1; degree <= 7; ++degree)
        for (const std::size_t size : {3U, 4U, 9U}) {
            const auto curve = fractions(size, {degree, Ends::Closed});
            const auto n = static_cast<std::int64_t>(size);
            for (std::int64_t i = -degree; i < n + degree; ++i)
                EXPECT_EQ(control_point(curve, i),
                          curve.points()[static_cast<std::size_t>((i + 10 * n) % n)]);
            for (int r = 0; r < degree; ++r)
                EXPECT_EQ(derived(curve, 0, r), derived(curve, curve.last(), r)) << degree << " " << r;
        }
}

TEST(Closed, TurnsWithItsControlPoints) {
    for (int degree = 1; degree <= 7; ++degree) {
        const auto curve = fractions(7, {degree, Ends::Closed});
        auto points = curve.points();
        std::rotate(points.begin(), points.begin() + 2, points.end());
        const auto turned = curve_of(points, curve.shape());
        for (const Rational& t : tests::fractions_between(2, 7, 20))
            EXPECT_EQ(derived(turned, t - 2, 0), derived(curve, t, 0)) << degree << " " << t;
    }
}

TEST(Open, IsTheSumOfItsOwnBasisFunctions) {
    const auto curve = fractions(8, {3, Ends::Open});
    for (const Rational& t : tests::fractions_between(curve.first(), curve.last(), 30)) {
        Rational sum(0);
        for (int i = 0; i < 8; ++i) sum += cubic_basis(Rational(t - i)) * curve.points()[i];
        EXPECT_EQ(derived(curve, t, 0), sum);
    }
    EXPECT_EQ(phantom_count(curve.shape()), 0);
}

TEST(Clamped, RunsFromTheFirstPointToTheLastAlongThePolygon) {
    for (int degree = 1; degree <= 7; ++degree) {
        const auto curve = fractions(static_cast<std::size_t>(degree) + 4, {degree, Ends::Clamped});
        const auto& c = curve.points();
        const auto spline = spline_of(curve);
        EXPECT_EQ(derived(curve, 0, 0), c.front());
        EXPECT_EQ(derived(curve, curve.last(), 0), c.back());
        EXPECT_EQ(derived(curve, 0, 1), degree * (c[1] - c[0]));
        EXPECT_EQ(derived(curve, curve.last(), 1), degree * (c[c.size() - 1] - c[c.size() - 2]));
        for (int k = 0; k <= degree; ++k) {
            EXPECT_EQ(spline.knots[k], 0);
            EXPECT_EQ(spline.knots[spline.knots.size() - 1 - k], curve.last());
        }
    }
}

TEST(Clamped, WithDegreeAndOnePointsIsABezierCurve) {
    const auto curve = fractions(4, {3, Ends::Clamped});
    const auto& c = curve.points();
    for (const Rational& t : tests::fractions_between(0, 1, 12)) {
        const Rational w = 1 - t;
        EXPECT_EQ(derived(curve, t, 0),
                  w * w * w * c[0] + 3 * t * w * w * c[1] + 3 * t * t * w * c[2] + t * t * t * c[3]);
    }
}

TEST(Curve, HasTheValuesOfTheDocumentation) {
    const auto spline = spline_of(curve_of(tests::report_points(), {3, Ends::Natural}));
    struct Row {
        double t, x, y;
    };
    // Printed to ten decimals.
    for (const Row& row :
         {Row{0, -0.8, 1}, Row{0.5, -0.7479166667, 0.9020833333}, Row{1, -0.6833333333, 0.8166666667},
          Row{3.5, -0.24375, 0.5541666667}, Row{6, 0.4, 0.6}, Row{7, 0.5, 1}}) {
        const glm::dvec2 p = evaluate(spline, row.t);
        EXPECT_NEAR(p.x, row.x, 0.5e-10 + 1e-15) << row.t;
        EXPECT_NEAR(p.y, row.y, 0.5e-10 + 1e-15) << row.t;
    }
}

TEST(Magnitude, IsTheLargestCoordinateAndNaNWhereOneIs) {
    EXPECT_EQ(magnitude(-3.5), 3.5);
    EXPECT_EQ(magnitude(glm::dvec3(1, -7, 2)), 7);
    EXPECT_EQ(magnitude(glm::vec2(-0.0F, 0.0F)), 0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 p(5);
        p[axis] = nan;
        EXPECT_TRUE(std::isnan(magnitude(p)));
        EXPECT_TRUE(std::isnan(norm(p)));
    }
}

TEST(Norm, IsWithinItsRoundings) {
    Observed use("Error of a length, in roundings over the most", "point", 1);
    std::int64_t place = 0;
    for (const auto& p : tests::scattered_points<glm::dvec3>(1000, 11)) {
        const High exact = sqrt(High(p.x) * p.x + High(p.y) * p.y + High(p.z) * p.z);
        const double bound = rounding_of(kNormRoundings, Precision::Double) * static_cast<double>(exact);
        use.add(tests::share_of(tests::error_of_value(norm(p), exact), bound), place++);
    }
    use.check();
}

TEST(LargestCoordinate, IsTheLargestMagnitudeAndNaNWhereOneIs) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(largest_coordinate(std::vector<glm::dvec2>{}), 0);
    EXPECT_EQ(largest_coordinate(std::vector<glm::dvec2>{{1, -7}, {3, 2}}), 7);
    for (const auto& points : {std::vector<double>{nan, 5}, std::vector<double>{5, nan}})
        EXPECT_TRUE(std::isnan(largest_coordinate(points)));
}

TEST(Norm, DoesNotOverflowOnTheWay) {
    EXPECT_EQ(norm(-2.0), 2);
    EXPECT_EQ(norm(glm::dvec2(3, 4)), 5);
    EXPECT_EQ(norm(glm::dvec2(0x3p600, 0x4p600)), 0x5p600);
    EXPECT_EQ(norm(glm::vec2(0x3p-100F, 0x4p-100F)), 0x5p-100F);
    EXPECT_TRUE(std::isfinite(norm(glm::dvec3(1e308 / 2))));
}

}  // namespace
}  // namespace loopcheck::core
