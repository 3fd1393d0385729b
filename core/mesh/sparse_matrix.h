// A sparse matrix, and its Matrix Market file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// A sparse matrix by rows; the columns of a row ascend.
struct SparseMatrix {
    Index column_count = 0;
    std::vector<std::size_t> offsets{0};
    std::vector<Index> columns;
    std::vector<double> weights;

    Index row_count() const { return static_cast<Index>(offsets.size()) - 1; }
};

/// The largest |row sum - wanted| in units of roundoff, each over sum |w| of its row, summed without
/// rounding. At most 1/2 for rows whose weights are rounded once.
double row_sum_error(const SparseMatrix& matrix, Index first_row, Index end_row, double wanted);

/// The matrix in the coordinate format of Matrix Market: real, general, counted from 1, each weight with the
/// shortest digits that read back to the same bits.  `comment` goes into lines that start with %.
std::string matrix_market(const SparseMatrix& matrix, std::string_view comment);

}  // namespace loopcheck::core
