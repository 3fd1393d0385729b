#include "core/loop/tessellation/lattice.h"

namespace loopcheck::core {

VertexKey key_of(const Topology& control, Index face, const LatticePoint& point) {
    const Triangle& corners = control.triangles[face];
    const std::array<std::int64_t, 3> barycentric{kLatticeUnit - point.u - point.v, point.u, point.v};
    for (int i = 0; i < 3; ++i)
        if (barycentric[i] == kLatticeUnit) return {VertexKey::Kind::Vertex, corners[i], 0, 0};
    for (int i = 0; i < 3; ++i) {
        const int j = next_corner(i), k = previous_corner(i);
        if (barycentric[i] != 0) continue;
        const Index edge = control.face_edges[face][j];
        const bool ends_at_j = control.edge_ends[edge][1] == corners[j];
        return {VertexKey::Kind::Edge, edge, barycentric[ends_at_j ? j : k], 0};
    }
    return {VertexKey::Kind::Face, face, point.u, point.v};
}

std::size_t VertexKeyHash::operator()(const VertexKey& key) const {
    // The multiplier, 2^64 over the golden ratio, spreads low bits upwards; the shift brings them back.
    std::uint64_t h = static_cast<std::uint64_t>(key.id) * 3 + static_cast<std::uint64_t>(key.kind);
    for (const std::int64_t x : {key.s, key.t}) {
        h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
        h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
}

}  // namespace loopcheck::core
