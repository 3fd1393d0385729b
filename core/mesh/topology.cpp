#include "core/mesh/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace loopcheck::core {
namespace {

// Side i of face f is numbered 3 f + i; it runs from corner i to the next corner.
struct Side {
    std::uint64_t ends;  // the smaller vertex in the upper half, the larger in the lower
    Index side;

    bool operator<(const Side& other) const {
        return ends != other.ends ? ends < other.ends : side < other.side;
    }
};

class Builder {
  public:
    Builder(Index vertex_count, std::vector<Triangle> triangles) {
        t_.vertex_count = vertex_count;
        t_.triangles = std::move(triangles);
    }

    Result<Topology> build() {
        if (auto error = join_sides()) return tl::unexpected(*error);
        number_edges();
        if (auto error = make_rings()) return tl::unexpected(*error);
        return std::move(t_);
    }

  private:
    Index start_of(Index side) const { return t_.triangles[side / 3][side % 3]; }
    Index end_of(Index side) const { return t_.triangles[side / 3][next_corner(side % 3)]; }

    // Finds the one or two sides of every edge; partner_ is the other one, or kNone.
    std::optional<Error> join_sides() {
        const auto side_count = static_cast<Index>(3 * t_.triangles.size());
        std::vector<Side> sides;
        sides.reserve(side_count);
        for (Index s = 0; s < side_count; ++s) {
            const auto [low, high] = std::minmax({start_of(s), end_of(s)});
            sides.push_back({static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high), s});
        }
        std::sort(sides.begin(), sides.end());

        partner_.assign(side_count, kNone);
        std::optional<Error> first;
        Index first_side = std::numeric_limits<Index>::max();
        for (auto run = sides.begin(); run != sides.end();) {
            const auto end =
                std::find_if(run, sides.end(), [&](const Side& s) { return s.ends != run->ends; });
            if (auto error = join_run({run, end}); error && run->side < first_side) {
                first = std::move(error);
                first_side = run->side;
            }
            run = end;
        }
        return first;
    }

    // The sides between one pair of vertices: joins two that run in opposite directions, diagnoses all else.
    std::optional<Error> join_run(std::span<const Side> run) {
        if (run.size() == 1) return std::nullopt;
        if (run.size() == 2 && start_of(run[0].side) != start_of(run[1].side)) {
            partner_[run[0].side] = run[1].side;
            partner_[run[1].side] = run[0].side;
            return std::nullopt;
        }
        for (std::size_t i = 0; i < run.size(); ++i)
            for (std::size_t j = i + 1; j < run.size() && j < i + kPairsLookedAt; ++j)
                if (same_winding(run[i].side / 3, run[j].side / 3))
                    return Error{ErrorCode::DuplicateFace,
                                 fmt::format("The face has the same vertices and winding as face {}.",
                                             run[i].side / 3),
                                 {Place::Kind::Face, run[j].side / 3}};
        const Index a = start_of(run[0].side), b = end_of(run[0].side);
        if (run.size() > 2)
            return Error{
                ErrorCode::NonManifoldEdge,
                fmt::format("The edge between vertices {} and {} has {} faces; an edge of a manifold has "
                            "one or two.",
                            a, b, run.size()),
                {Place::Kind::Face, run[2].side / 3}};
        return Error{
            ErrorCode::InconsistentWinding,
            fmt::format("The face runs from vertex {} to vertex {}, and so does face {}; neighbours run "
                        "along their edge in opposite directions.",
                        a, b, run[0].side / 3),
            {Place::Kind::Face, run[1].side / 3}};
    }

    bool same_winding(Index f, Index g) const {
        Triangle rotated = t_.triangles[g];
        for (int i = 0; i < 3; ++i) {
            if (rotated == t_.triangles[f]) return true;
            std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
        }
        return false;
    }

    // Numbers the edges as they are first met, faces in order.
    void number_edges() {
        t_.face_edges.resize(t_.triangles.size());
        for (Index f = 0; f < t_.face_count(); ++f)
            for (int i = 0; i < 3; ++i) {
                const Index side = 3 * f + i, partner = partner_[side];
                if (partner != kNone && partner < side) {
                    const Index e = t_.face_edges[partner / 3][partner % 3];
                    t_.face_edges[f][i] = e;
                    t_.edge_faces[e][1] = f;
                } else {
                    t_.face_edges[f][i] = t_.edge_count();
                    t_.edge_ends.push_back({start_of(side), end_of(side)});
                    t_.edge_faces.push_back({f, kNone});
                }
            }
    }

    std::optional<Error> make_rings() {
        std::vector<Index> first_side = leading_sides();
        std::vector<Index> edge_count(t_.vertex_count, 0);
        for (const auto& ends : t_.edge_ends)
            for (const Index v : ends) ++edge_count[v];

        t_.ring_offsets.assign(1, 0);
        t_.ring_offsets.reserve(t_.vertex_count + std::size_t{1});
        t_.ring_edges.reserve(2 * t_.edge_ends.size());
        for (Index v = 0; v < t_.vertex_count; ++v) {
            if (first_side[v] != kNone) walk_ring(first_side[v]);
            const std::size_t walked = t_.ring_edges.size() - t_.ring_offsets.back();
            if (walked != static_cast<std::size_t>(edge_count[v]))
                return Error{
                    ErrorCode::NonManifoldVertex,
                    fmt::format("The faces around the vertex form more than one fan: {} of its {} edges "
                                "are connected through faces.",
                                walked, edge_count[v]),
                    {Place::Kind::Vertex, v}};
            t_.ring_offsets.push_back(t_.ring_edges.size());
        }
        return std::nullopt;
    }

    // Per vertex the side its ring starts with: a boundary side that leads out of it, else the side that
    // leads out of it in its lowest face.
    std::vector<Index> leading_sides() const {
        std::vector<Index> lead(t_.vertex_count, kNone);
        const auto side_count = static_cast<Index>(partner_.size());
        for (Index side = 0; side < side_count; ++side) {
            Index& current = lead[start_of(side)];
            if (current == kNone || (partner_[side] == kNone && partner_[current] != kNone)) current = side;
        }
        return lead;
    }

    void walk_ring(Index first) {
        Index side = first;
        do {
            t_.ring_edges.push_back(t_.face_edges[side / 3][side % 3]);
            const Index incoming = side - side % 3 + previous_corner(side % 3);
            side = partner_[incoming];
            if (side == kNone) t_.ring_edges.push_back(t_.face_edges[incoming / 3][incoming % 3]);
        } while (side != kNone && side != first);
    }

    // Enough to name a duplicate, without a quadratic search around an edge of very many faces.
    static constexpr std::size_t kPairsLookedAt = 64;

    Topology t_;
    std::vector<Index> partner_;
};

}  // namespace

Result<Topology> make_topology(Index vertex_count, std::vector<Triangle> triangles) {
    if (triangles.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3)
        return fail(ErrorCode::TooLarge,
                    fmt::format("The mesh has {} faces; at most 2^31 - 1 corners can be numbered.",
                                triangles.size()));
    return Builder(vertex_count, std::move(triangles)).build();
}

}  // namespace loopcheck::core
