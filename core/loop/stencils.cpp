#include "core/loop/stencils.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace loopcheck::core {
namespace {

using High = HighPrecision;

struct Entry {
    Index column;
    High weight;
};

// Rows over the control vertices, in 38 digits.
struct HighRows {
    std::vector<std::size_t> offsets{0};
    std::vector<Entry> entries;

    std::span<const Entry> row(Index i) const {
        return {entries.data() + offsets[i], offsets[i + 1] - offsets[i]};
    }
    std::size_t size_of(Index i) const { return offsets[i + 1] - offsets[i]; }
};

// Sums rows, one at a time, by scattering them over all columns.
class RowSum {
  public:
    explicit RowSum(Index columns) : values_(columns, High(0)), used_(columns, 0) {}

    void add(const High& weight, std::span<const Entry> row) {
        if (weight == 0) return;
        for (const Entry& e : row) {
            if (!used_[e.column]) touched_.push_back(e.column);
            used_[e.column] = 1;
            values_[e.column] += weight * e.weight;
        }
    }
    void finish_into(HighRows& out) {
        std::sort(touched_.begin(), touched_.end());
        for (const Index c : touched_) {
            out.entries.push_back({c, values_[c]});
            values_[c] = 0;
            used_[c] = 0;
        }
        touched_.clear();
        out.offsets.push_back(out.entries.size());
    }

  private:
    std::vector<High> values_;
    std::vector<std::uint8_t> used_;
    std::vector<Index> touched_;
};

HighRows identity(Index count) {
    HighRows out;
    for (Index v = 0; v < count; ++v) {
        out.entries.push_back({v, High(1)});
        out.offsets.push_back(out.entries.size());
    }
    return out;
}

HighRows product(const Rows& rows, Weights weights, const HighRows& parent, Index columns) {
    const auto table = weights_of<High>(rows, weights);
    HighRows out;
    RowSum sum(columns);
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const auto vertices = rows.columns_of(i);
        for (std::size_t j = 0; j < vertices.size(); ++j)
            sum.add(table[rows.mask_of_row[i]][j], parent.row(vertices[j]));
        sum.finish_into(out);
    }
    return out;
}

// What a product can have at the most: as if no two of its columns were the same.
double most_weights_of(const Rows& rows, const HighRows& parent) {
    double count = 0;
    for (const Index v : rows.columns) count += static_cast<double>(parent.size_of(v));
    return count;
}
double most_limit_weights(const Topology& t, const HighRows& rows) {
    double count = 0;
    for (Index v = 0; v < t.vertex_count; ++v) {
        count += static_cast<double>(rows.size_of(v));
        for (const Index e : t.ring(v)) count += static_cast<double>(rows.size_of(t.other_end(e, v)));
    }
    return count;
}

HighRows limit_rows(const SchemeLevel& level, const SchemeOptions& options, const HighRows& rows,
                    Index columns) {
    LimitTable<High> table(level, options);
    HighRows out;
    RowSum sum(columns);
    for (Index v = 0; v < level.topology.vertex_count; ++v) {
        const auto& weights = table.masks(v).position;
        const auto ring = level.topology.ring(v);
        for (std::size_t i = 0; i <= ring.size(); ++i)
            sum.add(weights[i], rows.row(i < ring.size() ? level.topology.other_end(ring[i], v) : v));
        sum.finish_into(out);
    }
    return out;
}

SparseMatrix rounded(const HighRows& rows, Index columns) {
    const High kNoise("1e-33");
    SparseMatrix out;
    out.column_count = columns;
    for (std::size_t i = 0; i + 1 < rows.offsets.size(); ++i) {
        const auto row = rows.row(static_cast<Index>(i));
        High largest = 0;
        for (const Entry& e : row) largest = std::max(largest, High(abs(e.weight)));
        for (const Entry& e : row) {
            if (abs(e.weight) <= largest * kNoise) continue;
            out.columns.push_back(e.column);
            out.weights.push_back(static_cast<double>(e.weight));
        }
        out.offsets.push_back(out.columns.size());
    }
    return out;
}

std::optional<Error> too_many(double weights, double most, int level) {
    if (weights <= most) return std::nullopt;
    return Error{ErrorCode::OutOfMemory,
                 fmt::format("The stencils of level {} may have {:.3g} weights; {:.3g} fit into memory.",
                             level, weights, most)};
}

}  // namespace

Result<SparseMatrix> stencils(const TriangleMesh& mesh, const SchemeOptions& options, int level, StencilOf of,
                              double most_weights) {
    const Index columns = mesh.vertex_count();
    HighRows rows = identity(columns);
    SchemeLevel scheme = control_level(mesh, options.boundary);
    for (int l = 0; l < level; ++l) {
        auto step = next_level(scheme, options);
        if (!step) return tl::unexpected(step.error());
        if (auto error = too_many(most_weights_of(step->rows, rows), most_weights, l + 1))
            return tl::unexpected(*error);
        rows = product(step->rows, options.weights, rows, columns);
        scheme = std::move(step->child);
    }
    if (of == StencilOf::VertexLimit) {
        if (auto error = too_many(most_limit_weights(scheme.topology, rows), most_weights, level))
            return tl::unexpected(*error);
        rows = limit_rows(scheme, options, rows, columns);
    }
    return rounded(rows, columns);
}

SparseMatrix as_matrix(const SurfaceStencil<HighPrecision>& stencil, Index control_vertices) {
    HighRows rows;
    for (const auto& weights : stencil.weights) {
        for (std::size_t j = 0; j < weights.size(); ++j)
            rows.entries.push_back({stencil.columns[j], weights[j]});
        rows.offsets.push_back(rows.entries.size());
    }
    return rounded(rows, control_vertices);
}

}  // namespace loopcheck::core
