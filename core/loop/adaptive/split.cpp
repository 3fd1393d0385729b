#include "core/loop/adaptive/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/loop/split.h"

namespace loopcheck::core {
namespace {

int unsplit_edges(const Topology& t, Index f, const std::vector<std::uint8_t>& is_split) {
    const Triangle& edges = t.face_edges[f];
    return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](Index e) { return !is_split[e]; }));
}

class Splitter {
  public:
    Splitter(const Topology& parent, const std::vector<std::uint8_t>& is_split)
        : parent_(parent), point_of_(is_split.size(), kNone), first_child_(is_split.size()) {
        for (Index e = 0; e < parent.edge_count(); ++e)
            if (is_split[e]) {
                point_of_[e] = parent.vertex_count + static_cast<Index>(out_.split_edges.size());
                out_.split_edges.push_back(e);
            }
    }

    PartialSplit build(Index inner_edges) && {
        child().vertex_count = parent_.vertex_count + static_cast<Index>(out_.split_edges.size());
        number_edges(inner_edges);
        for (Index f = 0; f < parent_.face_count(); ++f) split_face(f);
        make_rings();
        for (Index v = 0; v < parent_.vertex_count; ++v)
            out_.ancestors.push_back({Ancestor::Kind::Vertex, v});
        for (const Index e : out_.split_edges) out_.ancestors.push_back(edge_ancestor(parent_, e));
        return std::move(out_);
    }

  private:
    Topology& child() { return out_.topology; }

    // Makes the edges on those of the parent, after the ones inside its faces, which are not known yet.
    void number_edges(Index inner_edges) {
        child().edge_ends.resize(inner_edges);
        child().edge_faces.resize(inner_edges, {kNone, kNone});
        out_.edges.resize(inner_edges);
        const auto add = [&](const std::array<Index, 2>& ends, const EdgeOrigin& origin) {
            child().edge_ends.push_back(ends);
            child().edge_faces.push_back({kNone, kNone});
            out_.edges.push_back(origin);
        };
        for (Index e = 0; e < parent_.edge_count(); ++e) {
            first_child_[e] = child().edge_count();
            const auto& ends = parent_.edge_ends[e];
            if (point_of_[e] == kNone) {
                add(ends, {EdgeOrigin::Kind::Kept, e, 0});
                continue;
            }
            for (int i = 0; i < 2; ++i) add({point_of_[e], ends[i]}, {EdgeOrigin::Kind::Half, e, i});
        }
    }

    // What is left of edge e at vertex v, which is one of its ends.
    Index at_end(Index e, Index v) const {
        const bool is_second = parent_.edge_ends[e][0] != v;
        return first_child_[e] + (point_of_[e] != kNone && is_second ? 1 : 0);
    }

    void split_face(Index f) {
        const Triangle& corners = parent_.triangles[f];
        Triangle midpoints;
        for (int i = 0; i < 3; ++i) midpoints[i] = point_of_[parent_.face_edges[f][i]];
        const Index first_inner = next_inner_;
        const SplitPattern pattern = split_pattern(corners, midpoints);
        for (const Triangle& piece : pattern.triangles()) {
            const Index face = child().face_count();
            Triangle edges;
            for (int i = 0; i < 3; ++i) {
                edges[i] = edge_of_side(f, midpoints, piece[i], piece[next_corner(i)], first_inner);
                auto& faces = child().edge_faces[edges[i]];
                faces[faces[0] == kNone ? 0 : 1] = face;
            }
            child().triangles.push_back(piece);
            child().face_edges.push_back(edges);
            out_.faces.push_back({f, child_number(corners, midpoints, piece)});
        }
    }

    // The edge from `from` to `to`, two of the corners and midpoints of face f.
    Index edge_of_side(Index f, const Triangle& midpoints, Index from, Index to, Index first_inner) {
        const Triangle& corners = parent_.triangles[f];
        for (int i = 0; i < 3; ++i) {
            const Index e = parent_.face_edges[f][i], a = corners[i], b = corners[next_corner(i)];
            if (midpoints[i] == kNone ? from == a && to == b : from == a && to == midpoints[i])
                return at_end(e, a);
            if (midpoints[i] != kNone && from == midpoints[i] && to == b) return at_end(e, b);
        }
        for (Index e = first_inner; e < next_inner_; ++e)
            if (child().edge_ends[e] == std::array{to, from}) return e;
        child().edge_ends[next_inner_] = {from, to};
        out_.edges[next_inner_] = {EdgeOrigin::Kind::Inside, f, 0};
        for (int i = 0; i < 3; ++i)
            if (from == midpoints[i] && to == midpoints[previous_corner(i)])
                out_.edges[next_inner_] = {EdgeOrigin::Kind::Cut, f, i};
        return next_inner_++;
    }

