// The validated control mesh: what every implementation in this project subdivides.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/ids.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// A triangle mesh with sharpness tags that is known to be well formed.
///
/// Its existence is the proof: finite coordinates, three different vertices in every face, every edge of one
/// or two faces that run along it in opposite directions, one fan of faces around every vertex, tags on
/// things that exist, at least one face.  Isolated vertices are allowed.
class TriangleMesh {
  public:
    /// Checks the data and takes it.
    ///
    /// Errors   every ErrorCode from NotATriangle to DuplicateFace, with the first offending place.
    static Result<TriangleMesh> make(MeshData data);

    std::span<const glm::dvec3> positions() const { return positions_; }
    const Topology& topology() const { return topology_; }
    Index vertex_count() const { return topology_.vertex_count; }
    Index face_count() const { return topology_.face_count(); }

    /// Sharpness per edge of `topology()`, in [0, 10]; 10 is infinite.  Boundary edges are not sharpened
    /// here.
    std::span<const float> edge_sharpness() const { return edge_sharpness_; }
    /// Sharpness per vertex, in [0, 10]; 10 is infinite.
    std::span<const float> vertex_sharpness() const { return vertex_sharpness_; }
    /// Per face: 1 for a hole.
    std::span<const std::uint8_t> holes() const { return holes_; }

    /// The same mesh with these edges of `topology()` infinitely sharp.
    TriangleMesh with_infinite_sharpness(std::span<const Index> edges) const;

    /// Largest |coordinate|: the M of the error bounds.  At least the smallest normal number.
    double largest_coordinate() const;
    /// Length of the diagonal of the bounding box of the positions.
    double diagonal() const;

  private:
    TriangleMesh() = default;

    std::vector<glm::dvec3> positions_;
    Topology topology_;
    std::vector<float> edge_sharpness_;
    std::vector<float> vertex_sharpness_;
    std::vector<std::uint8_t> holes_;
};

/// Which floating-point type positions are computed in.
enum class Precision : std::uint8_t { Float, Double };
std::string_view name(Precision precision);

/// NotFinite, with the vertex, where a coordinate is beyond half the range of `precision`, so that a sum of
/// weighted coordinates could overflow; else nothing.
std::optional<Error> check_fits(std::span<const glm::dvec3> positions, Precision precision);
std::optional<Error> check_fits(const TriangleMesh& mesh, Precision precision);

/// Sharpness at and above which an edge or vertex is sharp for ever.
inline constexpr float kInfiniteSharpness = 10;

}  // namespace loopcheck::core
