// One triangle of a level with what decides its surface.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "core/loop/box_spline.h"
#include "core/loop/corner_view.h"
#include "core/loop/sublevel.h"

namespace loopcheck::core {

/// A point of a regular patch: a sum of vertices of the part, most often one.
struct PatchPoint {
    std::array<std::pair<Index, int>, 3> terms{};
    int count = 0;

    PatchPoint() = default;
    explicit PatchPoint(Index v) : terms{{{v, 1}}}, count(1) {}
    /// x + y - z, which continues the surface linearly beyond the edge (x, y).
    static PatchPoint across(Index x, Index y, Index z);
    /// 2 v - e.
    static PatchPoint opposite(Index v, Index e);
    /// Sum of |coefficient|.
    int magnitude() const { return count == 1 ? 1 : 3; }
};

/// The 12 points of a regular triangle, by the places of `patch_basis`.
using Patch = std::array<PatchPoint, kPatchPoints>;

/// The faces around the corners of a face, which refine like the whole level.
struct FacePart {
    SubLevel part;
    Index face = 0;  ///< as a number of the part
    std::array<CornerView, 3> views;
    std::optional<Patch> patch;  ///< where all corners are regular

    const Triangle& corners() const { return part.level.topology.triangles[face]; }
};

/// The part around a face of a level.
FacePart face_part(const SchemeLevel& level, Index face, Creasing creasing);

}  // namespace loopcheck::core
