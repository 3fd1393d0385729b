// The weight of a neighbour in the rule for smooth interior vertices, as a function of the valence.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <optional>
#include <type_traits>

#include "core/mesh/high_precision.h"
#include "core/mesh/options.h"

namespace loopcheck::core {

/// Relative error of every weight of a mask at an extraordinary vertex, in units of roundoff: the c_w of the
/// error bound.  In 5/8 - t^2 the rounding of t counts 1.7 times, in all 6.4; tests observe 5.5 up to valence
/// 1000.
inline constexpr int kLoopWeightUlps = 7;

/// cos(2 pi / n) where it is rational: n = 1, 2, 3, 4 and 6.
inline std::optional<Rational> rational_cosine_of_turn(int n) {
    switch (n) {
        case 1:
            return Rational(1);
        case 2:
            return Rational(-1);
        case 3:
            return Rational(-1, 2);
        case 4:
            return Rational(0);
        case 6:
            return Rational(1, 2);
        default:
            return std::nullopt;
    }
}

/// True where Loop's weight is a fraction of integers.
inline bool is_rational_loop_weight(int n) {
    return rational_cosine_of_turn(n).has_value();
}

/// Weight of each neighbour in Loop's rule for an interior vertex of valence n.
///
///     b(n) = (5/8 - (3/8 + cos(2 pi / n)/4)^2) / n
///
/// Source  [Loop87].  Warren's simplification is `warren_weight`; the two agree only at n = 3 and n = 6.
///
/// Range   n >= 2; for `Rational` the n of `is_rational_loop_weight`.
///
/// Error   at most kLoopWeightUlps units of roundoff; exact for n = 6 and for `Rational`.
///
/// b(3) = 3/16, b(4) = 31/256 and b(6) = 1/16 exactly.  In float and double the operations and their order
/// are OpenSubdiv's (float: rounded once, from double).
template <class Scalar>
Scalar loop_weight(int n) {
    if constexpr (std::is_same_v<Scalar, Rational>) {
        const Rational t = Rational(3, 8) + rational_cosine_of_turn(n).value() / 4;
        return (Rational(5, 8) - t * t) / n;
    } else {
        using Work = std::conditional_t<std::is_same_v<Scalar, float>, double, Scalar>;
        if (n == 6) return Scalar(1) / 16;
        using std::cos;
        const Work inverse = Work(1) / n;
        const Work t = cos(boost::math::constants::two_pi<Work>() * inverse) / 4 + Work(3) / 8;
        return static_cast<Scalar>((Work(5) / 8 - t * t) * inverse);
    }
}

/// Weight of each neighbour in Warren's simplification of Loop's rule: 3/16 for n = 3, else 3/(8n).
///
/// Source  [Warren95], as many implementations have it.
/// Range   n >= 2.
/// Error   at most 1 unit of roundoff.
template <class Scalar>
Scalar warren_weight(int n) {
    return n == 3 ? Scalar(3) / 16 : Scalar(3) / (8 * n);
}

template <class Scalar>
Scalar ring_weight(Weights weights, int n) {
    return weights == Weights::Loop ? loop_weight<Scalar>(n) : warren_weight<Scalar>(n);
}

/// What is left for the vertex itself: 1 - n b.  Float: computed in double and rounded once, as OpenSubdiv
/// does.
template <class Scalar>
Scalar centre_weight(Scalar b, int n) {
    using Work = std::conditional_t<std::is_same_v<Scalar, float>, double, Scalar>;
    return static_cast<Scalar>(1 - static_cast<Work>(b) * n);
}

}  // namespace loopcheck::core
