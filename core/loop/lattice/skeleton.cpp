#include "core/loop/lattice/skeleton.h"

#include <algorithm>

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/sums.h"
#include "core/loop/mask_choice.h"

namespace loopcheck::core {
namespace {

// The weighted sum of a mask over `point_at(place)`.
template <class Real, class PointAt>
Quad<Real> apply_mask(const Mask& mask, Weights weights, PointAt&& point_at) {
    const auto w = weights_of<Real>(mask, weights);
    const auto places = places_of(mask);
    Quad<Real> sum{};
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * Quad<Real>(point_at(places[i]));
    return sum;
}

// The edge point of segment q of edge e at a level, with ends a and b and `beyond[side]` opposite it.
template <class Real>
Quad<Real> point_of_segment(const LatticeSource<Real>& source, int level, Index e, Index q,
                            const PaddedPoint<Real>& a, const PaddedPoint<Real>& b,
                            const std::array<const PaddedPoint<Real>*, 2>& beyond) {
    const LatticeSharpness& sharpness = source.sharpness[level];
    const float s = sharpness.of_segment(e, q);
    if (!is_sharp(s)) return smooth_edge_point<Real>(a, b, *beyond[0], *beyond[1]);
    if (is_infinite(s)) return crease_edge_point<Real>(a, b);
    const LatticeSharpness& child = source.sharpness[level + 1];
    const Mask mask = edge_point_mask(s, {child.of_segment(e, 2 * q), child.of_segment(e, 2 * q + 1)},
                                      source.options.crease_share);
    return apply_mask<Real>(mask, source.options.weights,
                            [&](int place) { return place < 2 ? (place == 0 ? a : b) : *beyond[place - 2]; });
}

}  // namespace

template <class Real>
void PointStore<Real>::make_room(std::size_t items) {
    if (items <= room_) return;
    // A quad at the last point reads one real more.
    reals_ =
        std::make_unique_for_overwrite<Real[]>(kPacked * items * static_cast<std::size_t>(points_each_) + 1);
    room_ = items;
}

template <class Real>
void PointStore<Real>::hold_all(Index count, std::ptrdiff_t points_each) {
    points_each_ = points_each;
    make_room(static_cast<std::size_t>(count));
}

template <class Real>
void PointStore<Real>::hold(std::span<const Index> items, Index count, std::ptrdiff_t points_each) {
    points_each_ = points_each;
    make_room(items.size());
    slots_.resize(static_cast<std::size_t>(count));
    for (std::size_t slot = 0; slot < items.size(); ++slot) slots_[items[slot]] = static_cast<Index>(slot);
}

template <class Real>
void FanPoints<Real>::hold_all(const Topology& topology) {
    vertices_.hold_all(topology.vertex_count, levels_);
    edges_.hold_all(topology.edge_count(), 2 * levels_);
}

template <class Real>
void FanPoints<Real>::hold(std::span<const Index> vertices, std::span<const Index> edges,
                           const Topology& topology) {
    vertices_.hold(vertices, topology.vertex_count, levels_);
    edges_.hold(edges, topology.edge_count(), 2 * levels_);
}

// -- Fans.

template <class Real>
void Fan<Real>::run(Index v, int level, FanPoints<Real>& points) {
    start(v);
    for (int l = 0; l < level; ++l) {
        const bool stored = l < points.levels();
        step(l, stored);
        if (stored) store(l + 1, points);
    }
}

template <class Real>
void Fan<Real>::start(Index v) {
    const Topology& t = source_.topology;
    vertex_ = v;
    edges_ = t.ring(v);
    ends_.clear();
    ring_.resize(edges_.size() + 2);
    next_ring_.resize(edges_.size() + 2);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const auto& ends = t.edge_ends[edges_[i]];
        const int end = ends[0] == v ? 0 : 1;
        ends_.push_back(end);
        ring_[i + 1] = load_point<Real>(source_.control, ends[1 - end]);
    }
    close_ring();
    centre_ = load_point<Real>(source_.control, v);
}

template <class Real>
void Fan<Real>::close_ring() {
    ring_[0] = ring_[edges_.size()];
    ring_[edges_.size() + 1] = ring_[1];
}

template <class Real>
void Fan<Real>::step(int level, bool with_ring) {
    if (with_ring && !source_.sharpness[level].has_sharp())
        refine_smooth_ring<Real>(centre_, ring_.data(), ends_, next_ring_.data());
    else if (with_ring)
        for (std::size_t i = 0; i < edges_.size(); ++i) next_ring_[i + 1] = edge_point(level, i);
    centre_ = vertex_point(level);
    if (with_ring) {
        std::swap(ring_, next_ring_);
        close_ring();
    }
}

