#include "core/loop/error_bound.h"

#include <cmath>

namespace loopcheck::core {
namespace {

// The bound is itself computed in double, from exact positions rounded to double: m + 8 roundings a level,
// that is less than 1e-9 of it for any row of fewer than 10^6 terms.
constexpr double kRoundUp = 1 + 1e-9;

}  // namespace

Bounds control_bounds(std::span<const glm::dvec3> positions, Precision precision) {
    Bounds out(positions.size(), glm::dvec3(0));
    if (precision == Precision::Float)
        for (std::size_t v = 0; v < out.size(); ++v)
            for (int i = 0; i < 3; ++i)
                out[v][i] =
                    std::abs(static_cast<double>(static_cast<float>(positions[v][i])) - positions[v][i]);
    return out;
}

glm::dvec3 row_bound(std::span<const double> weights, std::span<const double> sizes, int ulps,
                     const RowBase& base, Precision precision) {
    const auto terms = static_cast<double>(base.columns.size());
    const double g = rounding_of(terms + ulps, precision);
    glm::dvec3 carried(0), size(0);
    for (std::size_t j = 0; j < base.columns.size(); ++j)
        for (int i = 0; i < 3; ++i) {
            const double inherited = base.bounds[base.columns[j]][i];
            carried[i] += std::abs(weights[j]) * inherited;
            size[i] += sizes[j] * (std::abs(base.exact[base.columns[j]][i]) + inherited);
        }
    glm::dvec3 bound;
    for (int i = 0; i < 3; ++i)
        bound[i] = (carried[i] + g * size[i]) * kRoundUp + terms * smallest_subnormal(precision);
    return bound;
}

Bounds next_bounds(const Rows& rows, Weights weights, std::span<const glm::dvec3> exact_parent,
                   const Bounds& parent, Precision precision) {
    const auto table = weights_of<double>(rows, weights);
    auto sizes = table;
    for (auto& row : sizes)
        for (double& w : row) w = std::abs(w);
    Bounds out;
    out.reserve(rows.row_count());
    for (std::size_t row = 0; row < rows.row_count(); ++row) {
        const RowBase base{rows.columns_of(row), exact_parent, parent};
        const Index mask = rows.mask_of_row[row];
        out.push_back(base.columns.size() == 1
                          ? parent[base.columns[0]]
                          : row_bound(table[mask], sizes[mask], weight_ulps(rows.masks[mask], weights), base,
                                      precision));
    }
    return out;
}

}  // namespace loopcheck::core
