#include "core/loop/error_bound.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::add_use;
using tests::bounds_of;
using tests::ExactLevels;
using tests::mesh_of;
using tests::Observed;
using tests::positions_of;
using tests::steps_of;

template <class Real>
constexpr Precision kPrecision = std::is_same_v<Real, float> ? Precision::Float : Precision::Double;

TEST(ControlBounds, AreTheRoundingOfEveryCoordinate) {
    const std::vector<glm::dvec3> positions{{0.1, 1, -1.0 / 3}, {1e-50, 0x1p-149, 1e30}};
    const auto bounds = control_bounds(positions, Precision::Float);
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (int i = 0; i < 3; ++i) {
            const HighPrecision x(positions[v][i]), rounded(static_cast<float>(positions[v][i]));
            EXPECT_EQ(HighPrecision(bounds[v][i]), abs(x - rounded)) << v << " " << i;
        }
    EXPECT_GT(bounds[0].x, 0);
    EXPECT_EQ(bounds[0].y, 0);
    EXPECT_EQ(bounds[1].x, 1e-50);
    EXPECT_EQ(bounds[1].y, 0);
}

TEST(ControlBounds, AreZeroInDouble) {
    const auto positions = tests::scattered(5);
    EXPECT_EQ(control_bounds(positions, Precision::Double), Bounds(5, glm::dvec3(0)));
}

// One row by hand: the midpoint of 1 and 3 has two terms and exact weights, so its bound is
// (E_0 + E_1)/2 + g(2) (1 + E_0 + 3 + E_1)/2 + 2 t; the corners keep theirs.
TEST(NextBounds, AreTheFormulaOnASingleTriangle) {
    MeshData data = tests::triangle();
    data.positions = {{1, 0, 0}, {3, 0, 0}, {0, 8, 0}};
    const auto mesh = mesh_of(std::move(data));
    const auto steps = steps_of(mesh, {}, 1);
    const Bounds parent{{0.25, 0, 0}, {0.5, 0, 0}, {0, 0, 0.125}};
    const auto bounds = next_bounds(steps[0].rows, Weights::Loop, mesh.positions(), parent, Precision::Float);
    for (int v = 0; v < 3; ++v) EXPECT_EQ(bounds[v], parent[v]);
    const double g = 0x1p-23 / (1 - 0x1p-23);
    const double expected = 0.375 + g * (4 + 0.75) / 2 + 2 * 0x1p-149;
    EXPECT_NEAR(bounds[3].x, expected, 2e-9 * expected);  // rounded up by 1e-9
    EXPECT_GE(bounds[3].x, expected);
    EXPECT_LE(bounds[3].y, 2 * 0x1p-149);
}

// How a row may be summed.

template <class Real>
using Terms = std::vector<std::pair<Real, Real>>;  // weight and coordinate

template <class Real>
Real reversed(const Terms<Real>& terms) {
    Real sum = 0;
    for (auto term = terms.rbegin(); term != terms.rend(); ++term) sum += term->first * term->second;
    return sum;
}

template <class Real>
Real pairwise(const Terms<Real>& terms) {
    std::vector<Real> sums;
    for (const auto& [w, x] : terms) sums.push_back(w * x);
    while (sums.size() > 1) {
        std::vector<Real> next;
        for (std::size_t i = 0; i + 1 < sums.size(); i += 2) next.push_back(sums[i] + sums[i + 1]);
        if (sums.size() % 2 == 1) next.push_back(sums.back());
        sums = std::move(next);
    }
    return sums.front();
}

template <class Real>
Real fused(const Terms<Real>& terms) {
    Real sum = 0;
    for (const auto& [w, x] : terms) sum = std::fma(w, x, sum);
    return sum;
}

template <class Real>
Real forward(const Terms<Real>& terms) {
    Real sum = 0;
    for (const auto& [w, x] : terms) sum += w * x;
    return sum;
}

template <class Real>
using Sum = Real (*)(const Terms<Real>&);
template <class Real>
using WeightTable = std::vector<std::vector<Real>>;

template <class Real>
Points<Real> apply_by(Sum<Real> sum, const Rows& rows, const WeightTable<Real>& weights,
                      const Points<Real>& parent) {
    Points<Real> out;
    for (std::size_t row = 0; row < rows.row_count(); ++row) {
        const auto columns = rows.columns_of(row);
        Point<Real> point;
        for (int i = 0; i < 3; ++i) {
            Terms<Real> terms;
            for (std::size_t j = 0; j < columns.size(); ++j)
                terms.emplace_back(weights[rows.mask_of_row[row]][j], parent[columns[j]][i]);
            point[i] = sum(terms);
        }
        out.push_back(point);
    }
    return out;
}

