#include "core/loop/lattice/refiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

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

// The same for masks that most vertices have, without the mask as data.
template <class Real>
Point<Real> crease_edge_point(const Point<Real>& a, const Point<Real>& b) {
    constexpr Real half = Real(1) / 2;
    Point<Real> sum(0);
    sum += half * a;
    sum += half * b;
    return sum;
}

template <class Real>
Point<Real> crease_vertex_point(const Point<Real>& a, const Point<Real>& b, const Point<Real>& vertex) {
    constexpr Real side = Real(1) / 8, centre = Real(3) / 4;
    Point<Real> sum(0);
    sum += side * a;
    sum += side * b;
    sum += centre * vertex;
    return sum;
}

// Of smooth vertices: the weight of a neighbour and that of the vertex, by valence.
template <class Real>
class SmoothWeights {
  public:
    SmoothWeights(const Topology& topology, Weights weights) {
        for (Index v = 0; v < topology.vertex_count; ++v) {
            const std::size_t n = topology.ring(v).size();
            if (n < 2) continue;
            if (n >= by_valence_.size()) by_valence_.resize(n + 1, {Real(0), Real(0)});
            if (by_valence_[n][1] != 0) continue;
            const auto all = weights_of<Real>(Mask{.ring = static_cast<int>(n)}, weights);
            by_valence_[n] = {all.front(), all.back()};
        }
    }
    const std::array<Real, 2>& operator[](std::size_t n) const { return by_valence_[n]; }

