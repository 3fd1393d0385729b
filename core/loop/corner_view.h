// A face seen from one of its corners: what decides its surface there.
#pragma once

#include "core/loop/refine.h"
#include "core/loop/sectors.h"

namespace loopcheck::core {

/// The corner of a face, and where the face is around it.
struct CornerView {
    Star star;
    Sector sector;         ///< that holds the face
    int place = 0;         ///< of the face in it: it lies between the sector's edges `place` and `place` + 1
    bool settled = false;  ///< nothing at it is semi-sharp; else the rest is not filled in

    /// True where the faces around it are those of the box spline: smooth with 6 faces, or in the sector of
    /// the face a crease with 3 or a corner with 1.
    bool is_regular() const;
};

/// The view from corner 0, 1 or 2 of a face.  Requires the whole ring of that vertex.
CornerView view_from(const SchemeLevel& level, Index face, int corner);

}  // namespace loopcheck::core
