#include "compare/surface/row_difference.h"

#include <cmath>
#include <numeric>

#include "core/loop/error_bound.h"

namespace loopcheck::compare {

int order_of(core::Derivative derivative) {
    if (derivative == core::Derivative::Position) return 0;
    return derivative <= core::Derivative::Dv ? 1 : 2;
}

core::SurfaceRows difference(const core::SurfaceRows& tested, const core::SurfaceStencil<double>& exact) {
    core::SurfaceRows out;
    const auto put = [&](const auto* a, std::size_t i, const auto* b, std::size_t j) {
        out.columns.push_back(a ? a->columns[i] : b->columns[j]);
        for (int d = 0; d < core::kDerivatives; ++d)
            out.weights[d].push_back((a ? a->weights[d][i] : 0) - (b ? b->weights[d][j] : 0));
    };
    const core::SurfaceRows* const no_tested = nullptr;
    const core::SurfaceStencil<double>* const no_exact = nullptr;
    std::size_t i = 0, j = 0;
    while (i < tested.columns.size() || j < exact.columns.size()) {
        const bool first =
            j == exact.columns.size() || (i < tested.columns.size() && tested.columns[i] < exact.columns[j]);
        if (first) {
            put(&tested, i++, no_exact, 0);
        } else if (i == tested.columns.size() || exact.columns[j] < tested.columns[i]) {
            put(no_tested, 0, &exact, j++);
        } else {
            put(&tested, i++, &exact, j++);
        }
    }
    return out;
}

double size_of(const std::vector<double>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.,
                           [](double sum, double w) { return sum + std::abs(w); });
}

double unbalance_of(const std::vector<double>& weights) {
    return std::abs(std::accumulate(weights.begin(), weights.end(), 0.));
}

double larger(double a, double b) {
    return std::isnan(a) || a >= b ? a : b;
}

double allowed_rounding(const core::SurfaceStencil<double>& exact, core::Derivative derivative) {
    return kRoundingShares * exact.weight_error[static_cast<int>(derivative)] *
           core::unit_roundoff(core::Precision::Double);
}

}  // namespace loopcheck::compare
