#include "core/loop/lattice/refiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/loop/lattice/sums.h"
#include "core/loop/mask_choice.h"

namespace loopcheck::core {
namespace {

// The weighted sum of a mask over `point_at(place)`.
template <class Real, class PointAt>
Point<Real> apply_mask(const Mask& mask, Weights weights, PointAt&& point_at) {
    const auto w = weights_of<Real>(mask, weights);
    const auto places = places_of(mask);
    Point<Real> sum(0);
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * point_at(places[i]);
    return sum;
}

int end_of(const Topology& topology, Index e, Index v) {
    return topology.edge_ends[e][0] == v ? 0 : 1;
}

// Where a row of a closed lattice begins.
std::size_t row_begin(Index segments, Index j) {
    return static_cast<std::size_t>(j) * (segments + 1) - static_cast<std::size_t>(j) * (j - 1) / 2;
}

std::size_t closed_size(Index segments) {
    return row_begin(segments, segments) + 1;
}

// -- Fans.

// Control vertices and, in the order of `Topology::ring_edges`, the nearest point on each edge around them.
template <class Real>
struct Fan {
    Points<Real> centre, ring;
};

// What a pass needs of the level it leads from.
struct Pass {
    const Topology& topology;
    const SchemeOptions& options;
    const LatticeSharpness& sharpness;
    const LatticeSharpness& child;
    Index segments;

