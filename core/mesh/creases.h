// Creases where the faces of a mesh meet at an angle.
#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// A mesh with creases by angle, and how many edges it has them on.
struct CreasedMesh {
    TriangleMesh mesh;
    std::size_t edges = 0;
};

/// The mesh with its edges infinitely sharp where its faces meet at more than an angle: inner edges whose
/// dihedral angle, between the normals of the two faces, is above `angle` by more than kAngleSlack.  An edge
/// of a degenerate face has no angle and stays as it is.
///
/// Boundary edges need no tag.  What becomes of a vertex is the scheme's rule: a dart at one sharp edge, a
/// crease at two, a corner at more.
///
/// Range   any `angle`, in radians; from pi on, and where it is not a number, nothing is tagged.
/// Laws    1. sharpness is never less than before; all else is unchanged;
///         2. a larger angle tags a subset;
///         3. renumbering vertices or faces, or turning the corners of a face, tags the same edges.
CreasedMesh with_creases(const TriangleMesh& mesh, double angle);

}  // namespace loopcheck::core
