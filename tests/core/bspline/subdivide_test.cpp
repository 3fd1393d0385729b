#include "core/bspline/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "tests/support/curves.h"
#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::curve_of;
using tests::error_of;
using tests::Observed;
using tests::value_of;
using Fractions = std::vector<Rational>;
using High = HighPrecision;

Rational at(const Curve<Rational>& curve, const Rational& t) {
    return evaluate(spline_of(curve), t);
}

Rational largest_second_difference_of(const Fractions& c, bool closed) {
    const std::size_t n = c.size(), skip = closed ? 0 : 1;
    Fractions out;
    for (std::size_t i = skip; i + skip < n; ++i)
        out.push_back(c[(i + n - 1) % n] - 2 * c[i] + c[(i + 1) % n]);
    return tests::largest_of(out);
}

TEST(SubdivideCubic, IsTheRules) {
    for (const std::size_t n : {2U, 3U, 4U, 9U}) {
        const Fractions c = tests::scattered_fractions(n, 5);
        const Fractions open = subdivide_cubic(c, false);
        ASSERT_EQ(open.size(), 2 * n - 1);
        EXPECT_EQ(open.front(), c.front());
        EXPECT_EQ(open.back(), c.back());
        for (std::size_t i = 1; i + 1 < n; ++i) EXPECT_EQ(open[2 * i], (c[i - 1] + 6 * c[i] + c[i + 1]) / 8);
        for (std::size_t i = 0; i + 1 < n; ++i) EXPECT_EQ(open[2 * i + 1], (c[i] + c[i + 1]) / 2);
        const Fractions closed = subdivide_cubic(c, true);
        ASSERT_EQ(closed.size(), 2 * n);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(closed[2 * i], (c[(i + n - 1) % n] + 6 * c[i] + c[(i + 1) % n]) / 8);
            EXPECT_EQ(closed[2 * i + 1], (c[i] + c[(i + 1) % n]) / 2);
        }
    }
}

TEST(SubdivideCubic, HasTheValuesOfTheDocumentation) {
    const auto level = subdivide_cubic(tests::report_points(), false);
    ASSERT_EQ(level.size(), 15U);
    EXPECT_EQ(level[1], glm::dvec2(-0.75, 0.9));
    EXPECT_NEAR(level[2].x, -0.6875, 4 * unit_roundoff(Precision::Double));
    EXPECT_NEAR(level[2].y, 0.8125, 4 * unit_roundoff(Precision::Double));
}

TEST(SubdivideCubic, SumsFromZeroTheNeighboursFirst) {
    const auto c = tests::scattered_points<float>(9, 4);
    const auto level = subdivide_cubic(c, false);
    for (std::size_t i = 1; i + 1 < c.size(); ++i) {
        float sum = 0;
        sum += 0.125F * c[i - 1];
        sum += 0.125F * c[i + 1];
        sum += 0.75F * c[i];
        EXPECT_EQ(level[2 * i], sum);
    }
    for (const double p : subdivide_cubic(std::vector<double>{-0.0, -0.0, -0.0}, false))
        EXPECT_FALSE(std::signbit(p));
}

TEST(SubdivideCubic, DividesTheLargestSecondDifferenceByFour) {
    for (const std::size_t n : {3U, 4U, 9U, 20U})
        for (const bool closed : {false, true}) {
            Fractions c = tests::scattered_fractions(n, n);
            for (int level = 0; level < 4; ++level) {
                const Rational before = largest_second_difference_of(c, closed);
                EXPECT_GT(before, 0);
                c = subdivide_cubic(c, closed);
                EXPECT_EQ(4 * largest_second_difference_of(c, closed), before);
            }
        }
}

// The errors of one step, in roundings of the largest |coordinate|.
template <class Scalar, class Step>
void check_step(const char* what, int roundings, Step step) {
    const Precision precision = std::same_as<Scalar, float> ? Precision::Float : Precision::Double;
    Observed use(what, "point", 1);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto c = tests::scattered_points<Scalar>(25, seed);
        const std::vector<High> exact(c.begin(), c.end());
        const auto got = step(c);
        const auto wanted = step(exact);
        const double bound = rounding_of(roundings, precision) * static_cast<double>(tests::largest_of(c));
        for (std::size_t i = 0; i < got.size(); ++i)
            use.add(tests::share_of(tests::error_of_value(got[i], wanted[i]), bound),
                    static_cast<std::int64_t>(i), static_cast<double>(got[i]),
                    static_cast<double>(wanted[i]));
    }
    use.check();
}

