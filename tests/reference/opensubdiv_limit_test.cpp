#include "reference/opensubdiv/limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "reference/opensubdiv/opensubdiv.h"
#include "tests/support/meshes.h"
#include "tests/support/observed.h"

namespace loopcheck::reference {
namespace {

using core::Index;
using core::Precision;
using namespace tests;

constexpr core::SchemeOptions kEdgeOnly{.boundary = core::BoundaryRule::EdgeOnly};

core::Result<core::Limits> limit(const core::MeshData& data, int levels, core::SchemeOptions options = {},
                                 Precision precision = Precision::Double) {
    return opensubdiv_limit(mesh_of(data), options, levels, precision);
}

// The weight of every control vertex in the limit of vertex 0.
std::vector<double> weights_at_0(core::MeshData data, core::SchemeOptions options = {}) {
    std::vector<double> out;
    for (auto& p : data.positions) p = {};
    for (auto& p : data.positions) {
        p.x = 1;
        out.push_back(limit(data, 0, options)->levels[0].positions[0].x);
        p.x = 0;
    }
    return out;
}

TEST(OpensubdivLimit, OfARegularVertexIsOneHalfAndTwelfths) {
    EXPECT_EQ(weights_at_0(wheel(6)),
              (std::vector<double>{1. / 2, 1. / 12, 1. / 12, 1. / 12, 1. / 12, 1. / 12, 1. / 12}));
}

TEST(OpensubdivLimit, AtValenceNIsThatOfLoopsWeight) {
    // Fewer than ten roundings of numbers below 1.
    Observed seen("limit weights", "valence", 10 * 0x1p-53);
    for (const int n : {3, 4, 5, 7, 12, 64}) {
        const double c = 3. / 8 + std::cos(2 * std::numbers::pi / n) / 4, b = (5. / 8 - c * c) / n;
        const double neighbour = 1 / (n + 3 / (8 * b));
        const auto weights = weights_at_0(wheel(n));
        for (int i = 1; i <= n; ++i) seen.add(std::abs(weights[i] - neighbour), n, weights[i], neighbour);
    }
    seen.check();
}

TEST(OpensubdivLimit, OnACreaseOrBoundaryIsSixthsAndTwoThirds) {
    for (int k = 1; k <= 5; ++k) {
        std::vector<double> wanted(k + 2, 0.);
        wanted[0] = 4. / 6;
        wanted[1] = wanted[k + 1] = 1. / 6;
        EXPECT_EQ(weights_at_0(open_fan(k), kEdgeOnly), wanted) << k;
    }
    core::MeshData creased = wheel(7);
    creased.creases = {{0, 2, 10}, {0, 5, 10}};
    EXPECT_EQ(weights_at_0(creased), (std::vector<double>{4. / 6, 0, 1. / 6, 0, 0, 1. / 6, 0, 0}));
}

TEST(OpensubdivLimit, TakesSemiSharpForSharpUntilItHasDecayed) {
    core::MeshData creased = wheel(6);
    creased.creases = {{0, 1, 0.5F}, {0, 4, 0.5F}};
    EXPECT_EQ(weights_at_0(creased), (std::vector<double>{4. / 6, 1. / 6, 0, 0, 1. / 6, 0, 0}));

    const auto limits = limit(creased, 1);
    const auto refined = opensubdiv_refine(mesh_of(creased), {}, 1, Precision::Double);
    const auto& p = refined->levels[1].positions;
    const Index edge_points = 7;  // of level 1; the spokes are sides 0, 2 and so on of the faces in order
    glm::dvec3 smooth = p[0] / 2.;
    for (const Index e : {0, 2, 4, 6, 8, 10}) smooth += p[edge_points + e] / 12.;
    EXPECT_LE(glm::distance(limits->levels[1].positions[0], smooth), 1e-15);
}

TEST(OpensubdivLimit, IsInTheOrderOfTheRefinementAtEveryLevel) {
    const auto mesh = mesh_of(bipyramid(5));
    const auto two = opensubdiv_limit(mesh, {}, 2, Precision::Double);
    const auto one = opensubdiv_limit(mesh, {}, 1, Precision::Double);
    const auto refined = opensubdiv_refine(mesh, {}, 2, Precision::Double);
    ASSERT_TRUE(one && two && refined);
    ASSERT_EQ(two->levels.size(), 3U);
    EXPECT_EQ(one->levels[1].positions, two->levels[1].positions);
    for (int l = 0; l <= 2; ++l) {
        const auto& level = two->levels[l];
        ASSERT_EQ(level.positions.size(), refined->levels[l].positions.size());
        ASSERT_EQ(level.tangent1.size(), level.positions.size());
        ASSERT_EQ(level.tangent2.size(), level.positions.size());
        // All levels have one limit: the first vertices of each are the control vertices.
        for (int v = 0; v < 7; ++v)
            EXPECT_LE(glm::distance(level.positions[v], two->levels[0].positions[v]), 1e-15) << l << " " << v;
    }
}

TEST(OpensubdivLimit, HasTangentsWithTheOutsideToTheirLeft) {
    const auto limits = limit(tetrahedron(), 2);
    for (const auto& level : limits->levels)
        for (std::size_t v = 0; v < level.positions.size(); ++v) {
            const auto outward = level.positions[v] - glm::dvec3(4, 4, 4);
            EXPECT_GT(glm::dot(glm::cross(level.tangent1[v], level.tangent2[v]), outward), 0) << v;
        }
}

TEST(OpensubdivLimit, KeepsIsolatedVertices) {
    core::MeshData data = wheel(4);
    data.positions.emplace_back(7, 8, 9);
    const auto limits = limit(data, 1);
    ASSERT_TRUE(limits);
    for (const auto& level : limits->levels) {
        EXPECT_EQ(level.positions[5], glm::dvec3(7, 8, 9));
        EXPECT_EQ(level.tangent1[5], glm::dvec3(0));
        EXPECT_EQ(level.tangent2[5], glm::dvec3(0));
    }
}

TEST(OpensubdivLimit, OfFloatsIsComputedInFloat) {
    const auto doubles = limit(bipyramid(5), 1), floats = limit(bipyramid(5), 1, {}, Precision::Float);
    ASSERT_TRUE(doubles && floats);
    EXPECT_EQ(floats->precision, Precision::Float);
    const auto& p = floats->levels[1].positions;
    for (const auto& q : p) EXPECT_EQ(q.x, static_cast<double>(static_cast<float>(q.x)));
    EXPECT_NE(p, doubles->levels[1].positions);
    EXPECT_LE(glm::distance(p[0], doubles->levels[1].positions[0]), 1e-6);
}

TEST(OpensubdivLimit, RefusesWhatRefinementRefuses) {
    const auto code = [](const core::Result<core::Limits>& made) { return made.error().code; };
    core::SchemeOptions warren;
    warren.weights = core::Weights::Warren;
    EXPECT_EQ(code(limit(triangle(), 1, warren)), core::ErrorCode::Unsupported);
    EXPECT_EQ(code(limit(triangle(), 16)), core::ErrorCode::Unsupported);
    core::MeshData huge = triangle();
    huge.positions[1].x = 1e300;
    EXPECT_EQ(code(limit(huge, 1, {}, Precision::Float)), core::ErrorCode::NotFinite);
    EXPECT_TRUE(limit(huge, 1));
}

}  // namespace
}  // namespace loopcheck::reference
