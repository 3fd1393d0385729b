#include "reference/opensubdiv/catmull_clark.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "reference/opensubdiv/opensubdiv.h"
#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

using namespace internal;
using core::ErrorCode;
using core::Index;
using core::Place;

std::optional<core::Error> check_face(std::span<const Index> corners, Index vertex_count, Place place) {
    if (corners.size() != 4)
        return core::Error{ErrorCode::Unsupported,
                           fmt::format("Only quads are refined; this face has {} corners.", corners.size()),
                           place};
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = corners[i];
        if (v < 0 || v >= vertex_count)
            return core::Error{ErrorCode::IndexOutOfRange, fmt::format("There is no vertex {}.", v), place};
        const auto before = corners.first(i);
        if (std::find(before.begin(), before.end(), v) != before.end())
            return core::Error{ErrorCode::RepeatedVertex, fmt::format("Vertex {} appears twice.", v), place};
    }
    return std::nullopt;
}

// What OpenSubdiv takes for granted: asked for less, it reads and writes beyond its arrays.
std::optional<core::Error> check_quads(const core::MeshData& data) {
    if (data.positions.empty() || data.face_sizes.empty())
        return core::Error{ErrorCode::EmptyMesh, "There are no vertices or no faces."};
    if (!data.creases.empty() || !data.corners.empty() || !data.holes.empty())
        return core::Error{ErrorCode::Unsupported, "Quads are refined without creases, corners and holes."};
    if (!core::sizes_match(data))
        return core::Error{ErrorCode::IndexOutOfRange,
                           "The sizes of the faces are not the number of their corners."};
    const auto vertex_count = static_cast<Index>(data.positions.size());
    std::vector<int> face_count(data.positions.size());
    std::optional<core::Error> error;
    core::for_each_face(data, [&](std::size_t f, std::span<const Index> corners) {
        if (!error)
            error = check_face(corners, vertex_count, {Place::Kind::Face, static_cast<std::int64_t>(f)});
        if (!error)
            for (const Index v : corners) ++face_count[v];
    });
    if (error) return error;
    for (Index v = 0; v < vertex_count; ++v)
        if (2 * std::int64_t{face_count[v]} > Far::VALENCE_LIMIT)
            return core::Error{ErrorCode::Unsupported,
                               "OpenSubdiv may not take so many edges at a vertex.",
                               {Place::Kind::Vertex, v}};
    return std::nullopt;
}

core::Result<RefinerPtr> refiner_of(const core::MeshData& data, core::BoundaryRule boundary) {
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(data.positions.size());
    descriptor.numFaces = static_cast<int>(data.face_sizes.size());
    descriptor.numVertsPerFace = data.face_sizes.data();
    descriptor.vertIndicesPerFace = data.face_corners.data();
    return create_refiner(descriptor, Sdc::SCHEME_CATMARK, {.boundary = boundary});
}

QuadAncestor ancestor_of(const Far::ConstIndexArray& vertices) {
    QuadAncestor out;
    out.count = static_cast<std::uint8_t>(vertices.size());
    for (int i = 0; i < vertices.size(); ++i) out.vertices.at(i) = vertices[i];
    return out;
}

std::vector<QuadAncestor> child_ancestors(const Far::TopologyLevel& parent, int child_count) {
    std::vector<QuadAncestor> out(child_count);
    for (Index v = 0; v < parent.GetNumVertices(); ++v)
        out.at(parent.GetVertexChildVertex(v)) = {1, {v, core::kNone, core::kNone, core::kNone}};
    for (Index e = 0; e < parent.GetNumEdges(); ++e)
        out.at(parent.GetEdgeChildVertex(e)) = ancestor_of(parent.GetEdgeVertices(e));
    for (Index f = 0; f < parent.GetNumFaces(); ++f)
        out.at(parent.GetFaceChildVertex(f)) = ancestor_of(parent.GetFaceVertices(f));
    return out;
}

std::vector<Quad> faces_of(const Far::TopologyLevel& level) {
    std::vector<Quad> out;
    out.reserve(level.GetNumFaces());
    for (Index f = 0; f < level.GetNumFaces(); ++f) {
        const auto v = level.GetFaceVertices(f);
        out.push_back({v[0], v[1], v[2], v[3]});
    }
    return out;
}

template <class Real>
std::optional<core::Error> take_levels(std::span<const glm::dvec3> positions,
                                       const Far::TopologyRefiner& base, int levels, CatmullClark& out) {
    const auto take = [&](const Far::TopologyRefiner& refiner, const std::vector<Value<Real>>& values,
                          core::LimitLevel limit) {
        const int l = refiner.GetMaxLevel();
        const Far::TopologyLevel& level = refiner.GetLevel(l);
        out.levels.push_back({to_positions(values), faces_of(level), {}, std::move(limit)});
        if (l > 0)
            out.levels.back().ancestors = child_ancestors(refiner.GetLevel(l - 1), level.GetNumVertices());
    };
    return visit_levels<Real>(positions, base, levels, take);
}

}  // namespace

core::Result<CatmullClark> opensubdiv_catmull_clark(const core::MeshData& data, core::BoundaryRule boundary,
                                                    int levels, core::Precision precision) {
    if (auto error = check_quads(data)) return tl::unexpected(*error);
    if (auto error = core::check_fits(data.positions, precision)) return tl::unexpected(*error);
    if (levels < 0 || levels > kOpensubdivMaxLevels)
        return core::fail(ErrorCode::Unsupported, fmt::format("OpenSubdiv refines 0 to {} levels, not {}.",
                                                              kOpensubdivMaxLevels, levels));
    return contained([&]() -> core::Result<CatmullClark> {
        const auto base = refiner_of(data, boundary);
        if (!base) return tl::unexpected(base.error());
        CatmullClark out{precision, {}};
        const auto error = precision == core::Precision::Float
                               ? take_levels<float>(data.positions, **base, levels, out)
                               : take_levels<double>(data.positions, **base, levels, out);
        if (error) return tl::unexpected(*error);
        return out;
    });
}

}  // namespace loopcheck::reference
