// Uniform refinement straight to level L, without the levels in between.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <tuple>

#include "core/loop/lattice/address.h"
#include "core/loop/lattice/pattern.h"
#include "core/loop/lattice/source.h"
#include "core/mesh/point.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Refines a mesh L times, with the same bits as `refine`, on any number of threads.
///
/// Every vertex of level L lies on a vertex, on an edge or inside a face of the control mesh
/// (`LatticeAddress`), and inside a face all are regular.  So three passes are enough, none of which needs
/// another's neighbours:
///
///   1. fans: a control vertex and its ring pass through all levels by themselves;
///   2. strips: an edge and the nearest row on either side, given the fans of the corners of its faces;
///   3. patches: the inside of a face, given its edges.
///
/// Topology is prepared once; positions are pushed through again and again.
class LatticeRefiner {
  public:
    static constexpr int kMostLevels = 15;

    /// Refers to the mesh, which must live as long.  Requires 0 <= level.
    /// Errors   TooLarge: a level beyond `kMostLevels`.
    static Result<LatticeRefiner> make(const TriangleMesh& mesh, const SchemeOptions& options, int level);
    static Result<LatticeRefiner> make(TriangleMesh&&, const SchemeOptions&, int) = delete;

    const LatticeOrder& order() const { return order_; }
    const Topology& topology() const { return mesh_->topology(); }

    /// The positions of level L by `order()`.
    ///
    /// Requires `control` with a point a control vertex, and `refined` with room for
    /// `order().vertex_count()`.
    /// Memory  beside the result: 2^L E points, and 4^(L - 1) a thread.
    /// Error   that of core/loop/error_bound.h.
    template <class Real>
    void refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined, int threads = 1) const;

    /// Gets the closed lattice of control face f, row by row from edge 0: (i, j) is number
    /// j (N + 1) - j (j - 1)/2 + i.  `points` is valid during the call.
    template <class Real>
    using FaceVisitor = std::function<void(Index f, std::span<const Point<Real>> points)>;
    struct FaceRange {
        Index first = 0, last = 0;  ///< without `last`
    };

    /// The same, face after face, in memory of order 4^L whatever the number of faces, beside 8 bytes an
    /// edge and 4 a vertex of the control mesh.  Several threads may visit ranges of their own.
    template <class Real>
    void refine_by_face(std::span<const Point<Real>> control, FaceRange faces,
                        const FaceVisitor<Real>& visit) const;
    template <class Real>
    void refine_by_face(std::span<const Point<Real>> control, const FaceVisitor<Real>& visit) const {
        refine_by_face<Real>(control, {0, topology().face_count()}, visit);
    }

    /// The faces of level L over `order()`, in its order.
    /// Requires `order().fits_index()`, and room for `order().face_count()`.
    void triangles(std::span<Triangle> faces, int threads = 1) const;

  private:
    template <class Real>
    friend class LatticeLimits;

    LatticeRefiner(const TriangleMesh& mesh, const SchemeOptions& options, int level);

    template <class Real>
    LatticeSource<Real> source(std::span<const Point<Real>> control) const {
        return {topology(), options_, sharpness_, std::get<SmoothWeights<Real>>(smooth_), control};
    }

    const TriangleMesh* mesh_;
    SchemeOptions options_;
    LatticeOrder order_;
    SharpnessLevels sharpness_;
    std::tuple<SmoothWeights<float>, SmoothWeights<double>> smooth_;
    LatticePattern pattern_;
};

}  // namespace loopcheck::core
