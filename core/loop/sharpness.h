// Sharpness of edges and vertices, and how it decays from level to level.
#pragma once

#include <array>
#include <vector>

#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Sharpness per edge and per vertex of one level, after the boundary option has been applied.  In [0, 10];
/// 10 is infinite.  Stored and decayed in float, in OpenSubdiv's order of operations: never templated, so
/// that every scalar type refines by the same rules.
struct Sharpness {
    std::vector<float> edge;
    std::vector<float> vertex;
};

inline bool is_sharp(float s) {
    return s > 0;
}
inline bool is_infinite(float s) {
    return s >= kInfiniteSharpness;
}
inline bool is_semi_sharp(float s) {
    return is_sharp(s) && !is_infinite(s);
}

/// The mesh's own tags, with boundary edges made infinitely sharp and, under `EdgeAndCorner`, also the
/// boundary vertices of exactly one face.  Isolated vertices are infinitely sharp: they stay where they are.
Sharpness control_sharpness(const TriangleMesh& mesh, BoundaryRule boundary);

/// Uniform decay of one level: s - 1 where s > 1, else 0; infinite stays infinite.
float uniform_decay(float s);

/// Chaikin decay of an edge at one of its ends.
///
///     s' = max(0, 3/4 s + 1/4 (mean sharpness of the other semi-sharp edges at that end) - 1)
///
/// An edge that is the only semi-sharp one there decays uniformly.
/// Source  [DeRose98], section 3, as OpenSubdiv has it.
/// Sum and count are those of all semi-sharp edges at that end, s included.
float chaikin_decay(float s, float semi_sharp_sum, int semi_sharp_count);

/// Sharpness of the child half of each edge, at the end it leads to: [e][i] belongs to the half towards end
/// i.
std::vector<std::array<float, 2>> half_edge_sharpness(const Topology& topology, const Sharpness& sharpness,
                                                      Creasing creasing);

}  // namespace loopcheck::core
