// B-spline basis functions: Cox and de Boor's recursion over any knots, and the uniform cubic in closed form.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace loopcheck::core {

/// Highest degree of a curve.
inline constexpr int kMaxDegree = 20;

/// Basis function i of the given degree,
///
///     N_i,0(t) = 1 where k_i <= t < k_(i+1), else 0
///     N_i,d(t) = (t - k_i) / (k_(i+d) - k_i) N_i,d-1(t)
///              + (k_(i+d+1) - t) / (k_(i+d+1) - k_(i+1)) N_i+1,d-1(t)
///
/// a fraction over nothing being nothing, and the last interval that is not empty closed at its right end.
///
/// Source  [deBoor72], [Cox72].  The *order* is d + 1.
///
/// Range   0 <= degree <= kMaxDegree, knots ascending, i + degree + 1 < their number.
///
/// Error   relative, at most kBasisRoundingsPerDegree * degree roundings where nothing underflows: no two
///         numbers that were rounded are subtracted.
///
/// Laws    1. not negative, and zero outside [k_i, k_(i+d+1)]; 2. where d + 1 of them overlap they sum to 1.
template <class Scalar>
Scalar basis_function(std::span<const Scalar> knots, int degree, std::size_t i, const Scalar& t) {
    std::array<Scalar, kMaxDegree + 1> value;
    for (int j = 0; j <= degree; ++j) {
        const Scalar &low = knots[i + j], &high = knots[i + j + 1];
        const bool closed = t == high && high == knots.back() && low < high;
        value[j] = Scalar((low <= t && t < high) || closed ? 1 : 0);
    }
    for (int d = 1; d <= degree; ++d)
        for (int j = 0; j <= degree - d; ++j) {
            const std::size_t k = i + static_cast<std::size_t>(j);
            Scalar sum(0);
            if (value[j] != 0) sum += (t - knots[k]) / (knots[k + d] - knots[k]) * value[j];
            if (value[j + 1] != 0)
                sum += (knots[k + d + 1] - t) / (knots[k + d + 1] - knots[k + 1]) * value[j + 1];
            value[j] = sum;
        }
    return value[0];
}
/// Two differences, a quotient, a product and a sum.
inline constexpr int kBasisRoundingsPerDegree = 5;

/// Derivative of order r of the same function,
///
///     N'_i,d(t) = d / (k_(i+d) - k_i) N_i,d-1(t) - d / (k_(i+d+1) - k_(i+1)) N_i+1,d-1(t)
///
/// and so on.  At a knot where it jumps it is that of the right side, at the last knot that of the left.
/// Zero for r > degree.
///
/// Source  [deBoor78], chapter X.
///
/// Cost    2^r basis functions.
///
/// Error   at most (5 degree + 4 r) roundings of the same sum with every term taken positive, which is at
///         most 2^r d!/(d-r)! over the product of the narrowest knot differences.
template <class Scalar>
Scalar basis_derivative(std::span<const Scalar> knots, int degree, std::size_t i, const Scalar& t, int r) {
    if (r > degree) return Scalar(0);
    if (r == 0) return basis_function(knots, degree, i, t);
    const auto half = [&](std::size_t k) {
        const Scalar width = knots[k + degree] - knots[k];
        if (width == 0) return Scalar(0);
        return Scalar(degree / width * basis_derivative(knots, degree - 1, k, t, r - 1));
    };
    return half(i) - half(i + 1);
}

