// OpenSubdiv's limit of the vertices of every level.
#pragma once

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// Position and two tangents of every vertex of the levels 0 to `levels` as Far::PrimvarRefinerReal::Limit
/// gives them, every level the last one of a refiner of its own.
///
/// Shapes   the vertex order of `opensubdiv_refine`.  The tangents are OpenSubdiv's own, its lengths
/// included;
///          at a sharp corner they lead along the first two edges of its ring.  A vertex without faces keeps
///          its position and has zero tangents.
/// Errors   those of `opensubdiv_refine`.
/// Laws     (1) level l is the same for every levels >= l.  (2) A vertex that is semi-sharp at level l has
///          there the limit of an infinitely sharp one.
core::Result<core::Limits> opensubdiv_limit(const core::TriangleMesh& mesh,
                                            const core::SchemeOptions& options, int levels,
                                            core::Precision precision);

}  // namespace loopcheck::reference
