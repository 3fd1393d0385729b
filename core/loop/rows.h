// One level of refinement as a sparse matrix: a row of (parent vertex, weight) for every refined vertex.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/loop/masks.h"
#include "core/loop/sharpness.h"
#include "core/mesh/point.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The rows of one level, made once from topology, rules and sharpness.  The weights themselves are made from
/// the masks in whatever scalar type is asked for.
struct Rows {
    std::vector<std::size_t> offsets;  ///< refined vertices + 1 entries into `columns`
    std::vector<Index> columns;        ///< parent vertices, in the order in which they are summed
    std::vector<Index> mask_of_row;    ///< index into `masks`
    std::vector<Mask> masks;           ///< the different masks that occur

    std::size_t row_count() const { return mask_of_row.size(); }
    std::span<const Index> columns_of(std::size_t row) const {
        return {columns.data() + offsets[row], offsets[row + 1] - offsets[row]};
    }
    const Mask& mask(std::size_t row) const { return masks[mask_of_row[row]]; }
};

/// The rows that lead from a level to the next, in the order of `split`: vertex points, then edge points.
/// `halves` is `half_edge_sharpness` of the same level.
Rows make_rows(const Topology& topology, const Sharpness& sharpness,
               std::span<const std::array<float, 2>> halves, const SchemeOptions& options);

/// The weights of every mask in `rows.masks`.
template <class Scalar>
std::vector<std::vector<Scalar>> weights_of(const Rows& rows, Weights weights) {
    std::vector<std::vector<Scalar>> out;
    out.reserve(rows.masks.size());
    for (const Mask& mask : rows.masks) out.push_back(weights_of<Scalar>(mask, weights));
    return out;
}

/// The refined positions: p'_i = sum_j w_ij p_j, summed from zero in the order of the columns.
///
/// In float and double that order is OpenSubdiv's, and so are the bits.
template <class Scalar>
Points<Scalar> apply(const Rows& rows, Weights weights, std::span<const Point<Scalar>> positions) {
    const auto table = weights_of<Scalar>(rows, weights);
    Points<Scalar> out;
    out.reserve(rows.row_count());
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const auto& w = table[rows.mask_of_row[i]];
        const auto columns = rows.columns_of(i);
        Scalar x(0), y(0), z(0);
        for (std::size_t j = 0; j < columns.size(); ++j) {
            const auto& p = positions[columns[j]];
            x += w[j] * p.x;
            y += w[j] * p.y;
            z += w[j] * p.z;
        }
        out.push_back({x, y, z});
    }
    return out;
}

}  // namespace loopcheck::core
