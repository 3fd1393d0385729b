// Where OpenSubdiv stops refining at a parameter of a face, and what it has there.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "compare/surface/corner_class.h"
#include "core/loop/sublevel.h"
#include "reference/opensubdiv/surface.h"

namespace loopcheck::compare {

/// A range of every coordinate.
struct Spread {
    glm::dvec3 half{0};    ///< half of largest - smallest
    glm::dvec3 middle{0};  ///< |the mean of the two|
};

/// The refined triangle whose patch holds a parameter.
struct PatchAt {
    enum class Kind : std::uint8_t {
        Regular,      ///< one quartic box spline
        Approximate,  ///< one irregular corner, at which nothing was semi-sharp one level above either
        SemiSharp,    ///< approximated where sharpness has not decayed, or has only just
        Crowded,      ///< approximated with several irregular corners, which level 1 cannot avoid
        Blurred,      ///< PatchTable as it comes: an infinitely sharp feature that is not kept sharp
    };
    Kind kind = Kind::Regular;
    int depth = 0;             ///< its level
    int turn = 1;              ///< -1 where it is turned by half a circle against the control face
    int corner = core::kNone;  ///< Approximate: which corner of it, and of the control face, is irregular
    CornerClass corner_class;  ///< of that corner
    /// Of the points around it: for Approximate those of the triangle one level above, else its own.
    Spread spread;
};

/// PatchTable as it comes: what is infinitely sharp is smoothed in the last level.
bool blurs(const reference::SurfaceSettings& settings);

/// The refinement of one face of a control mesh, as deep as it was asked for.
///
/// Method  OpenSubdiv refines a triangle while a corner of it is irregular, in any of its sectors, down to
/// the smooth level, or to the
///         sharp level where a corner is semi-sharp (PatchTable as it comes: or has an infinitely sharp
///         feature that is not a plain boundary).  The children of a triangle are found as in `LimitSurface`.
class FaceWalk {
  public:
    FaceWalk(const core::SchemeLevel& control, const core::SchemeOptions& options,
             std::span<const glm::dvec3> positions, core::Index face);
    ~FaceWalk();

    PatchAt patch_at(double u, double v, const reference::SurfaceSettings& settings);

    /// The classes of the three corners of the control face.
    const std::array<CornerClass, 3>& classes() const;

    /// Of the points around it.
    Spread spread() const;

  private:
    struct Node;
    Node& child(Node& parent, int k);

    core::SchemeOptions options_;
    std::unique_ptr<Node> root_;
};

}  // namespace loopcheck::compare