TEST(SubdivideCubic, IsWithinFourRoundings) {
    for (const bool closed : {false, true}) {
        const auto step = [&](const auto& c) { return subdivide_cubic(c, closed); };
        check_step<double>("Error of a cubic step over its bound", 4, step);
        check_step<float>("Error of a cubic step over its bound, float", 4, step);
    }
}

TEST(RefineAndAverage, IsWithinDegreeRoundings) {
    for (const int degree : {1, 2, 3, 8, 20})
        for (const bool closed : {false, true}) {
            const auto step = [&](const auto& c) { return refine_and_average(c, degree, closed); };
            check_step<double>("Error of averaging over its bound", degree, step);
        }
}

TEST(RefineAndAverage, HasBinomialsOverAPowerOfTwoAsWeights) {
    for (int degree = 1; degree <= 8; ++degree) {
        Fractions binomials{1};
        for (int k = 1; k <= degree + 1; ++k) binomials.push_back(binomials.back() * (degree + 2 - k) / k);
        const auto order = static_cast<std::size_t>(degree) + 1;
        for (std::size_t i = 0; i < order + 3; ++i) {
            Fractions unit(order + 3, Rational(0));
            unit[i] = 1;
            const Fractions column = refine_and_average(unit, degree, false);
            ASSERT_EQ(column.size(), 2 * unit.size() - static_cast<std::size_t>(degree));
            // Place j is at (degree - 1) / 4 + j / 2, and the weight is number 2 (place - i) + order / 2.
            for (std::size_t j = 0; j < column.size(); ++j) {
                const auto k = static_cast<int>(j) + degree - 2 * static_cast<int>(i);
                const bool reaches = k >= 0 && k <= degree + 1;
                EXPECT_EQ(column[j], reaches ? Rational(binomials[k] / (1 << degree)) : Rational(0));
            }
        }
    }
}

TEST(RefineAndAverage, IsTheCubicRulesWhereClosedOrFarFromTheEnds) {
    for (const std::size_t n : {1U, 2U, 3U, 4U, 11U}) {
        const Fractions c = tests::scattered_fractions(n, n);
        EXPECT_EQ(refine_and_average(c, 3, true), subdivide_cubic(c, true)) << n;
    }
    const Fractions c = tests::scattered_fractions(9, 2);
    const Fractions inner = refine_and_average(c, 3, false), all = subdivide_cubic(c, false);
    EXPECT_TRUE(std::equal(inner.begin(), inner.end(), all.begin() + 1, all.end() - 1));
}

TEST(RefineAndAverage, OfExtendedPointsIsTheNaturalCubic) {
    for (const std::size_t n : {2U, 3U, 4U, 11U}) {
        const auto curve = tests::curve_of_fractions(n, {3, Ends::Natural});
        const Fractions wide = refine_and_average(extended_points(curve), 3, false);
        const Fractions wanted = subdivide(curve).points();
        ASSERT_EQ(wide.size(), wanted.size() + 2);
        EXPECT_TRUE(std::equal(wanted.begin(), wanted.end(), wide.begin() + 1));
    }
}

TEST(RefineAndAverage, TakesClosedSequencesOfAnyLengthAndDegree) {
    for (int degree = 1; degree <= kMaxDegree; ++degree)
        for (std::size_t n = 1; n <= 6; ++n) {
            const Fractions constant(n, Rational(7));
            EXPECT_EQ(refine_and_average(constant, degree, true), Fractions(2 * n, Rational(7)));
        }
}

TEST(Subdivide, LeavesTheCurveAsItIs) {
    for (const CurveShape& shape : tests::shapes(1, 7)) {
        if (shape.ends == Ends::Clamped) continue;
        for (const std::size_t n : tests::sizes(shape)) {
            const auto curve = tests::curve_of_fractions(n, shape);
            const auto refined = subdivide(curve);
            EXPECT_EQ(refined.shape(), shape);
            const Rational begin = first_parameter(shape);
            const auto there = [&](const Rational& t) { return Rational(2 * (t - begin)); };
            const bool shifted = shape.ends == Ends::Closed && shape.degree % 2 == 0;
            EXPECT_EQ(refined.first(), shifted ? Rational(0) : there(curve.first()));
            EXPECT_EQ(refined.last(), shifted ? Rational(2 * curve.last()) : there(curve.last()));
            const Rational from = shifted ? begin : curve.first();
            for (const Rational& t : tests::fractions_between(from, curve.last(), 17))
                EXPECT_EQ(at(refined, there(t)), at(curve, t))
                    << name(shape.ends) << ", degree " << shape.degree << ", " << n << " points, t " << t;
        }
    }
}

