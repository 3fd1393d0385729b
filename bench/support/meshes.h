// The meshes that are refined.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::bench {

/// A sphere of 20 4^size triangles whose edges were turned at random, always the same: valences 3 to 14.
const core::TriangleMesh& varied_sphere(int size);

/// Its faces, and the vertices of its level.
constexpr int sphere_faces(int size) {
    return 20 << 2 * size;
}
constexpr double sphere_vertices(int size, int level) {
    return sphere_faces(size + level) / 2 + 2;
}

}  // namespace loopcheck::bench