  private:
    std::vector<std::array<Real, 2>> by_valence_;
};

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

    // The edge point of segment q of edge e, with ends a and b; `beyond(side)` is opposite it in a face.
    template <class Real, class Beyond>
    Point<Real> edge_point(Index e, Index q, const Point<Real>& a, const Point<Real>& b,
                           Beyond&& beyond) const {
        const float s = sharpness.of_segment(e, q);
        if (!is_sharp(s)) return smooth_edge_point<Real>(a, b, beyond(0), beyond(1));
        if (is_infinite(s)) return crease_edge_point<Real>(a, b);
        const Mask mask = edge_point_mask(s, {child.of_segment(e, 2 * q), child.of_segment(e, 2 * q + 1)},
                                          options.crease_share);
        return apply_mask<Real>(mask, options.weights, [&](int place) {
            return place < 2 ? (place == 0 ? a : b) : beyond(place - 2);
        });
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
class FanStep {
  public:
    FanStep(const Pass& pass, const Fan<Real>& fan, const SmoothWeights<Real>& smooth)
        : pass_(pass), t_(pass.topology), fan_(fan), smooth_(smooth) {}

    Fan<Real> run() {
        Fan<Real> out;
        out.centre.reserve(fan_.centre.size());
        out.ring.reserve(fan_.ring.size());
        for (Index v = 0; v < t_.vertex_count; ++v) {
            const auto edges = t_.ring(v);
            const std::span<const Point<Real>> ring(fan_.ring.data() + t_.ring_offsets[v], edges.size());
            out.centre.push_back(vertex_point(v, edges, ring));
            for (std::size_t i = 0; i < edges.size(); ++i)
                out.ring.push_back(edge_point(v, edges[i], ring, i));
        }
        return out;
    }

  private:
    Point<Real> vertex_point(Index v, std::span<const Index> edges, std::span<const Point<Real>> ring) {
        sharp_.clear();
        bool is_smooth = !is_sharp(pass_.sharpness.of_vertex(v));
        for (const Index e : edges) {
            sharp_.push_back(pass_.sharpness.at_end(e, end_of(t_, e, v)));
            is_smooth &= !is_sharp(sharp_.back());
        }
        if (is_smooth) {
            const auto& [side, centre] = smooth_[ring.size()];
            Point<Real> sum(0);
            for (const Point<Real>& p : ring) sum += side * p;
            sum += centre * fan_.centre[v];
            return sum;
        }
        child_sharp_.clear();
        for (const Index e : edges) child_sharp_.push_back(pass_.child.at_end(e, end_of(t_, e, v)));
        const Mask mask = vertex_point_mask(pass_.sharpness.of_vertex(v), sharp_, child_sharp_);
        return apply_mask<Real>(mask, pass_.options.weights, [&](int place) {
            return place == mask.ring ? fan_.centre[v] : ring[static_cast<std::size_t>(place)];
        });
    }

    Point<Real> edge_point(Index v, Index e, std::span<const Point<Real>> ring, std::size_t i) const {
        const int end = end_of(t_, e, v);
        const auto beyond = [&](int side) { return opposite<Real>(ring, i, end, side); };
        return pass_.edge_point<Real>(e, end == 0 ? 0 : pass_.segments - 1, fan_.centre[v], ring[i], beyond);
    }

    const Pass& pass_;
    const Topology& t_;
    const Fan<Real>& fan_;
    const SmoothWeights<Real>& smooth_;
    std::vector<float> sharp_, child_sharp_;  // of the vertex at hand
};

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
    explicit Strip(const Topology& topology) : t_(topology) {}

    void start(Index e, const Fan<Real>& fan) {
        e_ = e;
        sides_ = t_.is_boundary_edge(e) ? 1 : 2;
        for (int end = 0; end < 2; ++end) {
            const auto ring = t_.ring(t_.edge_ends[e][end]);
            place_[end] = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), e) - ring.begin());
        }
        for (int side = 0; side < sides_; ++side) rows_[side].assign(1, ends(fan, side).first);
    }

    // From the points `edge` to those of the next level, `next`.
    void step(const Pass& pass, const Fan<Real>& next_fan, std::span<const Point<Real>> edge,
              std::span<Point<Real>> next) {
        const Index n = pass.segments;
        next[0] = next_fan.centre[t_.edge_ends[e_][0]];
        next[2 * n] = next_fan.centre[t_.edge_ends[e_][1]];
        vertex_points(pass, edge, next);
        edge_points(pass, edge, next);
        for (int side = 0; side < sides_; ++side) advance_row(side, edge, ends(next_fan, side));
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
            if (is_infinite(sharp[0]) && is_infinite(sharp[3])) {
                next[2 * i] = crease_vertex_point<Real>(edge[i + 1], edge[i - 1], edge[i]);
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
        for (Index q = 0; q < pass.segments; ++q)
            next[2 * q + 1] =
                pass.edge_point<Real>(e_, q, edge[q], edge[q + 1], [&](int side) { return beside(side, q); });
    }

    // Segments from the edge to the row: the first of a line, so the upright face comes first.
    void advance_row(int side, std::span<const Point<Real>> edge, const RowEnds<Real>& ends) {
        Row<Real>& row = rows_[side];
        const std::size_t n = row.size();
        const auto at = [&](std::size_t k) -> const Point<Real>& {
            return side == 0 ? edge[k] : edge[n - k];
        };
        spare_.resize(2 * n);
        spare_.front() = ends.first;
        spare_.back() = ends.last;
        for (std::size_t k = 0; k + 1 < n; ++k) {
            spare_[2 * k + 1] = smooth_edge_point<Real>(at(k + 1), row[k], at(k), row[k + 1]);
            spare_[2 * k + 2] = smooth_edge_point<Real>(at(k + 1), row[k + 1], at(k + 2), row[k]);
        }
        std::swap(row, spare_);
    }

    const Topology& t_;
    Index e_ = 0;
    int sides_ = 2;
    std::array<std::size_t, 2> place_{};  // of the edge in the rings of its ends
    std::array<Row<Real>, 2> rows_;
    Row<Real> spare_;
};

// -- Patches.

// The edge point of a and b between the upright face with `up` opposite and the inverted one with `down`.
template <class Real>
Point<Real> inner_edge_point(const Point<Real>& a, const Point<Real>& b, bool upright, const Point<Real>& up,
                             const Point<Real>& down) {
    return smooth_edge_point<Real>(a, b, upright ? up : down, upright ? down : up);
}

