#include "core/loop/stencils.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::Observed;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// The positions of the rows, and sum |w| |x|, in 38 digits.
struct Applied {
    Points<HighPrecision> points;
    std::vector<std::array<double, 3>> size;
};
Applied applied(const SparseMatrix& matrix, std::span<const glm::dvec3> positions) {
    Applied out;
    for (Index i = 0; i < matrix.row_count(); ++i) {
        std::array<HighPrecision, 3> sum{};
        std::array<double, 3> size{};
        for (std::size_t k = matrix.offsets[i]; k < matrix.offsets[i + 1]; ++k)
            for (int c = 0; c < 3; ++c) {
                const double x = positions[matrix.columns[k]][c];
                sum[c] += HighPrecision(matrix.weights[k]) * x;
                size[c] += std::abs(matrix.weights[k] * x);
            }
        out.points.push_back({sum[0], sum[1], sum[2]});
        out.size.push_back(size);
    }
    return out;
}

class StencilsOfEveryModel : public testing::TestWithParam<std::string> {};

// Applied to the control points they are the refined points: off by one rounding a weight.
TEST_P(StencilsOfEveryModel, AreTheRefinementAndTheLimit) {
    constexpr int kLevel = 2;
    const auto model = tests::load_model(GetParam());
    const auto steps = tests::steps_of(model.mesh, model.options, kLevel);
    const auto exact = tests::positions_of<HighPrecision>(steps, model.options.weights, model.mesh).back();
    const auto matrix = stencils(model.mesh, model.options, kLevel, StencilOf::Vertex, kNoLimit).value();
    ASSERT_EQ(matrix.row_count(), static_cast<Index>(exact.size()));
    const auto got = applied(matrix, model.mesh.positions());
    Observed use(model.name + ": |rows times control points - exact| / (u sum |w x|)", "vertex", 1);
    for (std::size_t v = 0; v < exact.size(); ++v) {
        const auto add = [&](const HighPrecision& a, const HighPrecision& b, double size) {
            // Of the 38 digits, 30 are left after two levels.
            use.add(tests::share_of(static_cast<double>(abs(HighPrecision(a - b))),
                                    size * tests::kRoundoff<double> + 1e-30 * size),
                    static_cast<std::int64_t>(v));
        };
        add(got.points[v].x, exact[v].x, got.size[v][0]);
        add(got.points[v].y, exact[v].y, got.size[v][1]);
        add(got.points[v].z, exact[v].z, got.size[v][2]);
    }
    use.check();

    const auto limit = stencils(model.mesh, model.options, kLevel, StencilOf::VertexLimit, kNoLimit).value();
    const auto limit_points = applied(limit, model.mesh.positions());
    const auto in_double = limits<double>(model.mesh, model.options, kLevel).value().levels.back().positions;
    // Two rows of refinement and one of the limit, each of at most 361 terms.
    Observed off(model.name + ": limit rows against `limits`, over u M", "vertex", 3 * 400);
    for (std::size_t v = 0; v < in_double.size(); ++v)
        off.add(tests::error_of_value(in_double[v].x, limit_points.points[v].x) /
                    (tests::kRoundoff<double> * model.mesh.largest_coordinate()),
                static_cast<std::int64_t>(v));
    off.check();
    Observed sums(model.name + ": row sums, u sum |w|", "matrix", 1);
    sums.add(row_sum_error(matrix, 0, matrix.row_count(), 1), 0);
    sums.add(row_sum_error(limit, 0, limit.row_count(), 1), 1);
    sums.check();
}

INSTANTIATE_TEST_SUITE_P(Models, StencilsOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(Stencils, OfLevelZeroAreTheIdentity) {
    const auto mesh = tests::mesh_of(tests::wheel(4));
    const auto matrix = stencils(mesh, {}, 0, StencilOf::Vertex, kNoLimit).value();
    EXPECT_EQ(matrix.columns, (std::vector<Index>{0, 1, 2, 3, 4}));
    EXPECT_EQ(matrix.weights, std::vector<double>(5, 1.0));
}

TEST(Stencils, AreRefusedBeforeTheyAreTooMany) {
    const auto mesh = tests::mesh_of(tests::wheel(6));
    EXPECT_TRUE(stencils(mesh, {}, 2, StencilOf::Vertex, 10000));
    EXPECT_EQ(stencils(mesh, {}, 2, StencilOf::Vertex, 50).error().code, ErrorCode::OutOfMemory);
    EXPECT_EQ(stencils(mesh, {}, 0, StencilOf::VertexLimit, 5).error().code, ErrorCode::OutOfMemory);
}

TEST(RowSumError, SeesAWeightThatIsOff) {
    SparseMatrix matrix{2, {0, 2}, {0, 1}, {0.5, 0.5}};
    EXPECT_EQ(row_sum_error(matrix, 0, 1, 1), 0);
    matrix.weights[1] += 0x1p-50;
    EXPECT_NEAR(row_sum_error(matrix, 0, 1, 1), 8, 1e-9);
    EXPECT_GT(row_sum_error(matrix, 0, 1, 0), 1e15);
}

TEST(MatrixMarket, ReadsBackToTheSameBits) {
    const auto mesh = tests::mesh_of(tests::bipyramid(7));
    const auto matrix = stencils(mesh, {}, 1, StencilOf::VertexLimit, kNoLimit).value();
    std::istringstream in(matrix_market(matrix, "two\nlines"));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "%%MatrixMarket matrix coordinate real general");
    std::getline(in, line);
    EXPECT_EQ(line, "% two");
    std::getline(in, line);
    EXPECT_EQ(line, "% lines");
    std::size_t rows = 0, columns = 0, weights = 0;
    in >> rows >> columns >> weights;
    EXPECT_EQ(rows, static_cast<std::size_t>(matrix.row_count()));
    EXPECT_EQ(columns, static_cast<std::size_t>(mesh.vertex_count()));
    ASSERT_EQ(weights, matrix.weights.size());
    for (std::size_t k = 0; k < weights; ++k) {
        Index row = 0, column = 0;
        double weight = 0;
        in >> row >> column >> weight;
        EXPECT_LT(matrix.offsets[row - 1], k + 1);
        EXPECT_GT(matrix.offsets[row], k);
        EXPECT_EQ(column - 1, matrix.columns[k]);
        EXPECT_EQ(weight, matrix.weights[k]);
    }
    EXPECT_FALSE(in >> line);
}

TEST(AsMatrix, HasARowForEveryDerivative) {
    const auto mesh = tests::mesh_of(tests::bipyramid(7));
    LimitSurface<HighPrecision> surface(mesh, {});
    const auto matrix = as_matrix(surface.stencil(3, HighPrecision(0.25), HighPrecision(0.5)).value(), 9);
    EXPECT_EQ(matrix.row_count(), kDerivatives);
    EXPECT_EQ(matrix.column_count, 9);
    EXPECT_LE(row_sum_error(matrix, 0, 1, 1), 1);
    EXPECT_LE(row_sum_error(matrix, 1, kDerivatives, 0), 1);
}

}  // namespace
}  // namespace loopcheck::core
