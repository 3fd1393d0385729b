// What an implementation of subdivision returns: every level, with the ancestry of every vertex.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "core/mesh/ids.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// The rule of a vertex, from the sharpness at and around it ([DeRose98], section 3).
enum class VertexRule : std::uint8_t {
    Smooth,  ///< no sharp edge
    Dart,    ///< one sharp edge; refined like Smooth
    Crease,  ///< two sharp edges
    Corner,  ///< more than two sharp edges, or a sharpness of its own
};
std::string_view name(VertexRule rule);

/// Where a refined vertex comes from: the vertex point of a parent vertex or the edge point of a parent edge.
struct Ancestor {
    enum class Kind : std::uint8_t { Vertex, Edge };
    Kind kind = Kind::Vertex;
    /// Vertex: its index in the parent level.  Edge: 3 f + i for edge i of a face f of the parent level that
    /// has it (edge i joins corner i and the next).  An edge named by its faces stays one edge where two
    /// edges have the same ends.
    Index index = 0;

    bool operator==(const Ancestor&) const = default;
};

/// What a subject says of a vertex beyond its position.
struct VertexTag {
    VertexRule rule = VertexRule::Smooth;
    bool boundary = false;

    bool operator==(const VertexTag&) const = default;
};

struct RefinedLevel {
    std::vector<glm::dvec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Ancestor> ancestors;  ///< one a vertex; empty at level 0
    std::vector<VertexTag> tags;      ///< one a vertex; empty where the subject keeps none
};

/// Levels 0 (the control mesh) to L.  Every float is a double, so positions of both precisions are stored as
/// double.
struct Refinement {
    Precision precision = Precision::Double;
    std::vector<RefinedLevel> levels;
};

}  // namespace loopcheck::core
