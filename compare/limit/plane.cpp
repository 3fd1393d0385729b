#include "compare/limit/plane.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace loopcheck::compare {
namespace {

using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A tangent divided by a power of two, so that no product of two overflows or underflows, and its error
// alike.
struct Scaled {
    DoubleDouble3 tangent;
    double length = 0, error = 0;
};

bool is_finite(const DoubleDouble3& t) {
    return std::isfinite(t[0].high) && std::isfinite(t[1].high) && std::isfinite(t[2].high);
}

Scaled scaled(const DoubleDouble3& t, const dvec3& error) {
    const double largest = std::max({std::abs(t[0].high), std::abs(t[1].high), std::abs(t[2].high)});
    const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
    Scaled out;
    dvec3 high, rest;
    for (int i = 0; i < 3; ++i) {
        out.tangent[i] = {std::scalbn(t[i].high, exponent), std::scalbn(t[i].low, exponent)};
        high[i] = out.tangent[i].high;
        rest[i] = std::scalbn(error[i], exponent);
    }
    out.length = glm::length(high);
    out.error = glm::length(rest);
    return out;
}

DoubleDouble minor_of(const DoubleDouble& a, const DoubleDouble& b, const DoubleDouble& c,
                      const DoubleDouble& d) {
    DoubleDouble out;
    add_product(out, a, d);
    add_product(out, {-b.high, -b.low}, c);
    return out;
}

}  // namespace

Plane plane_of(const DoubleDouble3& t1, const DoubleDouble3& t2, const dvec3& e1, const dvec3& e2) {
    if (!is_finite(t1) || !is_finite(t2)) return {dvec3(0), kInfinity};
    const Scaled a = scaled(t1, e1), b = scaled(t2, e2);
    dvec3 cross;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross[i] = minor_of(a.tangent[j], a.tangent[k], b.tangent[j], b.tangent[k]).high;
    }
    const double largest = std::max({std::abs(cross.x), std::abs(cross.y), std::abs(cross.z)});
    if (largest == 0) return {dvec3(0), kInfinity};
    const dvec3 direction = cross / largest;
    const double length = glm::length(direction);
    const double off = a.error * b.length + b.error * a.length + a.error * b.error;
    const double sine = off / (largest * length);
    return {direction / length, sine < 1 ? std::asin(sine) + kAngleSlack : kInfinity};
}

Plane plane_of(const dvec3& t1, const dvec3& t2) {
    const auto widened = [](const dvec3& t) { return DoubleDouble3{{{t.x, 0}, {t.y, 0}, {t.z, 0}}}; };
    return plane_of(widened(t1), widened(t2), dvec3(0), dvec3(0));
}

double angle_between(const Plane& a, const Plane& b) {
    if (!a.exists() || !b.exists()) return kInfinity;
    return std::atan2(glm::length(glm::cross(a.normal, b.normal)), std::abs(glm::dot(a.normal, b.normal)));
}

}  // namespace loopcheck::compare
