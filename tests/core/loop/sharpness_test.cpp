#include "core/loop/sharpness.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/loop/refine.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::mesh_of;
using Halves = std::vector<std::array<float, 2>>;

constexpr BoundaryRule kBoundaryRules[] = {BoundaryRule::None, BoundaryRule::EdgeOnly,
                                           BoundaryRule::EdgeAndCorner};

TEST(Sharpness, IsZeroSemiSharpOrInfinite) {
    EXPECT_FALSE(is_sharp(0));
    EXPECT_TRUE(is_sharp(std::numeric_limits<float>::denorm_min()));
    EXPECT_FALSE(is_semi_sharp(0));
    EXPECT_TRUE(is_semi_sharp(0.1F));
    EXPECT_TRUE(is_semi_sharp(std::nextafter(10.0F, 0.0F)));
    EXPECT_FALSE(is_infinite(std::nextafter(10.0F, 0.0F)));
    EXPECT_TRUE(is_infinite(10));
    EXPECT_FALSE(is_semi_sharp(10));
}

TEST(UniformDecay, TakesOneALevelAndEndsAtZero) {
    const std::pair<float, std::vector<float>> ladders[] = {{0, {0}},
                                                            {0.25F, {0, 0}},
                                                            {0.5F, {0, 0}},
                                                            {1, {0, 0}},
                                                            {1.25F, {0.25F, 0}},
                                                            {1.5F, {0.5F, 0, 0}},
                                                            {2.5F, {1.5F, 0.5F, 0}},
                                                            {3, {2, 1, 0, 0}},
                                                            {9.5F, {8.5F, 7.5F}},
                                                            {10, {10, 10, 10}},
                                                            {11, {10, 10}}};
    for (const auto& [start, ladder] : ladders) {
        float s = start;
        for (const float next : ladder) EXPECT_EQ(s = uniform_decay(s), next) << start;
    }
}

// 3/4 s + 1/4 (mean of the others) - 1, by hand.  All of these are exact in float.
TEST(ChaikinDecay, MovesTowardsTheMeanOfTheOthers) {
    EXPECT_EQ(chaikin_decay(2, 2 + 1, 2), 0.75F);           // 1.5 + 0.25 - 1
    EXPECT_EQ(chaikin_decay(1, 2 + 1, 2), 0.25F);           // 0.75 + 0.5 - 1
    EXPECT_EQ(chaikin_decay(3, 3 + 3, 2), 2);               // equal ones decay uniformly
    EXPECT_EQ(chaikin_decay(4, 4 + 2 + 1, 3), 2.375F);      // 3 + 0.375 - 1
    EXPECT_EQ(chaikin_decay(0.5F, 0.5F + 9.5F, 2), 1.75F);  // 0.375 + 2.375 - 1: it grows
}

TEST(ChaikinDecay, IsUniformForTheOnlySemiSharpEdge) {
    for (const float s : {0.5F, 1.0F, 1.5F, 3.25F, 9.5F}) EXPECT_EQ(chaikin_decay(s, s, 1), uniform_decay(s));
}

TEST(ChaikinDecay, EndsAtZero) {
    EXPECT_EQ(chaikin_decay(0.5F, 0.5F + 0.5F, 2), 0);
    EXPECT_EQ(chaikin_decay(1.25F, 1.25F + 0.25F, 2), 0);  // 0.9375 + 0.0625 - 1: just zero
    EXPECT_EQ(chaikin_decay(1.2F, 1.2F + 0.05F, 2), 0);
}

TEST(ChaikinDecay, LeavesZeroAndInfiniteAlone) {
    EXPECT_EQ(chaikin_decay(0, 3, 2), 0);
    EXPECT_EQ(chaikin_decay(10, 3, 2), 10);
}

// The halves of the spokes of a wheel of valence 6, whose sharpness is given; outer ends are on the boundary.
Halves spokes(const std::vector<float>& sharpness, Creasing creasing) {
    MeshData data = tests::wheel(6);
    for (std::size_t i = 0; i < sharpness.size(); ++i)
        data.creases.push_back({0, static_cast<Index>(i + 1), sharpness[i]});
    const auto mesh = mesh_of(std::move(data));
    const Topology& t = mesh.topology();
    const auto halves =
        half_edge_sharpness(t, control_sharpness(mesh, BoundaryRule::EdgeAndCorner), creasing);
    Halves out;
    for (const Index e : t.ring(0)) {
        const int inner = t.edge_ends[e][0] == 0 ? 0 : 1;
        out.push_back({halves[e][inner], halves[e][1 - inner]});
    }
    return out;
}

