// Meshes that carry a curve: Loop's boundaries and creases are cubic B-splines.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/bspline/curve.h"
#include "core/mesh/options.h"
#include "core/mesh/refinement.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// Where in a mesh the control polygon is.
enum class CarrierKind : std::uint8_t {
    StripWithCorners,  ///< open: the boundary of a strip, corners of infinite sharpness at both ends
    StripOneFace,      ///< open: the same where each end has one face, so that edge-and-corner keeps it
    Rim,               ///< closed: the outer boundary of a band
    Crease,            ///< closed: an infinitely sharp crease inside a wider band
};
std::string_view name(CarrierKind kind);

/// The kinds for curves with these ends: Natural or Closed, else none.
std::span<const CarrierKind> carriers_for(core::Ends ends);

/// A mesh, the rules that make its polygon a curve, and the vertices of the polygon in order.
struct Carrier {
    core::TriangleMesh mesh;
    core::SchemeOptions options;
    bool closed = false;
    std::vector<core::Index> polygon;
};

/// Requires kind among carriers_for the ends of the curve.  All other vertices are copies of the polygon,
/// moved aside; they have no say.
///
/// Errors   TooLarge.
core::Result<Carrier> make_carrier(CarrierKind kind, std::span<const glm::dvec3> control_points);

/// The polygon in the level after `parent`, by ancestry: the vertex points and edge points of the polygon.
///
/// Errors   SubjectFailed where an edge point or a vertex point is missing or there twice.
core::Result<std::vector<core::Index>> refined_polygon(std::span<const core::Index> polygon, bool closed,
                                                       const core::RefinedLevel& parent,
                                                       const core::RefinedLevel& child);

}  // namespace loopcheck::compare