    Mask edge_mask(Index e, Index q) const {
        return edge_point_mask(sharpness.of_segment(e, q),
                               {child.of_segment(e, 2 * q), child.of_segment(e, 2 * q + 1)},
                               options.crease_share);
    }
};

template <class Real>
Fan<Real> control_fan(const Topology& topology, std::span<const Point<Real>> control) {
    Fan<Real> out{{control.begin(), control.end()}, {}};
    out.ring.reserve(topology.ring_edges.size());
    for (Index v = 0; v < topology.vertex_count; ++v)
        for (const Index e : topology.ring(v)) out.ring.push_back(control[topology.other_end(e, v)]);
    return out;
}

// The vertex opposite an edge of a fan, in the first (side 0) or second of its faces.  The first is to the
// left of the edge from its end 0.
template <class Real>
const Point<Real>& opposite(std::span<const Point<Real>> ring, std::size_t i, int end, int side) {
    const std::size_t n = ring.size();
    return end == side ? ring[(i + 1) % n] : ring[(i + n - 1) % n];
}

template <class Real>
Fan<Real> next_fan(const Pass& pass, const Fan<Real>& fan) {
    const Topology& t = pass.topology;
    Fan<Real> out;
    out.centre.reserve(fan.centre.size());
    out.ring.reserve(fan.ring.size());
    std::vector<float> sharp, child_sharp;
    for (Index v = 0; v < t.vertex_count; ++v) {
        const auto edges = t.ring(v);
        const std::span<const Point<Real>> ring(fan.ring.data() + t.ring_offsets[v], edges.size());
        sharp.clear();
        child_sharp.clear();
        for (const Index e : edges) {
            sharp.push_back(pass.sharpness.at_end(e, end_of(t, e, v)));
            child_sharp.push_back(pass.child.at_end(e, end_of(t, e, v)));
        }
        const Mask mask = vertex_point_mask(pass.sharpness.of_vertex(v), sharp, child_sharp);
        out.centre.push_back(apply_mask<Real>(mask, pass.options.weights, [&](int place) {
            return place == mask.ring ? fan.centre[v] : ring[static_cast<std::size_t>(place)];
        }));
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const int end = end_of(t, edges[i], v);
            const Mask edge = pass.edge_mask(edges[i], end == 0 ? 0 : pass.segments - 1);
            out.ring.push_back(apply_mask<Real>(edge, pass.options.weights, [&](int place) {
                if (place < 2) return place == end ? fan.centre[v] : ring[i];
                return opposite<Real>(ring, i, end, place - 2);
            }));
        }
    }
    return out;
}

// -- Strips.

// The row nearest to an edge in one of its faces: point k is between points k and k + 1 of the edge as that
// face runs.
template <class Real>
using Row = Points<Real>;

// The first and the last point of a row are in the fans at the ends of the edge.
template <class Real>
struct RowEnds {
    Point<Real> first, last;
};

template <class Real>
class Strip {
  public:
    Strip(const Topology& topology, Index e)
        : t_(topology), e_(e), sides_(topology.is_boundary_edge(e) ? 1 : 2) {
        for (int end = 0; end < 2; ++end) {
            const auto ring = t_.ring(t_.edge_ends[e][end]);
            place_[end] = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), e) - ring.begin());
        }
    }

    void start(const Fan<Real>& fan) {
        for (int side = 0; side < sides_; ++side) rows_[side] = {ends(fan, side).first};
    }

    // From the points `edge` to those of the next level, `next`.
    void step(const Pass& pass, const Fan<Real>& next_fan, std::span<const Point<Real>> edge,
              std::span<Point<Real>> next) {
        const Index n = pass.segments;
        next[0] = next_fan.centre[t_.edge_ends[e_][0]];
        next[2 * n] = next_fan.centre[t_.edge_ends[e_][1]];
        vertex_points(pass, edge, next);
        edge_points(pass, edge, next);
        for (int side = 0; side < sides_; ++side) rows_[side] = next_row(side, edge, ends(next_fan, side));
    }

  private:
    RowEnds<Real> ends(const Fan<Real>& fan, int side) const {
        const auto in_fan = [&](int end) {
            const Index v = t_.edge_ends[e_][end];
            const std::span<const Point<Real>> ring(fan.ring.data() + t_.ring_offsets[v], t_.ring(v).size());
            return opposite<Real>(ring, place_[end], end, side);
        };
        return {in_fan(side), in_fan(1 - side)};
    }

    // The point of the row on that side that is opposite segment q.
    const Point<Real>& beside(int side, Index q) const {
        const Row<Real>& row = rows_[side];
        return side == 0 ? row[q] : row[row.size() - 1 - q];
    }

    // Neighbour `place` of point i, from the next one on, counter-clockwise.
    const Point<Real>& neighbour(std::span<const Point<Real>> edge, Index i, int place) const {
        switch (place) {
            case 0:
                return edge[i + 1];
            case 1:
                return beside(0, i);
            case 2:
                return beside(0, i - 1);
            case 3:
                return edge[i - 1];
            case 4:
                return beside(1, i - 1);
            default:
                return beside(1, i);
        }
    }

    void vertex_points(const Pass& pass, std::span<const Point<Real>> edge,
                       std::span<Point<Real>> next) const {
        const int ring = sides_ == 2 ? 6 : 4;
        std::array<float, 6> sharp{}, child{};
        for (Index i = 1; i < pass.segments; ++i) {
            sharp[0] = pass.sharpness.of_segment(e_, i);
            sharp[3] = pass.sharpness.of_segment(e_, i - 1);
            if (!is_sharp(sharp[0]) || !is_sharp(sharp[3])) {
                next[2 * i] =
                    regular_vertex_point<Real>(edge[i], [&](int place) { return neighbour(edge, i, place); });
                continue;
            }
            child[0] = pass.child.of_segment(e_, 2 * i);
            child[3] = pass.child.of_segment(e_, 2 * i - 1);
            const std::size_t size = static_cast<std::size_t>(ring);
            const Mask mask =
                vertex_point_mask(0, std::span(sharp).first(size), std::span(child).first(size));
            next[2 * i] = apply_mask<Real>(mask, pass.options.weights, [&](int place) {
                return place == ring ? edge[i] : neighbour(edge, i, place);
            });
        }
    }

    void edge_points(const Pass& pass, std::span<const Point<Real>> edge, std::span<Point<Real>> next) const {
        for (Index q = 0; q < pass.segments; ++q) {
            if (!is_sharp(pass.sharpness.of_segment(e_, q))) {
                next[2 * q + 1] = smooth_edge_point<Real>(edge[q], edge[q + 1], beside(0, q), beside(1, q));
                continue;
            }
            next[2 * q + 1] = apply_mask<Real>(pass.edge_mask(e_, q), pass.options.weights, [&](int place) {
                return place < 2 ? edge[q + place] : beside(place - 2, q);
            });
        }
    }

    // Segments from the edge to the row: the first of a line, so the upright face comes first.
    Row<Real> next_row(int side, std::span<const Point<Real>> edge, const RowEnds<Real>& ends) const {
        const Row<Real>& row = rows_[side];
        const std::size_t n = row.size();
        const auto at = [&](std::size_t k) { return side == 0 ? edge[k] : edge[n - k]; };
        Row<Real> out;
        out.reserve(2 * n);
        for (std::size_t k = 0; k < n; ++k) {
            out.push_back(k == 0 ? ends.first
                                 : smooth_edge_point<Real>(at(k), row[k], at(k + 1), row[k - 1]));
            out.push_back(k + 1 == n ? ends.last
                                     : smooth_edge_point<Real>(at(k + 1), row[k], at(k), row[k + 1]));
        }
        return out;
    }

    const Topology& t_;
    Index e_;
    int sides_;
    std::array<std::size_t, 2> place_{};  // of the edge in the rings of its ends
    std::array<Row<Real>, 2> rows_;
};