    static int child_number(const Triangle& corners, const Triangle& midpoints, const Triangle& piece) {
        const SplitPattern whole = split_pattern(corners, {-2, -3, -4});
        const auto place = [&](Index v) {
            for (int i = 0; i < 3; ++i)
                if (v == midpoints[i]) return static_cast<Index>(-2 - i);
            return v;
        };
        const Triangle named{place(piece[0]), place(piece[1]), place(piece[2])};
        const auto pieces = whole.triangles();
        const auto found = std::find(pieces.begin(), pieces.end(), named);
        return found == pieces.end() ? kNone : static_cast<int>(found - pieces.begin());
    }

    void make_rings() {
        child().ring_offsets.assign(1, 0);
        for (Index v = 0; v < parent_.vertex_count; ++v) {
            if (!parent_.is_isolated(v)) walk_ring(v, at_end(parent_.ring(v).front(), v));
            child().ring_offsets.push_back(child().ring_edges.size());
        }
        for (const Index e : out_.split_edges) {
            const Index f = parent_.edge_faces[e][0];
            const Index end = parent_.triangles[f][next_corner(parent_.corner_of_edge(f, e))];
            walk_ring(point_of_[e], at_end(e, end));
            child().ring_offsets.push_back(child().ring_edges.size());
        }
    }

    // Counter-clockwise: from an edge into the face that runs along it away from v, out by the edge before.
    void walk_ring(Index v, Index first) {
        Index e = first;
        do {
            child().ring_edges.push_back(e);
            const auto& faces = child().edge_faces[e];
            const auto leads_out = [&](Index f) {
                return f != kNone && child().triangles[f][child().corner_of_edge(f, e)] == v;
            };
            const auto found = std::find_if(faces.begin(), faces.end(), leads_out);
            if (found == faces.end()) return;
            e = child().face_edges[*found][previous_corner(child().corner_of_edge(*found, e))];
        } while (e != first);
    }

    const Topology& parent_;
    std::vector<Index> point_of_;     // per edge
    std::vector<Index> first_child_;  // per edge, its first half or what is itself
    Index next_inner_ = 0;
    PartialSplit out_;
};

}  // namespace

std::vector<std::uint8_t> edges_to_split(const Topology& topology,
                                         const std::vector<std::uint8_t>& is_subdividable) {
    std::vector<std::uint8_t> out;
    out.reserve(topology.edge_ends.size());
    for (const auto& [f, g] : topology.edge_faces)
        out.push_back(is_subdividable[f] && (g == kNone || is_subdividable[g]) ? 1 : 0);
    return out;
}

Result<PartialSplit> split_where(const Topology& parent, const std::vector<std::uint8_t>& is_split,
                                 double most_faces) {
    std::array<std::size_t, 4> c{};
    for (Index f = 0; f < parent.face_count(); ++f) ++c[unsplit_edges(parent, f, is_split)];
    const std::size_t faces = 4 * c[0] + 3 * c[1] + 2 * c[2] + c[3];
    const std::size_t inner = 3 * c[0] + 2 * c[1] + c[2];
    const std::size_t split =
        static_cast<std::size_t>(std::count(is_split.begin(), is_split.end(), std::uint8_t{1}));
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<Index>::max());
    if (3 * faces > kMost || parent.vertex_count + split > kMost || inner + is_split.size() + split > kMost)
        return fail(
            ErrorCode::TooLarge,
            fmt::format("The next level would have {} faces; at most 2^31 - 1 corners can be numbered.",
                        faces));
    if (static_cast<double>(faces) > most_faces)
        return fail(ErrorCode::OutOfMemory,
                    fmt::format("The next level would have {} faces; there is room for {:.0f}.", faces,
                                std::max(most_faces, 0.0)));
    PartialSplit out = Splitter(parent, is_split).build(static_cast<Index>(inner));
    out.faces_with_unsplit = c;
    return out;
}

}  // namespace loopcheck::core
