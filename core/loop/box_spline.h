// The quartic box spline: the limit of a regular triangle as a function of the 12 points around it.
#pragma once

#include <array>

#include "core/mesh/ids.h"
#include "core/mesh/surface.h"

namespace loopcheck::core {

/// Number of points that a regular triangle depends on.
inline constexpr int kPatchPoints = 12;

/// By `Derivative`, then by place.
template <class Scalar>
using PatchBasis = std::array<std::array<Scalar, kPatchPoints>, kDerivatives>;

/// Values and derivatives of the 12 basis functions of a regular triangle, corners counter-clockwise, at
/// (u, v): a = 1 - u - v belongs to corner 0, u to corner 1, v to corner 2.
///
/// Place i is corner i; 3 + i the point across edge i, which joins corner i and the next; 6 + 2i and 7 + 2i
/// the two outer points at corner i, counter-clockwise, that is the fourth and fifth of its ring counted from
/// the next corner.  With a, b, c the barycentric coordinates of corner i, the next one and the one before:
///
///     12 corner = 6a^4 + 24a^3(b+c) + 24a^2(b^2+c^2) + 60a^2bc + 8a(b^3+c^3) + 36abc(b+c)
///                 + b^4 + c^4 + 6bc(b^2+c^2) + 12b^2c^2
///     12 across = a^4 + b^4 + 6ab(a^2+b^2) + 12a^2b^2 + 2c(a^3+b^3) + 6abc(a+b)
///     12 outer  = a^4 + 2a^3c  and  a^4 + 2a^3b
///
/// Source  the box spline with directions (1,0), (0,1), (1,1), each twice; [Stam98] tabulates it.
///
/// Error   at most kBasisRoundings units of roundoff of `patch_basis_magnitude`.
///
/// Laws    1. the values sum to 1, the derivatives to 0; 2. no value is negative; 3. the values at a corner
///         are the limit mask of valence 6.
template <class Scalar>
PatchBasis<Scalar> patch_basis(const Scalar& u, const Scalar& v);

/// The same sums with every term taken positive: what rounding errors are relative to.
PatchBasis<double> patch_basis_magnitude(double u, double v);

/// A term is a product of at most 9 factors, and up to 60 of them are summed and divided by 12.
inline constexpr int kBasisRoundings = 70;

namespace detail {

/// The monomials a^i b^j c^k of degree 4.
struct Monomial {
    int a, b, c;
};
inline constexpr int kMonomials = 15;
constexpr int monomial_index(int a, int b) {
    const int less_a = 4 - a;  // a = 4 first, then by b from high to low
    return less_a * (less_a + 1) / 2 + less_a - b;
}
constexpr std::array<Monomial, kMonomials> monomials() {
    std::array<Monomial, kMonomials> out{};
    for (int a = 4; a >= 0; --a)
        for (int b = 4 - a; b >= 0; --b) out[monomial_index(a, b)] = {a, b, 4 - a - b};
    return out;
}

/// 12 times the coefficient of each monomial in each basis function.
using PatchTable = std::array<std::array<int, kMonomials>, kPatchPoints>;
constexpr PatchTable patch_table() {
    struct Term {
        int coefficient;
        int a, b, c;
    };
    constexpr std::array corner{Term{6, 4, 0, 0},  Term{24, 3, 1, 0}, Term{24, 3, 0, 1}, Term{24, 2, 2, 0},
                                Term{24, 2, 0, 2}, Term{60, 2, 1, 1}, Term{8, 1, 3, 0},  Term{8, 1, 0, 3},
                                Term{36, 1, 2, 1}, Term{36, 1, 1, 2}, Term{1, 0, 4, 0},  Term{1, 0, 0, 4},
                                Term{6, 0, 3, 1},  Term{6, 0, 1, 3},  Term{12, 0, 2, 2}};
    constexpr std::array across{Term{1, 4, 0, 0}, Term{1, 0, 4, 0},  Term{6, 3, 1, 0},
                                Term{6, 1, 3, 0}, Term{12, 2, 2, 0}, Term{2, 3, 0, 1},
                                Term{2, 0, 3, 1}, Term{6, 2, 1, 1},  Term{6, 1, 2, 1}};
    constexpr std::array fourth{Term{1, 4, 0, 0}, Term{2, 3, 0, 1}};
    constexpr std::array fifth{Term{1, 4, 0, 0}, Term{2, 3, 1, 0}};
    PatchTable out{};
    for (int i = 0; i < 3; ++i) {
        const auto add = [&](int place, const auto& terms) {
            for (const Term& t : terms) {
                std::array<int, 3> power{};
                power[i] = t.a;
                power[next_corner(i)] = t.b;
                power[previous_corner(i)] = t.c;
                out[place][monomial_index(power[0], power[1])] += t.coefficient;
            }
        };
        add(i, corner);
        add(3 + i, across);
        add(6 + 2 * i, fourth);
        add(7 + 2 * i, fifth);
    }
    return out;
}

/// `minus` is -1, or 1 to take every term positive.
template <class Scalar>
PatchBasis<Scalar> patch_basis(const std::array<Scalar, 3>& barycentric, int minus) {
    std::array<std::array<Scalar, 5>, 3> powers;
    for (int i = 0; i < 3; ++i) {
        powers[i][0] = Scalar(1);
        for (int p = 1; p < 5; ++p) powers[i][p] = powers[i][p - 1] * barycentric[i];
    }
    // d^x/da d^y/db d^z/dc of a monomial.
    const auto derivative = [&](const Monomial& m, int x, int y, int z) {
        const auto factor = [](int power, int times) {
            return times == 0 ? 1 : times == 1 ? power : power * (power - 1);
        };
        const int f = factor(m.a, x) * factor(m.b, y) * factor(m.c, z);
        if (f == 0) return Scalar(0);
        return Scalar(f * powers[0][m.a - x] * powers[1][m.b - y] * powers[2][m.c - z]);
    };
    constexpr PatchTable table = patch_table();
    constexpr auto all = monomials();
    PatchBasis<Scalar> out{};
    for (int j = 0; j < kMonomials; ++j) {
        const auto d = [&](int x, int y, int z) { return derivative(all[j], x, y, z); };
        const Scalar aa = d(2, 0, 0), ab = d(1, 1, 0), ac = d(1, 0, 1);
        const std::array<Scalar, kDerivatives> values{d(0, 0, 0),
                                                      Scalar(d(0, 1, 0) + minus * d(1, 0, 0)),
                                                      Scalar(d(0, 0, 1) + minus * d(1, 0, 0)),
                                                      Scalar(d(0, 2, 0) + minus * 2 * ab + aa),
                                                      Scalar(d(0, 1, 1) + minus * ab + minus * ac + aa),
                                                      Scalar(d(0, 0, 2) + minus * 2 * ac + aa)};
        for (int place = 0; place < kPatchPoints; ++place)
            if (table[place][j] != 0)
                for (int k = 0; k < kDerivatives; ++k) out[k][place] += table[place][j] * values[k];
    }
    for (auto& row : out)
        for (Scalar& value : row) value /= 12;
    return out;
}

}  // namespace detail

template <class Scalar>
PatchBasis<Scalar> patch_basis(const Scalar& u, const Scalar& v) {
    return detail::patch_basis<Scalar>({Scalar(1 - u - v), u, v}, -1);
}

inline PatchBasis<double> patch_basis_magnitude(double u, double v) {
    return detail::patch_basis<double>({1 - u - v, u, v}, 1);
}

}  // namespace loopcheck::core