// The worst weights that the bound allows: each as large as `weight_ulps` lets it be, so that their errors
// add up.
template <class Real>
WeightTable<Real> largest_allowed_weights(const Rows& rows, Weights weights) {
    WeightTable<Real> out;
    for (const Mask& mask : rows.masks) {
        const double error = weight_ulps(mask, weights) * unit_roundoff(kPrecision<Real>);
        auto& row = out.emplace_back();
        for (const auto& exact : weights_of<HighPrecision>(mask, weights)) {
            const HighPrecision most = exact + abs(exact) * error;
            Real w = static_cast<Real>(most);
            if (HighPrecision(w) > most) w = std::nextafter(w, -std::numeric_limits<Real>::infinity());
            row.push_back(w);
        }
    }
    return out;
}

// Refines by step_by(rows, positions) and compares every level with the exact one.  The control points are
// rounded to Real before both, so that what is measured is refinement: its bound starts at zero.
template <class Real, class StepBy>
Observed use_of_bound(const std::string& what, const std::vector<Step>& steps, Weights weights,
                      const TriangleMesh& mesh, StepBy step_by) {
    auto positions = convert_points<Real>(mesh.positions());
    const auto exact = positions_of<HighPrecision>(steps, weights, convert_points<HighPrecision>(positions));
    const auto bounds =
        bounds_of(steps, weights, exact, Bounds(positions.size(), glm::dvec3(0)), kPrecision<Real>);
    Observed use(what + ", share of the bound", "vertex", 1);
    for (std::size_t l = 0; l < steps.size(); ++l) {
        positions = step_by(steps[l].rows, positions);
        add_use(use, positions, exact[l + 1], bounds[l + 1]);
    }
    return use;
}

template <class Real>
auto by_our_rows(Weights weights) {
    return [=](const Rows& rows, const Points<Real>& parent) { return apply<Real>(rows, weights, parent); };
}

class BoundOf : public testing::TestWithParam<std::string> {
  protected:
    static constexpr int kLevels = 3;

    static void TearDownTestSuite() {
        for (const auto& [what, largest] : overall_)
            fmt::print("[ OBSERVED ] all models, {}: largest share of the bound {:.3f} ({})\n", what,
                       largest.first, largest.second);
    }

    template <class Real, class StepBy>
    void check(const std::string& what, StepBy step_by) const {
        const Observed use = use_of_bound<Real>(what, steps_, weights_, model_.mesh, step_by);
        use.check();
        auto& largest = overall_[what];
        if (!(use.largest() <= largest.first)) largest = {use.largest(), model_.name};
    }

    template <class Real>
    void check_sum(const std::string& what, Sum<Real> sum) const {
        check<Real>(what, [&](const Rows& rows, const Points<Real>& parent) {
            return apply_by<Real>(sum, rows, weights_of<Real>(rows, weights_), parent);
        });
    }

    template <class Real>
    void check_worst_weights(const std::string& what) const {
        check<Real>(what, [&](const Rows& rows, const Points<Real>& parent) {
            return apply_by<Real>(forward<Real>, rows, largest_allowed_weights<Real>(rows, weights_), parent);
        });
    }

    inline static std::map<std::string, std::pair<double, std::string>> overall_;
    const tests::LoadedModel model_ = tests::load_model(GetParam());
    const Weights weights_ = model_.options.weights;
    const std::vector<Step> steps_ = steps_of(model_.mesh, model_.options, kLevels);
};

TEST_P(BoundOf, HoldsForOurRows) {
    check<float>("float", by_our_rows<float>(weights_));
    check<double>("double", by_our_rows<double>(weights_));
}

// From the control points as they are: the bound starts at their rounding, of which corners use all.
TEST_P(BoundOf, HoldsForControlPointsThatAreRounded) {
    const auto exact = positions_of<HighPrecision>(steps_, weights_, model_.mesh);
    const auto bounds = bounds_of(steps_, weights_, exact, model_.mesh, Precision::Float);
    const auto got = positions_of<float>(steps_, weights_, model_.mesh);
    Observed use("float, rounded control points, share of the bound", "vertex", 1);
    for (std::size_t l = 0; l < got.size(); ++l) add_use(use, got[l], exact[l], bounds[l]);
    use.check();
}

TEST_P(BoundOf, HoldsForEveryOrderOfSummation) {
    check_sum<float>("float, reversed", reversed<float>);
    check_sum<double>("double, reversed", reversed<double>);
    check_sum<float>("float, pairwise", pairwise<float>);
    check_sum<double>("double, pairwise", pairwise<double>);
}

TEST_P(BoundOf, HoldsWithFusedMultiplyAdd) {
    check_sum<float>("float, fused", fused<float>);
    check_sum<double>("double, fused", fused<double>);
}

TEST_P(BoundOf, HoldsForTheWorstWeightsItAllows) {
    check_worst_weights<float>("float, worst weights");
    check_worst_weights<double>("double, worst weights");
}

INSTANTIATE_TEST_SUITE_P(Models, BoundOf, testing::ValuesIn(tests::model_files()), tests::model_test_name);

