#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/bspline/curve.h"
#include "core/mesh/rounding.h"
#include "reference/boost_math/cardinal.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::tests {
namespace {

using core::HighPrecision;
using core::Precision;

// Knots of basis function 0, centred at 0, and one more: the last of all is closed at its right end.
template <class Scalar>
std::vector<Scalar> centred_knots(int degree) {
    std::vector<Scalar> out;
    for (int k = 0; k <= degree + 2; ++k) out.push_back(Scalar(2 * k - (degree + 1)) / 2);
    return out;
}

template <class Scalar>
Scalar core_cardinal(int degree, double x, int order) {
    return core::basis_derivative<Scalar>(centred_knots<Scalar>(degree), degree, 0, Scalar(x), order);
}

// Even and odd fractions of the support, its knots with their neighbours, and places beyond it.
std::vector<double> places(int degree) {
    const double half = (degree + 1) / 2.0;
    std::vector<double> out{-half - 3, half + 3, 0x1p-1000, 1e300, -0.0};
    for (int k = -200; k <= 200; ++k) out.push_back(half * k / 197);
    for (double knot = -half; knot <= half; knot += 0.5)
        for (const double x : {std::nextafter(knot, -9.0), knot, std::nextafter(knot, 9.0)}) out.push_back(x);
    return out;
}

int lowest_degree(int order) {
    return order == 0 ? 1 : order + 1;
}

double boost_bound(int degree, int order) {
    return std::ldexp(core::rounding_of(reference::boost_cardinal_roundings(degree), Precision::Double),
                      order);
}

TEST(BoostCardinal, IsTheBasisFunctionWithinItsBound) {
    for (int order = 0; order <= 2; ++order)
        for (int d = lowest_degree(order); d <= reference::kBoostMaxDegree; ++d) {
            Observed use("Boost, degree " + std::to_string(d) + ", order " + std::to_string(order) +
                             ": share of the bound",
                         "place", 1);
            std::int64_t place = 0;
            for (const double x : places(d)) {
                const double got = value_of(reference::boost_cardinal(d, x, order));
                const auto exact = core_cardinal<HighPrecision>(d, x, order);
                use.add(share_of(error_of_value(got, exact), boost_bound(d, order)), place++, got,
                        static_cast<double>(exact));
            }
            use.check();
        }
}

// The same in double: the bounds of both are allowed.
TEST(BoostCardinal, AgreesWithOursInDouble) {
    for (int d = 1; d <= reference::kBoostMaxDegree; ++d) {
        const double allowed =
            boost_bound(d, 0) + core::rounding_of(core::kBasisRoundingsPerDegree * d, Precision::Double);
        Observed difference("Boost and ours, degree " + std::to_string(d) + ": difference", "place", allowed);
        std::int64_t place = 0;
        for (const double x : places(d)) {
            const double got = value_of(reference::boost_cardinal(d, x, 0));
            const double ours = core_cardinal<double>(d, x, 0);
            difference.add(std::abs(got - ours), place++, got, ours);
        }
        difference.check();
    }
}

TEST(BoostCardinal, IsEvenOrOddToTheBit) {
    for (int order = 0; order <= 2; ++order)
        for (int d = lowest_degree(order); d <= reference::kBoostMaxDegree; ++d)
            for (const double x : places(d))
                EXPECT_EQ(value_of(reference::boost_cardinal(d, -x, order)),
                          (order == 1 ? -1 : 1) * value_of(reference::boost_cardinal(d, x, order)))
                    << d << " " << order << " " << x;
}

// Named: the one place where Boost's slope is wrong and not only another convention.
TEST(BoostCardinal, SlopeOfTheHatGoesOnBeyondItsSupport) {
    const auto slope = [](double x) { return value_of(reference::boost_cardinal(1, x, 1)); };
    for (const double x : {1.25, 2.0, 1e300}) {
        EXPECT_EQ(slope(x), -1) << x;
        EXPECT_EQ(slope(-x), 1) << x;
        EXPECT_EQ(core_cardinal<double>(1, x, 1), 0) << x;
    }
}

// Named: ours is right-continuous.
TEST(BoostCardinal, SlopeOfTheHatIsTheMeanAtItsKnots) {
    const double knots[]{-1, 0, 1}, boost[]{0.5, 0, -0.5}, ours[]{1, -1, 0};
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(value_of(reference::boost_cardinal(1, knots[k], 1)), boost[k]);
        EXPECT_EQ(core_cardinal<double>(1, knots[k], 1), ours[k]);
    }
    for (const double x : {-0.75, -0.25, 0.25, 0.75})
        EXPECT_EQ(value_of(reference::boost_cardinal(1, x, 1)), core_cardinal<double>(1, x, 1)) << x;
}

// Named: where a step of the recursion is left a NaN goes through, else the hat function has made 0 of it.
TEST(BoostCardinal, HidesANanBelowTheSecondStep) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int order = 0; order <= 2; ++order)
        for (int d = lowest_degree(order); d <= reference::kBoostMaxDegree; ++d)
            EXPECT_EQ(std::isnan(value_of(reference::boost_cardinal(d, nan, order))), d - order >= 2)
                << d << " " << order;
}

