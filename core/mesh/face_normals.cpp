#include "core/mesh/face_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace loopcheck::core {
namespace {

double largest_of(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// The vector over its largest coordinate; zero stays zero.
glm::dvec3 scaled(const glm::dvec3& v) {
    const double size = largest_of(v);
    return size > 0 ? v / size : v;
}

// The corner opposite the longest side, and among sides of one length the last of the corners in space, so
// that the order of the corners does not matter.  Sides are scaled alike: their squares do not overflow, and
// one that underflows is not the longest.
int widest_corner(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& sides) {
    const double size = std::max({largest_of(sides[0]), largest_of(sides[1]), largest_of(sides[2])});
    if (!(size > 0)) return 0;
    const auto key = [&](int i) {
        const glm::dvec3 side = sides[i] / size, corner = corners[i];
        return std::tuple(glm::dot(side, side), corner.x, corner.y, corner.z);
    };
    const std::array keys{key(0), key(1), key(2)};
    return static_cast<int>(std::max_element(keys.begin(), keys.end()) - keys.begin());
}

}  // namespace

// Its error, with |side| = 1.  Each side is off by 2 u, and the products of the cross product by 2/sqrt(3) u:
// together less than 5.2 u beside a length of `sine`.  The unit vectors of x and y are at most
// 2 |x - y| / (|x| + |y|) apart, which is less than 7 u / sine: either sine > 10.2 u, or the length above
// 8 u that is asked for is enough.  The last rounding of the cross product, the length and the division add
// less than 5 u.
std::optional<glm::dvec3> unit_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    // The largest angle also has the largest sine: there the cross product is most accurate.
    const std::array sides{c - b, a - c, b - a};
    const int widest = widest_corner({a, b, c}, sides);
    const glm::dvec3 one = scaled(sides[next_corner(widest)]), other = scaled(sides[previous_corner(widest)]);
    const glm::dvec3 normal = glm::cross(one, other);
    const double length = glm::length(normal);
    constexpr double kRoundings = 8;
    if (!(length > kRoundings * unit_roundoff(Precision::Double) * glm::length(one) * glm::length(other)))
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
