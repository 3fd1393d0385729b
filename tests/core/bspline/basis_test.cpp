#include "core/bspline/basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/cardinal_b_spline.hpp>
#include <random>
#include <vector>

#include "core/mesh/rounding.h"
#include "tests/support/curves.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::Observed;
using High = HighPrecision;

const double kHighRoundoff = static_cast<double>(std::numeric_limits<High>::epsilon()) / 2;

template <class Scalar>
std::vector<Scalar> widened(const std::vector<double>& values) {
    return {values.begin(), values.end()};
}

// The knots -(d+1)/2, ..., (d+1)/2: one basis function, centred at 0.
template <class Scalar>
std::vector<Scalar> centred_knots(int degree) {
    std::vector<Scalar> out;
    for (int k = 0; k <= degree + 1; ++k) out.push_back(Scalar(2 * k - (degree + 1)) / 2);
    return out;
}

template <class Scalar>
Scalar centred(int degree, const Scalar& x, int r = 0) {
    const auto knots = centred_knots<Scalar>(degree);
    return basis_derivative<Scalar>(knots, degree, 0, x, r);
}

// Ascending, not even, none more than `most` times in a row.
template <class Scalar>
std::vector<Scalar> random_knots(std::size_t count, int most, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Scalar> out{Scalar(0)};
    for (int repeats = 1; out.size() < count;) {
        const bool repeat = repeats < most && random() % 3 == 0;
        const Scalar step = Scalar(static_cast<int>(1 + random() % 7)) / 4;
        out.push_back(repeat ? out.back() : Scalar(out.back() + step));
        repeats = repeat ? repeats + 1 : 1;
    }
    return out;
}

// A polynomial as its coefficients, to differentiate by hand.
using Polynomial = std::vector<Rational>;
Polynomial differentiated(const Polynomial& p) {
    Polynomial out;
    for (std::size_t i = 1; i < p.size(); ++i) out.push_back(static_cast<int>(i) * p[i]);
    return out;
}
Polynomial product(const Polynomial& a, const Polynomial& b) {
    if (a.empty() || b.empty()) return {};
    Polynomial out(a.size() + b.size() - 1, Rational(0));
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) out[i + j] += a[i] * b[j];
    return out;
}
Polynomial sum(Polynomial a, const Polynomial& b) {
    a.resize(std::max(a.size(), b.size()), Rational(0));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
    return a;
}
Rational value_at(const Polynomial& p, const Rational& t) {
    Rational out(0);
    for (std::size_t i = p.size(); i-- > 0;) out = out * t + p[i];
    return out;
}

// Cox and de Boor's recursion with polynomials: the piece of N_i,d between knots s and s + 1.
Polynomial piece(const std::vector<Rational>& k, int d, std::size_t i, std::size_t s) {
    if (d == 0) return i == s ? Polynomial{1} : Polynomial{};
    Polynomial out;
    if (const Rational width = k[i + d] - k[i]; width != 0)
        out = product({-k[i] / width, 1 / width}, piece(k, d - 1, i, s));
    if (const Rational width = k[i + d + 1] - k[i + 1]; width != 0)
        out = sum(out, product({k[i + d + 1] / width, -1 / width}, piece(k, d - 1, i + 1, s)));
    return out;
}

TEST(BasisFunction, IsTheClosedFormOfTheUniformCubic) {
    for (int i = -80; i <= 80; ++i) {
        const Rational x(i, 32);
        EXPECT_EQ(centred(3, x), cubic_basis(x)) << x;
    }
}

template <class Scalar>
void check_both_forms(double roundoff) {
    constexpr int kRoundings = 3 * kBasisRoundingsPerDegree + kCubicBasisRoundings;
    Observed use("Difference of recursion and closed form over both bounds", "sample", 1);
    for (int i = -1100; i <= 1100; ++i) {
        const Scalar x = Scalar(i) / 512, closed = cubic_basis(x);
        const Scalar difference = centred(3, x) - closed;
        use.add(tests::share_of(
                    std::abs(static_cast<double>(difference)),
                    kRoundings * roundoff / (1 - kRoundings * roundoff) * static_cast<double>(closed)),
                i, static_cast<double>(centred(3, x)), static_cast<double>(closed));
    }
    use.check();
}

