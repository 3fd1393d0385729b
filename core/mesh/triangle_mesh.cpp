#include "core/mesh/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>
#include <optional>

namespace loopcheck::core {
namespace {

constexpr auto kMaxCount = static_cast<std::size_t>(std::numeric_limits<Index>::max());

std::optional<Error> check_counts(const MeshData& data) {
    if (data.positions.empty()) return Error{ErrorCode::EmptyMesh, "The mesh has no vertices."};
    if (data.face_sizes.empty()) return Error{ErrorCode::EmptyMesh, "The mesh has no faces."};
    const std::size_t most =
        std::max({data.positions.size(), data.face_corners.size(), data.face_sizes.size(),
                  data.creases.size(), data.corners.size(), data.holes.size()});
    if (most > kMaxCount)
        return Error{ErrorCode::TooLarge,
                     fmt::format("The mesh has {} of one thing; at most 2^31 - 1 can be numbered.", most)};
    return std::nullopt;
}

std::optional<Error> check_positions(std::span<const glm::dvec3> positions) {
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(positions[v][i]))
                return Error{ErrorCode::NotFinite,
                             fmt::format("Coordinate {} is {}.", "xyz"[i], positions[v][i]),
                             {Place::Kind::Vertex, static_cast<Index>(v)}};
    return std::nullopt;
}

Result<std::vector<Triangle>> check_faces(const MeshData& data) {
    const auto vertex_count = static_cast<Index>(data.positions.size());
    std::vector<Triangle> triangles;
    triangles.reserve(data.face_sizes.size());
    std::size_t corner = 0;
    for (std::size_t f = 0; f < data.face_sizes.size(); ++f) {
        const Place place{Place::Kind::Face, static_cast<Index>(f)};
        if (data.face_sizes[f] != 3)
            return fail(
                ErrorCode::NotATriangle,
                fmt::format("The face has {} corners; Loop subdivision takes triangles{}.",
                            data.face_sizes[f],
                            data.face_sizes[f] > 3 ? " (--triangulate splits polygons by a fan)" : ""),
                place);
        if (data.face_corners.size() - corner < 3)
            return fail(ErrorCode::IndexOutOfRange, "The corners of the face are missing.", place);
        const Triangle t{data.face_corners[corner], data.face_corners[corner + 1],
                         data.face_corners[corner + 2]};
        for (const Index v : t)
            if (v < 0 || v >= vertex_count)
                return fail(ErrorCode::IndexOutOfRange,
                            fmt::format("The face names vertex {}, but the vertices are 0 to {}.", v,
                                        vertex_count - 1),
                            place);
        for (int i = 0; i < 3; ++i)
            if (t[i] == t[next_corner(i)])
                return fail(ErrorCode::RepeatedVertex, fmt::format("Vertex {} appears twice.", t[i]), place);
        triangles.push_back(t);
        corner += 3;
    }
    if (corner != data.face_corners.size())
        return fail(ErrorCode::IndexOutOfRange, fmt::format("There are {} corners, but the faces have {}.",
                                                            data.face_corners.size(), corner));
    return triangles;
}

std::optional<Index> find_edge(const Topology& topology, Index a, Index b) {
    const auto in_range = [&](Index v) { return v >= 0 && v < topology.vertex_count; };
    if (!in_range(a) || !in_range(b)) return std::nullopt;
    if (topology.ring(b).size() < topology.ring(a).size()) std::swap(a, b);
    for (const Index e : topology.ring(a))
        if (topology.other_end(e, a) == b) return e;
    return std::nullopt;
}

std::optional<Error> check_sharpness(float sharpness, const std::string& whose) {
    if (sharpness >= 0) return std::nullopt;
    return Error{ErrorCode::BadSharpness,
                 fmt::format("{} has the sharpness {}; sharpness is 0 or positive.", whose, sharpness)};
}

Result<std::vector<float>> check_creases(const Topology& topology, std::span<const EdgeSharpness> creases) {
    std::vector<float> sharpness(topology.edge_ends.size(), 0);
    for (const auto& crease : creases) {
        const std::string whose = fmt::format("The crease between vertices {} and {}", crease.a, crease.b);
        const auto edge = find_edge(topology, crease.a, crease.b);
        if (!edge) return fail(ErrorCode::NoSuchEdge, whose + " is not on an edge of the mesh.");
        if (auto error = check_sharpness(crease.sharpness, whose)) return tl::unexpected(*error);
        sharpness[*edge] = std::min(crease.sharpness, kInfiniteSharpness);
    }
    return sharpness;
}

Result<std::vector<float>> check_corners(Index vertex_count, std::span<const VertexSharpness> corners) {
    std::vector<float> sharpness(vertex_count, 0);
    for (const auto& corner : corners) {
        if (corner.vertex < 0 || corner.vertex >= vertex_count)
            return fail(ErrorCode::IndexOutOfRange,
                        fmt::format("A corner names vertex {}, but the vertices are 0 to {}.", corner.vertex,
                                    vertex_count - 1));
        if (auto error =
                check_sharpness(corner.sharpness, fmt::format("The corner at vertex {}", corner.vertex)))
            return tl::unexpected(*error);
        sharpness[corner.vertex] = std::min(corner.sharpness, kInfiniteSharpness);
    }
    return sharpness;
}

Result<std::vector<std::uint8_t>> check_holes(Index face_count, std::span<const Index> holes) {
    std::vector<std::uint8_t> flags(face_count, 0);
    for (const Index f : holes) {
        if (f < 0 || f >= face_count)
            return fail(ErrorCode::HoleOutOfRange,
                        fmt::format("A hole names face {}, but the faces are 0 to {}.", f, face_count - 1));
        flags[f] = 1;
    }
    return flags;
}

}  // namespace

