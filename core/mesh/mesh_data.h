// A mesh as somebody gave it: polygons, tags and nothing checked.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/ids.h"
#include "core/mesh/options.h"

namespace loopcheck::core {

/// Sharpness of the edge between two vertices.  10 and above is infinite.
struct EdgeSharpness {
    Index a = 0;
    Index b = 0;
    float sharpness = 0;
};

/// Sharpness of a vertex.  10 and above is infinite.
struct VertexSharpness {
    Index vertex = 0;
    float sharpness = 0;
};

/// Input of `TriangleMesh::make`.  Anything may be wrong with it.
///
/// Faces are polygons, counter-clockwise: face f has face_sizes[f] corners, which follow each other in
/// face_corners.  When an edge or vertex is given a sharpness twice, the last one counts.
struct MeshData {
    std::vector<glm::dvec3> positions;
    std::vector<Index> face_sizes;
    std::vector<Index> face_corners;
    std::vector<EdgeSharpness> creases;
    std::vector<VertexSharpness> corners;
    std::vector<Index> holes;  ///< faces that belong to the topology but not to the surface

    void add_face(std::span<const Index> vertices) {
        face_sizes.push_back(static_cast<Index>(vertices.size()));
        face_corners.insert(face_corners.end(), vertices.begin(), vertices.end());
    }
};

/// True where no face size is negative and together they are the number of corners.
bool sizes_match(const MeshData& data);

/// Calls visit(f, corners) for every face f in order, corners a span.  Requires sizes_match(data).
template <class Visit>
void for_each_face(const MeshData& data, Visit visit) {
    std::span<const Index> rest = data.face_corners;
    for (std::size_t f = 0; f < data.face_sizes.size(); ++f) {
        const auto size = static_cast<std::size_t>(data.face_sizes[f]);
        visit(f, rest.first(size));
        rest = rest.subspan(size);
    }
}

/// Splits every polygon by a fan from its first corner.  Triangles are kept; a hole becomes a hole a piece.
///
/// What `TriangleMesh::make` refuses stays wrong: faces of fewer than three corners are kept, holes that name
/// no face still name none, and nothing is changed unless sizes_match(data).
///
/// `split` counts the polygons that were split.
struct Triangulated {
    MeshData data;
    std::size_t split = 0;
    std::vector<Index> polygon_of;  ///< per new face, the face it was part of
};
Triangulated triangulate(const MeshData& data);

}  // namespace loopcheck::core
