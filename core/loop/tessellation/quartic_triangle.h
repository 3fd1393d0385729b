// A regular triangle of the limit surface as a polynomial in Bernstein form.
#pragma once

#include <array>
#include <span>

#include "core/loop/box_spline.h"
#include "core/mesh/point.h"

namespace loopcheck::core {

/// A point of a triangle: its barycentric coordinates, which sum to 1.
using Barycentric = std::array<double, 3>;

/// The corners of a triangle within another one.
using SubTriangle = std::array<Barycentric, 3>;

/// The whole triangle, and its four children in the order of `split`.
inline constexpr SubTriangle kWholeTriangle{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
inline constexpr std::array<SubTriangle, 4> kChildTriangles{
    {{{{1, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}}},
     {{{0.5, 0.5, 0}, {0, 1, 0}, {0, 0.5, 0.5}}},
     {{{0.5, 0, 0.5}, {0, 0.5, 0.5}, {0, 0, 1}}},
     {{{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}}}};

/// A quartic over a triangle, with a, b, c the barycentric coordinates:
///
///     S = sum_(i+j+k=4)  4!/(i! j! k!)  a^i b^j c^k  p_ijk.
///
/// Law  S lies in the convex hull of the p_ijk: the polynomials are positive and sum to 1.
struct QuarticTriangle {
    std::array<glm::dvec3, detail::kMonomials> points;  ///< in the order of `detail::monomials`

    /// The surface at corner 0, 1 or 2.
    const glm::dvec3& corner(int i) const;
};

/// The surface of the regular triangle with these 12 points, by the places of `patch_basis`.
QuarticTriangle quartic_triangle(std::span<const glm::dvec3, kPatchPoints> patch);

/// The same surface over a triangle within this one.
///
/// Method  de Casteljau: p_ijk is the blossom of S at i times corner 0, j times corner 1, k times corner 2.
QuarticTriangle restricted(const QuarticTriangle& quartic, const SubTriangle& corners);

}  // namespace loopcheck::core
