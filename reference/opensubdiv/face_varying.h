// Does OpenSubdiv write every limit value of face-varying data?
#pragma once

#include <span>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/ids.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// Which of the `values` face-varying values of a level Far::PrimvarRefinerReal::LimitFaceVarying did not
/// write: `unwritten`, ascending.
struct UnwrittenValues {
    int values = 0;
    std::vector<core::Index> unwritten;
};

/// Asks OpenSubdiv for the limit of every face-varying value after `levels` uniform refinements, interpolated
/// smoothly up to seams and boundaries (FVAR_LINEAR_NONE), and reports the values it left alone.
///
/// Takes    value_indices: one triangle a face, the value at each of its corners; every index in
///          [0, value_count), every value at corners of exactly one vertex.
/// Errors   those of `opensubdiv_refine`; IndexOutOfRange and RepeatedVertex where value_indices breaks the
///          above.
core::Result<UnwrittenValues> opensubdiv_unwritten_limit_values(const core::TriangleMesh& mesh,
                                                                const core::SchemeOptions& options,
                                                                std::span<const core::Triangle> value_indices,
                                                                int value_count, int levels);

}  // namespace loopcheck::reference
