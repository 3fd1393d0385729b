// Stencils: the vertices of a level, or their limits, as rows over the control vertices.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/loop/evaluate.h"

namespace loopcheck::core {

/// A sparse matrix by rows; the columns of a row ascend.
struct SparseMatrix {
    Index column_count = 0;
    std::vector<std::size_t> offsets{0};
    std::vector<Index> columns;
    std::vector<double> weights;

    Index row_count() const { return static_cast<Index>(offsets.size()) - 1; }
};

/// What the rows stand for.
enum class StencilOf : std::uint8_t { Vertex, VertexLimit };

/// A row for every vertex of level `level`, in the order of `refine`: its position, or the limit of it, over
/// the control vertices.
///
/// Error    the rows of all levels are multiplied in 38 digits and rounded once.  Weights below 10^-33 of the
///          largest in their row are zero in truth and left out.
///
/// Errors   TooLarge; OutOfMemory, before it is allocated, where a step could have more than `most_weights`.
///
/// Laws     1. every row sums to 1; 2. applied to the control positions they give what `refine` and `limits`
///          give, up to rounding.
Result<SparseMatrix> stencils(const TriangleMesh& mesh, const SchemeOptions& options, int level, StencilOf of,
                              double most_weights);

/// Peak memory of `stencils` per weight, in bytes: two levels of them in 38 digits, with their columns.
inline constexpr double kStencilBytesPerWeight = 140;

/// The six rows of a point of the limit surface, by `Derivative`.
SparseMatrix as_matrix(const SurfaceStencil<HighPrecision>& stencil, Index control_vertices);

/// The largest |row sum - wanted| in units of roundoff, each over sum |w| of its row, summed without
/// rounding. At most 1/2 for rows whose weights are rounded once.
double row_sum_error(const SparseMatrix& matrix, Index first_row, Index end_row, double wanted);

/// The matrix in the coordinate format of Matrix Market: real, general, counted from 1, each weight with the
/// shortest digits that read back to the same bits.  `comment` goes into lines that start with %.
std::string matrix_market(const SparseMatrix& matrix, std::string_view comment);

}  // namespace loopcheck::core
