// Loop refinement, level by level.
#pragma once

#include <cstdint>
#include <vector>

#include "core/loop/rows.h"
#include "core/loop/rules.h"
#include "core/loop/split.h"
#include "core/mesh/refinement.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Everything that decides how a level refines, and nothing of where its vertices are.
struct SchemeLevel {
    Topology topology;
    Sharpness sharpness;
    std::vector<VertexClass> classes;
};

/// Level 0.
SchemeLevel control_level(const TriangleMesh& mesh, BoundaryRule boundary);

/// Per vertex of the next level 1 where it comes from a vertex or edge with a finite sharpness: of every
/// vertex, then of every edge.
std::vector<std::uint8_t> comes_from_finite_sharpness(const SchemeLevel& parent);

/// A level without its positions.
RefinedLevel as_refined_level(const SchemeLevel& level, std::vector<Ancestor> ancestors);

/// The way from a level to the next.
struct Step {
    Rows rows;
    std::vector<Ancestor> ancestors;
    SchemeLevel child;
};

/// One step of Loop's scheme: split every triangle into four, make the rows, let the sharpness decay.
/// Errors  TooLarge.
Result<Step> next_level(const SchemeLevel& level, const SchemeOptions& options);

/// Refines the mesh `levels` times.  The order of vertices and faces is that of `split`.
///
/// Real     float or double; float rounds the control positions first.
/// Errors   TooLarge; NotFinite, see `check_fits`.
/// Error    within the bound of core/loop/error_bound.h.
/// Laws     1. affine maps commute with refinement, up to rounding; 2. rotating the indices of a face or
/// renumbering
///          the vertices changes the order, not the surface (except that the share at a semi-sharp vertex, a
///          mean in float, is summed in ring order);
///          3. every row sums to 1.
template <class Real>
Result<Refinement> refine(const TriangleMesh& mesh, const SchemeOptions& options, int levels);

extern template Result<Refinement> refine<float>(const TriangleMesh&, const SchemeOptions&, int);
extern template Result<Refinement> refine<double>(const TriangleMesh&, const SchemeOptions&, int);

}  // namespace loopcheck::core