// -- Patches.

// The inside of the next level of a closed lattice of n segments.
template <class Real>
void refine_inside(const Points<Real>& before, Index n, Points<Real>& after) {
    const auto at = [&](Index i, Index j) -> const Point<Real>& { return before[row_begin(n, j) + i]; };
    const auto edge_point = [&](const Point<Real>& a, const Point<Real>& b, bool upright,
                                const Point<Real>& up, const Point<Real>& inverted) {
        return upright ? smooth_edge_point<Real>(a, b, up, inverted)
                       : smooth_edge_point<Real>(a, b, inverted, up);
    };
    for (Index row = 1; row + 1 < 2 * n; ++row) {
        Point<Real>* out = after.data() + row_begin(2 * n, row);
        const Index j = row / 2;
        for (Index column = 1; column + row < 2 * n; ++column) {
            const Index i = column / 2;
            if (row % 2 == 0 && column % 2 == 0) {
                const int start = ring_start(i, j);
                out[column] = regular_vertex_point<Real>(at(i, j), [&](int place) {
                    const auto [di, dj] = kSixths[(start + place) % 6];
                    return at(i + di, j + dj);
                });
            } else if (row % 2 == 0) {
                out[column] =
                    edge_point(at(i, j), at(i + 1, j), upright_first(j, i), at(i, j + 1), at(i + 1, j - 1));
            } else if (column % 2 == 0) {
                out[column] =
                    edge_point(at(i, j), at(i, j + 1), upright_first(i, j), at(i + 1, j), at(i - 1, j + 1));
            } else {
                out[column] = edge_point(at(i + 1, j), at(i, j + 1), upright_first(i + j + 1, j), at(i, j),
                                         at(i + 1, j + 1));
            }
        }
    }
}

}  // namespace

LatticeRefiner::LatticeRefiner(const TriangleMesh& mesh, const SchemeOptions& options, int level)
    : topology_(mesh.topology()), options_(options), order_(mesh.topology(), level) {
    sharpness_.emplace_back(control_sharpness(mesh, options.boundary));
    for (int l = 0; l < level; ++l) sharpness_.push_back(sharpness_.back().next(topology_, options.creasing));
}

Result<LatticeRefiner> LatticeRefiner::make(const TriangleMesh& mesh, const SchemeOptions& options,
                                            int level) {
    constexpr std::int64_t kMost = std::numeric_limits<Index>::max();
    constexpr int kMostLevels = 15;  // one face has more corners than can be numbered at the next
    if (level <= kMostLevels) {
        const LatticeOrder order(mesh.topology(), level);
        if (order.vertex_count() <= kMost && 3 * order.face_count() <= kMost)
            return LatticeRefiner(mesh, options, level);
    }
    return fail(ErrorCode::TooLarge,
                fmt::format("Level {} has more vertices or corners of faces than 2^31 - 1.", level));
}

