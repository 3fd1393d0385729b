// Small flat meshes for demonstrations.
#pragma once

#include "core/mesh/mesh_data.h"

namespace loopcheck::compare {

/// n faces around vertex 0, closed; the ring 1, ..., n on the unit circle, counter-clockwise.
core::MeshData flat_wheel(int n);

/// k faces around vertex 0, which is on the boundary; the ring 1, ..., k + 1 on half the unit circle.
core::MeshData flat_fan(int k);

/// n wedges of the triangular lattice around vertex 0, `rings` steps deep.
core::MeshData flat_disc(int n, int rings);

/// Of `flat_disc(6, rings)`: the vertex so many steps from vertex 0 along a straight line, backwards if
/// negative.
core::Index on_line(int step);

/// An octahedron, flattened: valence 4 everywhere.
core::MeshData flat_octahedron();

/// Two triangles glued along all edges.
core::MeshData flat_pillow();

}  // namespace loopcheck::compare
