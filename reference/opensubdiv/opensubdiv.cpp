#include "reference/opensubdiv/opensubdiv.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/version.h>

#include <vector>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using core::Index;

core::VertexRule to_rule(Sdc::Crease::Rule rule) {
    switch (rule) {
        case Sdc::Crease::RULE_DART:
            return core::VertexRule::Dart;
        case Sdc::Crease::RULE_CREASE:
            return core::VertexRule::Crease;
        case Sdc::Crease::RULE_CORNER:
            return core::VertexRule::Corner;
        default:
            return core::VertexRule::Smooth;
    }
}

// The ancestors of the vertices of the level after `parent`, from OpenSubdiv's own maps of children.
std::vector<core::Ancestor> child_ancestors(const Far::TopologyLevel& parent, int child_count) {
    std::vector<core::Ancestor> out(child_count);
    for (Index v = 0; v < parent.GetNumVertices(); ++v)
        out.at(parent.GetVertexChildVertex(v)) = {core::Ancestor::Kind::Vertex, v};
    for (Index e = 0; e < parent.GetNumEdges(); ++e) {
        const Index side = 3 * parent.GetEdgeFaces(e)[0] + parent.GetEdgeFaceLocalIndices(e)[0];
        out.at(parent.GetEdgeChildVertex(e)) = {core::Ancestor::Kind::Edge, side};
    }
    return out;
}

core::RefinedLevel take_topology(const Far::TopologyRefiner& refiner, int l) {
    const Far::TopologyLevel& level = refiner.GetLevel(l);
    core::RefinedLevel out;
    out.triangles.reserve(level.GetNumFaces());
    for (Index f = 0; f < level.GetNumFaces(); ++f) {
        const auto v = level.GetFaceVertices(f);
        out.triangles.push_back({v[0], v[1], v[2]});
    }
    if (l > 0) out.ancestors = child_ancestors(refiner.GetLevel(l - 1), level.GetNumVertices());
    out.tags.reserve(level.GetNumVertices());
    for (Index v = 0; v < level.GetNumVertices(); ++v)
        out.tags.push_back({to_rule(level.GetVertexRule(v)), level.IsVertexBoundary(v)});
    return out;
}

template <class Real>
core::Refinement refine_positions(const core::TriangleMesh& mesh, const Far::TopologyRefiner& refiner) {
    const Far::PrimvarRefinerReal<Real> primvars(refiner);
    auto values = internal::control_values<Real>(mesh.positions());
    core::Refinement out;
    for (int l = 0; l <= refiner.GetMaxLevel(); ++l) {
        if (l > 0) {
            std::vector<internal::Value<Real>> refined(refiner.GetLevel(l).GetNumVertices());
            primvars.Interpolate(l, values, refined);
            values = std::move(refined);
        }
        out.levels.push_back(take_topology(refiner, l));
        out.levels.back().positions = internal::to_positions(values);
    }
    return out;
}

}  // namespace

std::string opensubdiv_version() {
    return fmt::format("{}.{}.{}", OPENSUBDIV_VERSION_MAJOR, OPENSUBDIV_VERSION_MINOR,
                       OPENSUBDIV_VERSION_PATCH);
}

core::Result<core::Refinement> opensubdiv_refine(const core::TriangleMesh& mesh,
                                                 const core::SchemeOptions& options, int levels,
                                                 core::Precision precision) {
    if (auto error = internal::check_supported(mesh, options, levels)) return tl::unexpected(*error);
    if (auto error = core::check_fits(mesh, precision)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<core::Refinement> {
        const auto base = internal::make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        const auto refiner = internal::refined_uniformly(**base, levels);
        if (!refiner) return tl::unexpected(refiner.error());
        core::Refinement out = precision == core::Precision::Float
                                   ? refine_positions<float>(mesh, **refiner)
                                   : refine_positions<double>(mesh, **refiner);
        out.precision = precision;
        return out;
    });
}

}  // namespace loopcheck::reference
