// The last level as a mesh to write, straight from the control mesh.
#pragma once

#include <cstdint>

#include "core/mesh/error.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Whose order the vertices and faces of a level are in.
enum class LevelOrder : std::uint8_t {
    Split,    ///< that of `split`, which is OpenSubdiv's
    Lattice,  ///< that of `LatticeOrder`
};

/// Level L of a mesh, with the bits of `refine`: positions, faces, holes and what sharpness is left, but for
/// that of the boundary under this rule.  Creases are in the order of the edges of `split`, or edge by edge
/// of the control mesh; the first end is the one born last. Errors   NotFinite where coordinates are beyond
/// the precision; TooLarge.
Result<MeshData> refined_mesh(const TriangleMesh& mesh, const SchemeOptions& options, Precision precision,
                              int level, LevelOrder order);

}  // namespace loopcheck::core
