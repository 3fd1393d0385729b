#include "core/bspline/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/bspline/limit.h"
#include "core/mesh/rounding.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::tests {
namespace {

using core::Curve;
using core::Ends;
using core::HighPrecision;
using core::Rational;

constexpr Ends kEnds[]{Ends::Natural, Ends::Closed, Ends::Open};
constexpr int kSteps[]{1, 2, 3, 7, 16, 100, 1000};

template <class P>
using Sampler = std::vector<P> (*)(const Curve<P>&, int);

// Numbers without any symmetry, none of them a fraction of few digits.
template <class Real>
std::vector<Real> scattered_numbers(int count) {
    std::vector<Real> out;
    for (int i = 0; i < count; ++i) out.push_back(static_cast<Real>(3 * std::cos(1.7 * i) + std::sin(i * i)));
    return out;
}

// A cubic curve through numbers: what is claimed of coordinates needs no more than one.
template <class To, class From>
Curve<To> curve_of(const std::vector<From>& numbers, Ends ends) {
    return Curve<To>::make(std::vector<To>(numbers.begin(), numbers.end()), {3, ends}).value();
}

int least_points(Ends ends) {
    return ends == Ends::Natural ? 2 : ends == Ends::Closed ? 3 : 4;
}

template <class Real>
double largest_coordinate(const Curve<Real>& curve) {
    Real largest = 0;
    for (const Real c : core::extended_points(curve)) largest = std::max(largest, std::abs(c));
    return static_cast<double>(largest);
}

// The share of the bound that the errors against the oracle take: de Boor's algorithm in 38 digits at j/s.
template <class Real>
void add_use(Observed& use, const Curve<Real>& curve, int s, const std::vector<Real>& samples,
             int roundings) {
    const auto exact_curve = curve_of<HighPrecision>(curve.points(), curve.shape().ends);
    const auto exact = core::spline_of(exact_curve);
    const auto precision = sizeof(Real) == 4 ? core::Precision::Float : core::Precision::Double;
    const double bound = core::rounding_of(roundings, precision) * largest_coordinate(curve);
    for (std::size_t j = 0; j < samples.size(); ++j) {
        const auto place = static_cast<std::int64_t>(j);
        const HighPrecision wanted = core::evaluate(exact, core::sample_parameter(exact_curve, s, place));
        use.add(share_of(error_of_value(samples[j], wanted), bound), place, static_cast<double>(samples[j]),
                static_cast<double>(wanted));
    }
}

template <class Real>
void observe(const std::string& what, Sampler<Real> sample, int (*roundings)(int)) {
    for (const int s : kSteps) {
        Observed use(what + ", " + std::to_string(s) + " an interval: share of the bound", "sample", 1);
        for (const Ends ends : kEnds)
            for (const int n : {least_points(ends), 9}) {
                const auto curve = curve_of<Real>(scattered_numbers<Real>(n), ends);
                add_use(use, curve, s, sample(curve, s), roundings(s));
            }
        use.check();
    }
}

constexpr auto kTableRoundings = [](int) { return core::kTableSampleRoundings; };

TEST(SampleByTable, IsWithinItsBound) {
    observe<double>("table, double", core::sample_by_table, kTableRoundings);
    observe<float>("table, float", core::sample_by_table, kTableRoundings);
}

TEST(SampleByDifferences, IsWithinItsBound) {
    observe<double>("differences, double", core::sample_by_differences, core::difference_sample_roundings);
    observe<float>("differences, float", core::sample_by_differences, core::difference_sample_roundings);
}

// The points with which the starts weigh most: c = +1 and -1 after the signs of a difference, and all alike,
// where every addition to p rounds a number as large as there is.
TEST(SampleByDifferences, IsWithinItsBoundWhereEverySignIsAgainstIt) {
    const double third = 1.0 / 3;
    Observed use("differences, double, signs: share of the bound", "sample", 1);
    for (int signs = 0; signs < 16; ++signs) {
        std::vector<double> points;
        for (int i = 0; i < 4; ++i) points.push_back((signs >> i & 1) != 0 ? third : -third);
        const auto curve = curve_of<double>(points, Ends::Open);
        for (const int s : kSteps)
            add_use(use, curve, s, core::sample_by_differences(curve, s),
                    core::difference_sample_roundings(s));
    }
    use.check();
}

TEST(Samples, AreTheSameBothWaysInExactArithmetic) {
    std::vector<Rational> points;
    for (int i = 0; i < 6; ++i) points.push_back(Rational(7 * i * i % 11 - 4, i + 1));
    for (const Ends ends : kEnds)
        for (const int s : {1, 2, 3, 7, 16}) {
            const auto curve = curve_of<Rational>(points, ends);
            const auto spline = core::spline_of(curve);
            const auto samples = core::sample_by_table(curve, s);
            EXPECT_EQ(core::sample_by_differences(curve, s), samples) << core::name(ends) << " " << s;
            for (std::size_t j = 0; j < samples.size(); ++j)
                EXPECT_EQ(samples[j], core::evaluate(spline, core::sample_parameter(
                                                                 curve, s, static_cast<std::int64_t>(j))))
                    << core::name(ends) << " " << s << " sample " << j;
        }
}

TEST(Samples, GoFromTheFirstToTheLastParameter) {
    for (const Ends ends : kEnds)
        for (const int n : {least_points(ends), 9})
            for (const int s : kSteps) {
                const auto curve = curve_of<double>(scattered_numbers<double>(n), ends);
                const auto count = static_cast<std::int64_t>(core::sample_by_table(curve, s).size());
                EXPECT_EQ(count, static_cast<std::int64_t>(curve.last() - curve.first()) * s + 1);
                EXPECT_EQ(core::sample_parameter(curve, s, 0), curve.first());
                EXPECT_EQ(core::sample_parameter(curve, s, count - 1), curve.last());
            }
}

TEST(Samples, AreLimitPositionsAtKnots) {
    for (const Ends ends : kEnds) {
        const auto curve = curve_of<double>(scattered_numbers<double>(9), ends);
        const auto positions = core::limits(curve).positions;
        const auto samples = core::sample_by_table(curve, 16);
        const double bound = core::rounding_of(core::kTableSampleRoundings + 4, core::Precision::Double) *
                             largest_coordinate(curve);
        for (std::size_t i = 0; i < positions.size(); ++i)
            EXPECT_NEAR(samples[16 * i], positions[i], bound) << core::name(ends) << " " << i;
    }
}

TEST(Samples, HaveTheSameBitsBothWaysAtKnots) {
    for (const Ends ends : kEnds)
        for (const int s : kSteps) {
            const auto curve = curve_of<double>(scattered_numbers<double>(9), ends);
            const auto by_table = core::sample_by_table(curve, s);
            const auto by_differences = core::sample_by_differences(curve, s);
            ASSERT_EQ(by_table.size(), by_differences.size());
            for (std::size_t j = 0; j < by_table.size(); j += static_cast<std::size_t>(s))
                EXPECT_EQ(by_table[j], by_differences[j]) << core::name(ends) << " " << s << " sample " << j;
        }
}

TEST(Samples, EndWhereTheyBeganOnAClosedCurve) {
    for (const int n : {3, 4, 9})
        for (const int s : kSteps) {
            const auto curve = curve_of<double>(scattered_numbers<double>(n), Ends::Closed);
            for (const auto& samples :
                 {core::sample_by_table(curve, s), core::sample_by_differences(curve, s)})
                EXPECT_EQ(samples.front(), samples.back()) << n << " points, " << s << " an interval";
        }
}

template <class P, int D>
void expect_coordinates_by_themselves() {
    std::vector<P> points(9);
    for (int i = 0; i < 9; ++i)
        for (int d = 0; d < D; ++d) points[i][d] = scattered_numbers<typename P::value_type>(36)[i * D + d];
    const auto curve = Curve<P>::make(points, {}).value();
    for (int d = 0; d < D; ++d) {
        std::vector<typename P::value_type> numbers;
        for (const P& p : points) numbers.push_back(p[d]);
        const auto graph = curve_of<typename P::value_type>(numbers, Ends::Natural);
        const auto by_table = core::sample_by_table(curve, 7);
        const auto by_differences = core::sample_by_differences(curve, 7);
        const auto table_of_one = core::sample_by_table(graph, 7);
        const auto differences_of_one = core::sample_by_differences(graph, 7);
        ASSERT_EQ(by_table.size(), table_of_one.size());
        for (std::size_t j = 0; j < by_table.size(); ++j) {
            EXPECT_EQ(by_table[j][d], table_of_one[j]);
            EXPECT_EQ(by_differences[j][d], differences_of_one[j]);
        }
    }
}

TEST(Samples, OfPointsAreTheSamplesOfEachCoordinate) {
    expect_coordinates_by_themselves<glm::vec2, 2>();
    expect_coordinates_by_themselves<glm::vec3, 3>();
    expect_coordinates_by_themselves<glm::dvec2, 2>();
    expect_coordinates_by_themselves<glm::dvec3, 3>();
}

TEST(DifferenceRows, HaveNoOverflowAtTheMostSamples) {
    const std::int64_t s = core::kMaxSamplesPerInterval;
    const auto rows = core::detail::difference_rows<Rational>(s);
    const Rational h(1, s);
    EXPECT_EQ(rows[1][2], h / 2 + h * h / 2 - h * h * h / 2);
    for (int r = 0; r < 4; ++r) {
        Rational sum;
        for (const Rational& w : rows[r]) sum += w;
        EXPECT_EQ(sum, r == 0 ? 1 : 0) << "order " << r;
    }
}

}  // namespace
}  // namespace loopcheck::tests