TEST(BoostCardinal, RefusesWhatBoostDoesNotHave) {
    const auto code = [](int degree, int order) {
        return error_of(reference::boost_cardinal(degree, 0.25, order)).code;
    };
    for (const int d : {-1, 0, reference::kBoostMaxDegree + 1})
        EXPECT_EQ(code(d, 0), core::ErrorCode::Unsupported);
    for (const int d : {1, 2}) EXPECT_EQ(code(d, 2), core::ErrorCode::Unsupported);
    for (const int order : {-1, 3}) EXPECT_EQ(code(5, order), core::ErrorCode::Unsupported);
}

// The parameters of a domain: its ends, the knots and their neighbours, and fractions.
std::vector<double> parameters_of(double first, double last) {
    std::vector<double> out{first, last, std::nextafter(first, last), std::nextafter(last, first)};
    for (double t = first; t < last; t += 0.5)
        for (const double x : {t, t + 1.0 / 3, std::nextafter(t + 0.5, first)}) out.push_back(x);
    return out;
}

// Against the oracle, for every shape of ends with uniform knots.
void add_curve_use(Observed& use, int degree, core::Ends ends, int count) {
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(3 * std::cos(1.7 * i) + std::sin(i * i));
    const core::CurveShape shape{degree, ends};
    const auto curve = core::Curve<double>::make(numbers, shape).value();
    const auto exact =
        core::spline_of(core::Curve<HighPrecision>::make({numbers.begin(), numbers.end()}, shape).value());
    const auto points = core::extended_points(curve);
    double largest = 0;
    for (const double c : points) largest = std::max(largest, std::abs(c));
    // One more for the phantoms.
    const double bound =
        largest * core::rounding_of(reference::boost_curve_roundings(degree) + 1, Precision::Double);
    const auto parameters = parameters_of(curve.first(), curve.last());
    const auto got = value_of(
        reference::boost_curve_points<double>(degree, points, -core::phantom_count(shape), parameters));
    ASSERT_EQ(got.size(), parameters.size());
    for (std::size_t j = 0; j < got.size(); ++j) {
        const auto wanted = core::evaluate(exact, HighPrecision(parameters[j]));
        use.add(share_of(error_of_value(got[j], wanted), bound), static_cast<std::int64_t>(j), got[j],
                static_cast<double>(wanted));
    }
}

TEST(BoostCurvePoints, AreOnTheCurveWithinTheirBound) {
    for (int d = 1; d <= reference::kBoostMaxDegree; ++d) {
        Observed use("Boost's curve, degree " + std::to_string(d) + ": share of the bound", "parameter", 1);
        for (const core::Ends ends : {core::Ends::Natural, core::Ends::Closed, core::Ends::Open}) {
            if (ends == core::Ends::Natural && d % 2 == 0) continue;
            for (const int count : {d + 1, 40}) add_curve_use(use, d, ends, std::max(count, 3));
        }
        use.check();
    }
}

TEST(BoostCurvePoints, OfPointsAreThoseOfEachCoordinate) {
    const std::vector<glm::dvec3> points{{1, 2, 3}, {0.1, 0.2, 0.4}, {7, -1, 2}, {3, 3, -9}, {1, 0, 2}};
    const std::vector<double> parameters{6, 6.25, 6.7, 7, 7.9, 8};
    const auto got = value_of(reference::boost_curve_points<glm::dvec3>(3, points, 5, parameters));
    const std::vector<glm::dvec2> flat(points.begin(), points.end());
    const auto flat_got = value_of(reference::boost_curve_points<glm::dvec2>(3, flat, 5, parameters));
    ASSERT_EQ(got.size(), parameters.size());
    for (int d = 0; d < 3; ++d) {
        std::vector<double> numbers;
        for (const auto& p : points) numbers.push_back(p[d]);
        const auto one = value_of(reference::boost_curve_points<double>(3, numbers, 5, parameters));
        for (std::size_t j = 0; j < one.size(); ++j) {
            EXPECT_EQ(got[j][d], one[j]);
            if (d < 2) {
                EXPECT_EQ(flat_got[j][d], one[j]);
            }
        }
    }
}

TEST(BoostCurvePoints, RefuseWhatTheyCannotReach) {
    const std::vector<double> points{1, 2, 3, 4, 5};
    const auto code = [&](int degree, double t) {
        return error_of(reference::boost_curve_points<double>(degree, points, -1, std::span(&t, 1))).code;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double t : {-0x1p-50, 2 + 0x1p-50, nan, 1e300})
        EXPECT_EQ(code(3, t), core::ErrorCode::OutsideDomain) << t;
    EXPECT_EQ(code(7, 1), core::ErrorCode::OutsideDomain);
    EXPECT_EQ(code(0, 1), core::ErrorCode::Unsupported);
    EXPECT_EQ(code(reference::kBoostMaxDegree + 1, 1), core::ErrorCode::Unsupported);
}

TEST(BoostVersion, IsTwoNumbers) {
    const std::string version = reference::boost_version();
    EXPECT_TRUE(version.starts_with("1.")) << version;
    EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 1) << version;
}

}  // namespace
}  // namespace loopcheck::tests
