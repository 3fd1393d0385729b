// What a point of a curve can be.
#pragma once

#include <cmath>
#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/mesh/high_precision.h"
#include "core/mesh/point.h"

namespace loopcheck::core {

namespace detail {
template <class P>
struct ScalarTrait {
    using type = typename P::value_type;
};
template <std::floating_point P>
struct ScalarTrait<P> {
    using type = P;
};
template <>
struct ScalarTrait<HighPrecision> {
    using type = HighPrecision;
};
template <>
struct ScalarTrait<Rational> {
    using type = Rational;
};
}  // namespace detail

/// The type of its coordinates, of the parameters and of the weights.
template <class P>
using ScalarOf = typename detail::ScalarTrait<P>::type;

/// A point of a curve: glm::vec2, vec3, dvec2 or dvec3, Point<HighPrecision>, or a number by itself. Whatever
/// can be added and weighted will do: the subdivision matrix is what rows of a matrix are subdivided into.
template <class P>
concept CurvePoint = std::copyable<P> && requires(const P& p, const ScalarOf<P>& s) {
    { p + p } -> std::convertible_to<P>;
    { p - p } -> std::convertible_to<P>;
    { s* p } -> std::convertible_to<P>;
};

/// The largest |coordinate|; NaN where one is.
template <std::floating_point Real>
Real magnitude(Real p) {
    return std::abs(p);
}
template <std::floating_point Real, int D>
Real magnitude(const glm::vec<D, Real>& p) {
    Real largest = 0;
    for (int i = 0; i < D && !std::isnan(largest); ++i)
        if (!(std::abs(p[i]) <= largest)) largest = std::abs(p[i]);
    return largest;
}

/// The largest |coordinate| of all points, 0 of none; NaN where one is.
template <class P>
ScalarOf<P> largest_coordinate(const std::vector<P>& points) {
    ScalarOf<P> largest = 0;
    for (const P& p : points)
        if (const auto size = magnitude(p); !(size <= largest) && !std::isnan(largest)) largest = size;
    return largest;
}

/// Euclidean length, without overflow on the way.
///
/// Error   at most kNormRoundings: three coordinates are scaled, squared, added, and scaled back.
inline constexpr int kNormRoundings = 5;
template <std::floating_point Real>
Real norm(Real p) {
    return std::abs(p);
}
template <std::floating_point Real>
Real norm(const glm::vec<2, Real>& p) {
    return std::hypot(p.x, p.y);
}
template <std::floating_point Real>
Real norm(const glm::vec<3, Real>& p) {
    return std::hypot(p.x, p.y, p.z);
}

}  // namespace loopcheck::core
