// The limit surface anywhere: position and derivatives at a parameter of a face, exact but for rounding.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/loop/limit.h"
#include "core/mesh/point.h"
#include "core/mesh/surface.h"

namespace loopcheck::core {

/// What there is to say of the derivatives at a point.
enum class Smoothness : std::uint8_t {
    Regular,       ///< first and second derivatives exist, within the face
    TangentPlane,  ///< an irregular vertex: du and dv span its tangent plane, lengths and curvature mean
                   ///< nothing
    NoPlane,       ///< an irregular vertex without a tangent plane; `NoNormal` says why
};

/// The curvature of the limit surface around a smooth interior vertex of valence n.
///
/// With lambda = 3/8 + cos(2 pi/n)/4 and mu the largest eigenvalue after 1 and lambda (of the vertex and two
/// rings, which matters at n = 3: 1/8), curvature behaves as (mu/lambda^2)^level: continuous for n = 6,
/// bounded for n = 4 and 5, unbounded for n = 3 and n >= 7. Source  [Loop87]; tested by the growth of the
/// second derivatives.
enum class Curvature : std::uint8_t { Continuous, Bounded, Unbounded };
Curvature curvature_at(int valence);
/// "continuous", "bounded", "unbounded".
std::string_view name(Curvature curvature);

/// A point of the limit surface and its derivatives as rows over the control vertices.
template <class Scalar>
struct SurfaceStencil {
    std::vector<Index> columns;  ///< ascending
    /// By `Derivative`: position sums to 1, the others to 0.  The lengths of du and dv are those of the
    /// parametrisation by (u, v); the second derivatives are zero unless `Regular`.
    std::array<std::vector<Scalar>, kDerivatives> weights;
    Smoothness smoothness = Smoothness::Regular;
    NoNormal no_normal = NoNormal::None;
    /// Bound of sum_j |w_j - exact w_j| by `Derivative`, in units of roundoff, for parameters that are
    /// multiples of 2^-52 (2^-126 for the 38-digit scalar); other parameters may be rounded to these.
    std::array<double, kDerivatives> weight_error{};
};

/// The stencil with its weights in double, for comparison with other implementations.
template <class Scalar>
SurfaceRows as_rows(const SurfaceStencil<Scalar>& stencil);

/// A point of the limit surface.
template <class Scalar>
struct SurfacePoint {
    std::array<Point<Scalar>, kDerivatives> values;  ///< by `Derivative`
    Smoothness smoothness = Smoothness::Regular;
    NoNormal no_normal = NoNormal::None;

    const Point<Scalar>& at(Derivative d) const { return values[static_cast<int>(d)]; }
};

/// Whether a face has a limit surface: nothing, or why not.  Holes have none; with `BoundaryRule::None` no
/// face at a boundary vertex has one.
std::optional<Error> no_limit_surface(const TriangleMesh& mesh, BoundaryRule boundary, Index face);

/// The limit surface of a mesh, face by face.
///
/// Method  The faces around the three corners of a face decide its surface.  They are refined, and the child
///         that holds the parameter is taken, until nothing at its corners is semi-sharp and every corner is
///         regular within the sector of the face: smooth with 6 faces, a crease with 3, a corner with 1.
///         Then the surface is `patch_basis` of 12 points; those beyond a sharp edge are made up so that
///         the rules of the crease follow from the smooth ones: x + y - z across an edge, and 2 v - e_0 and
///         2 v - e_1 at a corner.  A parameter that ends at an irregular vertex gets its limit masks.
///         Depth: log2(1/distance to the nearest irregular corner) + 1, and a level for each started unit
///         of sharpness.  Nearer than 2^-kDeepest to an irregular corner the surface is taken at the corner:
///         (5/8)^kDeepest, the largest eigenvalue there is, is below 10^-40.
///
/// What was refined is kept for the current face only, so ask face by face.
template <class Scalar>
class LimitSurface {
  public:
    static constexpr int kDeepest = 200;

    LimitSurface(const TriangleMesh& mesh, const SchemeOptions& options);
    ~LimitSurface();

    /// The rows at (u, v) of a face.  Derivatives are one-sided at sharp edges: those of this face.
    /// Errors  IndexOutOfRange, OutsideDomain, NoLimitSurface.
    Result<SurfaceStencil<Scalar>> stencil(Index face, const Scalar& u, const Scalar& v);

  private:
    struct Node;
    Node& child(Node& parent, int k);
    void enter(Index face);
    SurfaceStencil<Scalar> regular(const Node& node, const Scalar& u, const Scalar& v, int depth,
                                   int turn) const;
    SurfaceStencil<Scalar> at_corner(const Node& node, int corner);

    const TriangleMesh& mesh_;
    SchemeOptions options_;
    SchemeLevel control_;
    Index face_ = kNone;
    std::unique_ptr<Node> root_;
    std::map<Star, LimitMasks<Scalar>> corner_masks_;
};

extern template class LimitSurface<double>;
extern template class LimitSurface<HighPrecision>;

/// One point of the limit surface.  For many, use `LimitSurface`.
///
/// Scalar   double or HighPrecision.
/// Errors   IndexOutOfRange, OutsideDomain, NoLimitSurface.
/// Error    per coordinate and derivative d at most u M (weight_error[d] + (m + 1) sum_j |w_j|), with m
/// columns
///          and M the largest |coordinate|.
/// Laws     1. at a vertex it is the limit mask; 2. refining the mesh does not change it; 3. second
/// derivatives
///          are those of the first; 4. points on a shared edge agree from both faces, and derivatives along
///          it;
///          5. affine maps commute with it.
template <class Scalar>
Result<SurfacePoint<Scalar>> evaluate(const TriangleMesh& mesh, const SchemeOptions& options, Index face,
                                      const Scalar& u, const Scalar& v);

/// The point of a stencil.
template <class Scalar>
SurfacePoint<Scalar> apply(const SurfaceStencil<Scalar>& stencil, std::span<const Point<Scalar>> positions) {
    SurfacePoint<Scalar> out{{}, stencil.smoothness, stencil.no_normal};
    for (int d = 0; d < kDerivatives; ++d) {
        Scalar x(0), y(0), z(0);
        for (std::size_t j = 0; j < stencil.columns.size(); ++j) {
            const Scalar& w = stencil.weights[d][j];
            const auto& p = positions[stencil.columns[j]];
            x += w * p.x;
            y += w * p.y;
            z += w * p.z;
        }
        out.values[d] = {x, y, z};
    }
    return out;
}

}  // namespace loopcheck::core
