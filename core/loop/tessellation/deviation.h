// How far a surface is from a triangle and from the triangles around it, where its convex hull is known.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/mesh/point.h"

namespace loopcheck::core {

/// The corners of a triangle in space.
using TrianglePoints = std::array<glm::dvec3, 3>;

/// A triangle and its unit normal; without one where it is degenerate.
struct PlacedTriangle {
    TrianglePoints corners;
    std::optional<glm::dvec3> normal;
};
PlacedTriangle placed_triangle(const TrianglePoints& corners);

/// The distance from a point to a triangle, in space.
double distance_to(const PlacedTriangle& triangle, const glm::dvec3& point);

/// How far a surface can be from a triangle: the largest over the points of its convex hull.
///
/// That is a bound since the distance to a convex set is a convex function, whose largest value over a convex
/// hull is at one of the points.
struct Deviation {
    double distance = 0;  ///< to the triangle
    double height = 0;    ///< over or under its plane; as `distance` where it is degenerate
    double aside = 0;     ///< in the plane, from the triangle to the projection
};
/// Of two surfaces together.
Deviation larger(const Deviation& a, const Deviation& b);
Deviation deviation_of(std::span<const glm::dvec3> hull, const PlacedTriangle& triangle);

/// The steepest star that `distance_to_star` works with: cos 80 degrees.
inline constexpr double kLeastCosine = 0.17364817766693036;

/// An edge of the border of a star.
struct BorderEdge {
    glm::dvec3 from, to;
};

/// A bound of the distance to the triangles that share a vertex with one whose corners they surround;
/// infinite where it has none to say.
///
///     height + aside tan(theta)
///
/// where theta < 80 degrees is the largest angle of their normals with that of the triangle, and `aside` less
/// than the distance, in its plane, from the triangle to the projected border of the star.
///
/// Proof  Let p be a projected point of the surface and q the point of the triangle nearest to it.  All
///        triangles of the star project with the same orientation, and around each corner they project to at
///        least a full turn, so the segment from q to p can be followed along the star until it meets its
///        border, which is further away than it is long.  On the way it climbs at most aside tan(theta); so
///        over p there is a point of the star at most that high, and the surface is at most `height` high.
///
/// `star` holds the triangles and `border` the edges of these at which no corner of the triangle is.
double distance_to_star(const Deviation& deviation, const PlacedTriangle& triangle,
                        std::span<const PlacedTriangle> star, std::span<const BorderEdge> border);

}  // namespace loopcheck::core
