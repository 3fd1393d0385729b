#include "reference/openmesh/openmesh.h"

#include <gtest/gtest.h>

#include "reference/openmesh/last_level.h"
#include "tests/reference/meshes.h"

namespace loopcheck::reference {
namespace {

using core::Precision;
using test::fan;
using test::make;

constexpr core::SchemeOptions kEdgeOnly{.boundary = core::BoundaryRule::EdgeOnly};

core::Result<core::Refinement> refine(const core::MeshData& data, int levels,
                                      core::SchemeOptions options = kEdgeOnly,
                                      Precision precision = Precision::Double) {
    return openmesh_refine(make(data), options, levels, precision);
}

TEST(Openmesh, SaysItsVersion) {
    EXPECT_NE(openmesh_version().find('.'), std::string::npos);
}

TEST(Openmesh, GivesEveryLevelWithAncestry) {
    const auto made = refine(fan(5, true), 3);
    ASSERT_TRUE(made);
    ASSERT_EQ(made->levels.size(), 4U);
    for (std::size_t l = 1; l < 4; ++l) {
        EXPECT_EQ(made->levels[l].triangles.size(), 5U << (2 * l));
        EXPECT_EQ(made->levels[l].ancestors.size(), made->levels[l].positions.size());
    }
}

TEST(Openmesh, RefinesAgainAndAgainWithTheSameBits) {
    const auto made = refine(fan(5, true), 2);
    auto timed = OpenmeshLastLevel<double>::make(make(fan(5, true)), kEdgeOnly);
    ASSERT_TRUE(made && timed);
    for (int i = 0; i < 2; ++i) {
        timed->clear();
        timed->refine(2);
        EXPECT_EQ(timed->positions(), made->levels.back().positions);
    }
    EXPECT_EQ(OpenmeshLastLevel<float>::make(make(fan(50, true)), kEdgeOnly).error().code,
              core::ErrorCode::Unsupported);
}

TEST(Openmesh, KeepsTheLastBitsOfDouble) {
    // The edge point of a boundary edge is (a + b) / 2, which is exact here: a float on the way would show.
    core::MeshData data = fan(1, false);
    data.positions = {{0.1, 0, 0}, {0.1, 1, 0}, {0.1, 0, 1}};
    const auto made = refine(data, 1);
    ASSERT_TRUE(made);
    for (const auto& p : made->levels[1].positions) EXPECT_NEAR(p.x, 0.1, 4 * 0x1p-53 * 0.1);
}

TEST(Openmesh, RefusesByNameWhatItCannotDo) {
    const auto error = [](const core::Result<core::Refinement>& made) { return made.error(); };
    core::MeshData creased = fan(4, true), cornered = creased, isolated = creased, huge = creased;
    creased.creases.push_back({0, 1, 1});
    cornered.corners.push_back({0, 1});
    isolated.positions.emplace_back(7, 8, 9);
    huge.positions[1].x = 1e300;
    core::SchemeOptions warren = kEdgeOnly;
    warren.weights = core::Weights::Warren;
    for (const auto& refused : {error(refine(creased, 1)), error(refine(cornered, 1)),
                                error(refine(isolated, 1)), error(refine(fan(4, true), 1, warren)),
                                error(refine(fan(50, true), 1)), error(refine(fan(1, false), 1, {}))})
        EXPECT_EQ(refused.code, core::ErrorCode::Unsupported) << refused.sentence;
    EXPECT_NE(error(refine(fan(50, true), 1)).sentence.find("reads past its weight table at valence 50"),
              std::string::npos);
    EXPECT_TRUE(refine(huge, 1));
    EXPECT_EQ(error(refine(huge, 1, kEdgeOnly, Precision::Float)).code, core::ErrorCode::Unsupported);
    huge.positions[1].x = 1e308;
    EXPECT_NE(error(refine(huge, 1)).sentence.find("overflows for a coordinate of 1e+308"),
              std::string::npos);
}

TEST(Openmesh, TakesWhatRefinesAlike) {
    EXPECT_TRUE(refine(fan(49, true), 2));
    EXPECT_TRUE(refine(fan(49, true), 1, {}))
        << "no boundary vertex of one face: edge-and-corner is edge-only";
    EXPECT_TRUE(refine(fan(60, false), 1)) << "the weight table is not used on the boundary";
}

}  // namespace
}  // namespace loopcheck::reference