template <class Real>
void Fan<Real>::store(int level, FanPoints<Real>& points) const {
    store_packed<Real>(centre_, points.vertex(vertex_, level));
    for (std::size_t i = 0; i < edges_.size(); ++i)
        store_packed<Real>(ring_[i + 1], points.next_to(edges_[i], ends_[i], level));
}

template <class Real>
PaddedPoint<Real> Fan<Real>::vertex_point(int level) {
    const LatticeSharpness& sharpness = source_.sharpness[level];
    bool is_smooth = true;
    if (sharpness.has_sharp()) {
        sharp_.clear();
        is_smooth = !is_sharp(sharpness.of_vertex(vertex_));
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            sharp_.push_back(sharpness.at_end(edges_[i], ends_[i]));
            is_smooth &= !is_sharp(sharp_.back());
        }
    }
    if (is_smooth) return smooth_vertex_point<Real>(centre_, ring(), source_.smooth[edges_.size()]);
    child_sharp_.clear();
    for (std::size_t i = 0; i < edges_.size(); ++i)
        child_sharp_.push_back(source_.sharpness[level + 1].at_end(edges_[i], ends_[i]));
    const Mask mask = vertex_point_mask(sharpness.of_vertex(vertex_), sharp_, child_sharp_);
    return apply_mask<Real>(mask, source_.options.weights, [&](int place) {
        return place == mask.ring ? centre_ : ring()[static_cast<std::size_t>(place)];
    });
}

// The first face of an edge is to its left as seen from its end 0.
template <class Real>
Quad<Real> Fan<Real>::edge_point(int level, std::size_t i) const {
    const PaddedPoint<Real>&left = ring_[i + 2], &right = ring_[i];
    const bool outward = ends_[i] == 0;
    return point_of_segment<Real>(source_, level, edges_[i], outward ? 0 : (Index{1} << level) - 1, centre_,
                                  ring_[i + 1], {outward ? &left : &right, outward ? &right : &left});
}

// -- Strips.

template <class Real>
void Strip<Real>::run(Index e, int level, const FanPoints<Real>& fans, EdgePoints<Real>& points) {
    const Topology& t = source_.topology;
    edge_number_ = e;
    sides_ = t.is_boundary_edge(e) ? 1 : 2;
    int l = std::min(fans.levels(), 1);
    if (l == 0) {
        take_control();
    } else {
        find_arms();
        take_level_1(fans);
        store(1, points);
    }
    for (; l < level; ++l) {
        step(l, fans);
        if (l < points.levels()) store(l + 1, points);
    }
}

template <class Real>
void Strip<Real>::store(int level, EdgePoints<Real>& points) const {
    Real* out = points.at(edge_number_, level, 0);
    for (std::size_t i = 0; i < edge_.size(); ++i, out += kPacked) store_packed<Real>(edge_[i], out);
}

template <class Real>
void Strip<Real>::take_control() {
    const Topology& t = source_.topology;
    edge_.resize(2);
    for (std::size_t end = 0; end < 2; ++end)
        edge_[end] = load_point<Real>(source_.control, t.edge_ends[edge_number_][end]);
    for (int side = 0; side < sides_; ++side) {
        const Index f = t.edge_faces[edge_number_][side];
        constexpr std::array<int, 3> kOpposite{2, 0, 1};
        rows_[side].resize(1);
        rows_[side][0] =
            load_point<Real>(source_.control, t.triangles[f][kOpposite[t.corner_of_edge(f, edge_number_)]]);
    }
}

template <class Real>
void Strip<Real>::find_arms() {
    const Topology& t = source_.topology;
    for (int side = 0; side < sides_; ++side) {
        const Index f = t.edge_faces[edge_number_][side];
        const int c = t.corner_of_edge(f, edge_number_);
        // The edge after this one in the face begins where this one ends, the one before ends where it
        // begins.
        const auto arm = [&](int corner, int end) {
            const Index edge = t.face_edges[f][corner % 3];
            return Arm{edge, t.edge_faces[edge][0] == f ? end : 1 - end};
        };
        arms_[side] = {arm(c + 2, 1), arm(c + 1, 0)};
        if (side == 1) std::swap(arms_[side][0], arms_[side][1]);
    }
}

