#include "core/bspline/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/bspline/limit.h"
#include "tests/support/curves.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::curve_of;
using tests::error_of;
using tests::Observed;
using tests::value_of;

constexpr std::size_t kRoom = 1'000'000;

template <class P>
FlatCurve<P> flat(const Curve<P>& curve, double tolerance) {
    return value_of(flatten(spline_of(curve), curve.first(), curve.last(), tolerance, kRoom));
}

// Round, some of its points twice.
std::vector<glm::dvec2> winding_points(std::size_t count) {
    std::vector<glm::dvec2> out;
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(i - i % 5 / 4);
        out.push_back({x + std::cos(1.7 * x), 3 * std::sin(2.3 * x + 1)});
    }
    return out;
}

template <class P>
void expect_ascending(const FlatCurve<P>& flat, double first, double last) {
    ASSERT_EQ(flat.parameters.size(), flat.points.size());
    ASSERT_GE(flat.parameters.size(), 2U);
    EXPECT_EQ(flat.parameters.front(), first);
    EXPECT_EQ(flat.parameters.back(), last);
    EXPECT_TRUE(std::is_sorted(flat.parameters.begin(), flat.parameters.end(), std::less_equal<>()));
}

// Distances of curve and chord at the same parameter, many on every chord.
template <class P>
double farthest_from_chords(const Spline<P>& spline, const FlatCurve<P>& flat) {
    double farthest = 0;
    for (std::size_t i = 0; i + 1 < flat.points.size(); ++i)
        for (int k = 1; k < 16; ++k) {
            const double u = k / 16.0;
            const double t = (1 - u) * flat.parameters[i] + u * flat.parameters[i + 1];
            const P chord = (1 - u) * flat.points[i] + u * flat.points[i + 1];
            farthest = std::max(farthest, norm(evaluate(spline, t) - chord));
        }
    return farthest;
}

TEST(Flatten, IsWithinToleranceForEveryShape) {
    Observed use("Distance from the chords over the tolerance", "degree", 1);
    for (const CurveShape& shape : tests::shapes(1, 8))
        for (const std::size_t n : tests::sizes(shape))
            for (const double tolerance : {1.0, 0.1, 1e-3}) {
                const auto curve = curve_of(winding_points(n), shape);
                const auto spline = spline_of(curve);
                const auto result = flat(curve, tolerance);
                expect_ascending(result, curve.first(), curve.last());
                const double rounding =
                    2 * rounding_of(evaluation_roundings(shape.degree) + 4, Precision::Double) *
                    std::sqrt(2.0) * static_cast<double>(n + 4) * 3;
                use.add(farthest_from_chords(spline, result) / (tolerance + rounding), shape.degree);
            }
    use.check();
}

TEST(Flatten, PutsItsPointsOnTheCurve) {
    const auto curve = curve_of(winding_points(9), {3, Ends::Closed});
    const auto spline = spline_of(curve);
    const auto result = flat(curve, 0.01);
    for (std::size_t i = 0; i < result.points.size(); ++i)
        EXPECT_EQ(result.points[i], evaluate(spline, result.parameters[i]));
}

// What a chord from a to b is judged by, taken apart at the knots.
double criterion(const Spline<glm::dvec2>& spline, double a, double b) {
    const auto second = detail::second_derivative(spline);
    double largest = 0;
    for (std::size_t s = span_of(spline, a); s < spline.points.size() && spline.knots[s] < b; ++s) {
        const double low = std::max(a, spline.knots[s]), high = std::min(b, spline.knots[s + 1]);
        if (low < high)
            largest = std::max(largest, detail::largest_second_derivative(second, s - 2, low, high));
    }
    return (b - a) * (b - a) / 8 * largest;
}

