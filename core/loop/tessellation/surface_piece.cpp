#include "core/loop/tessellation/surface_piece.h"

namespace loopcheck::core {
namespace {

glm::dvec3 sum_of(const PatchPoint& point, std::span<const glm::dvec3> positions) {
    glm::dvec3 sum(0);
    for (int i = 0; i < point.count; ++i)
        sum += static_cast<double>(point.terms[i].second) * positions[point.terms[i].first];
    return sum;
}

QuarticTriangle quartic_of(const Patch& patch, std::span<const glm::dvec3> positions) {
    std::array<glm::dvec3, kPatchPoints> points;
    for (int p = 0; p < kPatchPoints; ++p) points[p] = sum_of(patch[p], positions);
    return quartic_triangle(points);
}

// The corner and the other ends of its edges, from the face on in both directions, each up to the first
// infinitely sharp edge.
void add_influence(const SchemeLevel& level, Index face, int corner, std::span<const glm::dvec3> positions,
                   std::vector<glm::dvec3>& hull) {
    const Topology& t = level.topology;
    const Index v = t.triangles[face][corner];
    const auto ring = t.ring(v);
    const std::size_t n = ring.size();
    std::size_t last = 0;
    while (ring[last] != t.face_edges[face][previous_corner(corner)]) ++last;
    const auto is_wall = [&](std::size_t i) { return is_infinite(level.sharpness.edge[ring[i]]); };
    std::size_t count = 2;  // the two edges of the face, and `last` is the second of them
    while (count < n && !is_wall(last)) {
        last = (last + 1) % n;
        ++count;
    }
    std::size_t first = (last + n + 1 - count) % n;
    while (count < n && !is_wall(first)) {
        first = (first + n - 1) % n;
        ++count;
    }
    hull.push_back(positions[v]);
    for (std::size_t i = 0; i < count; ++i) hull.push_back(positions[t.other_end(ring[(first + i) % n], v)]);
}

}  // namespace

SurfacePiece::SurfacePiece(const SchemeLevel& level, std::span<const glm::dvec3> positions, Index face,
                           Creasing creasing) {
    auto around = std::make_unique<Around>(Around{face_part(level, face, creasing), {}});
    for (const Index v : around->part.part.vertices) around->positions.push_back(positions[v]);
    if (around->part.patch)
        surface_ = quartic_of(*around->part.patch, around->positions);
    else
        surface_ = std::move(around);
}

std::array<SurfacePiece, 4> SurfacePiece::children(const SchemeOptions& options) const {
    if (const auto* quartic = std::get_if<QuarticTriangle>(&surface_)) {
        const auto child = [&](int k) { return SurfacePiece(restricted(*quartic, kChildTriangles[k])); };
        return {child(0), child(1), child(2), child(3)};
    }
    const Around& around = *std::get<std::unique_ptr<Around>>(surface_);
    const Step step = next_level(around.part.part.level, options).value();  // never too large: a few faces
    const auto positions = apply<double>(step.rows, options.weights, around.positions);
    const auto child = [&](int k) {
        return SurfacePiece(step.child, positions, 4 * around.part.face + k, options.creasing);
    };
    return {child(0), child(1), child(2), child(3)};
}

void SurfacePiece::add_hull(const SubTriangle& within, std::vector<glm::dvec3>& hull) const {
    if (const auto* quartic = std::get_if<QuarticTriangle>(&surface_)) {
        const QuarticTriangle part = restricted(*quartic, within);
        for (const SubTriangle& child : kChildTriangles) {
            const auto points = restricted(part, child).points;
            hull.insert(hull.end(), points.begin(), points.end());
        }
        return;
    }
    const Around& around = *std::get<std::unique_ptr<Around>>(surface_);
    for (int i = 0; i < 3; ++i)
        add_influence(around.part.part.level, around.part.face, i, around.positions, hull);
}

glm::dvec3 CornerLimits::at(const SurfacePiece& piece, int corner) {
    if (const auto* quartic = std::get_if<QuarticTriangle>(&piece.surface_)) return quartic->corner(corner);
    const auto& around = *std::get<std::unique_ptr<SurfacePiece::Around>>(piece.surface_);
    const SchemeLevel& level = around.part.part.level;
    const Index v = around.part.corners()[corner];
    const auto position = [&](const LimitMasks<double>& masks) {
        return sum_over_ring<double>(level.topology, v, masks.position, around.positions);
    };
    const CornerView& view = around.part.views[corner];
    if (!view.settled) return position(LimitTable<double>(level, options_).masks(v));
    auto found = masks_.find(view.star);
    if (found == masks_.end())
        found = masks_.emplace(view.star, limit_masks<double>(view.star, options_.weights)).first;
    return position(found->second);
}

}  // namespace loopcheck::core
