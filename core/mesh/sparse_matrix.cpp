#include "core/mesh/sparse_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/high_precision.h"
#include "core/mesh/io/number.h"

namespace loopcheck::core {

double row_sum_error(const SparseMatrix& matrix, Index first_row, Index end_row, double wanted) {
    double largest = 0;
    for (Index i = first_row; i < end_row; ++i) {
        HighPrecision sum = 0, size = 0;
        for (std::size_t k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k) {
            sum += matrix.weights[k];
            size += std::abs(matrix.weights[k]);
        }
        const double off = static_cast<double>(abs(HighPrecision(sum - wanted)));
        if (off == 0) continue;
        largest = std::max(largest, off / (static_cast<double>(size) * 0x1p-53));
    }
    return largest;
}

std::string matrix_market(const SparseMatrix& matrix, std::string_view comment) {
    std::string out = "%%MatrixMarket matrix coordinate real general\n% ";
    for (const char c : comment) {
        out += c;
        if (c == '\n') out += "% ";
    }
    out += fmt::format("\n{} {} {}\n", matrix.row_count(), matrix.column_count, matrix.weights.size());
    for (Index i = 0; i < matrix.row_count(); ++i)
        for (std::size_t k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k)
            out += fmt::format("{} {} {}\n", i + 1, matrix.columns[k] + 1, shortest(matrix.weights[k]));
    return out;
}

}  // namespace loopcheck::core
