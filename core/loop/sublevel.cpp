#include "core/loop/sublevel.h"

#include <algorithm>

namespace loopcheck::core {
namespace {

// Numbers of the whole, ascending: the number in the part is the position here.
class Renumbering {
  public:
    void add(Index whole) { whole_.push_back(whole); }
    void close() {
        std::sort(whole_.begin(), whole_.end());
        whole_.erase(std::unique(whole_.begin(), whole_.end()), whole_.end());
    }
    // kNone for what is not in the part.
    Index operator()(Index whole) const {
        const auto found = std::lower_bound(whole_.begin(), whole_.end(), whole);
        return found != whole_.end() && *found == whole ? static_cast<Index>(found - whole_.begin()) : kNone;
    }
    const std::vector<Index>& whole() const { return whole_; }

  private:
    std::vector<Index> whole_;
};

Triangle renumbered(const Renumbering& number, const Triangle& t) {
    return {number(t[0]), number(t[1]), number(t[2])};
}

}  // namespace

SubLevel sublevel_around(const Topology& topology, const Sharpness& sharpness, std::span<const Index> kept) {
    Renumbering vertices, edges, faces;
    for (const Index v : kept) {
        vertices.add(v);
        for (const Index e : topology.ring(v))
            for (const Index f : topology.edge_faces[e])
                if (f != kNone) faces.add(f);
    }
    faces.close();
    for (const Index f : faces.whole())
        for (int i = 0; i < 3; ++i) {
            vertices.add(topology.triangles[f][i]);
            edges.add(topology.face_edges[f][i]);
        }
    vertices.close();
    edges.close();

    SubLevel out;
    out.vertices = vertices.whole();
    out.faces = faces.whole();
    Topology& t = out.level.topology;
    Sharpness& s = out.level.sharpness;
    t.vertex_count = static_cast<Index>(out.vertices.size());
    for (const Index f : faces.whole()) {
        t.triangles.push_back(renumbered(vertices, topology.triangles[f]));
        t.face_edges.push_back(renumbered(edges, topology.face_edges[f]));
    }
    for (const Index e : edges.whole()) {
        const auto [a, b] = topology.edge_ends[e];
        t.edge_ends.push_back({vertices(a), vertices(b)});
        const auto [f, g] = topology.edge_faces[e];
        const Index first = faces(f), second = g == kNone ? kNone : faces(g);
        t.edge_faces.push_back(first == kNone ? std::array{second, kNone} : std::array{first, second});
        // A boundary of the part only: smooth, it would ask for the face that is missing.
        const bool is_cut = g != kNone && (first == kNone || second == kNone);
        s.edge.push_back(is_cut ? kInfiniteSharpness : sharpness.edge[e]);
    }
    s.vertex.assign(out.vertices.size(), kInfiniteSharpness);
    std::vector<std::uint8_t> is_kept(out.vertices.size(), 0);
    for (const Index v : kept) {
        const Index local = vertices(v);
        out.kept.push_back(local);
        is_kept[local] = 1;
        s.vertex[local] = sharpness.vertex[v];
    }
    t.ring_offsets.push_back(0);
    for (std::size_t v = 0; v < out.vertices.size(); ++v) {
        if (is_kept[v])
            for (const Index e : topology.ring(out.vertices[v])) t.ring_edges.push_back(edges(e));
        t.ring_offsets.push_back(t.ring_edges.size());
    }
    out.level.classes = classify(t, s, {});
    return out;
}

std::vector<Index> with_neighbours(const Topology& topology, std::span<const Index> vertices) {
    std::vector<Index> out(vertices.begin(), vertices.end());
    const auto add = [&](Index v) {
        if (std::find(out.begin(), out.end(), v) == out.end()) out.push_back(v);
    };
    for (const Index v : vertices)
        for (const Index e : topology.ring(v)) add(topology.other_end(e, v));
    return out;
}

std::vector<Index> vertices_to_keep(const Topology& topology, std::span<const Index> vertices,
                                    Creasing creasing) {
    if (creasing == Creasing::Chaikin) return with_neighbours(topology, vertices);
    return {vertices.begin(), vertices.end()};
}

}  // namespace loopcheck::core