TEST(Flatten, NeedsNoMorePointsThanAnyChoiceFromAFineGrid) {
    for (const CurveShape& shape :
         {CurveShape{2, Ends::Closed}, CurveShape{3, Ends::Natural}, CurveShape{3, Ends::Closed},
          CurveShape{3, Ends::Clamped}, CurveShape{4, Ends::Open}, CurveShape{5, Ends::Natural}})
        for (const double tolerance : {0.5, 0.1, 0.02}) {
            const auto curve = curve_of(winding_points(8), shape);
            const auto spline = spline_of(curve);
            const auto greedy = flat(curve, tolerance);
            // With the parameters that were found the fewest chords are exactly as many.
            std::set<double> grid(greedy.parameters.begin(), greedy.parameters.end());
            for (int k = 1; k < 120; ++k)
                grid.insert(curve.first() + (curve.last() - curve.first()) * k / 120);
            const std::vector<double> t(grid.begin(), grid.end());
            std::vector<std::size_t> chords(t.size(), t.size());
            chords[0] = 0;
            for (std::size_t i = 0; i < t.size(); ++i)
                for (std::size_t j = i + 1; j < t.size(); ++j) {
                    // Half an ulp of leave, for the points that are as far as they may be.
                    if (!(criterion(spline, t[i], t[j]) <= tolerance * (1 + 1e-14))) break;
                    chords[j] = std::min(chords[j], chords[i] + 1);
                }
            EXPECT_EQ(greedy.points.size() - 1, chords.back()) << name(shape.ends) << shape.degree;
        }
}

TEST(Flatten, JudgesByTheSecondDerivativeItself) {
    // Of a cubic it is linear between knots: the largest is at their ends.
    const auto spline = spline_of(curve_of(winding_points(8), {3, Ends::Natural}));
    const auto second = detail::second_derivative(spline);
    for (std::size_t s = 3; s < spline.points.size(); ++s)
        for (const auto& [u, v] : {std::pair{0.0, 1.0}, {0.25, 0.5}, {0.9, 1.0}}) {
            const double a = spline.knots[s] + u, b = spline.knots[s] + v;
            double wanted = 0;
            for (int k = 0; k <= 64; ++k) {
                glm::dvec2 bend(0);
                for (std::size_t i = s - 3; i <= s; ++i)
                    bend += cubic_basis_second_derivative(a + (b - a) * k / 64 - spline.knots[i + 2]) *
                            spline.points[i];
                wanted = std::max(wanted, norm(bend));
            }
            const double got = detail::largest_second_derivative(second, s - 2, a, b);
            EXPECT_NEAR(got, wanted, 100 * unit_roundoff(Precision::Double) * 60);
        }
}

TEST(BezierPoints, AreBlossomsAtTheEndsOfThePart) {
    Observed use("Difference of two ways to Bezier points over their roundings", "degree", 1);
    for (int degree = 1; degree <= kMaxDegree; ++degree)
        for (const Ends ends : {Ends::Open, Ends::Clamped}) {
            const auto spline = spline_of(curve_of(winding_points(24), {degree, ends}));
            const double largest = 27;
            for (auto s = static_cast<std::size_t>(degree); s < spline.points.size(); ++s)
                for (const auto& [u, v] : {std::pair{0.0, 1.0}, {0.0, 0x1p-40}, {0.3, 0.6}, {0.875, 1.0}}) {
                    const double a = spline.knots[s] + u, b = spline.knots[s] + v;
                    const auto points = detail::bezier_points(spline, s, a, b);
                    for (int k = 0; k <= degree; ++k) {
                        const glm::dvec2 wanted = blossom(
                            spline, s, [&](std::size_t r) { return static_cast<int>(r) < k ? b : a; });
                        // Each by as many convex combinations as the degree, or twice as many.
                        const double bound =
                            rounding_of(3 * kBasisRoundingsPerDegree * degree, Precision::Double) * largest;
                        use.add(magnitude(points[k] - wanted) / bound, degree);
                    }
                }
        }
    use.check();
}

TEST(Flatten, ShrinksItsCriterionWithTheChord) {
    for (int degree = 2; degree <= 8; ++degree) {
        const auto spline = spline_of(curve_of(winding_points(12), {degree, Ends::Closed}));
        for (double a = 0.5; a < 6; a += 0.37)
            for (double width = 2; width > 0.01; width *= 0.7) {
                const double outer = criterion(spline, a, a + width);
                EXPECT_LE(criterion(spline, a + width / 8, a + width), outer);
                EXPECT_LE(criterion(spline, a, a + width * 7 / 8), outer);
            }
    }
}