TEST(HalfEdgeSharpness, UniformIsTheSameAtBothEnds) {
    EXPECT_EQ(spokes({2.5F, 1, 10}, Creasing::Uniform),
              (Halves{{1.5F, 1.5F}, {0, 0}, {10, 10}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(HalfEdgeSharpness, ChaikinLooksAtEachEndOnItsOwn) {
    // Inside the others count; outside every spoke is the only semi-sharp edge.
    EXPECT_EQ(spokes({4, 2, 1}, Creasing::Chaikin),
              (Halves{{2.375F, 3}, {1.125F, 1}, {0.5F, 0}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(HalfEdgeSharpness, ChaikinDoesNotCountInfiniteNeighbours) {
    EXPECT_EQ(spokes({2.5F, 10}, Creasing::Chaikin),
              (Halves{{1.5F, 1.5F}, {10, 10}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}));
    EXPECT_EQ(spokes({2, 10, 1}, Creasing::Chaikin),
              (Halves{{0.75F, 1}, {10, 10}, {0.25F, 0}, {0, 0}, {0, 0}, {0, 0}}));
}

TEST(ControlSharpness, KeepsTheTags) {
    MeshData data = tests::wheel(5);
    data.creases = {{0, 2, 1.5F}, {0, 3, 10}};
    data.corners = {{0, 2.5F}, {4, 10}};
    const auto mesh = mesh_of(std::move(data));
    for (const auto rule : kBoundaryRules) {
        const auto s = control_sharpness(mesh, rule);
        EXPECT_EQ(s.vertex, (std::vector<float>{2.5F, 0, 0, 0, 10, 0}));
        for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
            const bool on_boundary = mesh.topology().is_boundary_edge(e);
            EXPECT_EQ(s.edge[e], on_boundary ? 10 : mesh.edge_sharpness()[e]) << e;
        }
    }
}

TEST(ControlSharpness, BoundaryEdgesAreInfiniteWhateverTheirTag) {
    MeshData data = tests::square();
    data.creases = {{0, 1, 0.5F}};
    const auto mesh = mesh_of(std::move(data));
    for (const auto rule : kBoundaryRules)
        EXPECT_EQ(control_sharpness(mesh, rule).edge, (std::vector<float>{10, 10, 0, 10, 10}));
}

// In a fan of n faces the two outermost vertices have one face; for n = 1 the middle one has, too.
class Fan : public testing::TestWithParam<int> {};

TEST_P(Fan, KeepsOneFaceCornersOnlyUnderEdgeAndCorner) {
    const auto mesh = mesh_of(tests::open_fan(GetParam()));
    for (const auto rule : kBoundaryRules) {
        std::vector<float> expected(mesh.vertex_count(), 0);
        if (rule == BoundaryRule::EdgeAndCorner) {
            expected[1] = expected.back() = 10;
            if (GetParam() == 1) expected[0] = 10;
        }
        EXPECT_EQ(control_sharpness(mesh, rule).vertex, expected) << name(rule);
    }
}

INSTANTIATE_TEST_SUITE_P(Faces, Fan, testing::Range(1, 10));

TEST(ControlSharpness, IsolatedVerticesAreInfinite) {
    MeshData data = tests::wheel(3);
    data.positions.push_back({1, 2, 3});
    const auto mesh = mesh_of(std::move(data));
    for (const auto rule : kBoundaryRules)
        EXPECT_EQ(control_sharpness(mesh, rule).vertex, (std::vector<float>{0, 0, 0, 0, 10}));
}

// The next level, for every model: halves go to the halves, vertices decay, all that is new is smooth.
class SharpnessOf : public testing::TestWithParam<std::string> {};

TEST_P(SharpnessOf, DecaysFromLevelToLevel) {
    const auto model = tests::load_model(GetParam());
    SchemeLevel parent = control_level(model.mesh, model.options.boundary);
    for (int level = 0; level < 4; ++level) {
        const auto halves = half_edge_sharpness(parent.topology, parent.sharpness, model.options.creasing);
        auto step = next_level(parent, model.options);
        ASSERT_TRUE(step);
        const Sharpness& child = step->child.sharpness;
        ASSERT_EQ(child.edge.size(), step->child.topology.edge_ends.size());
        ASSERT_EQ(child.vertex.size(), static_cast<std::size_t>(step->child.topology.vertex_count));
        for (Index e = 0; e < parent.topology.edge_count(); ++e)
            for (int i = 0; i < 2; ++i)
                ASSERT_EQ(child.edge[half_edge(parent.topology, e, i)], halves[e][i]) << e;
        for (Index e = 0; e < 3 * parent.topology.face_count(); ++e) ASSERT_EQ(child.edge[e], 0) << e;
        for (Index v = 0; v < step->child.topology.vertex_count; ++v)
            ASSERT_EQ(child.vertex[v],
                      v < parent.topology.vertex_count ? uniform_decay(parent.sharpness.vertex[v]) : 0)
                << v;
        parent = std::move(step->child);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, SharpnessOf, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