TEST(BasisFunction, IsWithinBothBoundsOfTheClosedForm) {
    check_both_forms<float>(unit_roundoff(Precision::Float));
    check_both_forms<double>(unit_roundoff(Precision::Double));
    check_both_forms<High>(kHighRoundoff);
}

TEST(BasisFunction, IsTheRecursionOfPolynomialsAndSoAreItsDerivatives) {
    for (int degree = 1; degree <= 5; ++degree) {
        const auto knots = random_knots<Rational>(static_cast<std::size_t>(2 * degree) + 4, degree + 1, 5);
        for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i)
            for (std::size_t s = 0; s + 1 < knots.size(); ++s) {
                if (knots[s] == knots[s + 1]) continue;
                Polynomial wanted = piece(knots, degree, i, s);
                for (int r = 0; r <= degree + 1; ++r) {
                    // At the left end of the interval too: the right side counts.
                    for (const Rational& u : {Rational(0), Rational(1, 3), Rational(6, 7)}) {
                        const Rational t = knots[s] + u * (knots[s + 1] - knots[s]);
                        EXPECT_EQ(basis_derivative<Rational>(knots, degree, i, t, r), value_at(wanted, t))
                            << "degree " << degree << ", function " << i << ", r " << r << ", t " << t;
                    }
                    wanted = differentiated(wanted);
                }
            }
    }
}

TEST(BasisFunction, IsNotNegativeAndZeroOutsideItsKnots) {
    for (int degree = 0; degree <= 8; ++degree) {
        const auto knots = random_knots<double>(30, degree + 1, 17);
        for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i)
            for (double t = -1; t < knots.back() + 1; t += 0.03125) {
                const double value = basis_function<double>(knots, degree, i, t);
                EXPECT_GE(value, 0);
                EXPECT_LE(value, 1 + rounding_of(kBasisRoundingsPerDegree * degree, Precision::Double));
                const bool inside = t > knots[i] && t < knots[i + degree + 1];
                const bool outside = t < knots[i] || t > knots[i + degree + 1];
                EXPECT_FALSE((inside && value == 0) || (outside && value != 0)) << degree << " " << t;
            }
    }
}

TEST(BasisFunction, SumsToOneWhereAllOverlap) {
    for (int degree = 1; degree <= 8; ++degree)
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const auto knots =
                random_knots<Rational>(static_cast<std::size_t>(2 * degree) + 5, degree + 1, seed);
            const std::size_t count = knots.size() - degree - 1;
            for (const Rational& t : tests::fractions_between(knots[degree], knots[count], 12)) {
                Rational total(0);
                for (std::size_t i = 0; i < count; ++i)
                    total += basis_function<Rational>(knots, degree, i, t);
                // The end of the domain begins the next interval: fewer functions where it is torn off.
                EXPECT_TRUE(total == 1 || t == knots[count]) << degree << " " << t;
            }
        }
}

TEST(BasisFunction, IsClosedAtTheRightEndOfItsKnots) {
    for (int degree = 0; degree <= 8; ++degree) {
        const auto order = static_cast<std::size_t>(degree) + 1;
        std::vector<double> clamped(order, 0.0);
        clamped.insert(clamped.end(), {1.0, 2.0});
        clamped.insert(clamped.end(), order, 3.0);
        const std::size_t count = clamped.size() - order;
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(basis_function<double>(clamped, degree, i, 3.0), i + 1 == count ? 1 : 0) << degree;
            EXPECT_EQ(basis_function<double>(clamped, degree, i, 0.0), i == 0 ? 1 : 0) << degree;
            EXPECT_EQ(basis_function<double>(clamped, degree, i, std::nextafter(3.0, 4.0)), 0) << degree;
        }
        // Its derivative there is that of the left side.
        EXPECT_EQ(basis_derivative<double>(clamped, degree, count - 1, 3.0, 1), degree) << degree;
    }
}