template <class Real>
LatticeRefiner::Skeleton<Real> LatticeRefiner::refine_skeleton(std::span<const Point<Real>> control) const {
    const int levels = order_.level();
    std::vector<Fan<Real>> fans{control_fan<Real>(topology_, control)};
    const auto pass = [&](int l) {
        return Pass{topology_, options_, sharpness_[l], sharpness_[l + 1], Index{1} << l};
    };
    for (int l = 0; l < levels; ++l) fans.push_back(next_fan<Real>(pass(l), fans.back()));

    Skeleton<Real> out{fans.back().centre, {}};
    const auto edges = static_cast<std::size_t>(topology_.edge_count());
    for (int l = 0; l <= levels; ++l) out.edges.emplace_back(edges * ((std::size_t{1} << l) + 1));
    for (std::size_t e = 0; e < edges; ++e) {
        const auto points = [&](int l) {
            const std::size_t size = (std::size_t{1} << l) + 1;
            return std::span(out.edges[l]).subspan(e * size, size);
        };
        for (int end = 0; end < 2; ++end) points(0)[end] = control[topology_.edge_ends[e][end]];
        Strip<Real> strip(topology_, static_cast<Index>(e));
        strip.start(fans[0]);
        for (int l = 0; l < levels; ++l) strip.step(pass(l), fans[l + 1], points(l), points(l + 1));
    }
    return out;
}

template <class Real>
void LatticeRefiner::refine_face(const Skeleton<Real>& skeleton, Index f, Patch<Real>& patch) const {
    for (int l = 0; l <= order_.level(); ++l) {
        const Index n = Index{1} << l;
        std::swap(patch.before, patch.points);
        patch.points.resize(closed_size(n));
        for (int c = 0; c < 3; ++c) {
            const Index e = topology_.face_edges[f][c];
            const bool along = topology_.edge_faces[e][0] == f;
            const Point<Real>* edge =
                skeleton.edges[l].data() + static_cast<std::size_t>(e) * (n + std::size_t{1});
            for (Index at = 0; at < n; ++at) {
                const std::array<std::array<Index, 2>, 3> place{{{at, 0}, {n - at, at}, {0, n - at}}};
                const auto [i, j] = place[c];
                patch.points[row_begin(n, j) + i] = edge[along ? at : n - at];
            }
        }
        if (l > 0) refine_inside<Real>(patch.before, n / 2, patch.points);
    }
}

template <class Real>
void LatticeRefiner::refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined) const {
    const Skeleton<Real> skeleton = refine_skeleton<Real>(control);
    const Index n = order_.segments();
    std::copy(skeleton.vertices.begin(), skeleton.vertices.end(), refined.begin());
    for (Index e = 0; e < topology_.edge_count(); ++e) {
        const auto begin = skeleton.edges.back().begin() + e * (n + std::ptrdiff_t{1});
        std::copy(begin + 1, begin + n, refined.begin() + order_.first_of_edge(e));
    }
    Patch<Real> patch;
    for (Index f = 0; f < topology_.face_count(); ++f) {
        refine_face(skeleton, f, patch);
        auto out = refined.begin() + order_.first_of_face(f);
        for (Index j = 1; j + 1 < n; ++j) {
            const auto row = patch.points.begin() + static_cast<std::ptrdiff_t>(row_begin(n, j));
            out = std::copy(row + 1, row + (n - j), out);
        }
    }
}

void LatticeRefiner::triangles(std::span<Triangle> faces) const {
    const Index n = order_.segments();
    auto out = faces.begin();
    for (Index f = 0; f < topology_.face_count(); ++f)
        for (std::int64_t t = 0; t < std::int64_t{n} * n; ++t) {
            const auto corners = corners_of(triangle_at(n, t));
            for (int c = 0; c < 3; ++c)
                (*out)[c] = static_cast<Index>(order_.vertex_at(topology_, f, corners[c][0], corners[c][1]));
            ++out;
        }
}

template void LatticeRefiner::refine<float>(std::span<const Point<float>>, std::span<Point<float>>) const;
template void LatticeRefiner::refine<double>(std::span<const Point<double>>, std::span<Point<double>>) const;
template LatticeRefiner::Skeleton<float> LatticeRefiner::refine_skeleton<float>(
    std::span<const Point<float>>) const;
template LatticeRefiner::Skeleton<double> LatticeRefiner::refine_skeleton<double>(
    std::span<const Point<double>>) const;
template void LatticeRefiner::refine_face<float>(const Skeleton<float>&, Index, Patch<float>&) const;
template void LatticeRefiner::refine_face<double>(const Skeleton<double>&, Index, Patch<double>&) const;

}  // namespace loopcheck::core
