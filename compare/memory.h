// How much memory a refinement needs, known before it is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/mesh/error.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// Size of a level, by V' = V + E, E' = 2E + 3F, F' = 4F.  In double: it may be beyond every integer type.
struct LevelSize {
    double vertices = 0, edges = 0, faces = 0;
};
LevelSize level_size(const core::TriangleMesh& mesh, int level);

/// Peak memory of writing a mesh, in bytes per vertex.  A test measures it.
inline constexpr double kWrittenBytesPerVertex = 150;

/// Peak memory of refining straight to a level and of writing it, in bytes per vertex.  A test measures it.
inline constexpr double kWrittenStraightBytesPerVertex = 240;

/// Memory of a control mesh with what refining straight to a level prepares, in bytes per face.
inline constexpr double kControlBytesPerFace = 250;

/// Peak memory of a tessellation within a tolerance, of measuring and of writing it, in bytes per triangle.
/// A test measures it.
inline constexpr double kTessellationBytesPerTriangle = 1100;

/// Memory this process may still take, in bytes: the least of what the machine has available, what its
/// control group (version 2) leaves, and the limit on its address space.
double available_memory();

/// OutOfMemory where `bytes` do not fit into `limit`: "`what` and needs about 3 GiB; 2 GiB may be used".
std::optional<core::Error> check_memory(std::string_view what, double bytes, double limit);

/// OutOfMemory, with the number needed, where `levels` levels at `bytes_per_vertex` do not fit into `limit`
/// bytes; TooLarge where they cannot be numbered.
std::optional<core::Error> check_memory(const core::TriangleMesh& mesh, int levels, double bytes_per_vertex,
                                        double limit);

}  // namespace loopcheck::compare
