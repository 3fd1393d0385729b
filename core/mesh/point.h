// A point in space with coordinates of any scalar type.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <type_traits>
#include <vector>

namespace loopcheck::core {

/// Three coordinates and the vector operations: what GLM's vectors cannot be for a multiprecision scalar.
template <class Scalar>
struct Vec3 {
    using value_type = Scalar;
    Scalar x{}, y{}, z{};

    friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(const Scalar& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
    bool operator==(const Vec3&) const = default;
};

/// glm::vec3 and glm::dvec3 for float and double, Vec3 for every other scalar.
template <class Scalar>
using Point = std::conditional_t<std::is_floating_point_v<Scalar>, glm::vec<3, Scalar>, Vec3<Scalar>>;

template <class Scalar>
using Points = std::vector<Point<Scalar>>;

/// 2^exponent p, exact but for over- and underflow.
inline glm::dvec3 times_power_of_two(const glm::dvec3& p, int exponent) {
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
}

/// The positions in another scalar type, each coordinate rounded (or widened) once.
template <class To, class PointRange>
Points<To> convert_points(const PointRange& points) {
    Points<To> out;
    out.reserve(points.size());
    for (const auto& p : points)
        out.push_back({static_cast<To>(p.x), static_cast<To>(p.y), static_cast<To>(p.z)});
    return out;
}

}  // namespace loopcheck::core
