#include "core/bspline/subdivide.h"

#include <map>

namespace loopcheck::core {
namespace {

// A row of a matrix as a point of a curve: what is done to points is done to rows, and gives the matrix.
struct Row {
    using value_type = Rational;
    std::map<Index, Rational> weights;

    friend Row operator+(Row a, const Row& b) {
        for (const auto& [column, weight] : b.weights) a.weights[column] += weight;
        return a;
    }
    friend Row operator*(const Rational& s, Row a) {
        for (auto& entry : a.weights) entry.second *= s;
        return a;
    }
    friend Row operator-(const Row& a, const Row& b) { return a + Rational(-1) * b; }
};

}  // namespace

double point_count(const CurveShape& shape, std::size_t control_points, int level) {
    auto n = static_cast<double>(control_points);
    for (int l = 0; l < level; ++l) switch (shape.ends) {
            case Ends::Natural:
                n = 2 * n - 1;
                break;
            case Ends::Closed:
                n = 2 * n;
                break;
            case Ends::Open:
            case Ends::Clamped:
                n = 2 * n - shape.degree;  // as many more as there are intervals, n - degree
                break;
        }
    return n;
}

Result<SparseMatrix> subdivision_matrix(const CurveShape& shape, std::size_t point_count) {
    std::vector<Row> unit(point_count);
    for (std::size_t i = 0; i < point_count; ++i) unit[i].weights[static_cast<Index>(i)] = 1;
    const auto curve = Curve<Row>::make(std::move(unit), shape);
    if (!curve) return tl::unexpected(curve.error());
    const auto rows =
        shape.ends == Ends::Clamped ? refine_knots(spline_of(*curve)).points : subdivide(*curve).points();
    SparseMatrix out;
    out.column_count = static_cast<Index>(point_count);
    for (const Row& row : rows) {
        for (const auto& [column, weight] : row.weights) {
            if (weight == 0) continue;
            out.columns.push_back(column);
            out.weights.push_back(static_cast<double>(weight));
        }
        out.offsets.push_back(out.columns.size());
    }
    return out;
}

}  // namespace loopcheck::core