/// The degree + 1 functions that the polynomials of interval s are made of, those of s - degree, ..., s, or
/// their derivatives of order r: the two recursions above, all functions at once, from N_s,0 = 1 alone.
///
/// Unlike those, t at the end of the domain belongs to the interval before it, and so do derivatives there.
///
/// Range   0 <= degree <= kMaxDegree, degree <= s, k_s < k_(s+1); t in that interval, or beyond, where the
///         polynomials go on.  Zero for r > degree.
///
/// Error   relative, at most kBasisRoundingsPerDegree * degree roundings for r = 0; else that of
///         `basis_derivative`.
template <class Scalar>
std::array<Scalar, kMaxDegree + 1> interval_basis(std::span<const Scalar> knots, int degree, std::size_t s,
                                                  const Scalar& t, int r) {
    std::array<Scalar, kMaxDegree + 1> b{};
    if (r > degree) return b;
    b[0] = 1;
    for (int d = 1; d <= degree; ++d)
        for (int j = d; j >= 0; --j) {
            // Function i of degree d, from i and i + 1 of the degree before: b[j - 1] and b[j].
            const std::size_t i = s - static_cast<std::size_t>(d - j);
            Scalar rise(0), fall(0);
            if (j > 0) rise = b[j - 1] / (knots[i + d] - knots[i]);
            if (j < d) fall = b[j] / (knots[i + d + 1] - knots[i + 1]);
            b[j] = d > degree - r ? Scalar(d * (rise - fall))
                                  : Scalar((t - knots[i]) * rise + (knots[i + d + 1] - t) * fall);
        }
    return b;
}

/// The uniform cubic, knots -2, -1, 0, 1, 2: with a = |x|,
///
///     N(x) = (4 - 6 a^2 + 3 a^3) / 6   for a < 1
///            (2 - a)^3 / 6             for 1 <= a < 2
///            0                         beyond
///
/// the first written as (1 + 3 w (1 + a w)) / 6 with w = 1 - a, where every term is positive.
///
/// Source  `basis_function` with these knots, expanded.
///
/// Error   relative, at most kCubicBasisRoundings: 2 - a is exact, 1 - a rounded once.
///
/// Laws    1. N(-x) = N(x); 2. the sum over N(x - i), i whole, is 1;
///         3. N(x) = (N(2x-2) + 4 N(2x-1) + 6 N(2x) + 4 N(2x+1) + N(2x+2)) / 8.
template <class Scalar>
Scalar cubic_basis(const Scalar& x) {
    const Scalar a = x < 0 ? Scalar(-x) : x;
    if (a >= 2) return Scalar(0);
    if (a >= 1) {
        const Scalar w = 2 - a;
        return w * w * w / 6;
    }
    const Scalar w = 1 - a;
    return (1 + 3 * w * (1 + a * w)) / 6;
}
inline constexpr int kCubicBasisRoundings = 8;

/// N'(x): the sign of -x times (4 a - 3 a^2) / 2 or (2 - a)^2 / 2.
///
/// Error   at most kCubicBasisRoundings roundings of 2/3, its largest value.
template <class Scalar>
Scalar cubic_basis_derivative(const Scalar& x) {
    const Scalar a = x < 0 ? Scalar(-x) : x;
    if (a >= 2) return Scalar(0);
    const Scalar w = 2 - a;
    const Scalar slope = a >= 1 ? Scalar(w * w / 2) : Scalar(a * (4 - 3 * a) / 2);
    return x < 0 ? slope : Scalar(-slope);
}

/// N''(x): 3 a - 2 or 2 - a, continuous and piecewise linear.
///
/// Error   at most 2 roundings of 2, its largest |value|.
template <class Scalar>
Scalar cubic_basis_second_derivative(const Scalar& x) {
    const Scalar a = x < 0 ? Scalar(-x) : x;
    if (a >= 2) return Scalar(0);
    return a >= 1 ? Scalar(2 - a) : Scalar(3 * a - 2);
}

/// The four cubics that reach the interval [i, i+1], at i + u: those of i-1, i, i+1, i+2.
///
///     w^3 / 6,   (1 + 3 w (1 + u w)) / 6,   (1 + 3 u (1 + u w)) / 6,   u^3 / 6,     w = 1 - u
///
/// Range   0 <= u <= 1.
/// Error   relative, at most kCubicBasisRoundings where u^3 does not underflow.
template <class Scalar>
std::array<Scalar, 4> cubic_weights(const Scalar& u) {
    const Scalar w = 1 - u;
    const Scalar middle = 1 + u * w;
    return {Scalar(w * w * w / 6), Scalar((1 + 3 * w * middle) / 6), Scalar((1 + 3 * u * middle) / 6),
            Scalar(u * u * u / 6)};
}

}  // namespace loopcheck::core