// Largest share of `roundings` that the relative error takes.
template <class Scalar>
void check_relative_error(Precision precision) {
    Observed use("Error of a basis function over its bound", "degree", 1);
    std::mt19937_64 random(3);
    for (int degree = 1; degree <= 8; ++degree) {
        const double bound = rounding_of(kBasisRoundingsPerDegree * degree, precision);
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            auto knots = random_knots<Scalar>(static_cast<std::size_t>(degree) + 6, degree, seed);
            for (Scalar& k : knots) k = k / 3;  // not dyadic, still ascending
            const std::vector<High> exact_knots(knots.begin(), knots.end());
            for (int sample = 0; sample < 40; ++sample) {
                const Scalar t =
                    knots.back() * static_cast<Scalar>(std::ldexp(static_cast<double>(random() >> 11), -53));
                for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i) {
                    const Scalar got = basis_function<Scalar>(knots, degree, i, t);
                    const High exact = basis_function<High>(exact_knots, degree, i, High(t));
                    use.add(tests::share_of(tests::error_of_value(got, exact),
                                            bound * static_cast<double>(exact)),
                            degree, static_cast<double>(got), static_cast<double>(exact));
                }
            }
        }
    }
    use.check();
}

TEST(BasisFunction, HasARelativeErrorOfFiveRoundingsADegree) {
    check_relative_error<double>(Precision::Double);
    check_relative_error<float>(Precision::Float);
}

// The terms of a derivative all taken positive, in high precision.
High absolute_derivative(const std::vector<High>& knots, int degree, std::size_t i, const High& t, int r) {
    if (r == 0) return basis_function<High>(knots, degree, i, t);
    High out(0);
    for (const std::size_t k : {i, i + 1})
        if (const High width = knots[k + degree] - knots[k]; width != 0)
            out += degree / width * absolute_derivative(knots, degree - 1, k, t, r - 1);
    return out;
}

TEST(BasisDerivative, HasTheErrorItStates) {
    Observed use("Error of a derivative over its bound", "10 degree + r", 1);
    Observed size("Terms of a derivative over 2^r d!/(d-r)! / differences", "10 degree + r",
                  1 + 100 * kHighRoundoff);
    for (int degree = 1; degree <= 6; ++degree) {
        auto knots = random_knots<double>(static_cast<std::size_t>(degree) + 6, degree, 4);
        for (double& k : knots) k /= 3;
        const auto exact_knots = widened<High>(knots);
        for (double t = 0.01; t < knots.back(); t += 0.07)
            for (std::size_t i = 0; i + degree + 1 < knots.size(); ++i)
                for (int r = 1; r <= std::min(degree, 3); ++r) {
                    const double got = basis_derivative<double>(knots, degree, i, t, r);
                    const High exact = basis_derivative<High>(exact_knots, degree, i, High(t), r);
                    const High terms = absolute_derivative(exact_knots, degree, i, High(t), r);
                    const double bound =
                        rounding_of(kBasisRoundingsPerDegree * degree + 4 * r, Precision::Double) *
                        static_cast<double>(terms);
                    use.add(tests::share_of(tests::error_of_value(got, exact), bound), 10 * degree + r, got,
                            static_cast<double>(exact));
                    // The narrowest nonempty difference of each order that the function has.
                    High most(1);
                    for (int step = 0; step < r; ++step) {
                        High narrowest(1000);
                        for (std::size_t k = i; k + degree - step <= i + degree + 1; ++k)
                            if (const High w = exact_knots[k + degree - step] - exact_knots[k]; w != 0)
                                narrowest = std::min(narrowest, w);
                        most *= 2 * High(degree - step) / narrowest;
                    }
                    size.add(static_cast<double>(High(terms / most)), 10 * degree + r);
                }
    }
    use.check();
    size.check();
}

