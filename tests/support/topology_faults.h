// An independent check of everything a Topology promises.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/mesh/topology.h"

namespace loopcheck::tests {

/// Collects what is inconsistent in a topology; no fault is no text.
class TopologyFaults {
  public:
    explicit TopologyFaults(const core::Topology& topology) : t_(topology) {
        check_sizes();
        if (!text_.empty()) return;
        for (core::Index f = 0; f < t_.face_count(); ++f) check_face(f);
        for (core::Index e = 0; e < t_.edge_count(); ++e) check_edge(e);
        if (!text_.empty()) return;
        count_uses();
        for (core::Index v = 0; v < t_.vertex_count; ++v) check_ring(v);
    }

    const std::string& text() const { return text_; }

  private:
    template <class... Args>
    void require(bool holds, fmt::format_string<Args...> format, Args&&... args) {
        if (!holds && text_.size() < 2000) text_ += fmt::format(format, std::forward<Args>(args)...) + "\n";
    }
    bool is_edge(core::Index e) const { return e >= 0 && e < t_.edge_count(); }
    bool is_vertex(core::Index v) const { return v >= 0 && v < t_.vertex_count; }

    void check_sizes() {
        require(t_.face_edges.size() == t_.triangles.size(), "faces: {} but {} with edges",
                t_.triangles.size(), t_.face_edges.size());
        require(t_.edge_faces.size() == t_.edge_ends.size(), "edges: {} but {} with faces",
                t_.edge_ends.size(), t_.edge_faces.size());
        require(t_.ring_offsets.size() == static_cast<std::size_t>(t_.vertex_count) + 1 &&
                    t_.ring_offsets.front() == 0 && t_.ring_offsets.back() == t_.ring_edges.size() &&
                    std::is_sorted(t_.ring_offsets.begin(), t_.ring_offsets.end()),
                "ring offsets are wrong");
    }

    // Edge i of a face joins corner i and the next one, and knows the face.
    void check_face(core::Index f) {
        for (int i = 0; i < 3; ++i) {
            const core::Index e = t_.face_edges[f][i];
            const core::Index a = t_.triangles[f][i], b = t_.triangles[f][core::next_corner(i)];
            require(is_vertex(a), "face {}: no vertex {}", f, a);
            require(is_edge(e), "face {}: no edge {}", f, e);
            if (!is_edge(e)) continue;
            const auto& ends = t_.edge_ends[e];
            require(std::minmax(ends[0], ends[1]) == std::minmax(a, b), "face {}: edge {} is not {}-{}", f, e,
                    a, b);
            require(t_.edge_faces[e][0] == f || t_.edge_faces[e][1] == f, "face {}: not on its edge {}", f,
                    e);
        }
    }

    // Two ends, one or two faces in ascending order, which run along it in opposite directions.
    void check_edge(core::Index e) {
        const auto [a, b] = t_.edge_ends[e];
        const auto [f, g] = t_.edge_faces[e];
        require(is_vertex(a) && is_vertex(b) && a != b, "edge {}: ends {} and {}", e, a, b);
        require(f >= 0 && f < t_.face_count() && g < t_.face_count() && (g == core::kNone || f < g),
                "edge {}: faces {} and {}", e, f, g);
        if (!text_.empty()) return;
        require(start_in(f, e) != core::kNone, "edge {}: face {} does not have it once", e, f);
        if (g == core::kNone) return;
        require(start_in(g, e) != core::kNone, "edge {}: face {} does not have it once", e, g);
        require(start_in(f, e) != start_in(g, e), "edge {}: both faces run along it in one direction", e);
    }

    // The vertex from which face f runs along edge e; kNone where f does not have e exactly once.
    core::Index start_in(core::Index f, core::Index e) const {
        if (std::count(t_.face_edges[f].begin(), t_.face_edges[f].end(), e) != 1) return core::kNone;
        for (int i = 0; i < 3; ++i)
            if (t_.face_edges[f][i] == e) return t_.triangles[f][i];
        return core::kNone;
    }

    void count_uses() {
        edges_at_.assign(t_.vertex_count, 0);
        faces_at_.assign(t_.vertex_count, 0);
        for (const auto& ends : t_.edge_ends)
            for (const core::Index v : ends) ++edges_at_[v];
        for (const auto& t : t_.triangles)
            for (const core::Index v : t) ++faces_at_[v];
    }

    // Every edge at v once; each is followed by the one that comes after it, counter-clockwise, in their
    // common face; boundary edges are at both ends of the ring and nowhere else.
    void check_ring(core::Index v) {
        const auto ring = t_.ring(v);
        const auto n = static_cast<int>(ring.size());
        require(std::all_of(ring.begin(), ring.end(), [&](core::Index e) { return is_edge(e); }) &&
                    std::set<core::Index>(ring.begin(), ring.end()).size() == ring.size() &&
                    n == edges_at_[v],
                "ring of {}: not each of its {} edges once", v, edges_at_[v]);
        if (!text_.empty() || n == 0) return;
        const bool open = t_.is_boundary_edge(ring.front());
        for (int i = 0; i < n; ++i) {
            const bool at_end = i == 0 || i == n - 1;
            require(t_.is_boundary_edge(ring[i]) == (open && at_end), "ring of {}: boundary at edge {}", v,
                    i);
            if (open && i == n - 1) break;
            require(edge_after(v, ring[i]) == ring[(i + 1) % n], "ring of {}: edge {} does not follow", v,
                    i + 1);
        }
        require(faces_at_[v] == n - (open ? 1 : 0), "ring of {}: {} edges but {} faces", v, n, faces_at_[v]);
        require(t_.face_count_at(v) == faces_at_[v] && t_.is_boundary_vertex(v) == open &&
                    t_.is_isolated(v) == (n == 0),
                "vertex {}: its members disagree with its ring", v);
    }

    // The next edge counter-clockwise around v: the last side of the face that runs from v along e.
    core::Index edge_after(core::Index v, core::Index e) const {
        for (const core::Index f : t_.edge_faces[e])
            for (int i = 0; f != core::kNone && i < 3; ++i)
                if (t_.face_edges[f][i] == e && t_.triangles[f][i] == v)
                    return t_.face_edges[f][core::previous_corner(i)];
        return core::kNone;
    }

    const core::Topology& t_;
    std::vector<int> edges_at_, faces_at_;
    std::string text_;
};

/// What is inconsistent in a topology, one line each; empty where nothing is.
inline std::string faults_of(const core::Topology& topology) {
    return TopologyFaults(topology).text();
}

}  // namespace loopcheck::tests
