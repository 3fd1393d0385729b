// OpenMesh's uniform Loop subdivider, as one function: a second, independent witness.
#pragma once

#include <string>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/refinement.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// LoopT reads its weights from a table of this many entries without a check.
inline constexpr int kOpenmeshMaxValence = 49;

/// LoopT sums up to kOpenmeshMaxValence neighbours, or 6 times a vertex, before it weighs: coordinates must
/// leave room.
inline constexpr int kOpenmeshHeadroom = 64;

/// Version of the OpenMesh headers this was compiled with, "9.0".
std::string openmesh_version();

/// Refines with OpenMesh::Subdivider::Uniform::LoopT in the given precision, one level at a time.  Every
/// level, with the ancestry of every vertex taken from OpenMesh's own edges; its order of faces and vertices
/// is kept.
///
/// Takes    meshes without sharpness and without isolated vertices; the boundary rule edge-only, and what
/// refines
///          alike: none, and edge-and-corner on a mesh that has no boundary vertex of exactly one face.
/// Errors   Unsupported (all else, Warren's weights, a valence above kOpenmeshMaxValence, coordinates within
///          a factor kOpenmeshHeadroom of overflow; by name), SubjectFailed.
core::Result<core::Refinement> openmesh_refine(const core::TriangleMesh& mesh,
                                               const core::SchemeOptions& options, int levels,
                                               core::Precision precision);

}  // namespace loopcheck::reference