// All of them come from fans.
template <class Real>
void Strip<Real>::take_level_1(const FanPoints<Real>& fans) {
    const auto& ends = source_.topology.edge_ends[edge_number_];
    edge_.resize(3);
    edge_[0] = load_quad<Real>(fans.vertex(ends[0], 1));
    edge_[1] = load_quad<Real>(fans.next_to(edge_number_, 0, 1));
    edge_[2] = load_quad<Real>(fans.vertex(ends[1], 1));
    for (int side = 0; side < sides_; ++side) {
        rows_[side].resize(2);
        for (std::size_t end = 0; end < 2; ++end) {
            const Arm& arm = arms_[side][end];
            rows_[side][end] = load_quad<Real>(fans.next_to(arm.edge, arm.end, 1));
        }
    }
}

template <class Real>
void Strip<Real>::step(int level, const FanPoints<Real>& fans) {
    const Index n = Index{1} << level;
    next_.resize(2 * static_cast<std::size_t>(n) + 1);
    const LatticeSharpness& sharpness = source_.sharpness[level];
    if (sharpness.is_even(edge_number_) && !is_sharp(sharpness.of_segment(edge_number_, 0))) {
        refine_smooth_edge<Real>(edge_.data(), rows_[0].data(), rows_[1].data(), n, next_.data());
    } else {
        vertex_points(level, n);
        edge_points(level, n);
    }
    if (level < fans.levels()) {
        for (int side = 0; side < sides_; ++side) advance_row(side, level, fans);
        const auto& ends = source_.topology.edge_ends[edge_number_];
        next_[0] = load_quad<Real>(fans.vertex(ends[0], level + 1));
        next_[2 * n] = load_quad<Real>(fans.vertex(ends[1], level + 1));
    }
    std::swap(edge_, next_);
}

template <class Real>
void Strip<Real>::vertex_points(int level, Index segments) {
    const LatticeSharpness &now = source_.sharpness[level], &child = source_.sharpness[level + 1];
    const Index e = edge_number_;
    const int ring = sides_ == 2 ? 6 : 4;
    std::array<float, 6> sharp{}, child_sharp{};
    for (Index i = 1; i < segments; ++i) {
        sharp[0] = now.of_segment(e, i);
        sharp[3] = now.of_segment(e, i - 1);
        const auto at = [&](int place) { return neighbour(i, place == ring ? kSelf : place); };
        if (!is_sharp(sharp[0]) && !is_sharp(sharp[3])) {
            next_[2 * i] = regular_vertex_point<Real>(edge_[i], at);
        } else if (is_infinite(sharp[0]) && is_infinite(sharp[3])) {
            next_[2 * i] = crease_vertex_point<Real>(edge_[i + 1], edge_[i - 1], edge_[i]);
        } else {
            child_sharp[0] = child.of_segment(e, 2 * i);
            child_sharp[3] = child.of_segment(e, 2 * i - 1);
            const auto size = static_cast<std::size_t>(ring);
            const Mask mask =
                vertex_point_mask(0, std::span(sharp).first(size), std::span(child_sharp).first(size));
            next_[2 * i] = apply_mask<Real>(mask, source_.options.weights, at);
        }
    }
}

template <class Real>
void Strip<Real>::edge_points(int level, Index segments) {
    for (Index q = 0; q < segments; ++q) {
        // A boundary edge is sharp for ever and reads nothing beside it.
        const PaddedPoint<Real>* second = sides_ == 2 ? &rows_[1][q] : nullptr;
        next_[2 * q + 1] = point_of_segment<Real>(source_, level, edge_number_, q, edge_[q], edge_[q + 1],
                                                  {&rows_[0][q], second});
    }
}

template <class Real>
void Strip<Real>::advance_row(int side, int level, const FanPoints<Real>& fans) {
    PaddedPoints<Real>& row = rows_[side];
    const std::size_t n = row.size();
    spare_.resize(2 * n);
    const auto near = [&](const Arm& arm) {
        return load_quad<Real>(fans.next_to(arm.edge, arm.end, level + 1));
    };
    spare_[0] = near(arms_[side][0]);
    spare_[2 * n - 1] = near(arms_[side][1]);
    refine_row_beside<Real>(edge_.data(), row.data(), static_cast<Index>(n), spare_.data());
    std::swap(row, spare_);
}

template class PointStore<float>;
template class PointStore<double>;
template class FanPoints<float>;
template class FanPoints<double>;
template class Fan<float>;
template class Fan<double>;
template class Strip<float>;
template class Strip<double>;

}  // namespace loopcheck::core