TEST(Flatten, FindsItsParametersToTheLastPlaces) {
    const auto curve = curve_of(winding_points(8), {3, Ends::Natural});
    const auto spline = spline_of(curve);
    const double tolerance = 0.03;
    const auto result = flat(curve, tolerance);
    ASSERT_GT(result.parameters.size(), 5U);
    for (std::size_t i = 0; i + 2 < result.parameters.size(); ++i) {
        const double a = result.parameters[i], b = result.parameters[i + 1];
        EXPECT_LE(criterion(spline, a, b), tolerance);
        EXPECT_GT(criterion(spline, a, std::nextafter(std::nextafter(b, 9.0), 9.0)), tolerance);
    }
}

TEST(Flatten, NeedsNoMorePointsForALargerTolerance) {
    for (const CurveShape& shape : tests::shapes(1, 8)) {
        std::size_t most = std::numeric_limits<std::size_t>::max();
        for (double tolerance = 0.001; tolerance < 10; tolerance *= 1.3) {
            const std::size_t count = flat(curve_of(winding_points(12), shape), tolerance).points.size();
            EXPECT_LE(count, most) << name(shape.ends) << shape.degree << " " << tolerance;
            most = count;
        }
    }
}

TEST(Flatten, KeepsCorners) {
    for (int degree = 1; degree <= 5; ++degree) {
        const auto d = static_cast<std::size_t>(degree);
        Spline<glm::dvec2> spline{degree, {}, winding_points(3 * d + 1), false};
        spline.knots.assign(d + 1, 0);
        spline.knots.insert(spline.knots.end(), d, 1);
        spline.knots.insert(spline.knots.end(), d, 3);
        spline.knots.insert(spline.knots.end(), d + 1, 4);
        ASSERT_EQ(check_knots(spline.knots, degree, spline.points.size()), std::nullopt);
        for (const double tolerance : {1e9, 0.01}) {
            const auto result = value_of(flatten(spline, 0.0, 4.0, tolerance, kRoom));
            expect_ascending(result, 0, 4);
            for (const double corner : {1.0, 3.0}) {
                const auto found = std::find(result.parameters.begin(), result.parameters.end(), corner);
                ASSERT_NE(found, result.parameters.end()) << degree;
                const auto i = static_cast<std::size_t>(found - result.parameters.begin());
                const glm::dvec2 difference =
                    result.points[i] - spline.points[d * static_cast<std::size_t>(corner == 1 ? 1 : 2)];
                EXPECT_LE(norm(difference),
                          rounding_of(evaluation_roundings(degree), Precision::Double) * 60);
            }
        }
        EXPECT_EQ(value_of(flatten(spline, 0.0, 4.0, 1e9, kRoom)).points.size(), 4U) << degree;
    }
}

TEST(Flatten, OfDegreeOneIsThePolygon) {
    for (const Ends ends : {Ends::Natural, Ends::Closed, Ends::Open, Ends::Clamped}) {
        auto points = winding_points(7);
        const auto result = flat(curve_of(points, {1, ends}), 0.001);
        if (ends == Ends::Closed) points.push_back(points.front());
        EXPECT_EQ(result.points, points);
    }
}

TEST(Flatten, TakesAPartOfTheDomain) {
    const auto curve = curve_of(winding_points(9), {3, Ends::Natural});
    const auto spline = spline_of(curve);
    for (const double first : {0.0, 0.3, 2.0, 2.5})
        for (const double last : {2.75, 3.0, 7.9, 8.0}) {
            const auto result = value_of(flatten(spline, first, last, 0.01, kRoom));
            expect_ascending(result, first, last);
            EXPECT_LE(farthest_from_chords(spline, result), 0.01);
        }
}

