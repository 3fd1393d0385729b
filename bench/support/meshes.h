// The meshes that are refined.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::bench {

/// A sphere of 20 4^size triangles: twelve vertices of valence 5, the others of valence 6.
const core::TriangleMesh& plain_sphere(int size);

/// The same with edges turned at random, always the same: valences 3 to 14.
const core::TriangleMesh& varied_sphere(int size);

/// Their faces, and the vertices of their level.
constexpr int sphere_faces(int size) {
    return 20 << 2 * size;
}
constexpr double sphere_vertices(int size, int level) {
    return 0.5 * sphere_faces(size + level) + 2;
}

}  // namespace loopcheck::bench
