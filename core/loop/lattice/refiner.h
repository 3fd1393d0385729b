// Uniform refinement straight to level L, without the levels in between.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/loop/lattice/address.h"
#include "core/loop/lattice/edge_sharpness.h"
#include "core/mesh/point.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Refines a mesh L times, with the same bits as `refine`.
///
/// Every vertex of level L lies on a vertex, on an edge or inside a face of the control mesh
/// (`LatticeAddress`), and inside a face all are regular.  So three passes are enough, none of which needs
/// another's neighbours:
///
///   1. fans: a control vertex and its ring pass through all levels by themselves;
///   2. strips: an edge and the nearest row on either side, given the fans of its ends;
///   3. patches: the inside of a face, given its edges.
///
/// Topology is prepared once; positions are pushed through again and again.  Memory beside the result: of
/// order V + E + 2^L E points, and 4^L for the one face in work.
class LatticeRefiner {
  public:
    /// Keeps what it needs of the mesh.
    /// Errors   TooLarge: level L has more than 2^31 - 1 vertices, or corners of faces.
    static Result<LatticeRefiner> make(const TriangleMesh& mesh, const SchemeOptions& options, int level);

    const LatticeOrder& order() const { return order_; }
    const Topology& topology() const { return topology_; }

    /// The positions of level L by `order()`.
    /// Requires `control` with a point a control vertex, and `refined` with room for
    /// `order().vertex_count()`. Error    that of core/loop/error_bound.h.
    template <class Real>
    void refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined) const;

    /// The same, face after face: `visit(f, points)` gets the closed lattice of control face f, row by row
    /// from edge 0: (i, j) is number j (N + 1) - j (j - 1)/2 + i.  `points` is valid during the call.
    template <class Real, class Visit>
    void refine_by_face(std::span<const Point<Real>> control, Visit&& visit) const {
        const Skeleton<Real> skeleton = refine_skeleton<Real>(control);
        Patch<Real> patch;
        for (Index f = 0; f < topology_.face_count(); ++f) {
            refine_face(skeleton, f, patch);
            visit(f, std::span<const Point<Real>>(patch.points));
        }
    }

    /// The faces of level L over `order()`, in its order.  Requires room for `order().face_count()`.
    void triangles(std::span<Triangle> faces) const;

  private:
    // The control vertices at level L, and the points on every edge at every level, ends included: those of
    // edge e at level l begin at e (2^l + 1).
    template <class Real>
    struct Skeleton {
        Points<Real> vertices;
        std::vector<Points<Real>> edges;
    };
    // The closed lattice of a face, and that of the level before.
    template <class Real>
    struct Patch {
        Points<Real> points, before;
    };

    LatticeRefiner(const TriangleMesh& mesh, const SchemeOptions& options, int level);

    template <class Real>
    Skeleton<Real> refine_skeleton(std::span<const Point<Real>> control) const;
    template <class Real>
    void refine_face(const Skeleton<Real>& skeleton, Index f, Patch<Real>& patch) const;

    Topology topology_;
    SchemeOptions options_;
    LatticeOrder order_;
    std::vector<LatticeSharpness> sharpness_;  // of levels 0 to L
};

}  // namespace loopcheck::core
