// What benchmarks time of OpenSubdiv is what the adapters give.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/opensubdiv/last_level.h"
#include "reference/opensubdiv/limit.h"
#include "reference/opensubdiv/opensubdiv.h"
#include "reference/opensubdiv/prepared_surface.h"
#include "reference/opensubdiv/stencil_table.h"
#include "reference/opensubdiv/surface.h"
#include "tests/reference/meshes.h"

namespace loopcheck::reference {
namespace {

using core::Precision;
using test::fan;
using test::make;

constexpr int kLevel = 2;

// Positions that differ by rounding alone: a few roundings of coordinates up to 1.
void expect_near(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, double allowed) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LE(glm::length(a[i] - b[i]), allowed) << i;
}

template <class Real>
void expect_the_adapters_bits(Precision precision, double roundoff) {
    const auto mesh = make(fan(5, true));
    const auto level = opensubdiv_refine(mesh, {}, kLevel, precision)->levels.back();
    const auto limit = opensubdiv_limit(mesh, {}, kLevel, precision)->levels.back();
    auto timed = OpensubdivLastLevel<Real>::make(mesh, {});
    ASSERT_TRUE(timed);
    for (const auto last : {LastTopology::Least, LastTopology::Full}) {
        timed->clear();
        timed->refine_topology(kLevel, last);
        timed->interpolate();
        EXPECT_EQ(timed->positions(), level.positions);
        EXPECT_EQ(timed->faces(), level.triangles);
    }
    timed->limit();
    EXPECT_EQ(timed->limit_positions(), limit.positions);
    std::vector<glm::dvec3> normals;
    for (std::size_t v = 0; v < limit.positions.size(); ++v)
        normals.push_back(glm::normalize(glm::cross(limit.tangent1[v], limit.tangent2[v])));
    expect_near(timed->limit_normals(), normals, 64 * roundoff);

    auto table = OpensubdivStencilTable<Real>::make(mesh, {}, kLevel);
    ASSERT_TRUE(table);
    table->update();
    expect_near(table->positions(), level.positions, 64 * roundoff);
}

TEST(OpensubdivTimed, HasTheBitsOfTheAdapterInDouble) {
    expect_the_adapters_bits<double>(Precision::Double, 0x1p-53);
}

TEST(OpensubdivTimed, HasTheBitsOfTheAdapterInFloat) {
    expect_the_adapters_bits<float>(Precision::Float, 0x1p-24);
}

TEST(OpensubdivTimed, KeepsTheControlMeshAtLevel0) {
    const auto mesh = make(fan(4, true));
    auto timed = OpensubdivLastLevel<double>::make(mesh, {});
    ASSERT_TRUE(timed);
    timed->refine_topology(0, LastTopology::Full);
    timed->interpolate();
    EXPECT_EQ(timed->positions(), std::vector<glm::dvec3>(mesh.positions().begin(), mesh.positions().end()));
}

TEST(OpensubdivTimed, EvaluatesTheSurfaceOfTheAdapter) {
    const auto mesh = make(fan(6, true));
    const auto timed = OpensubdivPreparedSurface::make(mesh, {});
    ASSERT_TRUE(timed);
    const glm::dvec2 uv(0.25, 0.5);
    for (core::Index f = 0; f < mesh.face_count(); ++f) {
        SurfaceSample sample;
        timed->evaluate(f, {&uv, 1}, {&sample, 1});
        const core::SurfaceLocation location{f, uv.x, uv.y};
        const auto rows = opensubdiv_surface(mesh, {}, {}, {&location, 1})->front();
        ASSERT_TRUE(rows);
        std::array<glm::dvec3, 3> sums{};
        for (std::size_t j = 0; j < rows->columns.size(); ++j)
            for (int d = 0; d < 3; ++d) sums[d] += rows->weights[d][j] * mesh.positions()[rows->columns[j]];
        expect_near({sample.position, sample.du, sample.dv}, {sums[0], sums[1], sums[2]}, 256 * 0x1p-53);
    }
}

TEST(OpensubdivTimed, RefusesWhatItDoesNotTime) {
    core::MeshData creased = fan(4, true);
    creased.creases.push_back({0, 1, 1});
    core::SchemeOptions warren;
    warren.weights = core::Weights::Warren;
    const auto mesh = make(fan(4, true));
    const auto is_unsupported = [](const auto& made) {
        return !made && made.error().code == core::ErrorCode::Unsupported;
    };
    EXPECT_TRUE(is_unsupported(OpensubdivLastLevel<double>::make(mesh, warren)));
    EXPECT_TRUE(is_unsupported(OpensubdivStencilTable<double>::make(mesh, {}, kOpensubdivMaxLevels + 1)));
    EXPECT_TRUE(is_unsupported(OpensubdivPreparedSurface::make(make(creased), {})));
    EXPECT_TRUE(
        is_unsupported(OpensubdivPreparedSurface::make(mesh, {.boundary = core::BoundaryRule::None})));
}

}  // namespace
}  // namespace loopcheck::reference
