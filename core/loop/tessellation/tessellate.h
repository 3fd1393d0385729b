// The limit surface as triangles that are nowhere further from it than a tolerance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// A triangle of a tessellation.
struct TessellationTriangle {
    Triangle vertices{};
    Index face = 0;  ///< the control face that it is in
    /// Of its corners: (u, v) in the face, multiples of 2^-32.
    std::array<std::array<double, 2>, 3> parameters{};
    double bound = 0;  ///< of the surface over these parameters
};

/// Triangles between points of the limit surface.
struct Tessellation {
    std::vector<glm::dvec3> positions;  ///< the control vertices that are in use come first, in their order
    std::vector<TessellationTriangle> triangles;  ///< ascending by face
    double bound = 0;                             ///< the largest of the triangles
    /// How many lattice triangles of each level are in use; one is up to three triangles.
    std::vector<std::size_t> leaves;

    int deepest_level() const { return static_cast<int>(leaves.size()) - 1; }
};

/// What is split while the tolerance is exceeded.
enum class Splitting : std::uint8_t {
    WhereNeeded,  ///< the triangles that exceed it, and those that must follow
    Everywhere,   ///< all: the result is the first level at which none exceeds it
};

/// The most triangles of which all corners can be numbered: 2^31/3.
inline constexpr std::size_t kMostTessellationTriangles = (std::size_t{1} << 31) / 3;

/// What may be spent.
struct TessellationLimits {
    int most_levels = 20;                     ///< more than 30 count as 30
    std::size_t most_triangles = 10'000'000;  ///< more than 2^31/3 count as that
};

/// The limit surface as triangles, so that no point of it is further than `tolerance` from them.
///
/// Method  Red-green-blue refinement.  Faces are split into four as in `split`, as long as the bound of a
///         triangle exceeds the tolerance.  So that no vertex is inside an edge, a triangle with split
///         neighbours is cut by `split_pattern`; it is split itself where three neighbours are, where one is
///         split twice, and where its surface is not a polynomial.
///
/// Result  Every vertex is a point of the limit surface and is there once; isolated vertices are left out.
///         Faces without a limit surface (`no_limit_surface`) have no triangles.
///
/// Bound   Over the parameters of a triangle the surface is in the convex hull of known points
///         (`SurfacePiece::add_hull`), so it is no further from the triangle than the furthest of these.
///         Where that exceeds the tolerance, `distance_to_star` bounds the distance to the triangles that
///         share a vertex with it: in a flat part nothing is split because triangles are uneven. What is
///         bounded is the distance from every point of the surface to the triangles, not the other way.
///         Rounding is not included: see Error.
///
/// Range   tolerance > 0 and finite.  About log4(d/tolerance) levels are needed, d the bound at level 0.
///
/// Error   per coordinate a vertex of level l is off by at most
///
///             E(l) = 3 (l + 1)(n + 30) u M
///
///         with n >= 6 the largest ring and M the largest |coordinate|; the bound of a triangle by at most
///         16 E(l + 3), but for slivers, whose normals rounding can turn.  For rings up to 64 that is less
///         than a fifth of any tolerance above 10^-10 M.
///
/// Errors  OutsideDomain: the tolerance; Unsupported: CreaseShare::Unclamped, whose weights may be negative;
///         NotFinite, see `check_fits`; NoLimitSurface: no face has one; TooLarge: the limits may not
///         suffice, with the worst face and its bound.
///
/// Laws    1. the triangles are manifold, with the Euler characteristic and the boundaries of the faces that
///         have a surface (but two faces glued on all edges stay so: then two edges have the same ends);
///         2. each vertex is `evaluate` at its parameters; 3. the largest distance measured is at most
///         `bound`; 4. Everywhere gives the vertices of `limits`.
///
/// `progress` is told the number of triangles after every round.
Result<Tessellation> tessellate(const TriangleMesh& mesh, const SchemeOptions& options, double tolerance,
                                const TessellationLimits& limits,
                                Splitting splitting = Splitting::WhereNeeded,
                                const std::function<void(std::size_t triangles)>& progress = {});

}  // namespace loopcheck::core
