// The limit surface over one triangle of any level: its children, its corners, and what encloses it.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "core/loop/face_part.h"
#include "core/loop/limit.h"
#include "core/loop/tessellation/quartic_triangle.h"

namespace loopcheck::core {

/// The limit surface over a triangle: a quartic, or where a corner is not regular the faces around the
/// corners, which refine like the whole mesh.
class SurfacePiece {
  public:
    /// Over a face of a level.
    SurfacePiece(const SchemeLevel& level, std::span<const glm::dvec3> positions, Index face,
                 Creasing creasing);

    bool is_regular() const { return std::holds_alternative<QuarticTriangle>(surface_); }

    /// In the order of `split`.
    std::array<SurfacePiece, 4> children(const SchemeOptions& options) const;

    /// Adds points whose convex hull contains the surface over a triangle within this one.
    ///
    /// A quartic is split into four once, which brings its points four times as near.  Else they are all the
    /// vertices that the surface depends on: around each corner those of the faces that an infinitely sharp
    /// edge does not part from the triangle.  Those of a child are weighted means of these, no weight is
    /// negative (but under CreaseShare::Unclamped), and so the limit is in their hull.
    ///
    /// Proof  A corner of a child is the point of a corner v of the triangle or of an edge of it.  So what is
    ///        around it on this side is the point of such a v or of an edge at v.  The rule of v takes its
    ///        ring, but with two infinitely sharp edges only these, which are the last on this side, and with
    ///        more only v.  The rule of an edge at v takes its ends and the vertices beside it, which are
    ///        neighbours of v on this side; where it is infinitely sharp only its ends.
    ///
    /// Requires `within` to be the whole triangle where the piece is not regular.
    void add_hull(const SubTriangle& within, std::vector<glm::dvec3>& hull) const;

  private:
    friend class CornerLimits;
    struct Around {
        FacePart part;
        std::vector<glm::dvec3> positions;  ///< by vertex of the part
    };

    explicit SurfacePiece(const QuarticTriangle& quartic) : surface_(quartic) {}

    std::variant<QuarticTriangle, std::unique_ptr<Around>> surface_;
};

/// The limit positions of corners of pieces.  Masks that were made are kept.
class CornerLimits {
  public:
    explicit CornerLimits(const SchemeOptions& options) : options_(options) {}
    glm::dvec3 at(const SurfacePiece& piece, int corner);

  private:
    SchemeOptions options_;
    std::map<Star, LimitMasks<double>> masks_;
};

}  // namespace loopcheck::core