// With phantoms beyond the largest a point may be rounded up to more than a curve may be made of.
TEST(Subdivide, TakesTheLargestPoints) {
    const double largest = std::numeric_limits<double>::max() * 0x1p-24;
    bool beyond = false;
    for (int degree = 3; degree <= 19; degree += 2)
        for (int pattern = 0; pattern < 1000; ++pattern) {
            const std::vector<double> points{largest, largest * std::cos(pattern),
                                             largest * std::sin(3 * pattern), largest};
            const auto refined = subdivide(curve_of(points, {degree, Ends::Natural}));
            for (const double x : refined.points()) {
                ASSERT_LE(std::abs(x), largest * (1 + degree * 0x1p-52)) << degree << " " << pattern;
                beyond = beyond || x > largest;
            }
        }
    EXPECT_TRUE(beyond);
}

TEST(Subdivide, MakesAsManyPointsAsItSays) {
    for (const CurveShape& shape : tests::shapes(1, 8)) {
        if (shape.ends == Ends::Clamped) continue;
        for (const std::size_t n : tests::sizes(shape)) {
            const std::size_t wanted = shape.ends == Ends::Natural ? 2 * n - 1
                                       : shape.ends == Ends::Closed
                                           ? 2 * n
                                           : 2 * n - static_cast<std::size_t>(shape.degree);
            EXPECT_EQ(subdivide(tests::curve_of_fractions(n, shape)).size(), wanted);
        }
    }
}

TEST(CurveLevels, HaveTheirPointsWhereTheyBelong) {
    // Points that are their own parameters stay so: the curve through them is t.
    for (const CurveShape& shape : tests::shapes(1, 7)) {
        if (shape.ends == Ends::Closed) continue;
        const std::size_t n = static_cast<std::size_t>(shape.degree) + 4;
        Fractions points;
        for (std::size_t i = 0; i < n; ++i)
            points.push_back(shape.ends == Ends::Clamped
                                 ? greville(spline_of(tests::curve_of_fractions(n, shape)), i)
                                 : Rational(static_cast<int>(i)));
        const auto levels = curve_levels(curve_of(points, shape), 4);
        ASSERT_EQ(levels.size(), 5U);
        for (const auto& level : levels)
            EXPECT_EQ(level.points, level.parameters) << name(shape.ends) << shape.degree;
    }
}

TEST(CurveLevels, OfAClosedCurveAreAStepApartFromTheirFirstParameter) {
    for (int degree = 1; degree <= 7; ++degree) {
        const CurveShape shape{degree, Ends::Closed};
        const auto levels = curve_levels(tests::curve_of_fractions(5, shape), 4);
        Rational first(0), step(1);
        Curve<Rational> curve = tests::curve_of_fractions(5, shape);
        for (std::size_t l = 0; l < levels.size(); ++l) {
            if (l > 0) {
                first += first_parameter(shape) * step;
                step /= 2;
                curve = subdivide(curve);
            }
            EXPECT_EQ(levels[l].points, curve.points());
            for (std::size_t i = 0; i < curve.size(); ++i)
                EXPECT_EQ(levels[l].parameters[i], first + static_cast<int>(i) * step);
        }
    }
}

TEST(CurveLevels, HalveEveryIntervalWhateverTheShape) {
    for (const CurveShape& shape : tests::shapes(1, 5)) {
        const auto curve = tests::curve_of_fractions(9, shape);
        const auto levels = curve_levels(curve, 3);
        EXPECT_EQ(levels.front().points, curve.points());
        const std::size_t d = static_cast<std::size_t>(shape.degree);
        std::size_t intervals = shape.ends == Ends::Closed ? 9 : shape.ends == Ends::Natural ? 8 : 9 - d;
        for (const auto& level : levels) {
            const std::size_t more = shape.ends == Ends::Closed ? 0 : shape.ends == Ends::Natural ? 1 : d;
            EXPECT_EQ(level.points.size(), intervals + more);
            EXPECT_EQ(level.parameters.size(), level.points.size());
            intervals *= 2;
        }
    }
}

