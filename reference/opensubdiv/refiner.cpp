#include "reference/opensubdiv/refiner.h"

#include <opensubdiv/far/error.h>

#include <mutex>

#include "reference/opensubdiv/opensubdiv.h"

namespace loopcheck::reference::internal {
namespace {

using core::Index;

// What OpenSubdiv said since the last call on this thread.  Its callbacks are global to the process, so they
// are set once and write to a buffer of the calling thread.
thread_local std::string messages;

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
    // Where every value is linear, face-varying values have no limit to ask for.
    out.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_NONE);
    return out;
}

}  // namespace

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

tl::unexpected<core::Error> failed(std::string_view why) {
    return core::fail(core::ErrorCode::SubjectFailed, fmt::format("OpenSubdiv failed: {}", why));
}

void catch_messages() {
    static std::once_flag once;
    std::call_once(once, [] {
        Far::SetErrorCallback([](Far::ErrorType, const char* message) { messages += message; });
        Far::SetWarningCallback([](const char* message) { messages += message; });
    });
    messages.clear();
}

const std::string& caught_messages() {
    return messages;
}

core::Result<RefinerPtr> create_refiner(const Far::TopologyDescriptor& descriptor, Sdc::SchemeType scheme,
                                        const core::SchemeOptions& options) {
    Factory::Options factory_options(scheme, sdc_options(options));
    factory_options.validateFullTopology = true;
    RefinerPtr refiner(Factory::Create(descriptor, factory_options));
    if (!refiner) return failed(caught_messages());
    return refiner;
}

core::Result<RefinerPtr> make_refiner(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                      std::optional<FaceVaryingTopology> values) {
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

    std::vector<Index> value_indices;
    Far::TopologyDescriptor::FVarChannel channel;
    if (values) {
        for (const auto& face : values->indices)
            value_indices.insert(value_indices.end(), face.begin(), face.end());
        channel.numValues = values->count;
        channel.valueIndices = value_indices.data();
        descriptor.numFVarChannels = 1;
        descriptor.fvarChannels = &channel;
    }

    return create_refiner(descriptor, Sdc::SCHEME_LOOP, options);
}

core::Result<RefinerPtr> refined_uniformly(const Far::TopologyRefiner& base, int levels) {
    RefinerPtr refiner(Factory::Create(base));
    if (!refiner) return failed(caught_messages());
    Far::TopologyRefiner::UniformOptions uniform(static_cast<unsigned>(levels));
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    if (refiner->GetMaxLevel() != levels)
        return failed(fmt::format("{} levels were asked for, {} made. {}", levels, refiner->GetMaxLevel(),
                                  caught_messages()));
    return refiner;
}

}  // namespace loopcheck::reference::internal
