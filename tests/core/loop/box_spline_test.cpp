#include "core/loop/box_spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mesh/high_precision.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::Observed;

constexpr int kSteps = 16;

// Calls visit(u, v) for the points of a grid over the triangle, borders included.
template <class Visit>
void for_each_parameter(Visit visit) {
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j) visit(double(i) / kSteps, double(j) / kSteps);
}

TEST(PatchBasis, SumsToOneAndItsDerivativesToZeroAsFractions) {
    for_each_parameter([](double u, double v) {
        const auto basis = patch_basis<Rational>(Rational(u), Rational(v));
        for (int d = 0; d < kDerivatives; ++d) {
            Rational sum = 0;
            for (const Rational& value : basis[d]) sum += value;
            EXPECT_EQ(sum, d == 0 ? 1 : 0) << u << " " << v << " " << d;
        }
    });
}

TEST(PatchBasis, HasNoNegativeValue) {
    for_each_parameter([](double u, double v) {
        const auto basis = patch_basis(u, v);
        for (const double value : basis[0]) EXPECT_GE(value, 0) << u << " " << v;
    });
}

// The corner has 1/2, its ring of six 1/12 each; the other five points nothing.
TEST(PatchBasis, IsTheLimitMaskAtTheCorners) {
    for (int corner = 0; corner < 3; ++corner) {
        const auto basis = patch_basis<Rational>(corner == 1 ? Rational(1) : Rational(0),
                                                 corner == 2 ? Rational(1) : Rational(0));
        std::array<Rational, kPatchPoints> wanted{};
        for (const int other : {0, 1, 2}) wanted[other] = Rational(1, 12);
        wanted[corner] = Rational(1, 2);
        for (const int place : {3 + corner, 3 + previous_corner(corner), 6 + 2 * corner, 7 + 2 * corner})
            wanted[place] = Rational(1, 12);
        EXPECT_EQ(basis[0], wanted) << corner;
    }
}

// Coordinates of the 12 places in the lattice in which corners 0, 1 and 2 are (0, 0), (1, 0) and (0, 1).
constexpr std::array<std::array<int, 2>, kPatchPoints> kLattice{
    {{0, 0}, {1, 0}, {0, 1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}, {0, -1}, {2, -1}, {2, 0}, {0, 2}, {-1, 2}}};

// Places in order: linear functions are reproduced, and of the quadratic x^2 the second derivative is 2.
TEST(PatchBasis, ReproducesLinearFunctionsAndSecondDerivatives) {
    for_each_parameter([](double u, double v) {
        const auto basis = patch_basis<Rational>(Rational(u), Rational(v));
        const auto sum = [&](Derivative d, auto&& function) {
            Rational out = 0;
            for (int place = 0; place < kPatchPoints; ++place)
                out += basis[static_cast<int>(d)][place] * function(kLattice[place][0], kLattice[place][1]);
            return out;
        };
        const auto x = [](int i, int) { return i; };
        const auto y = [](int, int j) { return j; };
        EXPECT_EQ(sum(Derivative::Position, x), Rational(u));
        EXPECT_EQ(sum(Derivative::Position, y), Rational(v));
        EXPECT_EQ(sum(Derivative::Du, x), 1);
        EXPECT_EQ(sum(Derivative::Dv, x), 0);
        EXPECT_EQ(sum(Derivative::Du, y), 0);
        EXPECT_EQ(sum(Derivative::Dv, y), 1);
        EXPECT_EQ(sum(Derivative::Duu, [](int i, int) { return i * i; }), 2);
        EXPECT_EQ(sum(Derivative::Duv, [](int i, int j) { return i * j; }), 1);
        EXPECT_EQ(sum(Derivative::Dvv, [](int, int j) { return j * j; }), 2);
        EXPECT_EQ(sum(Derivative::Dvv, [](int i, int) { return i * i; }), 0);
    });
}

TEST(PatchBasis, IsWithinItsErrorInDouble) {
    Observed use("error / (kBasisRoundings u magnitude)", "derivative", 1);
    for (int i = 0; i <= 101; ++i)
        for (int j = 0; i + j <= 101; ++j) {
            const double u = i / 128.0, v = j / 128.0;  // exact, so that 1 - u - v is
            const auto exact = patch_basis<HighPrecision>(HighPrecision(u), HighPrecision(v));
            const auto got = patch_basis(u, v);
            const auto magnitude = patch_basis_magnitude(u, v);
            for (int d = 0; d < kDerivatives; ++d)
                for (int place = 0; place < kPatchPoints; ++place)
                    use.add(tests::share_of(tests::error_of_value(got[d][place], exact[d][place]),
                                            kBasisRoundings * tests::kRoundoff<double> * magnitude[d][place]),
                            d, got[d][place], static_cast<double>(exact[d][place]));
        }
    use.check();
}

}  // namespace
}  // namespace loopcheck::core
