#include "core/loop/lattice/limits.h"

#include <algorithm>

#include "core/loop/lattice/parallel.h"
#include "core/loop/lattice/patch.h"
#include "core/loop/lattice/stream.h"
#include "core/loop/sublevel.h"

namespace loopcheck::core {
namespace {

Index edge_between(const Topology& t, Index a, Index b) {
    const auto ring = t.ring(a);
    return *std::find_if(ring.begin(), ring.end(), [&](Index e) { return t.other_end(e, a) == b; });
}

}  // namespace

template <class Real>
LatticeLimits<Real>::LatticeLimits(LatticeRefiner refiner)
    : refiner_(std::move(refiner)), pattern_(refiner_.order().segments()) {
    const Topology& t = refiner_.topology();
    const Masks& regular = *masks_of_star(Star{6, false, false, {}});
    regular_ = {regular.position.front(), regular.position.back(), regular.tangent2[1]};
    const SchemeLevel control = control_level(*refiner_.mesh_, refiner_.options_.boundary);
    of_vertex_.resize(static_cast<std::size_t>(t.vertex_count));
    for (Index v = 0; v < t.vertex_count; ++v) find_vertex_masks(control, v);
    of_edge_.resize(static_cast<std::size_t>(t.edge_count()));
    if (refiner_.order().level() > 0)
        for (Index e = 0; e < t.edge_count(); ++e) find_edge_masks(control, e);
}

template <class Real>
Result<LatticeLimits<Real>> LatticeLimits<Real>::make(const TriangleMesh& mesh, const SchemeOptions& options,
                                                      int level) {
    auto refiner = LatticeRefiner::make(mesh, options, level);
    if (!refiner) return tl::unexpected(refiner.error());
    return LatticeLimits(std::move(*refiner));
}

// -- Masks.

template <class Real>
LimitWeights<Real> LatticeLimits<Real>::first_sector(const LimitMasks<Real>& masks) {
    if (masks.sectors.empty()) return {masks.position, {}, {}};
    return {masks.position, masks.sectors.front().tangent1, masks.sectors.front().tangent2};
}

template <class Real>
const LimitWeights<Real>* LatticeLimits<Real>::masks_of_star(const Star& star) {
    auto& found = by_star_[star];
    if (!found)
        found =
            std::make_unique<const Masks>(first_sector(limit_masks<Real>(star, refiner_.options_.weights)));
    return found.get();
}

template <class Real>
void LatticeLimits<Real>::find_vertex_masks(const SchemeLevel& control, Index v) {
    const Topology& t = refiner_.topology();
    const LatticeSharpness& sharpness = refiner_.sharpness_[refiner_.order().level()];
    const auto ring = t.ring(v);
    Star star{static_cast<int>(ring.size()), t.is_boundary_vertex(v), is_sharp(sharpness.of_vertex(v)), {}};
    bool is_settled = !is_semi_sharp(sharpness.of_vertex(v));
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const float s = sharpness.at_end(ring[i], t.edge_ends[ring[i]][0] == v ? 0 : 1);
        if (is_sharp(s)) star.sharp.push_back(static_cast<int>(i));
        is_settled &= !is_semi_sharp(s);
    }
    of_vertex_[v] =
        is_settled ? masks_of_star(star)
                   : &semi_sharp_vertices_.emplace(v, semi_sharp_masks(control, {v})).first->second.front();
}

template <class Real>
void LatticeLimits<Real>::find_edge_masks(const SchemeLevel& control, Index e) {
    const Topology& t = refiner_.topology();
    const LatticeSharpness& sharpness = refiner_.sharpness_[refiner_.order().level()];
    if (!sharpness.is_even(e) || is_semi_sharp(sharpness.of_segment(e, 0))) {
        semi_sharp_edges_.emplace(e, semi_sharp_masks(control, {t.edge_ends[e][0], t.edge_ends[e][1]}));
        return;
    }
    const bool open = t.is_boundary_edge(e);
    Star star{open ? 4 : 6, open, false, {}};
    if (is_sharp(sharpness.of_segment(e, 0))) star.sharp = {0, 3};
    of_edge_[e] = masks_of_star(star);
}

