#include "core/loop/adaptive/criterion.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/mesh/face_normals.h"

namespace loopcheck::core {
namespace {

constexpr std::array kNeighbours{Neighbours::Edge, Neighbours::Vertex, Neighbours::FirstVertexRing};

template <class Visit>
void for_each_face_at(const Topology& t, Index v, Visit visit) {
    for (const Index e : t.ring(v))
        for (const Index f : t.edge_faces[e])
            if (f != kNone) visit(f);
}

// Every neighbour of f at least once, and perhaps f itself.
template <class Visit>
void for_each_neighbour(const Topology& t, Index f, Neighbours neighbours, Visit visit) {
    switch (neighbours) {
        case Neighbours::Edge:
            for (const Index e : t.face_edges[f])
                for (const Index g : t.edge_faces[e])
                    if (g != kNone) visit(g);
            return;
        case Neighbours::Vertex:
            for (const Index v : t.triangles[f]) for_each_face_at(t, v, visit);
            return;
        case Neighbours::FirstVertexRing:
            for_each_face_at(t, t.triangles[f][0], visit);
            return;
    }
}

}  // namespace

std::string_view name(Neighbours neighbours) {
    switch (neighbours) {
        case Neighbours::Edge:
            return "edge";
        case Neighbours::Vertex:
            return "vertex";
        case Neighbours::FirstVertexRing:
            return "first-vertex-ring";
    }
    return {};
}

std::optional<Neighbours> parse_neighbours(std::string_view text) {
    for (const Neighbours n : kNeighbours)
        if (name(n) == text) return n;
    return std::nullopt;
}

std::vector<double> largest_normal_angles(const Topology& topology, std::span<const glm::dvec3> positions,
                                          Neighbours neighbours) {
    const auto normals = face_normals(topology, positions);
    std::vector<double> angles(normals.size(), 0);
    for (Index f = 0; f < topology.face_count(); ++f)
        for_each_neighbour(topology, f, neighbours, [&](Index g) {
            if (g != f && normals[f] && normals[g])
                angles[f] = std::max(angles[f], angle_between(*normals[f], *normals[g]));
        });
    return angles;
}

Criterion where_smooth(double threshold, Neighbours neighbours) {
    return [=](const AdaptiveLevel& level) {
        std::vector<std::uint8_t> out;
        for (const double angle : largest_normal_angles(level.scheme.topology, level.positions, neighbours))
            out.push_back(threshold >= 0 && angle <= threshold + kAngleSlack ? 1 : 0);
        return out;
    };
}

Criterion where_bent(double threshold, Neighbours neighbours) {
    return [smooth = where_smooth(threshold, neighbours)](const AdaptiveLevel& level) {
        auto out = smooth(level);
        for (auto& flag : out) flag = flag ? 0 : 1;
        return out;
    };
}

Criterion where_listed(std::vector<Index> control_faces) {
    std::sort(control_faces.begin(), control_faces.end());
    return [list = std::move(control_faces)](const AdaptiveLevel& level) {
        std::vector<std::uint8_t> out;
        for (const Index f : level.control_face)
            out.push_back(std::binary_search(list.begin(), list.end(), f) ? 1 : 0);
        return out;
    };
}

}  // namespace loopcheck::core
