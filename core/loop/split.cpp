#include "core/loop/split.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

namespace loopcheck::core {
namespace {

int end_index(const Topology& parent, Index e, Index v) {
    return parent.edge_ends[e][0] == v ? 0 : 1;
}

void split_faces(const Topology& parent, Topology& child) {
    const Index V = parent.vertex_count;
    child.triangles.reserve(4 * parent.triangles.size());
    child.face_edges.reserve(4 * parent.triangles.size());
    for (Index f = 0; f < parent.face_count(); ++f) {
        const Triangle& v = parent.triangles[f];
        const Triangle& e = parent.face_edges[f];
        const Triangle point{V + e[0], V + e[1], V + e[2]};
        // The half of edge i of this face that touches corner c.
        const auto half = [&](int i, int c) {
            return half_edge(parent, e[i], end_index(parent, e[i], v[c]));
        };
        child.triangles.push_back({v[0], point[0], point[2]});
        child.triangles.push_back({point[0], v[1], point[1]});
        child.triangles.push_back({point[2], point[1], v[2]});
        child.triangles.push_back({point[1], point[2], point[0]});
        child.face_edges.push_back({half(0, 0), 3 * f, half(2, 0)});
        child.face_edges.push_back({half(0, 1), half(1, 1), 3 * f + 1});
        child.face_edges.push_back({3 * f + 2, half(1, 2), half(2, 2)});
        child.face_edges.push_back({3 * f + 2, 3 * f, 3 * f + 1});
    }
}

void split_edges(const Topology& parent, Topology& child) {
    const Index V = parent.vertex_count;
    const std::size_t count = 3 * parent.triangles.size() + 2 * parent.edge_ends.size();
    child.edge_ends.reserve(count);
    child.edge_faces.reserve(count);
    for (Index f = 0; f < parent.face_count(); ++f)
        for (int i = 0; i < 3; ++i) {
            const Triangle& e = parent.face_edges[f];
            child.edge_ends.push_back({V + e[i], V + e[previous_corner(i)]});
            child.edge_faces.push_back({4 * f + i, 4 * f + 3});
        }
    for (Index e = 0; e < parent.edge_count(); ++e)
        for (int i = 0; i < 2; ++i) {
            const Index end = parent.edge_ends[e][i];
            child.edge_ends.push_back({V + e, end});
            std::array<Index, 2> faces{kNone, kNone};
            for (int side = 0; side < 2; ++side) {
                const Index f = parent.edge_faces[e][side];
                if (f == kNone) continue;
                const int corner = parent.corner_of_edge(f, e);
                faces[side] = 4 * f + (parent.triangles[f][corner] == end ? corner : next_corner(corner));
            }
            child.edge_faces.push_back(faces);
        }
}

// The two new edges of face f that end at the edge point of e, in the order they are met counter-clockwise
// around that point, starting from the half along which f runs.
std::array<Index, 2> cuts_at_edge_point(const Topology& parent, Index f, Index e) {
    const int corner = parent.corner_of_edge(f, e);
    return {3 * f + next_corner(corner), 3 * f + corner};
}

void split_rings(const Topology& parent, Topology& child) {
    child.ring_offsets.reserve(child.vertex_count + std::size_t{1});
    child.ring_edges.reserve(2 * child.edge_ends.size());
    child.ring_offsets.push_back(0);
    for (Index v = 0; v < parent.vertex_count; ++v) {
        for (const Index e : parent.ring(v))
            child.ring_edges.push_back(half_edge(parent, e, end_index(parent, e, v)));
        child.ring_offsets.push_back(child.ring_edges.size());
    }
    for (Index e = 0; e < parent.edge_count(); ++e) {
        const auto [f0, f1] = parent.edge_faces[e];
        const Index start = parent.triangles[f0][parent.corner_of_edge(f0, e)];
        const int from = end_index(parent, e, start);  // f0 runs from this end to the other
        const auto cuts = cuts_at_edge_point(parent, f0, e);
        child.ring_edges.insert(child.ring_edges.end(), {half_edge(parent, e, 1 - from), cuts[0], cuts[1],
                                                         half_edge(parent, e, from)});
        if (f1 != kNone) {
            const auto beyond = cuts_at_edge_point(parent, f1, e);
            child.ring_edges.insert(child.ring_edges.end(), {beyond[0], beyond[1]});
        }
        child.ring_offsets.push_back(child.ring_edges.size());
    }
}

}  // namespace

Result<Topology> split(const Topology& parent) {
    const auto V = static_cast<std::int64_t>(parent.vertex_count);
    const auto E = static_cast<std::int64_t>(parent.edge_count());
    const auto F = static_cast<std::int64_t>(parent.face_count());
    constexpr std::int64_t kMost = std::numeric_limits<Index>::max();
    if (V + E > kMost || 12 * F > kMost || 2 * E + 3 * F > kMost)
        return fail(
            ErrorCode::TooLarge,
            fmt::format("The next level would have {} faces; at most 2^31 - 1 corners can be numbered.",
                        4 * F));

    Topology child;
    child.vertex_count = static_cast<Index>(V + E);
    split_faces(parent, child);
    split_edges(parent, child);
    split_rings(parent, child);
    return child;
}

std::vector<Ancestor> ancestors_of_split(const Topology& parent) {
    std::vector<Ancestor> out;
    out.reserve(parent.vertex_count + parent.edge_ends.size());
    for (Index v = 0; v < parent.vertex_count; ++v) out.push_back({Ancestor::Kind::Vertex, v});
    for (Index e = 0; e < parent.edge_count(); ++e) out.push_back(edge_ancestor(parent, e));
    return out;
}

}  // namespace loopcheck::core
