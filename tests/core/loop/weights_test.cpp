#include "core/loop/weights.h"

#include <gtest/gtest.h>

#include "core/loop/error_bound.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::error_of_value;
using tests::Observed;

constexpr int kLastValence = 1000;  // the range of kLoopWeightUlps

// Relative error in units of roundoff.
template <class Real>
double units(Real got, const HighPrecision& exact) {
    return error_of_value(got, exact) / static_cast<double>(exact) / tests::kRoundoff<Real>;
}

TEST(LoopWeight, IsTheFractionOfThePaper) {
    EXPECT_EQ(loop_weight<Rational>(2), Rational(39, 128));
    EXPECT_EQ(loop_weight<Rational>(3), Rational(3, 16));
    EXPECT_EQ(loop_weight<Rational>(4), Rational(31, 256));
    EXPECT_EQ(loop_weight<Rational>(6), Rational(1, 16));
}

TEST(LoopWeight, IsRationalWhereTheCosineIs) {
    for (int n = 1; n <= kLastValence; ++n) EXPECT_EQ(is_rational_loop_weight(n), n <= 4 || n == 6) << n;
}

TEST(LoopWeight, IsExactForTheRegularValence) {
    EXPECT_EQ(loop_weight<double>(6), 1.0 / 16);
    EXPECT_EQ(loop_weight<float>(6), 1.0F / 16);
    EXPECT_EQ(centre_weight<double>(loop_weight<double>(6), 6), 5.0 / 8);
    EXPECT_EQ(centre_weight<float>(loop_weight<float>(6), 6), 5.0F / 8);
}

// Two roundings of the scalar, of 128 bits, a step: far below 1e-36.
TEST(LoopWeight, HighPrecisionAgreesWithTheFractions) {
    for (const int n : {2, 3, 4, 6}) {
        const Rational b = loop_weight<Rational>(n);
        const HighPrecision exact = HighPrecision(numerator(b)) / HighPrecision(denominator(b));
        EXPECT_LE(abs(loop_weight<HighPrecision>(n) - exact), HighPrecision("1e-36")) << n;
    }
}

// b(5) = (5/8 - (3/8 + (sqrt 5 - 1)/16)^2) / 5, because cos 72 degrees = (sqrt 5 - 1)/4.
TEST(LoopWeight, HighPrecisionAgreesWithTheSquareRootAtFive) {
    const HighPrecision t = HighPrecision(3) / 8 + (sqrt(HighPrecision(5)) - 1) / 16;
    const HighPrecision exact = (HighPrecision(5) / 8 - t * t) / 5;
    EXPECT_LE(abs(loop_weight<HighPrecision>(5) - exact), HighPrecision("1e-36"));
}

// The largest error of the ring and of the centre weight for n = 2, ..., 1000.
template <class Real>
void measure(Weights weights, double ring_allowed, double centre_allowed) {
    const auto what = fmt::format("{} {}", name(weights), std::is_same_v<Real, float> ? "float" : "double");
    Observed ring(what + " ring weight, units of roundoff", "n =", ring_allowed);
    Observed centre(what + " centre weight, units of roundoff", "n =", centre_allowed);
    for (int n = 2; n <= kLastValence; ++n) {
        const Real b = ring_weight<Real>(weights, n), c = centre_weight<Real>(b, n);
        const auto exact_b = ring_weight<HighPrecision>(weights, n);
        const HighPrecision exact_c = 1 - exact_b * n;
        ring.add(units(b, exact_b), n, static_cast<double>(b), static_cast<double>(exact_b));
        centre.add(units(c, exact_c), n, static_cast<double>(c), static_cast<double>(exact_c));
    }
    ring.check();
    centre.check();
}

TEST(LoopWeight, IsWithinItsStatedErrorInDouble) {
    measure<double>(Weights::Loop, kLoopWeightUlps, kLoopWeightUlps);
}

TEST(LoopWeight, IsWithinItsStatedErrorInFloat) {
    measure<float>(Weights::Loop, kLoopWeightUlps, kLoopWeightUlps);
}

// The ring weight is one division, rounded once.
TEST(WarrenWeight, IsWithinItsStatedErrorInDouble) {
    measure<double>(Weights::Warren, 1, kLoopWeightUlps);
}

TEST(WarrenWeight, IsWithinItsStatedErrorInFloat) {
    measure<float>(Weights::Warren, 1, kLoopWeightUlps);
}

TEST(WarrenWeight, IsTheFractionOfThePaper) {
    for (int n = 2; n <= kLastValence; ++n)
        EXPECT_EQ(warren_weight<Rational>(n), n == 3 ? Rational(3, 16) : Rational(3) / (8 * n)) << n;
}

// "Equal" is to 36 digits; "different" is more than the two errors together, in float already.
TEST(WarrenWeight, EqualsLoopsOnlyAtThreeAndSix) {
    double nearest = 1;
    int nearest_n = 0;
    for (int n = 2; n <= kLastValence; ++n) {
        const auto loop = loop_weight<HighPrecision>(n), warren = warren_weight<HighPrecision>(n);
        const auto difference = static_cast<double>(abs(loop - warren) / loop);
        if (n == 3 || n == 6) {
            EXPECT_LE(difference, 1e-36) << n;
            continue;
        }
        EXPECT_GT(difference, 2 * kLoopWeightUlps * tests::kRoundoff<float>) << n;
        if (difference < nearest) nearest = difference, nearest_n = n;
    }
    fmt::print("[ OBSERVED ] smallest relative difference {:.3g} at n = {}\n", nearest, nearest_n);
}

// n b + (1 - n b), summed as a row is: n + 1 roundings of 2^-127 of terms that are at most 1.
TEST(LoopWeight, SumsToOneForEveryValence) {
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        Observed error(fmt::format("{} |sum - 1|", name(weights)), "n =", 1e-36);
        for (int n = 2; n <= kLastValence; ++n) {
            const auto b = ring_weight<HighPrecision>(weights, n);
            HighPrecision sum = 0;
            for (int i = 0; i < n; ++i) sum += b;
            sum += centre_weight<HighPrecision>(b, n);
            error.add(error_of_value(1.0, sum), n);
            if (weights == Weights::Warren || is_rational_loop_weight(n)) {
                const auto exact = ring_weight<Rational>(weights, n);
                EXPECT_EQ(exact * n + centre_weight<Rational>(exact, n), 1) << n;
            }
        }
        error.check();
    }
}

TEST(UnitRoundoff, IsHalfTheDistanceFromOneToTheNextNumber) {
    EXPECT_EQ(unit_roundoff(Precision::Double), std::numeric_limits<double>::epsilon() / 2);
    EXPECT_EQ(unit_roundoff(Precision::Float), double{std::numeric_limits<float>::epsilon()} / 2);
}

}  // namespace
}  // namespace loopcheck::core
