#include "core/loop/lattice/evaluator.h"

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/parallel.h"
#include "core/loop/lattice/split_order.h"
#include "core/loop/refine.h"

namespace loopcheck::core {
namespace {

// The rows, of which the one for place v is `row_at(v)`.
template <class Real, class RowAt>
GatherList<Real> list_of(const Rows& rows, Weights weights, RowAt&& row_at) {
    GatherList<Real> out;
    std::vector<std::uint32_t> weights_of_mask;
    for (const auto& mask : weights_of<Real>(rows, weights)) {
        weights_of_mask.push_back(static_cast<std::uint32_t>(out.weights.size()));
        out.weights.insert(out.weights.end(), mask.begin(), mask.end());
    }
    out.offsets.push_back(0);
    for (std::size_t v = 0; v < rows.row_count(); ++v) {
        const std::size_t row = row_at(v);
        const auto columns = rows.columns_of(row);
        out.columns.insert(out.columns.end(), columns.begin(), columns.end());
        out.offsets.push_back(static_cast<std::uint32_t>(out.columns.size()));
        out.first_weight.push_back(weights_of_mask[static_cast<std::size_t>(rows.mask_of_row[row])]);
    }
    return out;
}

}  // namespace

template <class Real>
Result<LatticeEvaluator<Real>> LatticeEvaluator<Real>::make(const TriangleMesh& mesh,
                                                            const SchemeOptions& options, int level) {
    auto refiner = LatticeRefiner::make(mesh, options, level);
    if (!refiner) return tl::unexpected(refiner.error());
    LatticeEvaluator out(std::move(*refiner));
    if (level > kListLevels) return out;
    SchemeLevel before = control_level(mesh, options.boundary);
    for (int l = 1; l <= level; ++l) {
        auto step = next_level(before, options);
        if (!step) return tl::unexpected(step.error());
        // The order of `split` in between, by address at the end.
        const LatticeOrder order(mesh.topology(), l);
        const SplitOrder split(mesh.topology(), l);
        out.lists_.push_back(list_of<Real>(step->rows, options.weights, [&](std::size_t v) {
            if (l < level) return v;
            const auto address = order.address_of(static_cast<std::int64_t>(v));
            return static_cast<std::size_t>(split.vertex(address));
        }));
        before = std::move(step->child);
    }
    return out;
}

template <class Real>
void LatticeEvaluator<Real>::refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined,
                                    int threads) const {
    if (lists_.empty()) return refiner_.refine<Real>(control, refined, threads);
    constexpr Index kRows = 2048;
    PaddedPoints<Real> points(control.size()), next;
    for (Index v = 0; v < static_cast<Index>(control.size()); ++v) points[v] = load_point<Real>(control, v);
    for (const GatherList<Real>& list : lists_) {
        const bool is_last = &list == &lists_.back();
        if (!is_last) next.resize(list.first_weight.size());
        for_ranges(static_cast<Index>(list.first_weight.size()), kRows, threads,
                   [&](Index first, Index last) {
                       if (is_last)
                           gather<Real>(list, points.data(), first, last,
                                        &refined[static_cast<std::size_t>(first)].x);
                       else
                           gather<Real>(list, points.data(), first, last, next.data() + first);
                   });
        std::swap(points, next);
    }
}

template class LatticeEvaluator<float>;
template class LatticeEvaluator<double>;

}  // namespace loopcheck::core
