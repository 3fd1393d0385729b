// Small flat meshes for demonstrations.
#pragma once

#include "core/mesh/mesh_data.h"

namespace loopcheck::compare {

/// n faces around vertex 0, closed; the ring 1, ..., n on the unit circle, counter-clockwise.
core::MeshData flat_wheel(int n);

/// k faces around vertex 0, which is on the boundary; the ring 1, ..., k + 1 on half the unit circle.
core::MeshData flat_fan(int k);

/// The triangular lattice up to `radius` steps around vertex 0; the vertices of a straight line through it
/// are `on_line(radius, -radius)`, ..., `on_line(radius, radius)`.
core::MeshData flat_hexagon(int radius);
core::Index on_line(int radius, int step);

/// An octahedron, flattened: valence 4 everywhere.
core::MeshData flat_octahedron();

/// Two triangles glued along all edges.
core::MeshData flat_pillow();

}  // namespace loopcheck::compare