// Of points on one edge, or of one vertex: what lies around them passes through the levels by itself.
template <class Real>
std::vector<LimitWeights<Real>> LatticeLimits<Real>::semi_sharp_masks(const SchemeLevel& control,
                                                                      std::vector<Index> points) const {
    const SchemeOptions& options = refiner_.options_;
    const auto part_around = [&](const SchemeLevel& level) {
        SubLevel part = sublevel_around(level.topology, level.sharpness,
                                        vertices_to_keep(level.topology, points, options.creasing));
        std::copy_n(part.kept.begin(), points.size(), points.begin());
        return part;
    };
    SubLevel part = part_around(control);
    for (int l = 0; l < refiner_.order().level(); ++l) {
        const Topology& t = part.level.topology;
        std::vector<Index> next{points.front()};
        for (std::size_t i = 1; i < points.size(); ++i) {
            next.push_back(t.vertex_count + edge_between(t, points[i - 1], points[i]));
            next.push_back(points[i]);
        }
        points = std::move(next);
        part = part_around(next_level(part.level, options).value().child);  // a part is never too large
    }
    LimitTable<Real> table(part.level, options);
    std::vector<Masks> out;
    for (const Index v : points) out.push_back(first_sector(table.masks(v)));
    return out;
}

// -- Points.

template <class Real>
void LatticeLimits<Real>::evaluate(std::span<const Point<Real>> control, std::span<Point<Real>> positions,
                                   std::span<Point<Real>> normals, int threads) const {
    const Topology& t = refiner_.topology();
    const int level = order().level();
    const Index n = order().segments();
    const LatticeSource<Real> from = refiner_.source<Real>(control);
    FanPoints<Real> fans(level);
    EdgePoints<Real> points(level);
    fans.hold_all(t);
    points.hold_all(t);
    const auto put = [&](const Masks& masks, const PaddedPoints<Real>& ring, std::int64_t v) {
        PaddedPoint<Real> position, normal;
        limit_of_ring<Real>(ring.data(), masks, position, normal);
        positions[static_cast<std::size_t>(v)] = position;
        normals[static_cast<std::size_t>(v)] = normal;
    };

    for_ranges(t.vertex_count, grain(1), threads, [&](Index first, Index last) {
        Fan<Real> fan(from);
        PaddedPoints<Real> ring;
        for (Index v = first; v < last; ++v) {
            fan.run(v, level, fans);
            ring.resize(fan.ring().size() + 1);
            std::copy(fan.ring().begin(), fan.ring().end(), ring.data());
            ring[fan.ring().size()] = fan.centre();
            put(*of_vertex_[v], ring, v);
        }
    });
    if (level == 0) return;
    for_ranges(t.edge_count(), grain(n), threads, [&](Index first, Index last) {
        Strip<Real> strip(from);
        PaddedPoints<Real> ring(7);
        for (Index e = first; e < last; ++e) {
            strip.run(e, level, fans, points);
            const std::vector<Masks>* own = of_edge_[e] == nullptr ? &semi_sharp_edges_.at(e) : nullptr;
            const int size = t.is_boundary_edge(e) ? 4 : 6;
            for (Index i = 1; i < n; ++i) {
                for (int place = 0; place < size; ++place) ring[place] = strip.neighbour(i, place);
                ring[size] = strip.neighbour(i, Strip<Real>::kSelf);
                put(own == nullptr ? *of_edge_[e] : (*own)[i], ring, order().first_of_edge(e) + i - 1);
            }
        }
    });
    if (order().inside_of_face() == 0) return;
    for_ranges(t.face_count(), grain(order().inside_of_face()), threads, [&](Index first, Index last) {
        FacePatch<Real> patch(t, pattern_, level);
        const std::size_t row = kPacked * static_cast<std::size_t>(n) + 1;
        Outbox<Real> out(kPacked * positions.size(), row), out_normals(kPacked * normals.size(), row);
        const auto begin = static_cast<std::size_t>(order().first_of_face(first));
        out.begin(&positions[begin].x);
        out_normals.begin(&normals[begin].x);
        for (Index f = first; f < last; ++f) {
            patch.run(control, f, points);
            for (Index j = 1; j + 1 < n; ++j) {
                limits_of_row<Real>(patch.last(), pattern_, j, regular_, out.end(), out_normals.end());
                out.advance(out.end() + kPacked * (n - j - 1));
                out_normals.advance(out_normals.end() + kPacked * (n - j - 1));
            }
        }
        out.flush();
        out_normals.flush();
    });
}

template class LatticeLimits<float>;
template class LatticeLimits<double>;

}  // namespace loopcheck::core
