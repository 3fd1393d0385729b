#include "core/loop/tessellation/deviation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "core/mesh/face_normals.h"
#include "core/mesh/ids.h"

namespace loopcheck::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point) {
    const glm::dvec3 ab = b - a, ap = point - a;
    const double square = glm::dot(ab, ab);
    const double t = square > 0 ? std::clamp(glm::dot(ap, ab) / square, 0.0, 1.0) : 0;
    return glm::length(ap - t * ab);
}

// Whether the projection of the point is in the triangle.
bool is_over(const PlacedTriangle& triangle, const glm::dvec3& point) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& a = triangle.corners[i];
        const glm::dvec3& b = triangle.corners[next_corner(i)];
        if (!(glm::dot(glm::cross(*triangle.normal, b - a), point - a) >= 0)) return false;
    }
    return true;
}

// Coordinates in the plane of a triangle.
class Plane {
  public:
    explicit Plane(const PlacedTriangle& triangle)
        : origin_(triangle.corners[0]),
          x_(glm::normalize(triangle.corners[1] - triangle.corners[0])),
          y_(glm::cross(*triangle.normal, x_)) {}
    glm::dvec2 operator()(const glm::dvec3& point) const {
        return {glm::dot(point - origin_, x_), glm::dot(point - origin_, y_)};
    }

  private:
    glm::dvec3 origin_, x_, y_;
};

using Corners = std::array<glm::dvec2, 3>;
using Segment = std::array<glm::dvec2, 2>;

// How far apart two convex sets are along a direction; negative where they overlap.
double gap(const Corners& triangle, const Segment& segment, const glm::dvec2& direction) {
    const double length = glm::length(direction);
    if (!(length > 0)) return -kInfinity;
    double inner = -kInfinity, outer = kInfinity;
    for (const glm::dvec2& p : triangle) inner = std::max(inner, glm::dot(p, direction));
    for (const glm::dvec2& p : segment) outer = std::min(outer, glm::dot(p, direction));
    return (outer - inner) / length;
}

// The distance is the largest gap; it is found across an edge of either, or between two of their points.
double distance_between(const Corners& triangle, const Segment& segment) {
    const auto across = [](const glm::dvec2& a, const glm::dvec2& b) {
        return glm::dvec2(b.y - a.y, a.x - b.x);
    };
    const glm::dvec2 normal = across(segment[0], segment[1]);
    double largest = std::max(gap(triangle, segment, normal), gap(triangle, segment, -normal));
    for (int i = 0; i < 3; ++i) {
        largest = std::max(largest, gap(triangle, segment, across(triangle[i], triangle[next_corner(i)])));
        for (const glm::dvec2& end : segment)
            largest = std::max(largest, gap(triangle, segment, end - triangle[i]));
    }
    return std::max(largest, 0.0);
}

// The slope of the steepest; infinite where one is too steep or degenerate.
double steepest(const glm::dvec3& normal, std::span<const PlacedTriangle> star) {
    double largest = 0;
    for (const PlacedTriangle& triangle : star) {
        if (!triangle.normal) return kInfinity;
        const double cosine = glm::dot(normal, *triangle.normal);
        if (!(cosine >= kLeastCosine)) return kInfinity;
        largest = std::max(largest, glm::length(glm::cross(normal, *triangle.normal)) / cosine);
    }
    return largest;
}

}  // namespace

PlacedTriangle placed_triangle(const TrianglePoints& corners) {
    return {corners, unit_normal(corners[0], corners[1], corners[2])};
}

double distance_to(const PlacedTriangle& triangle, const glm::dvec3& point) {
    const TrianglePoints& c = triangle.corners;
    if (triangle.normal && is_over(triangle, point))
        return std::abs(glm::dot(*triangle.normal, point - c[0]));
    return std::min({distance_to_segment(c[0], c[1], point), distance_to_segment(c[1], c[2], point),
                     distance_to_segment(c[2], c[0], point)});
}

Deviation deviation_of(std::span<const glm::dvec3> hull, const PlacedTriangle& triangle) {
    Deviation out;
    for (const glm::dvec3& point : hull) {
        out.distance = std::max(out.distance, distance_to(triangle, point));
        if (!triangle.normal) continue;
        const double height = glm::dot(*triangle.normal, point - triangle.corners[0]);
        out.height = std::max(out.height, std::abs(height));
        out.aside = std::max(out.aside, distance_to(triangle, point - height * *triangle.normal));
    }
    if (!triangle.normal) out.height = out.distance;
    return out;
}

Deviation larger(const Deviation& a, const Deviation& b) {
    return {std::max(a.distance, b.distance), std::max(a.height, b.height), std::max(a.aside, b.aside)};
}

double distance_to_star(const Deviation& deviation, const PlacedTriangle& triangle,
                        std::span<const PlacedTriangle> star, std::span<const BorderEdge> border) {
    if (!triangle.normal) return kInfinity;
    const double slope = steepest(*triangle.normal, star);
    if (!(slope < kInfinity)) return kInfinity;
    const Plane plane(triangle);
    const TrianglePoints& c = triangle.corners;
    const Corners corners{plane(c[0]), plane(c[1]), plane(c[2])};
    for (const BorderEdge& edge : border)
        if (!(deviation.aside < distance_between(corners, {plane(edge.from), plane(edge.to)})))
            return kInfinity;
    return deviation.height + deviation.aside * slope;
}

}  // namespace loopcheck::core
