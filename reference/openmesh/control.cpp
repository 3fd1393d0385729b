#include "reference/openmesh/control.h"

#include <fmt/format.h>

#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <limits>
#include <mutex>
#include <string>

#include "reference/openmesh/openmesh.h"

namespace loopcheck::reference::internal {
namespace {

using core::Index;

std::optional<std::string> why_unsupported(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           core::Precision precision) {
    const auto is_sharp = [](float s) { return s > 0; };
    const double largest = precision == core::Precision::Float ? double{std::numeric_limits<float>::max()}
                                                               : std::numeric_limits<double>::max();
    if (mesh.largest_coordinate() > largest / kOpenmeshHeadroom)
        return fmt::format(
            "OpenMesh's LoopT sums before it weighs, and overflows for a coordinate of {:.3g}.",
            mesh.largest_coordinate());
    if (options.weights != core::Weights::Loop) return "OpenMesh's LoopT has Loop's weights only.";
    if (std::any_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_sharp) ||
        std::any_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_sharp))
        return "OpenMesh's LoopT has no creases and no corners.";
    const core::Topology& t = mesh.topology();
    for (Index v = 0; v < t.vertex_count; ++v) {
        if (t.is_isolated(v))
            return fmt::format(
                "OpenMesh's LoopT loses the position of an isolated vertex, such as vertex {}.", v);
        if (!t.is_boundary_vertex(v) && t.face_count_at(v) > kOpenmeshMaxValence)
            return fmt::format("OpenMesh's LoopT reads past its weight table at valence {} (vertex {}).",
                               t.face_count_at(v), v);
        if (options.boundary == core::BoundaryRule::EdgeAndCorner && t.is_boundary_vertex(v) &&
            t.face_count_at(v) == 1)
            return fmt::format(
                "OpenMesh's LoopT has the boundary rule edge-only; edge-and-corner keeps vertex {}, which "
                "has one face.",
                v);
    }
    return std::nullopt;
}

}  // namespace

std::optional<core::Error> check_openmesh(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                          core::Precision precision) {
    if (auto why = why_unsupported(mesh, options, precision))
        return core::Error{core::ErrorCode::Unsupported, std::move(*why)};
    return core::check_fits(mesh, precision);
}

// OpenMesh's error stream is global to the process, and its first use, which sets it up, is not safe in two
// threads at once.
void silence_openmesh() {
    static std::once_flag once;
    std::call_once(once, [] { omerr().disable(); });
}

tl::unexpected<core::Error> openmesh_failed(std::string_view why) {
    return core::fail(core::ErrorCode::SubjectFailed, fmt::format("OpenMesh failed: {}", why));
}

}  // namespace loopcheck::reference::internal
