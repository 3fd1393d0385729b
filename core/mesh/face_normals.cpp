#include "core/mesh/face_normals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/mesh/rounding.h"

namespace loopcheck::core {
namespace {

// The vector over its largest coordinate; zero stays zero.
glm::dvec3 scaled(const glm::dvec3& v) {
    const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return size > 0 ? v / size : v;
}

}  // namespace

std::optional<glm::dvec3> unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = scaled(b - a), ac = scaled(c - a);
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double length = glm::length(normal);
    constexpr double kRoundings = 8;
    if (!(length > kRoundings * unit_roundoff(Precision::Double) * glm::length(ab) * glm::length(ac)))
        return std::nullopt;
    return normal / length;
}

std::vector<std::optional<glm::dvec3>> face_normals(const Topology& topology,
                                                    std::span<const glm::dvec3> positions) {
    std::vector<std::optional<glm::dvec3>> normals;
    normals.reserve(topology.triangles.size());
    for (const auto& [a, b, c] : topology.triangles)
        normals.push_back(unit_normal(positions[a], positions[b], positions[c]));
    return normals;
}

double angle_between(const glm::dvec3& m, const glm::dvec3& n) {
    return 2 * std::atan2(glm::length(m - n), glm::length(m + n));
}

}  // namespace loopcheck::core
