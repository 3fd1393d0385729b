#include "core/loop/lattice/limits.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/loop/lattice/evaluator.h"
#include "core/loop/lattice/split_order.h"
#include "core/loop/limit.h"
#include "tests/support/models.h"
#include "tests/support/random_meshes.h"
#include "tests/support/same_bits.h"

namespace loopcheck::core {
namespace {

template <class Real>
void expect_limits_of_the_rows(const TriangleMesh& mesh, const SchemeOptions& options, int levels) {
    const auto slow = limits<Real>(mesh, options, levels);
    ASSERT_TRUE(slow);
    const auto control = convert_points<Real>(mesh.positions());
    for (int l = 0; l <= levels; ++l) {
        const auto fast = LatticeLimits<Real>::make(mesh, options, l);
        ASSERT_TRUE(fast);
        const auto count = static_cast<std::size_t>(fast->order().vertex_count());
        Points<Real> positions(count), normals(count);
        fast->evaluate(control, positions, normals, 2);
        const SplitOrder split(mesh.topology(), l);
        const LimitLevel& wanted = slow->levels[l];
        ASSERT_EQ(wanted.positions.size(), count);
        for (std::size_t v = 0; v < count; ++v) {
            const auto address = fast->order().address_of(static_cast<std::int64_t>(v));
            const auto number = static_cast<std::size_t>(split.vertex(address));
            ASSERT_TRUE(tests::same_bits<Real>(positions[v], wanted.positions[number]))
                << "level " << l << ", " << tests::name_of(address);
            const Point<Real> across =
                glm::cross(Point<Real>(wanted.tangent1[number]), Point<Real>(wanted.tangent2[number]));
            const Real length = std::sqrt(across.x * across.x + across.y * across.y + across.z * across.z);
            const Point<Real> normal = across * (length > 0 ? 1 / length : Real(0));
            ASSERT_TRUE(tests::same_bits<Real>(normals[v], glm::dvec3(normal)))
                << "normal, level " << l << ", " << tests::name_of(address);
        }
    }
}

class LatticeLimitsOfEveryModel : public testing::TestWithParam<std::string> {};

TEST_P(LatticeLimitsOfEveryModel, HaveTheBitsOfLimits) {
    const TriangleMesh mesh = tests::load_model(GetParam()).mesh;
    const int levels = tests::levels_up_to(3);
    for (const BoundaryRule boundary :
         {BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None})
        for (const Creasing creasing : {Creasing::Uniform, Creasing::Chaikin}) {
            if (tests::is_short_run() && creasing == Creasing::Uniform) continue;
            SchemeOptions options;
            options.boundary = boundary;
            options.creasing = creasing;
            ASSERT_NO_FATAL_FAILURE(expect_limits_of_the_rows<double>(mesh, options, levels));
            if (boundary != BoundaryRule::EdgeOnly) continue;
            options.weights = Weights::Warren;
            ASSERT_NO_FATAL_FAILURE(expect_limits_of_the_rows<float>(mesh, options, levels));
        }
}

INSTANTIATE_TEST_SUITE_P(Models, LatticeLimitsOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(LatticeLimits, HaveTheBitsOfLimitsOnRandomMeshes) {
    tests::Random random(9);
    for (int trial = 0; trial < 8; ++trial) {
        const TriangleMesh mesh = tests::random_mesh(random, trial % 3 != 0);
        const SchemeOptions options = tests::random_options(random);
        ASSERT_NO_FATAL_FAILURE(expect_limits_of_the_rows<double>(mesh, options, tests::levels_up_to(3)))
            << trial;
    }
}

TEST(LatticeLimits, HaveTheSameBitsOnAnyNumberOfThreads) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow-creased")).mesh;
    const auto limits = LatticeLimits<double>::make(mesh, {}, 4).value();
    const auto count = static_cast<std::size_t>(limits.order().vertex_count());
    Points<double> alone(count), alone_normals(count), shared(count), shared_normals(count);
    limits.evaluate(mesh.positions(), alone, alone_normals, 1);
    limits.evaluate(mesh.positions(), shared, shared_normals, 3);
    EXPECT_EQ(alone, shared);
    EXPECT_EQ(alone_normals, shared_normals);
}

template <class Real>
void expect_the_same_bits_without_avx2() {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow-creased")).mesh;
    const auto control = convert_points<Real>(mesh.positions());
    for (int level = 1; level <= 4; ++level) {
        const auto limits = LatticeLimits<Real>::make(mesh, {}, level).value();
        const auto evaluator = LatticeEvaluator<Real>::make(mesh, {}, level).value();
        const auto refiner = LatticeRefiner::make(mesh, {}, level).value();
        std::array<std::array<Points<Real>, 4>, 2> made;
        for (const bool allowed : {false, true}) {
            allow_avx2(allowed);
            auto& [refined, again, positions, normals] = made[allowed];
            for (auto& points : made[allowed])
                points.resize(static_cast<std::size_t>(limits.order().vertex_count()));
            refiner.template refine<Real>(control, refined);
            evaluator.refine(control, again);
            limits.evaluate(control, positions, normals);
        }
        EXPECT_EQ(made[0], made[1]) << level;
    }
}

TEST(LatticeKernels, HaveTheSameBitsWithoutAvx2) {
    fmt::print("{}\n", lattice_instructions());
    expect_the_same_bits_without_avx2<double>();
    expect_the_same_bits_without_avx2<float>();
}

}  // namespace
}  // namespace loopcheck::core
