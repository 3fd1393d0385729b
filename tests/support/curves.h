// Curves for tests: points of every kind, every shape, and one coordinate as a number by itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/bspline/curve.h"
#include "core/mesh/rounding.h"

namespace loopcheck::tests {

/// A curve of eight points whose numbers the documentation quotes; z is 1/2.
inline std::vector<glm::dvec2> report_points() {
    return {{-0.8, 1.0}, {-0.7, 0.8}, {-0.5, 0.7}, {-0.5, 1.0},
            {0.0, 0.1},  {0.3, 0.6},  {0.4, 0.5},  {0.5, 1.0}};
}

/// The curve of points that fit their shape.  Throws where they do not, which fails the test.
template <class P>
core::Curve<P> curve_of(std::vector<P> points, const core::CurveShape& shape) {
    auto curve = core::Curve<P>::make(std::move(points), shape);
    if (!curve) throw std::runtime_error(core::to_string(curve.error()));
    return std::move(*curve);
}

template <class P>
inline constexpr int kDimension = P::length();
template <>
inline constexpr int kDimension<float> = 1;
template <>
inline constexpr int kDimension<double> = 1;

template <class P>
auto coordinate(const P& p, int axis) {
    if constexpr (std::floating_point<P>)
        return p;
    else
        return p[axis];
}

/// One coordinate of every point, widened without rounding.
template <class To, class P>
std::vector<To> coordinates(const std::vector<P>& points, int axis) {
    std::vector<To> out;
    for (const P& p : points) out.push_back(To(coordinate(p, axis)));
    return out;
}

template <class P>
constexpr core::Precision precision_of() {
    return std::same_as<core::ScalarOf<P>, float> ? core::Precision::Float : core::Precision::Double;
}

/// The largest |number|.
template <class Scalar>
Scalar largest_of(const std::vector<Scalar>& values) {
    Scalar largest(0);
    for (const Scalar& value : values) largest = std::max(largest, value < 0 ? Scalar(-value) : value);
    return largest;
}

/// Every shape of degrees least, ..., most.
inline std::vector<core::CurveShape> shapes(int least, int most) {
    std::vector<core::CurveShape> out;
    for (int degree = least; degree <= most; ++degree)
        for (const auto ends :
             {core::Ends::Natural, core::Ends::Closed, core::Ends::Open, core::Ends::Clamped})
            if (ends != core::Ends::Natural || degree % 2 == 1) out.push_back({degree, ends});
    return out;
}

/// Numbers of control points that the shape can have: the fewest first.
inline std::set<std::size_t> sizes(const core::CurveShape& shape) {
    const auto order = static_cast<std::size_t>(shape.degree) + 1;
    std::set<std::size_t> out;
    for (const std::size_t n : {std::size_t{2}, std::size_t{3}, std::size_t{5}, order, order + 4})
        if (!core::check_shape(shape, n)) out.insert(n);
    return out;
}

/// Points without any symmetry, some a million times as large as others.
template <class P>
std::vector<P> scattered_points(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto number = [&] {
        const double fraction = std::ldexp(static_cast<double>(random() >> 11), -53);
        const int exponent = static_cast<int>(random() % 20);
        return static_cast<core::ScalarOf<P>>(std::ldexp(2 * fraction - 1, exponent));
    };
    std::vector<P> out(count);
    for (P& p : out) {
        if constexpr (std::floating_point<P>)
            p = number();
        else
            for (int axis = 0; axis < kDimension<P>; ++axis) p[axis] = number();
    }
    return out;
}

/// Fractions with small numerators and denominators.
inline std::vector<core::Rational> scattered_fractions(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<core::Rational> out;
    while (out.size() < count)
        out.push_back(
            core::Rational(static_cast<int>(random() % 41) - 20, static_cast<int>(random() % 5) + 1));
    return out;
}

/// A curve over as many of them.
inline core::Curve<core::Rational> curve_of_fractions(std::size_t count, const core::CurveShape& shape) {
    return core::Curve<core::Rational>::make(scattered_fractions(count, count + 3), shape).value();
}

/// Parameters from `first` to `last`: the ends, whole and half numbers, the numbers next to them, and some
/// between.
template <class Scalar>
std::vector<Scalar> parameters(Scalar first, Scalar last) {
    std::vector<Scalar> out{first, last};
    for (Scalar t = std::ceil(2 * first) / 2; t <= last; t += Scalar(1) / 2)
        for (const Scalar near :
             {std::nextafter(t, first), t, std::nextafter(t, last), t + Scalar(0.3), t + Scalar(1e-4)})
            if (near >= first && near <= last) out.push_back(near);
    return out;
}
inline std::vector<core::Rational> fractions_between(const core::Rational& first, const core::Rational& last,
                                                     int steps) {
    std::vector<core::Rational> out;
    for (int i = 0; i <= steps; ++i) out.push_back(first + (last - first) * core::Rational(i, steps));
    return out;
}

}  // namespace loopcheck::tests
