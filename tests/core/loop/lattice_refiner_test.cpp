#include "core/loop/lattice/refiner.h"

#include <gtest/gtest.h>

#include <set>

#include "core/loop/lattice/evaluator.h"
#include "core/loop/lattice/split_order.h"
#include "core/loop/refine.h"
#include "tests/support/models.h"
#include "tests/support/random_meshes.h"
#include "tests/support/same_bits.h"

namespace loopcheck::core {
namespace {

constexpr std::array kBoundaryRules{BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None};
constexpr std::array kCreasings{Creasing::Uniform, Creasing::Chaikin};

// The vertex of `refine` at that address.
glm::dvec3 vertex_of(const RefinedLevel& level, const SplitOrder& split, const LatticeOrder& order,
                     std::int64_t v) {
    return level.positions[static_cast<std::size_t>(split.vertex(order.address_of(v)))];
}

template <class Real>
void expect_same_bits(const TriangleMesh& mesh, const SchemeOptions& options, int levels) {
    const auto slow = refine<Real>(mesh, options, levels);
    ASSERT_TRUE(slow);
    const auto control = convert_points<Real>(mesh.positions());
    for (int l = 0; l <= levels; ++l) {
        const auto refiner = LatticeRefiner::make(mesh, options, l);
        ASSERT_TRUE(refiner);
        Points<Real> fast(static_cast<std::size_t>(refiner->order().vertex_count()));
        refiner->template refine<Real>(control, fast, 2);
        ASSERT_EQ(fast.size(), slow->levels[l].positions.size());
        const auto evaluator = LatticeEvaluator<Real>::make(mesh, options, l);
        ASSERT_TRUE(evaluator);
        Points<Real> again(fast.size());
        evaluator->refine(control, again, 2);
        const SplitOrder split(refiner->topology(), l);
        for (std::size_t v = 0; v < fast.size(); ++v) {
            const auto address = refiner->order().address_of(static_cast<std::int64_t>(v));
            const glm::dvec3 wanted =
                vertex_of(slow->levels[l], split, refiner->order(), static_cast<std::int64_t>(v));
            ASSERT_TRUE(tests::same_bits<Real>(fast[v], wanted))
                << "level " << l << ", " << tests::name_of(address);
            ASSERT_TRUE(tests::same_bits<Real>(again[v], wanted))
                << "evaluator, level " << l << ", " << tests::name_of(address);
        }
    }
}

class LatticeOfEveryModel : public testing::TestWithParam<std::string> {};

TEST_P(LatticeOfEveryModel, HasTheBitsOfRefine) {
    const TriangleMesh mesh = tests::load_model(GetParam()).mesh;
    const int levels = tests::levels_up_to(4);
    for (const BoundaryRule boundary : kBoundaryRules)
        for (const Creasing creasing : kCreasings) {
            SchemeOptions options;
            options.boundary = boundary;
            options.creasing = creasing;
            ASSERT_NO_FATAL_FAILURE(expect_same_bits<double>(mesh, options, levels));
            options.weights = Weights::Warren;
            ASSERT_NO_FATAL_FAILURE(expect_same_bits<float>(mesh, options, levels));
        }
}

TEST_P(LatticeOfEveryModel, HasTheFacesOfRefine) {
    const TriangleMesh mesh = tests::load_model(GetParam()).mesh;
    const int levels = tests::levels_up_to(3);
    const auto slow = refine<double>(mesh, {}, levels);
    ASSERT_TRUE(slow);
    for (int l = 0; l <= levels; ++l) {
        const auto refiner = LatticeRefiner::make(mesh, {}, l);
        ASSERT_TRUE(refiner);
        const LatticeOrder& order = refiner->order();
        const SplitOrder split(refiner->topology(), l);
        std::vector<Triangle> faces(static_cast<std::size_t>(order.face_count()));
        refiner->triangles(faces);
        std::set<std::int64_t> seen;
        const std::int64_t per_face = std::int64_t{order.segments()} * order.segments();
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const auto t = static_cast<std::int64_t>(i);
            const std::int64_t number =
                split.face(static_cast<Index>(t / per_face), triangle_at(order.segments(), t % per_face));
            ASSERT_TRUE(seen.insert(number).second);
            const Triangle& wanted = slow->levels[l].triangles.at(static_cast<std::size_t>(number));
            for (int c = 0; c < 3; ++c)
                ASSERT_EQ(split.vertex(order.address_of(faces[i][c])), wanted[c])
                    << "level " << l << ", face " << i;
        }
        EXPECT_EQ(seen.size(), slow->levels[l].triangles.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Models, LatticeOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(LatticeRefiner, HasTheBitsOfRefineOnRandomMeshes) {
    tests::Random random(7);
    for (int trial = 0; trial < 40; ++trial) {
        const TriangleMesh mesh = tests::random_mesh(random, trial % 3 != 0);
        const SchemeOptions options = tests::random_options(random);
        ASSERT_NO_FATAL_FAILURE(expect_same_bits<double>(mesh, options, tests::levels_up_to(3))) << trial;
        ASSERT_NO_FATAL_FAILURE(expect_same_bits<float>(mesh, options, tests::levels_up_to(3))) << trial;
    }
}

TEST(LatticeRefiner, HasTheBitsOfRefineAtValence1000) {
    tests::Random random(8);
    const auto mesh = TriangleMesh::make(tests::bipyramid(1000, random)).value();
    expect_same_bits<double>(mesh, {}, 3);
    expect_same_bits<float>(mesh, {}, 3);
}

TEST(LatticeOrder, GivesEveryVertexOneAddress) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow")).mesh;
    for (int level = 0; level <= 6; ++level) {
        const LatticeOrder order(mesh.topology(), level);
        std::vector<char> seen(static_cast<std::size_t>(order.vertex_count()), 0);
        const SplitOrder split(mesh.topology(), level);
        for (std::int64_t v = 0; v < order.vertex_count(); ++v) {
            ASSERT_EQ(order.index_of(order.address_of(v)), v);
            char& once = seen.at(static_cast<std::size_t>(split.vertex(order.address_of(v))));
            ASSERT_EQ(once, 0);
            once = 1;
        }
    }
}

TEST(LatticeRefiner, VisitsEveryFaceWithItsPoints) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow-creased")).mesh;
    const auto control = convert_points<double>(mesh.positions());
    for (int level = 0; level <= 4; ++level) {
        const auto refiner = LatticeRefiner::make(mesh, {}, level).value();
        const LatticeOrder& order = refiner.order();
        Points<double> all(static_cast<std::size_t>(order.vertex_count()));
        refiner.refine<double>(control, all);
        Index visited = 0;
        const auto visit = [&](Index f, std::span<const glm::dvec3> points) {
            EXPECT_EQ(f, visited++);
            std::size_t at = 0;
            for (Index j = 0; j <= order.segments(); ++j)
                for (Index i = 0; i + j <= order.segments(); ++i)
                    ASSERT_TRUE(tests::same_bits<double>(
                        points[at++],
                        all[static_cast<std::size_t>(order.vertex_at(mesh.topology(), f, i, j))]))
                        << level << ": face " << f << " (" << i << ", " << j << ")";
            EXPECT_EQ(at, points.size());
        };
        refiner.refine_by_face<double>(control, visit);
        EXPECT_EQ(visited, mesh.face_count());
        visited = 7;  // alone, with nothing known of the faces around it
        refiner.refine_by_face<double>(control, {7, 8}, visit);
        EXPECT_EQ(visited, 8);
    }
}

TEST(LatticeRefiner, HasTheSameBitsOnAnyNumberOfThreads) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow-creased")).mesh;
    const auto refiner = LatticeRefiner::make(mesh, {}, 5).value();
    const auto vertices = static_cast<std::size_t>(refiner.order().vertex_count());
    const auto faces = static_cast<std::size_t>(refiner.order().face_count());
    Points<double> alone(vertices), shared(vertices);
    std::vector<Triangle> faces_alone(faces), faces_shared(faces);
    refiner.refine<double>(mesh.positions(), alone, 1);
    refiner.triangles(faces_alone, 1);
    for (const int threads : {2, 5}) {
        refiner.refine<double>(mesh.positions(), shared, threads);
        refiner.triangles(faces_shared, threads);
        EXPECT_EQ(alone, shared);
        EXPECT_EQ(faces_alone, faces_shared);
    }
}

TEST(LatticeRefiner, RefusesLevelsWhereOneFaceIsTooLarge) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow")).mesh;
    for (const int level : {16, 30, 1000}) {
        const auto refiner = LatticeRefiner::make(mesh, {}, level);
        ASSERT_FALSE(refiner) << level;
        EXPECT_EQ(refiner.error().code, ErrorCode::TooLarge);
    }
}

TEST(LatticeOrder, SaysWhetherAnIndexCanNumberIt) {
    const TriangleMesh mesh = tests::load_model(tests::model_path("cow")).mesh;
    EXPECT_TRUE(LatticeOrder(mesh.topology(), 8).fits_index());
    EXPECT_FALSE(LatticeOrder(mesh.topology(), 11).fits_index());
}

}  // namespace
}  // namespace loopcheck::core
