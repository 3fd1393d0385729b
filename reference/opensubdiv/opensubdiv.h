// OpenSubdiv's Far refinement of the Loop scheme, as one function.
#pragma once

#include <string>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/refinement.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// Most levels OpenSubdiv refines; asked for 16 it silently does none.
inline constexpr int kOpensubdivMaxLevels = 15;

/// Version of the OpenSubdiv headers this was compiled with, "3.5.0".
std::string opensubdiv_version();

/// Refines with Far::TopologyRefiner and Far::PrimvarRefinerReal in the given precision.  Every level, with
/// the ancestry, rule and boundary tag of every vertex as OpenSubdiv itself reports them; its own order is
/// kept.
///
/// Takes    every mesh `TriangleMesh` accepts, every boundary and creasing option.
/// Errors   Unsupported (Warren's weights, more than kOpensubdivMaxLevels levels, a valence above 65 535),
///          NotFinite (a coordinate beyond float), SubjectFailed (with OpenSubdiv's own message).
core::Result<core::Refinement> opensubdiv_refine(const core::TriangleMesh& mesh,
                                                 const core::SchemeOptions& options, int levels,
                                                 core::Precision precision);

}  // namespace loopcheck::reference