// Row 2 j of the next level, without its ends: vertex points of row j and the edge points between them.
template <class Real>
void even_row(const Point<Real>* below, const Point<Real>* row, const Point<Real>* above, Index j, Index end,
              Point<Real>* out) {
    for (Index column = 1; column < end; ++column) {
        const Index i = column / 2;
        if (column % 2 == 1) {
            out[column] =
                inner_edge_point<Real>(row[i], row[i + 1], upright_first(j, i), above[i], below[i + 1]);
            continue;
        }
        // By direction in sixths of a turn.
        const std::array<const Point<Real>*, 6> around{row + i + 1, above + i, above + i - 1,
                                                       row + i - 1, below + i, below + i + 1};
        int direction = ring_start(i, j);
        out[column] = regular_vertex_point<Real>(row[i], [&](int) -> const Point<Real>& {
            const Point<Real>& neighbour = *around[direction];
            direction = direction == 5 ? 0 : direction + 1;
            return neighbour;
        });
    }
}

// Row 2 j + 1, without its ends: the edge points between rows j and j + 1.
template <class Real>
void odd_row(const Point<Real>* row, const Point<Real>* above, Index j, Index end, Point<Real>* out) {
    for (Index column = 1; column < end; ++column) {
        const Index i = column / 2;
        out[column] =
            column % 2 == 0
                ? inner_edge_point<Real>(row[i], above[i], upright_first(i, j), row[i + 1], above[i - 1])
                : inner_edge_point<Real>(row[i + 1], above[i], upright_first(i + j + 1, j), row[i],
                                         above[i + 1]);
    }
}

// The inside of the next level of a closed lattice of n segments.
template <class Real>
void refine_inside(const Points<Real>& before, Index n, Points<Real>& after) {
    const auto row_of = [&](Index j) { return before.data() + row_begin(n, j); };
    for (Index row = 1; row + 1 < 2 * n; ++row) {
        const Index j = row / 2, end = 2 * n - row;
        Point<Real>* out = after.data() + row_begin(2 * n, row);
        if (row % 2 == 0)
            even_row<Real>(row_of(j - 1), row_of(j), row_of(j + 1), j, end, out);
        else
            odd_row<Real>(row_of(j), row_of(j + 1), j, end, out);
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
    const SmoothWeights<Real> smooth(topology_, options_.weights);
    for (int l = 0; l < levels; ++l) {
        const Pass step = pass(l);
        fans.push_back(FanStep<Real>(step, fans.back(), smooth).run());
    }

    Skeleton<Real> out{fans.back().centre, {}};
    const auto edges = static_cast<std::size_t>(topology_.edge_count());
    for (int l = 0; l <= levels; ++l) out.edges.emplace_back(edges * ((std::size_t{1} << l) + 1));
    Strip<Real> strip(topology_);
    for (std::size_t e = 0; e < edges; ++e) {
        const auto points = [&](int l) {
            const std::size_t size = (std::size_t{1} << l) + 1;
            return std::span(out.edges[l]).subspan(e * size, size);
        };
        for (int end = 0; end < 2; ++end) points(0)[end] = control[topology_.edge_ends[e][end]];
        strip.start(static_cast<Index>(e), fans[0]);
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
    std::vector<Index> row, above;
    // The vertices of row j, of which those between the ends are numbered in turn.
    const auto fill = [&](std::vector<Index>& vertices, Index f, Index j) {
        const Index last = n - j;
        vertices.resize(static_cast<std::size_t>(last) + 1);
        vertices[0] = static_cast<Index>(order_.vertex_at(topology_, f, 0, j));
        vertices[last] = static_cast<Index>(order_.vertex_at(topology_, f, last, j));
        if (j == 0)
            for (Index i = 1; i < last; ++i)
                vertices[i] = static_cast<Index>(order_.vertex_at(topology_, f, i, 0));
        else if (last > 1)
            std::iota(vertices.begin() + 1, vertices.end() - 1,
                      static_cast<Index>(order_.index_of({LatticeAddress::Kind::Face, f, 1, j})));
    };
    for (Index f = 0; f < topology_.face_count(); ++f) {
        fill(row, f, 0);
        for (Index j = 0; j < n; ++j) {
            fill(above, f, j + 1);
            for (Index i = 0; i + j + 1 < n; ++i) {
                *out++ = {row[i], row[i + 1], above[i]};
                *out++ = {above[i + 1], above[i], row[i + 1]};
            }
            *out++ = {row[n - j - 1], row[n - j], above[n - j - 1]};
            std::swap(row, above);
        }
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
