#include "core/loop/lattice/refiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/loop/lattice/parallel.h"
#include "core/loop/lattice/patch.h"
#include "core/loop/lattice/skeleton.h"
#include "core/loop/lattice/stream.h"

namespace loopcheck::core {
namespace {

void keep_once(std::vector<Index>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::size_t closed_size(Index segments) {
    return (static_cast<std::size_t>(segments) + 1) * (static_cast<std::size_t>(segments) + 2) / 2;
}

}  // namespace

LatticeRefiner::LatticeRefiner(const TriangleMesh& mesh, const SchemeOptions& options, int level)
    : mesh_(&mesh),
      options_(options),
      order_(mesh.topology(), level),
      sharpness_(mesh, options, level),
      smooth_({mesh.topology(), options.weights}, {mesh.topology(), options.weights}),
      pattern_(Index{1} << std::max(0, level - 1)) {}

Result<LatticeRefiner> LatticeRefiner::make(const TriangleMesh& mesh, const SchemeOptions& options,
                                            int level) {
    if (level <= kMostLevels) return LatticeRefiner(mesh, options, level);
    return fail(ErrorCode::TooLarge, fmt::format("Level {} is beyond {}, where one face has {} vertices.",
                                                 level, kMostLevels, closed_size(Index{1} << kMostLevels)));
}

template <class Real>
void LatticeRefiner::refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined,
                            int threads) const {
    const Topology& t = topology();
    const int level = order_.level();
    if (level == 0) {
        std::copy(control.begin(), control.end(), refined.begin());
        return;
    }
    const LatticeSource<Real> from = source<Real>(control);
    const Index n = order_.segments();
    FanPoints<Real> fans(level - 1);
    EdgePoints<Real> points(level - 1);
    fans.hold_all(t);
    points.hold_all(t);

    for_ranges(t.vertex_count, grain(1), threads, [&](Index first, Index last) {
        Fan<Real> fan(from);
        for (Index v = first; v < last; ++v) {
            fan.run(v, level, fans);
            refined[static_cast<std::size_t>(v)] = fan.centre();
        }
    });
    for_ranges(t.edge_count(), grain(n), threads, [&](Index first, Index last) {
        Strip<Real> strip(from);
        for (Index e = first; e < last; ++e) {
            strip.run(e, level, fans, points);
            auto out = refined.begin() + order_.first_of_edge(e);
            for (const PaddedPoint<Real>& q : strip.edge().subspan(1, static_cast<std::size_t>(n) - 1))
                *out++ = q;
        }
    });
    if (order_.inside_of_face() == 0) return;
    for_ranges(t.face_count(), grain(order_.inside_of_face()), threads, [&](Index first, Index last) {
        FacePatch<Real> patch(t, pattern_, level - 1);
        const auto rows_at_once =
            std::max<Index>(1, static_cast<Index>(kBlockBytes / sizeof(Point<Real>)) / (2 * n));
        Outbox<Real> out(
            kPacked * refined.size(),
            kPacked * 2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(rows_at_once) + 1);
        out.begin(&refined[static_cast<std::size_t>(order_.first_of_face(first))].x);
        for (Index f = first; f < last; ++f) {
            patch.run(control, f, points);
            for (Index j = 0; j < n / 2; j += rows_at_once)
                out.advance(refine_rows<Real>(patch.last(), pattern_, j, std::min(n / 2, j + rows_at_once),
                                              out.end()));
        }
        out.flush();
    });
}

template <class Real>
void LatticeRefiner::refine_by_face(std::span<const Point<Real>> control, FaceRange faces,
                                    const FaceVisitor<Real>& visit) const {
    const Topology& t = topology();
    const int level = order_.level();
    const Index n = order_.segments();
    const LatticeSource<Real> from = source<Real>(control);
    FanPoints<Real> fans(level);
    EdgePoints<Real> points(level);
    Fan<Real> fan(from);
    Strip<Real> strip(from);
    FacePatch<Real> patch(t, pattern_, level);
    Points<Real> packed(closed_size(n));
    std::vector<Index> corners, edges, around;
    // So many faces at once that few fans and strips are run again for the next.
    const Index block = std::max<Index>(1, (Index{1} << 15) / n / n);
    for (Index begin = faces.first; begin < faces.last; begin += block) {
        const Index end = std::min(faces.last, begin + block);
        corners.clear(), edges.clear(), around.clear();
        for (Index f = begin; f < end; ++f) {
            corners.insert(corners.end(), t.triangles[f].begin(), t.triangles[f].end());
            edges.insert(edges.end(), t.face_edges[f].begin(), t.face_edges[f].end());
        }
        keep_once(corners);
        keep_once(edges);
        for (const Index v : corners) around.insert(around.end(), t.ring(v).begin(), t.ring(v).end());
        keep_once(around);
        fans.hold(corners, around, t);
        points.hold(edges, t);
        for (const Index v : corners) fan.run(v, level, fans);
        for (const Index e : edges) strip.run(e, level, fans, points);
        for (Index f = begin; f < end; ++f) {
            patch.run(control, f, points);
            auto out = packed.begin();
            for (Index j = 0; j <= n; ++j)
                for (Index i = 0; i + j <= n; ++i) *out++ = patch.last().row(j)[i];
            visit(f, packed);
        }
    }
}

#define LOOPCHECK_INSTANCES(Real)                                                                         \
    template void LatticeRefiner::refine<Real>(std::span<const Point<Real>>, std::span<Point<Real>>, int) \
        const;                                                                                            \
    template void LatticeRefiner::refine_by_face<Real>(std::span<const Point<Real>>, FaceRange,           \
                                                       const FaceVisitor<Real>&) const;
LOOPCHECK_INSTANCES(float)
LOOPCHECK_INSTANCES(double)
#undef LOOPCHECK_INSTANCES

}  // namespace loopcheck::core
