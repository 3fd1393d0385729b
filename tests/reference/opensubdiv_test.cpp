#include "reference/opensubdiv/opensubdiv.h"

#include <gtest/gtest.h>

#include "tests/reference/meshes.h"

namespace loopcheck::reference {
namespace {

using core::Index;
using core::Precision;
using test::fan;
using test::make;

core::Result<core::Refinement> refine(const core::MeshData& data, int levels,
                                      core::SchemeOptions options = {},
                                      Precision precision = Precision::Double) {
    return opensubdiv_refine(make(data), options, levels, precision);
}

TEST(Opensubdiv, SaysItsVersion) {
    EXPECT_EQ(opensubdiv_version().substr(0, 2), "3.");
}

TEST(Opensubdiv, GivesEveryLevelWithAncestryAndTags) {
    const auto made = refine(fan(5, true), 3);
    ASSERT_TRUE(made);
    ASSERT_EQ(made->levels.size(), 4U);
    EXPECT_TRUE(made->levels[0].ancestors.empty());
    for (std::size_t l = 0; l < 4; ++l) {
        const auto& level = made->levels[l];
        EXPECT_EQ(level.triangles.size(), 5U << (2 * l));
        EXPECT_EQ(level.tags.size(), level.positions.size());
        if (l > 0) {
            EXPECT_EQ(level.ancestors.size(), level.positions.size());
        }
    }
    // The first vertex is the vertex point of vertex 0, the one after the last vertex point the edge point of
    // side 0.
    EXPECT_EQ(made->levels[1].ancestors[0], (core::Ancestor{core::Ancestor::Kind::Vertex, 0}));
    EXPECT_EQ(made->levels[1].ancestors[6], (core::Ancestor{core::Ancestor::Kind::Edge, 0}));
    EXPECT_FALSE(made->levels[1].tags[0].boundary);
    EXPECT_TRUE(made->levels[1].tags[1].boundary);
}

TEST(Opensubdiv, KeepsTheLastBitsOfDouble) {
    // 1/3 of float and of double differ from the 9th digit on: a float anywhere on the way would show.
    core::MeshData data = fan(1, false);
    for (auto& p : data.positions) p = glm::dvec3(1.0 / 3, 2.0 / 3, 1e-9 / 3) + p * 1e-12;
    const auto doubles = refine(data, 1), floats = refine(data, 1, {}, Precision::Float);
    ASSERT_TRUE(doubles && floats);
    EXPECT_EQ(doubles->levels[1].positions[0], data.positions[0]);  // a corner under the default option
    EXPECT_NE(floats->levels[1].positions[0], data.positions[0]);
    EXPECT_EQ(floats->levels[1].positions[0].x, static_cast<double>(static_cast<float>(data.positions[0].x)));
}

TEST(Opensubdiv, FollowsTheBoundaryOption) {
    const core::MeshData triangle = fan(1, false);
    core::SchemeOptions edge_only;
    edge_only.boundary = core::BoundaryRule::EdgeOnly;
    EXPECT_EQ(refine(triangle, 1)->levels[1].positions[0], triangle.positions[0]);
    EXPECT_NE(refine(triangle, 1, edge_only)->levels[1].positions[0], triangle.positions[0]);
}

TEST(Opensubdiv, KeepsIsolatedVertices) {
    core::MeshData data = fan(4, true);
    data.positions.emplace_back(7, 8, 9);
    const auto made = refine(data, 2);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->levels[2].positions[5], glm::dvec3(7, 8, 9));
}

TEST(Opensubdiv, TakesManyTagsAndHoles) {
    core::MeshData data = fan(6, true);
    for (Index i = 1; i <= 6; ++i) data.creases.push_back({0, i, 0.5F * static_cast<float>(i)});
    data.corners = {{0, 2.5F}, {3, 10}};
    data.holes = {0, 5};
    EXPECT_TRUE(refine(data, 3));
}

TEST(Opensubdiv, RefusesByNameWhatItCannotDo) {
    const auto code = [](const core::Result<core::Refinement>& made) { return made.error().code; };
    core::SchemeOptions warren;
    warren.weights = core::Weights::Warren;
    EXPECT_EQ(code(refine(fan(1, false), 1, warren)), core::ErrorCode::Unsupported);
    EXPECT_EQ(code(refine(fan(1, false), 16)), core::ErrorCode::Unsupported);
    EXPECT_EQ(code(refine(fan(70000, true), 1)), core::ErrorCode::Unsupported);
    core::MeshData huge = fan(1, false);
    huge.positions[1].x = 1e300;
    EXPECT_EQ(code(refine(huge, 1, {}, Precision::Float)), core::ErrorCode::NotFinite);
    EXPECT_TRUE(refine(huge, 1));
}

TEST(Opensubdiv, SurvivesALargeValence) {
    EXPECT_TRUE(refine(fan(30000, true), 1));
}

}  // namespace
}  // namespace loopcheck::reference
