// The same mesh written, placed or connected differently. Tags follow the vertices they are on.
#pragma once

#include "models/generate/mesh.h"

namespace loopcheck::models {

/// Face f starts at its vertex (f * step) mod 3: the same triangles, other first vertices.
Mesh with_rotated_faces(Mesh mesh, int step);

/// Vertex v becomes (stride v + 1) mod V; V and the stride must have no common factor.
Mesh with_renumbered_vertices(const Mesh& mesh, int stride);

/// The faces from last to first. For meshes without holes.
Mesh with_reversed_face_order(Mesh mesh);

/// A vertex of no face, put before vertex `index` of the list. For meshes without tags.
Mesh with_isolated_vertex(Mesh mesh, int index);

/// Both meshes in one, the second one moved aside. For meshes without tags.
Mesh side_by_side(Mesh first, const Mesh& second);

Mesh moved(Mesh mesh, double distance);
Mesh scaled(Mesh mesh, double factor, int decimals);

/// Vertex v scaled by 10^6, 1 or 10^-6 in turn.
Mesh with_mixed_magnitudes(Mesh mesh);

/// `count` random edge flips that keep every valence in [lowest, highest] and every edge single.
/// For closed meshes without tags.
Mesh with_random_flips(Mesh mesh, int count, int lowest, int highest);

}  // namespace loopcheck::models
