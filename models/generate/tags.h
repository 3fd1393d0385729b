// The vocabulary of tags: each function returns the mesh with one more of them.
#pragma once

#include <vector>

#include "models/generate/mesh.h"

namespace loopcheck::models {

/// Every edge of the path v0 v1 v2 ... with one sharpness.
Mesh with_crease(Mesh mesh, const std::vector<int>& path, double sharpness);

/// Edge i of the path with sharpness i.
Mesh with_graded_crease(Mesh mesh, const std::vector<int>& path, const std::vector<double>& sharpness);

Mesh with_corner(Mesh mesh, int vertex, double sharpness);
Mesh with_hole(Mesh mesh, int face);
Mesh with_boundary(Mesh mesh, InterpolateBoundary interpolate_boundary);
Mesh with_chaikin(Mesh mesh);

}  // namespace loopcheck::models