TEST(Flatten, IsTooLargeForTheRoomThereIs) {
    for (const CurveShape& shape : {CurveShape{3, Ends::Natural}, CurveShape{1, Ends::Open}}) {
        const auto curve = curve_of(winding_points(9), shape);
        const auto spline = spline_of(curve);
        const std::size_t needed = flat(curve, 0.01).points.size();
        for (std::size_t room = 0; room < needed; ++room)
            EXPECT_EQ(error_of(flatten(spline, curve.first(), curve.last(), 0.01, room)).code,
                      ErrorCode::TooLarge);
        // What is asked for is known before any point is: one more an interval, where |P''| is even.
        EXPECT_TRUE(flatten(spline, curve.first(), curve.last(), 0.01, 2 * needed));
    }
}

TEST(Flatten, TakesAnyTolerance) {
    const auto curve = curve_of(winding_points(9), {3, Ends::Natural});
    const auto spline = spline_of(curve);
    using Limits = std::numeric_limits<double>;
    for (const double huge : {1e6, Limits::max(), Limits::infinity()})
        EXPECT_EQ(flat(curve, huge).parameters, (std::vector<double>{0, 8}));
    for (const double tiny : {1e-30, Limits::denorm_min()})
        EXPECT_EQ(error_of(flatten(spline, 0.0, 8.0, tiny, 1000)).code, ErrorCode::TooLarge);
}

TEST(Flatten, OfOnePointOrALineIsTwoPoints) {
    for (const int degree : {1, 2, 3, 5}) {
        const std::vector<glm::dvec3> same(9, {1, 2, 3});
        const std::size_t corners = degree == 1 ? 9 : 0;
        EXPECT_EQ(flat(curve_of(same, {degree, Ends::Closed}), 1e-300).points.size(),
                  corners > 0 ? corners + 1 : 2);
    }
    std::vector<double> line;
    for (int i = 0; i < 9; ++i) line.push_back(i);
    EXPECT_EQ(flat(curve_of(line, {3, Ends::Natural}), 1e-300).parameters, (std::vector<double>{0, 8}));
}

TEST(Flatten, OfTheLargestPointsIsRefusedOrWithinTolerance) {
    const double largest = std::numeric_limits<double>::max() * 0x1p-24;
    const auto curve = curve_of(std::vector<double>{largest, -largest, largest, -largest}, {3, Ends::Closed});
    const auto result = flat(curve, largest / 1000);
    EXPECT_LE(farthest_from_chords(spline_of(curve), result), largest / 1000);
    EXPECT_EQ(error_of(flatten(spline_of(curve), 0.0, 4.0, 1.0, 1000)).code, ErrorCode::TooLarge);
}

TEST(Flatten, IsTooLargeWhereKnotsAreSoCloseThatThereIsNoSecondDerivative) {
    // A smooth bend over 2^-1060: its derivatives are infinite, and some are infinity times nothing.
    const double close = 0x1p-1060;
    const Spline<double> spline{3, {0, 0, 0, 0, close, 1, 1, 1, 1}, {0, 0, 5, 5, 0}, false};
    ASSERT_EQ(check_knots(spline.knots, 3, 5), std::nullopt);
    EXPECT_EQ(error_of(flatten(spline, 0.0, 1.0, 0.1, kRoom)).code, ErrorCode::TooLarge);
}

TEST(Flatten, NeverNeedsMorePointsThanUniformSubdivision) {
    for (const CurveShape& shape : tests::shapes(2, 8)) {
        if (shape.ends == Ends::Clamped) continue;
        for (const double tolerance : {1.1, 0.13, 0.017, 0.0023, 0.00031}) {
            const auto curve = curve_of(winding_points(11), shape);
            const int level = level_for_tolerance(curve, tolerance);
            // The intervals of that level, with one chord each.
            const double intervals = std::ceil(curve.last() - curve.first()) * std::ldexp(1.0, level);
            EXPECT_LE(static_cast<double>(flat(curve, tolerance).points.size()), intervals + 1)
                << name(shape.ends) << shape.degree << " " << tolerance;
        }
    }
}

}  // namespace
}  // namespace loopcheck::core
