// Which faces an adaptive step subdivides.
#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/loop/adaptive/level.h"

namespace loopcheck::core {

/// A decision about a level: for every face 1 where it is subdividable, else 0.  Any function will do: one of
/// those below, flatness, the size on a screen, or flags of a user's own.
using Criterion = std::function<std::vector<std::uint8_t>(const AdaptiveLevel&)>;

/// The faces that a face's normal is compared with.
enum class Neighbours : std::uint8_t {
    Edge,             ///< across its three edges
    Vertex,           ///< all that share a vertex with it
    FirstVertexRing,  ///< all around its first vertex: depends on which of its vertices is stored first
};
/// "edge", "vertex", "first-vertex-ring".
std::string_view name(Neighbours neighbours);
std::optional<Neighbours> parse_neighbours(std::string_view text);

/// Per face the largest angle between its normal and those of its neighbours, in [0, pi]; 0 where there is no
/// angle: no neighbour, or degenerate faces, which have no normal.
std::vector<double> largest_normal_angles(const Topology& topology, std::span<const glm::dvec3> positions,
                                          Neighbours neighbours);

/// The lab report's rule: a face is subdividable where its largest normal angle is at most `threshold`, in
/// radians, within kAngleSlack.  What is sharp stays as it is.  No face where the threshold is negative.
///
/// Laws  1. pi: every face, so uniform refinement;
///       2. with `Edge` and `Vertex` it depends neither on the numbering nor on where a face starts.
Criterion where_smooth(double threshold, Neighbours neighbours);

/// The usual meaning of adaptive: a face is subdividable where `where_smooth` says that it is not.
Criterion where_bent(double threshold, Neighbours neighbours);

/// The descendants of the listed faces of the control mesh.  Numbers of no face name nothing.
Criterion where_listed(std::vector<Index> control_faces);

/// pi/3, the report's threshold.
inline constexpr double kReportAngle = std::numbers::pi / 3;

}  // namespace loopcheck::core
