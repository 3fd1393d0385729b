#include "reference/opensubdiv/opensubdiv.h"

#include <fmt/format.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/version.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace loopcheck::reference {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using core::Index;

// What OpenSubdiv said since the last call on this thread.  Its callbacks are global to the process, so they
// are set once and write to a buffer of the calling thread.
thread_local std::string messages;

void catch_messages() {
    static std::once_flag once;
    std::call_once(once, [] {
        Far::SetErrorCallback([](Far::ErrorType, const char* message) { messages += message; });
        Far::SetWarningCallback([](const char* message) { messages += message; });
    });
    messages.clear();
}

// The interface PrimvarRefinerReal asks of a value.
template <class Real>
struct Value {
    Real x, y, z;

    void Clear() { x = y = z = 0; }
    void AddWithWeight(const Value& other, Real weight) {
        x += weight * other.x;
        y += weight * other.y;
        z += weight * other.z;
    }
};

std::optional<core::Error> check_supported(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           int levels) {
    const auto unsupported = [](std::string sentence) {
        return core::Error{core::ErrorCode::Unsupported, std::move(sentence)};
    };
    if (options.weights != core::Weights::Loop) return unsupported("OpenSubdiv has Loop's weights only.");
    if (levels > kOpensubdivMaxLevels)
        return unsupported(fmt::format("OpenSubdiv refines {} levels at most.", kOpensubdivMaxLevels));
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (mesh.topology().ring(v).size() > static_cast<std::size_t>(Far::VALENCE_LIMIT))
            return unsupported(
                fmt::format("OpenSubdiv takes {} edges around a vertex at most; vertex {} has {}.",
                            Far::VALENCE_LIMIT, v, mesh.topology().ring(v).size()));
    return std::nullopt;
}

Sdc::Options sdc_options(const core::SchemeOptions& options) {
    Sdc::Options out;
    switch (options.boundary) {
        case core::BoundaryRule::None:
            out.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_NONE);
            break;
        case core::BoundaryRule::EdgeOnly:
            out.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
            break;
        case core::BoundaryRule::EdgeAndCorner:
            out.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
            break;
    }
    out.SetCreasingMethod(options.creasing == core::Creasing::Chaikin ? Sdc::Options::CREASE_CHAIKIN
                                                                      : Sdc::Options::CREASE_UNIFORM);
    out.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_ALL);
    return out;
}

std::unique_ptr<Far::TopologyRefiner> make_refiner(const core::TriangleMesh& mesh,
                                                   const core::SchemeOptions& options) {
    const core::Topology& t = mesh.topology();
    const std::vector<int> sizes(t.triangles.size(), 3);
    std::vector<Index> corners;
    for (const auto& triangle : t.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());

    std::vector<Index> crease_ends, corner_vertices, holes;
    std::vector<float> crease_sharpness, corner_sharpness;
    for (Index e = 0; e < t.edge_count(); ++e)
        if (mesh.edge_sharpness()[e] > 0) {
            crease_ends.insert(crease_ends.end(), t.edge_ends[e].begin(), t.edge_ends[e].end());
            crease_sharpness.push_back(mesh.edge_sharpness()[e]);
        }
    for (Index v = 0; v < t.vertex_count; ++v)
        if (mesh.vertex_sharpness()[v] > 0) {
            corner_vertices.push_back(v);
            corner_sharpness.push_back(mesh.vertex_sharpness()[v]);
        }
    for (Index f = 0; f < t.face_count(); ++f)
        if (mesh.holes()[f]) holes.push_back(f);

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = t.vertex_count;
    descriptor.numFaces = t.face_count();
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    descriptor.numCreases = static_cast<int>(crease_sharpness.size());
    descriptor.creaseVertexIndexPairs = crease_ends.data();
    descriptor.creaseWeights = crease_sharpness.data();
    descriptor.numCorners = static_cast<int>(corner_vertices.size());
    descriptor.cornerVertexIndices = corner_vertices.data();
    descriptor.cornerWeights = corner_sharpness.data();
    descriptor.numHoles = static_cast<int>(holes.size());
    descriptor.holeIndices = holes.data();

    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Factory::Options factory_options(Sdc::SCHEME_LOOP, sdc_options(options));
    factory_options.validateFullTopology = true;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(descriptor, factory_options));
}

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
    std::vector<Value<Real>> values;
    for (const auto& p : mesh.positions())
        values.push_back({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)});

    core::Refinement out;
    for (int l = 0; l <= refiner.GetMaxLevel(); ++l) {
        if (l > 0) {
            std::vector<Value<Real>> refined(refiner.GetLevel(l).GetNumVertices());
            primvars.Interpolate(l, values, refined);
            values = std::move(refined);
        }
        out.levels.push_back(take_topology(refiner, l));
        out.levels.back().positions.reserve(values.size());
        for (const auto& v : values) out.levels.back().positions.emplace_back(v.x, v.y, v.z);
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
    if (auto error = check_supported(mesh, options, levels)) return tl::unexpected(*error);
    if (auto error = core::check_fits(mesh, precision)) return tl::unexpected(*error);
    const auto failed = [](std::string_view why) {
        return core::fail(core::ErrorCode::SubjectFailed, fmt::format("OpenSubdiv failed: {}", why));
    };
    catch_messages();
    try {
        const auto refiner = make_refiner(mesh, options);
        if (!refiner) return failed(messages);
        Far::TopologyRefiner::UniformOptions uniform(static_cast<unsigned>(levels));
        uniform.fullTopologyInLastLevel = true;
        refiner->RefineUniform(uniform);
        if (refiner->GetMaxLevel() != levels)
            return failed(fmt::format("{} levels were asked for, {} made. {}", levels, refiner->GetMaxLevel(),
                                      messages));
        core::Refinement out = precision == core::Precision::Float ? refine_positions<float>(mesh, *refiner)
                                                                   : refine_positions<double>(mesh, *refiner);
        out.precision = precision;
        return out;
    } catch (const std::exception& e) {
        return failed(e.what());
    }
}

}  // namespace loopcheck::reference