TEST(BasisDerivative, IsThatOfTheClosedFormAndZeroBeyondTheDegree) {
    for (int i = -80; i <= 80; ++i) {
        const Rational x(i, 32);
        EXPECT_EQ(centred(3, x, 1), cubic_basis_derivative(x)) << x;
        EXPECT_EQ(centred(3, x, 2), cubic_basis_second_derivative(x)) << x;
        const Rational a = abs(x);
        const int sign = x < 0 ? -1 : 1;
        const bool jumps = a == 0 || a == 1 || a == 2;
        EXPECT_TRUE(jumps || centred(3, x, 3) == sign * (a < 1 ? 3 : a < 2 ? -1 : 0)) << x;
        EXPECT_EQ(centred(3, x, 4), 0);
    }
    // At a knot where it jumps: the right side.
    EXPECT_EQ(centred(3, Rational(-2), 3), 1);
    EXPECT_EQ(centred(3, Rational(-1), 3), -3);
    EXPECT_EQ(centred(3, Rational(0), 3), 3);
    EXPECT_EQ(centred(3, Rational(1), 3), -1);
}

TEST(CubicBasis, IsTheFormulaEvenAndSumsToOne) {
    for (int i = 0; i <= 80; ++i) {
        const Rational a(i, 32), w = 2 - a;
        const Rational wanted = a < 1   ? Rational((4 - 6 * a * a + 3 * a * a * a) / 6)
                                : a < 2 ? Rational(w * w * w / 6)
                                        : Rational(0);
        EXPECT_EQ(cubic_basis(a), wanted) << a;
        EXPECT_EQ(cubic_basis(Rational(-a)), wanted) << a;
        Rational total(0);
        for (int k = -5; k <= 5; ++k) total += cubic_basis(Rational(a - k));
        EXPECT_EQ(total, 1) << a;
    }
}

TEST(CubicBasis, IsASumOfItsHalves) {
    const int binomial[] = {1, 4, 6, 4, 1};
    for (int i = -80; i <= 80; ++i) {
        const Rational x(i, 32);
        Rational total(0);
        for (int m = -2; m <= 2; ++m) total += binomial[m + 2] * cubic_basis(Rational(2 * x - m));
        EXPECT_EQ(cubic_basis(x), total / 8) << x;
    }
}

template <class Scalar>
void check_cubic_errors(Precision precision) {
    const double bound = rounding_of(kCubicBasisRoundings, precision);
    Observed value("Relative error of the cubic over its bound", "sample", 1);
    Observed slope("Error of its derivative over its bound", "sample", 1);
    Observed bend("Error of its second derivative over its bound", "sample", 1);
    Observed weight("Relative error of a weight over its bound", "sample", 1);
    for (int i = 0; i <= 3000; ++i) {
        const Scalar x = Scalar(i) / 1234 + Scalar(1e-5);
        const High exact_x(x);
        const auto add = [&](Observed& observed, Scalar got, const High& exact, double allowed) {
            observed.add(tests::share_of(tests::error_of_value(got, exact), allowed), i,
                         static_cast<double>(got), static_cast<double>(exact));
        };
        const High exact = cubic_basis(exact_x);
        add(value, cubic_basis(x), exact, bound * static_cast<double>(exact));
        add(slope, cubic_basis_derivative(x), cubic_basis_derivative(exact_x), bound * 2 / 3);
        add(bend, cubic_basis_second_derivative(x), cubic_basis_second_derivative(exact_x),
            rounding_of(2, precision) * 2);
        const Scalar u = Scalar(i) / 3000;
        const auto weights = cubic_weights(u);
        const auto exact_weights = cubic_weights(High(u));
        for (std::size_t k = 0; k < 4; ++k)
            add(weight, weights[k], exact_weights[k], bound * static_cast<double>(exact_weights[k]));
    }
    for (const Observed* observed : {&value, &slope, &bend, &weight}) observed->check();
}

TEST(CubicBasis, HasTheErrorsItStates) {
    check_cubic_errors<double>(Precision::Double);
    check_cubic_errors<float>(Precision::Float);
}

TEST(CubicWeights, AreTheFourFunctionsThatReachAnInterval) {
    for (int i = 0; i <= 32; ++i) {
        const Rational u(i, 32);
        const auto weights = cubic_weights(u);
        Rational total(0);
        for (int k = 0; k < 4; ++k) {
            EXPECT_EQ(weights[k], cubic_basis(Rational(u - (k - 1)))) << u << " " << k;
            total += weights[k];
        }
        EXPECT_EQ(total, 1);
    }
}

