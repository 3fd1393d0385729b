#include "compare/limit/oracle.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using core::Index;
using core::Precision;
using glm::dvec3;

dvec3 high_part(const DoubleDouble3& p) {
    return {p[0].high, p[1].high, p[2].high};
}

double largest_weight(const std::vector<HighPrecision>& weights) {
    double out = 0;
    for (const auto& w : weights) out = std::max(out, std::abs(static_cast<double>(w)));
    return out;
}

}  // namespace

dvec3 distance_from_exact(const ExactLimit& exact, const dvec3& p) {
    return glm::abs((p - exact.position) - exact.position_rest);
}

LimitOracle::VertexRows LimitOracle::rows_of(const core::LimitMasks<HighPrecision>& masks) {
    const auto add = [](Row& row, const std::vector<HighPrecision>& weights, std::size_t place, double size) {
        row.places.push_back(static_cast<int>(place));
        row.weights.push_back(to_double_double(weights[place]));
        row.rounded.push_back(row.weights.back().high);
        row.sizes.push_back(size);
    };
    VertexRows out;
    for (std::size_t i = 0; i < masks.position.size(); ++i)
        if (masks.position[i] != 0)
            add(out.position, masks.position, i, std::abs(static_cast<double>(masks.position[i])));
    if (masks.sectors.empty()) {
        out.no_normal = core::NoNormal::Isolated;
        return out;
    }
    const auto& sector = masks.sectors.front();
    out.no_normal = sector.no_normal;
    const double size1 = largest_weight(sector.tangent1), size2 = largest_weight(sector.tangent2);
    for (std::size_t i = 0; i < sector.tangent1.size(); ++i) {
        add(out.tangent1, sector.tangent1, i, size1);
        add(out.tangent2, sector.tangent2, i, size2 > 0 ? size2 : size1);
    }
    return out;
}

const LimitOracle::VertexRows& LimitOracle::rows_for(const core::LimitMasks<HighPrecision>& masks) {
    const auto found = rows_.find(&masks);
    return found != rows_.end() ? found->second : rows_.emplace(&masks, rows_of(masks)).first->second;
}

DoubleDouble3 LimitOracle::sum(Index v, const Row& row) {
    const core::Topology& t = level_.scheme.topology;
    const auto ring = t.ring(v);
    columns_.clear();
    DoubleDouble3 out;
    for (std::size_t j = 0; j < row.places.size(); ++j) {
        const auto place = static_cast<std::size_t>(row.places[j]);
        const Index column = place < ring.size() ? t.other_end(ring[place], v) : v;
        columns_.push_back(column);
        for (int i = 0; i < 3; ++i)
            add_product(out[i], row.weights[j], {level_.exact[column][i], level_.exact_rest[column][i]});
    }
    return out;
}

dvec3 LimitOracle::bound(const Row& row, int ulps, Precision precision) const {
    return core::row_bound(row.rounded, row.sizes, ulps, {columns_, level_.exact, level_.bound(precision)},
                           precision);
}

ExactLimit LimitOracle::limit(Index v, const core::LimitMasks<HighPrecision>& masks, Precision precision) {
    const VertexRows& rows = rows_for(masks);
    ExactLimit out;
    const DoubleDouble3 position = sum(v, rows.position);
    out.position = high_part(position);
    out.position_rest = {position[0].low, position[1].low, position[2].low};
    out.bound = columns_.size() == 1 ? level_.bound(precision)[v]
                                     : bound(rows.position, core::kLimitWeightUlps, precision);
    out.no_normal = rows.no_normal;
    if (rows.tangent1.places.empty()) return out;
    const DoubleDouble3 tangent1 = sum(v, rows.tangent1);
    const dvec3 bound1 = bound(rows.tangent1, core::kTangentWeightUlps, precision);
    const DoubleDouble3 tangent2 = sum(v, rows.tangent2);
    out.tangent2_bound = bound(rows.tangent2, core::kTangentWeightUlps, precision);
    out.plane = plane_of(tangent1, tangent2, bound1, out.tangent2_bound);
    return out;
}

}  // namespace loopcheck::compare