// The rows as maps: what is where.
std::vector<std::map<Index, double>> rows_of(const SparseMatrix& s) {
    std::vector<std::map<Index, double>> out(s.offsets.size() - 1);
    for (std::size_t r = 0; r < out.size(); ++r)
        for (std::size_t k = s.offsets[r]; k < s.offsets[r + 1]; ++k) out[r][s.columns[k]] = s.weights[k];
    return out;
}

TEST(SubdivisionMatrix, OfFiveNaturalPointsIsTheOneOfTheDocumentation) {
    const SparseMatrix s = value_of(subdivision_matrix({3, Ends::Natural}, 5));
    const int eighths[9][5] = {{8, 0, 0, 0, 0}, {4, 4, 0, 0, 0}, {1, 6, 1, 0, 0},
                               {0, 4, 4, 0, 0}, {0, 1, 6, 1, 0}, {0, 0, 4, 4, 0},
                               {0, 0, 1, 6, 1}, {0, 0, 0, 4, 4}, {0, 0, 0, 0, 8}};
    ASSERT_EQ(s.row_count(), 9);
    EXPECT_EQ(s.column_count, 5);
    const auto rows = rows_of(s);
    for (std::size_t r = 0; r < 9; ++r) {
        std::map<Index, double> wanted;
        for (Index column = 0; column < 5; ++column)
            if (eighths[r][column] != 0) wanted[column] = eighths[r][column] / 8.0;
        EXPECT_EQ(rows[r], wanted) << r;
    }
}

TEST(SubdivisionMatrix, HasRowsThatSumToOneAndColumnsThatAscend) {
    for (const CurveShape& shape : tests::shapes(1, 8))
        for (const std::size_t n : tests::sizes(shape)) {
            const SparseMatrix s = value_of(subdivision_matrix(shape, n));
            EXPECT_LE(row_sum_error(s, 0, s.row_count(), 1), shape.ends == Ends::Clamped ? 0.5 : 0);
            EXPECT_EQ(s.column_count, static_cast<Index>(n));
            for (std::size_t r = 0; r + 1 < s.offsets.size(); ++r) {
                const auto begin = s.columns.begin() + static_cast<std::ptrdiff_t>(s.offsets[r]);
                const auto end = s.columns.begin() + static_cast<std::ptrdiff_t>(s.offsets[r + 1]);
                EXPECT_TRUE(std::is_sorted(begin, end, std::less_equal<>()));
            }
            EXPECT_TRUE(std::none_of(s.weights.begin(), s.weights.end(), [](double w) { return w == 0; }));
        }
}

TEST(SubdivisionMatrix, TimesThePointsIsTheNextLevel) {
    Observed use("Clamped: difference of S c from the next level, in roundings of sum |w c|", "row", 1);
    for (const CurveShape& shape : tests::shapes(1, 8))
        for (const std::size_t n : tests::sizes(shape)) {
            const auto curve = tests::curve_of_fractions(n, shape);
            const Fractions wanted = curve_levels(curve, 1).back().points;
            const auto rows = rows_of(value_of(subdivision_matrix(shape, n)));
            ASSERT_EQ(rows.size(), wanted.size());
            for (std::size_t r = 0; r < rows.size(); ++r) {
                Rational got(0), size(0);
                for (const auto& [column, weight] : rows[r]) {
                    const Rational term = Rational(weight) * curve.points()[static_cast<std::size_t>(column)];
                    got += term;
                    size += abs(term);
                }
                if (shape.ends != Ends::Clamped) {
                    EXPECT_EQ(got, wanted[r]) << name(shape.ends) << shape.degree << " " << r;
                    continue;
                }
                const double error = static_cast<double>(Rational(abs(got - wanted[r])));
                use.add(tests::share_of(error, rounding_of(1, Precision::Double) * static_cast<double>(size)),
                        static_cast<std::int64_t>(r));
            }
        }
    use.check();
}

TEST(SubdivisionMatrix, IsRefusedWithoutACurve) {
    EXPECT_EQ(error_of(subdivision_matrix({4, Ends::Natural}, 9)).code, ErrorCode::Unsupported);
    EXPECT_EQ(error_of(subdivision_matrix({21, Ends::Closed}, 90)).code, ErrorCode::Unsupported);
    EXPECT_EQ(error_of(subdivision_matrix({3, Ends::Clamped}, 3)).code, ErrorCode::TooFewPoints);
    EXPECT_EQ(error_of(subdivision_matrix({3, Ends::Natural}, 0)).code, ErrorCode::TooFewPoints);
}

}  // namespace
}  // namespace loopcheck::core
