// Tags are added in the order of the calls, which is the order in the file.
#include "models/generate/tags.h"

#include <cstddef>

namespace loopcheck::models {

Mesh with_crease(Mesh mesh, const std::vector<int>& path, double sharpness) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        mesh.creases.push_back({path[i - 1], path[i], sharpness});
    }
    return mesh;
}

Mesh with_graded_crease(Mesh mesh, const std::vector<int>& path, const std::vector<double>& sharpness) {
    for (std::size_t i = 0; i < sharpness.size(); ++i) {
        mesh.creases.push_back({path[i], path[i + 1], sharpness[i]});
    }
    return mesh;
}

Mesh with_corner(Mesh mesh, int vertex, double sharpness) {
    mesh.corners.push_back({vertex, sharpness});
    return mesh;
}

Mesh with_hole(Mesh mesh, int face) {
    mesh.holes.push_back(face);
    return mesh;
}

Mesh with_boundary(Mesh mesh, InterpolateBoundary interpolate_boundary) {
    mesh.interpolate_boundary = interpolate_boundary;
    return mesh;
}

Mesh with_chaikin(Mesh mesh) {
    mesh.crease_method = CreaseMethod::Chaikin;
    return mesh;
}

}  // namespace loopcheck::models