Result<TriangleMesh> TriangleMesh::make(MeshData data) {
    if (auto error = check_counts(data)) return tl::unexpected(*error);
    if (auto error = check_positions(data.positions)) return tl::unexpected(*error);
    auto triangles = check_faces(data);
    if (!triangles) return tl::unexpected(triangles.error());
    auto topology = make_topology(static_cast<Index>(data.positions.size()), std::move(*triangles));
    if (!topology) return tl::unexpected(topology.error());
    auto edge_sharpness = check_creases(*topology, data.creases);
    if (!edge_sharpness) return tl::unexpected(edge_sharpness.error());
    auto vertex_sharpness = check_corners(topology->vertex_count, data.corners);
    if (!vertex_sharpness) return tl::unexpected(vertex_sharpness.error());
    auto holes = check_holes(topology->face_count(), data.holes);
    if (!holes) return tl::unexpected(holes.error());

    TriangleMesh mesh;
    mesh.positions_ = std::move(data.positions);
    mesh.topology_ = std::move(*topology);
    mesh.edge_sharpness_ = std::move(*edge_sharpness);
    mesh.vertex_sharpness_ = std::move(*vertex_sharpness);
    mesh.holes_ = std::move(*holes);
    return mesh;
}

TriangleMesh TriangleMesh::with_infinite_sharpness(std::span<const Index> edges) const {
    TriangleMesh mesh = *this;
    for (const Index e : edges) mesh.edge_sharpness_[e] = kInfiniteSharpness;
    return mesh;
}

double TriangleMesh::largest_coordinate() const {
    double m = std::numeric_limits<double>::min();
    for (const auto& p : positions_) m = std::max({m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return m;
}

double TriangleMesh::diagonal() const {
    glm::dvec3 low = positions_.front(), high = low;
    for (const auto& p : positions_) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
}

std::string_view name(Precision precision) {
    return precision == Precision::Float ? "float" : "double";
}

std::optional<Error> check_fits(std::span<const glm::dvec3> positions, Precision precision) {
    const double most = precision == Precision::Float ? double{std::numeric_limits<float>::max()} / 2
                                                      : std::numeric_limits<double>::max() / 2;
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(positions[v][i]) <= most))
                return Error{ErrorCode::NotFinite,
                             fmt::format("Coordinate {} is {}: sums of it may be beyond the range of {}.",
                                         "xyz"[i], positions[v][i], name(precision)),
                             {Place::Kind::Vertex, static_cast<Index>(v)}};
    return std::nullopt;
}

std::optional<Error> check_fits(const TriangleMesh& mesh, Precision precision) {
    return check_fits(mesh.positions(), precision);
}

}  // namespace loopcheck::core