// Boost's recurrence at arguments x and knots whose sums and differences need no rounding: two products, a
// sum and a quotient a degree from 2 on, every term positive.
constexpr int boost_roundings(int degree) {
    return 4 * (degree - 1);
}

template <int kDegree, class Scalar>
void compare_with_boost(const std::vector<double>& arguments, double roundoff, Observed& observed) {
    namespace bm = boost::math;
    const auto add = [&](const Scalar& ours, const Scalar& theirs, int roundings, const Scalar& size) {
        const Scalar difference = ours < theirs ? Scalar(theirs - ours) : Scalar(ours - theirs);
        observed.add(
            tests::share_of(static_cast<double>(difference),
                            roundings * roundoff / (1 - roundings * roundoff) * static_cast<double>(size)),
            kDegree, static_cast<double>(ours), static_cast<double>(theirs));
    };
    // Of the parts of a derivative: theirs are degree 1 and more, ours 4 roundings an order and more.
    const auto part = [](const Scalar& x) { return bm::cardinal_b_spline<kDegree - 1>(x); };
    const auto small_part = [](const Scalar& x) {
        return bm::cardinal_b_spline<(kDegree > 1 ? kDegree - 2 : 0)>(x);
    };
    for (const double argument : arguments) {
        const Scalar x(argument), half = Scalar(1) / 2;
        const Scalar value = centred(kDegree, x);
        add(value, bm::cardinal_b_spline<kDegree>(x),
            boost_roundings(kDegree) + kBasisRoundingsPerDegree * kDegree, value);
        if constexpr (kDegree >= 2) {
            const Scalar parts = part(x - half) + part(x + half);
            add(centred(kDegree, x, 1), bm::cardinal_b_spline_prime<kDegree>(x),
                boost_roundings(kDegree) + kBasisRoundingsPerDegree * kDegree + 4, parts);
        }
        if constexpr (kDegree >= 3) {
            const Scalar parts = small_part(x - 1) + 2 * small_part(x) + small_part(x + 1);
            add(centred(kDegree, x, 2), bm::cardinal_b_spline_double_prime<kDegree>(x),
                boost_roundings(kDegree) + kBasisRoundingsPerDegree * kDegree + 8, parts);
        }
    }
}

template <class Scalar, int... kDegrees>
void compare_all_with_boost(std::integer_sequence<int, kDegrees...>, const std::vector<double>& arguments,
                            double roundoff, Observed& observed) {
    (compare_with_boost<kDegrees + 1, Scalar>(arguments, roundoff, observed), ...);
}

TEST(BasisFunction, AgreesWithBoostMath) {
    // Multiples of 2^-40: arguments are exact in double, and any double is in high precision.
    std::vector<double> dyadic, any;
    for (int i = -900; i <= 900; ++i) {
        dyadic.push_back(std::ldexp(std::round(std::ldexp(i / 211.0, 40)), -40));
        any.push_back(i / 211.0);
    }
    for (int i = -9; i <= 9; ++i) dyadic.push_back(i / 2.0);
    Observed in_double("Difference from Boost.Math over its bound, double", "degree", 1);
    Observed in_high("Difference from Boost.Math over its bound, 38 digits", "degree", 1);
    const std::make_integer_sequence<int, 7> degrees;
    compare_all_with_boost<double>(degrees, dyadic, unit_roundoff(Precision::Double), in_double);
    compare_all_with_boost<High>(degrees, any, kHighRoundoff, in_high);
    in_double.check();
    in_high.check();
}

TEST(BasisDerivative, OfDegreeOneIsBoostMathsAwayFromKnotsAndInside) {
    for (const double x : {-0.75, -0.25, 0.25, 0.75})
        EXPECT_EQ(centred(1, x, 1), boost::math::cardinal_b_spline_prime<1>(x)) << x;
    // At knots Boost takes the mean of both sides, and beyond the support its -1 goes on: not ours.
    EXPECT_EQ(boost::math::cardinal_b_spline_prime<1>(0.0), 0);
    EXPECT_EQ(centred(1, 0.0, 1), -1);
    EXPECT_EQ(centred(1, 1.5, 1), 0);
}

}  // namespace
}  // namespace loopcheck::core
