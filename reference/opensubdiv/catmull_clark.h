// OpenSubdiv's Far refinement of the Catmull-Clark scheme on quads, with its limits, as one function.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/mesh_data.h"
#include "core/mesh/surface.h"

namespace loopcheck::reference {

using Quad = std::array<core::Index, 4>;

/// Where a refined vertex comes from, as vertices of the level before: one vertex, the two of an edge, or the
/// four of a face, in its order.
struct QuadAncestor {
    std::uint8_t count = 0;
    Quad vertices{core::kNone, core::kNone, core::kNone, core::kNone};

    bool operator==(const QuadAncestor&) const = default;
};

/// One level, in OpenSubdiv's own order.
struct CatmullClarkLevel {
    std::vector<glm::dvec3> positions;
    std::vector<Quad> faces;
    std::vector<QuadAncestor> ancestors;  ///< one a vertex; empty at level 0
    core::LimitLevel limit;               ///< Limit() of every vertex; the tangents as long as it makes them
};

/// Levels 0 (the control mesh) to L.
struct CatmullClark {
    core::Precision precision = core::Precision::Double;
    std::vector<CatmullClarkLevel> levels;
};

/// Refines with Far::TopologyRefiner, Sdc::SCHEME_CATMARK and Far::PrimvarRefinerReal in the given precision;
/// ancestry from OpenSubdiv's maps of children, limits as `opensubdiv_limit`.
///
/// Takes    quads without tags, and vertices without faces; what is manifold OpenSubdiv decides.
///
/// Errors   EmptyMesh; IndexOutOfRange, RepeatedVertex (with the face); NotFinite (with the vertex: NaN, or
///          beyond half the range of the precision); Unsupported (a face that is no quad, creases, corners or
///          holes, more than 32 767 faces at a vertex, levels below 0 or above kOpensubdivMaxLevels);
///          SubjectFailed (with OpenSubdiv's own message).
core::Result<CatmullClark> opensubdiv_catmull_clark(const core::MeshData& data, core::BoundaryRule boundary,
                                                    int levels, core::Precision precision);

}  // namespace loopcheck::reference