// The largest share of our bound that results by other rules take.
template <class Real>
double use_by_other_rules(const TriangleMesh& mesh, const SchemeOptions& ours, const SchemeOptions& theirs) {
    const auto steps = steps_of(mesh, ours, 1), other = steps_of(mesh, theirs, 1);
    const auto exact = positions_of<HighPrecision>(steps, ours.weights, mesh);
    const auto bounds = bounds_of(steps, ours.weights, exact, mesh, kPrecision<Real>);
    Observed use("", "", 1);
    add_use(use, positions_of<Real>(other, theirs.weights, mesh)[1], exact[1], bounds[1]);
    return use.largest();
}

// A violation proves that the masks differ: every difference of the rules must be one.
TEST(ErrorBound, IsViolatedByOtherMasks) {
    const auto expect_violation = [](const MeshData& data, const SchemeOptions& theirs, const char* what) {
        const auto mesh = mesh_of(data);
        const double in_float = use_by_other_rules<float>(mesh, {}, theirs);
        const double in_double = use_by_other_rules<double>(mesh, {}, theirs);
        fmt::print("[ OBSERVED ] {}: {:.3g} times the bound in float, {:.3g} in double\n", what, in_float,
                   in_double);
        EXPECT_GT(in_float, 1) << what;
        EXPECT_GT(in_double, 1) << what;
        EXPECT_LE(use_by_other_rules<double>(mesh, {}, {}), 1) << what;
    };
    expect_violation(tests::bipyramid(5), {.weights = Weights::Warren}, "Warren at valence 5");
    expect_violation(tests::bipyramid(1000), {.weights = Weights::Warren}, "Warren at valence 1000");
    expect_violation(tests::square(), {.boundary = BoundaryRule::EdgeOnly}, "another boundary rule");
    MeshData crease = tests::wheel(6);
    crease.creases = {{0, 1, 2}, {0, 3, 1}, {0, 4, 0.5F}};
    expect_violation(crease, {.creasing = Creasing::Chaikin}, "another decay of sharpness");
}

// Warren's weights are Loop's at valence 3 (and 6): no violation there.
TEST(ErrorBound, IsKeptByOtherRulesThatMeanTheSame) {
    EXPECT_LE(use_by_other_rules<double>(mesh_of(tests::tetrahedron()), {}, {.weights = Weights::Warren}), 1);
    EXPECT_LE(use_by_other_rules<float>(mesh_of(tests::bipyramid(3)), {}, {}), 1);
}

template <class Real>
void check_our_rows(const MeshData& data, const std::string& what) {
    const auto mesh = mesh_of(data);
    use_of_bound<Real>(what, steps_of(mesh, {}, 3), Weights::Loop, mesh, by_our_rows<Real>(Weights::Loop))
        .check();
}

TEST(ErrorBound, HoldsAtValence1000) {
    check_our_rows<float>(tests::bipyramid(1000), "float, valence 1000");
    check_our_rows<double>(tests::bipyramid(1000), "double, valence 1000");
}

// Products that fall below the smallest normal number lose all relative accuracy.
TEST(ErrorBound, HoldsAmongSubnormals) {
    MeshData data = tests::bipyramid(5);
    for (auto& p : data.positions) p *= 0x1p-140;
    check_our_rows<float>(data, "float, subnormal");
    for (auto& p : data.positions) p *= 0x1p-920;
    check_our_rows<double>(data, "double, subnormal");
}

void add_error_of_witness(Observed& error, const std::vector<Step>& steps, Weights weights,
                          const TriangleMesh& mesh) {
    const auto got = positions_of<HighPrecision>(steps, weights, mesh).back();
    const auto exact = positions_of<Rational>(steps, weights, mesh).back();
    const auto add = [&](std::size_t v, const HighPrecision& x, const Rational& wanted) {
        const HighPrecision value = HighPrecision(numerator(wanted)) / HighPrecision(denominator(wanted));
        error.add(static_cast<double>(abs(x - value)) / mesh.largest_coordinate(),
                  static_cast<std::int64_t>(v), static_cast<double>(x), static_cast<double>(value));
    };
    for (std::size_t v = 0; v < got.size(); ++v) {
        add(v, got[v].x, exact[v].x);
        add(v, got[v].y, exact[v].y);
        add(v, got[v].z, exact[v].z);
    }
}

// High precision against exact fractions, relative to the largest coordinate.  Warren's weights are fractions
// for every valence.  No more than two levels of 1000 roundings of 2^-127 each.
TEST(Witness, AgreesWithExactFractions) {
    int models = 0;
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        Observed error(fmt::format("{} relative error of high precision", name(weights)), "vertex", 1e-36);
        for (const auto& file : tests::model_files()) {
            const auto model = tests::load_model(file);
            const auto steps = steps_of(model.mesh, model.options, 2);
            if (!tests::are_fractions(steps, weights)) continue;
            ++models;
            add_error_of_witness(error, steps, weights, model.mesh);
        }
        error.check();
    }
    fmt::print("[ OBSERVED ] compared {} times\n", models);
}

}  // namespace
}  // namespace loopcheck::core
