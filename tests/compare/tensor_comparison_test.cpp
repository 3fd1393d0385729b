#include "compare/curve/tensor_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/support/observed.h"
#include "tests/support/results.h"

namespace loopcheck::compare {
namespace {

using core::BoundaryRule;
using core::Ends;
using core::ErrorCode;
using core::Grid;
using core::Precision;
using glm::dvec3;
using reference::CatmullClark;
using namespace tests;

constexpr Ends kNatural = Ends::Natural, kClosed = Ends::Closed;

// A sheet with its points shaken far out of place, or without any shape at all.
Grid<dvec3> random_grid(std::size_t rows, std::size_t columns, std::uint32_t seed = 1, double shape = 0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    Grid<dvec3> out{rows, columns, {}};
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
            out.points.push_back(dvec3(x, y, z) + shape * dvec3(j, i, 0));
        }
    return out;
}

// Coordinates from 1e-9 to 1e9: nothing but the largest is known to most digits.
Grid<dvec3> irregular_grid(std::size_t rows, std::size_t columns) {
    Grid<dvec3> out = random_grid(rows, columns, 7);
    for (std::size_t k = 0; k < out.points.size(); ++k)
        out.points[k] *= std::pow(10.0, static_cast<double>(k * 5 % 19) - 9);
    return out;
}

CatmullClark refined(const Grid<dvec3>& grid, Ends u, Ends v, int levels,
                     BoundaryRule boundary = BoundaryRule::EdgeAndCorner) {
    return value_of(
        reference::opensubdiv_catmull_clark(quad_mesh(grid, u, v), boundary, levels, Precision::Double));
}

void print(const std::string& what, const TensorComparison& seen) {
    for (const TensorLevel& level : seen.levels)
        fmt::print(
            "[ OBSERVED ] {} level {}: {} vertices; positions |a-b| {:.3g}, ours {:.3g} of {:.3g}, "
            "OpenSubdiv {:.3g} of {:.3g}; limits {:.3g}, use {:.2g}; {} normals {:.3g} rad, use {:.2g}\n",
            what, level.level, level.vertices, level.position.difference, level.position.ours_error,
            level.position.ours_bound, level.position.opensubdiv_error, level.position.opensubdiv_bound,
            level.limit.difference, level.limit.bound_use, level.normals, level.normal.difference,
            level.normal.bound_use);
}

struct Sheet {
    const char* name;
    std::size_t rows, columns;
    Ends u, v;
    int levels;
};
const std::vector<Sheet> kSheets{
    {"smallest open", 2, 2, kNatural, kNatural, 5}, {"open strip", 2, 5, kNatural, kNatural, 3},
    {"open", 6, 5, kNatural, kNatural, 4},          {"smallest cylinder", 2, 3, kClosed, kNatural, 5},
    {"cylinder", 5, 4, kNatural, kClosed, 3},       {"smallest torus", 3, 3, kClosed, kClosed, 4},
    {"torus", 4, 6, kClosed, kClosed, 3},
};

void check_same(const std::string& what, const Grid<dvec3>& grid, const TensorCase& given,
                bool every_normal = true) {
    const auto seen = value_of(compare_tensor(grid, given));
    print(what, seen);
    EXPECT_EQ(seen.verdict, Verdict::WithinRounding) << what << ": " << seen.note;
    ASSERT_EQ(seen.levels.size(), static_cast<std::size_t>(given.levels) + 1);
    for (std::size_t l = 0; l < seen.levels.size(); ++l) {
        const TensorLevel& level = seen.levels[l];
        const auto refined_count = [&](std::size_t n, Ends ends) {
            return ends == kClosed ? n << l : ((n - 1) << l) + 1;
        };
        EXPECT_EQ(level.vertices, refined_count(grid.rows, given.v) * refined_count(grid.columns, given.u));
        for (const TensorMeasure& measure : {level.position, level.limit, level.normal})
            EXPECT_LE(measure.bound_use, 1);
        if (every_normal) {
            EXPECT_GT(level.normals * 10, level.vertices * 9) << what << " level " << l;
        }
    }
}

TEST(TensorComparison, FindsTheSameSurfaceInDouble) {
    for (const Sheet& sheet : kSheets)
        check_same(sheet.name, random_grid(sheet.rows, sheet.columns),
                   {.u = sheet.u, .v = sheet.v, .levels = sheet.levels});
}

TEST(TensorComparison, FindsTheSameSurfaceInFloat) {
    for (const Sheet& sheet : kSheets)
        check_same(sheet.name, random_grid(sheet.rows, sheet.columns, 2),
                   {.u = sheet.u, .v = sheet.v, .levels = sheet.levels, .precision = Precision::Float});
}

TEST(TensorComparison, FindsTheSameSurfaceOfOtherGrids) {
    check_same("irregular", irregular_grid(4, 5), {.levels = 3}, false);
    check_same("wavy sheet", random_grid(5, 4, 3, 2), {.levels = 3, .precision = Precision::Float});
    check_same(
        "tiny",
        [] {
            Grid<dvec3> grid = random_grid(3, 3);
            for (dvec3& p : grid.points) p *= 0x1p-1070;
            return grid;
        }(),
        {.levels = 3}, false);
}

TEST(TensorComparison, LeavesNormalsOfAPointAlone) {
    Grid<dvec3> grid{3, 3, std::vector<dvec3>(9, dvec3(1, 1.0 / 3, -1))};
    const auto seen = value_of(compare_tensor(grid, TensorCase{.levels = 2}));
    EXPECT_NE(seen.verdict, Verdict::Differs) << seen.note;
    for (const TensorLevel& level : seen.levels) EXPECT_EQ(level.normals, 0U);
}

// Coordinates that are small whole numbers: nothing is rounded in the refinement, on either side.
TEST(TensorComparison, IsExactWhereNothingIsRounded) {
    Grid<dvec3> grid = random_grid(4, 4);
    for (dvec3& p : grid.points) p = glm::round(p * 1000.0);
    const auto seen = value_of(compare_tensor(grid, TensorCase{.levels = 4}));
    for (const TensorLevel& level : seen.levels) {
        EXPECT_EQ(level.position.difference, 0);
        EXPECT_EQ(level.position.ours_error, 0);
        EXPECT_EQ(level.position.opensubdiv_error, 0);
    }
}

// Which tangents OpenSubdiv gives, and how long: inside 12 times two derivatives, turned as its ring is; on
// the rim once the one along it and the one across, at a corner once both.  The plane and its side are ours.
TEST(TensorComparison, OpensubdivsTangentsAreTheDerivativesTwelveTimesInsideAndOnceOnTheRim) {
    const Grid<dvec3> grid = random_grid(4, 5);
    const auto theirs = refined(grid, kNatural, kNatural, 0).levels[0].limit;
    const auto surface = *core::TensorSurface<dvec3>::make(grid, {{3, kNatural}, {3, kNatural}});
    const auto ours = *core::limits(surface);
    Observed seen(
        "tangents", "vertex",
        tangent_bound(1, 0, 8.0 / 3, Precision::Double) + tangent_bound(1, 0, 2, Precision::Double));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 5; ++j) {
            const std::size_t k = i * 5 + j;
            const bool inside = i > 0 && i < 3 && j > 0 && j < 4;
            const double times = inside ? 12 : 1;
            const dvec3 t1 = theirs.tangent1[k] / times, t2 = theirs.tangent2[k] / times;
            const dvec3 du = ours.du.at(i, j), dv = ours.dv.at(i, j);
            // The four turns that keep the side.
            double least = std::numeric_limits<double>::infinity();
            for (const auto& [a, b] : {std::pair{du, dv}, {dv, -du}, {-du, -dv}, {-dv, du}})
                least = std::min(least, std::max(core::magnitude(t1 - a), core::magnitude(t2 - b)));
            seen.add(least, static_cast<std::int64_t>(k));
        }
    seen.check();
}

// A named difference: a natural end keeps a corner c with the neighbours a and b; a crease that runs through
// it moves it by (a + b - 2 c)/8, and its limit by (a + b - 2 c)/6.  The plane of OpenSubdiv's tangents
// there, (a - b)/2 and 3 (a + b - 2 c), is still that of a - c and b - c.
TEST(TensorComparison, EdgeOnlyMovesTheCornersOfAnOpenGridAsPredicted) {
    const Grid<dvec3> grid = random_grid(4, 5, 5);
    const auto seen =
        value_of(compare_tensor(grid, TensorCase{.levels = 1, .boundary = BoundaryRule::EdgeOnly}));
    EXPECT_EQ(seen.verdict, Verdict::Differs);
    ASSERT_EQ(seen.levels.size(), 2U);
    double moved = 0;
    for (const std::size_t i : {0U, 3U})
        for (const std::size_t j : {0U, 4U}) {
            const dvec3 a = grid.at(i, j == 0 ? 1 : 3), b = grid.at(i == 0 ? 1 : 2, j), c = grid.at(i, j);
            moved = std::max(moved, core::magnitude(a + b - 2.0 * c));
        }
    const auto check = [](const std::string& what, const TensorMeasure& measure, double predicted) {
        Observed difference(what, "level", measure.ours_bound + measure.opensubdiv_bound);
        difference.add(std::abs(measure.difference - predicted), 1, measure.difference, predicted);
        difference.check();
    };
    EXPECT_EQ(seen.levels[0].position.difference, 0);
    check("corners moved", seen.levels[1].position, moved / 8);
    check("limits of corners moved", seen.levels[0].limit, moved / 6);
    EXPECT_EQ(seen.levels[0].normals, 20U);
    EXPECT_LE(seen.levels[0].normal.bound_use, 1);
}

TEST(TensorComparison, EdgeOnlyIsTheSameWhereThereAreNoCorners) {
    check_same("cylinder, edge-only", random_grid(4, 5),
               {.u = kClosed, .v = kNatural, .levels = 2, .boundary = BoundaryRule::EdgeOnly});
    check_same("torus, edge-only", random_grid(4, 5),
               {.u = kClosed, .v = kClosed, .levels = 2, .boundary = BoundaryRule::EdgeOnly});
}

// The referee is cheated: something is changed in OpenSubdiv's refinement before it is judged.
template <class Cheat>
TensorComparison cheated(Cheat cheat) {
    const Grid<dvec3> grid = random_grid(4, 5, 9);
    CatmullClark theirs = refined(grid, kNatural, kClosed, 2);
    cheat(theirs);
    return value_of(compare_tensor(grid, kNatural, kClosed, theirs));
}

TEST(TensorReferee, IsContentWithoutACheat) {
    EXPECT_EQ(cheated([](CatmullClark&) {}).verdict, Verdict::WithinRounding);
}

// A vertex point with 35/64 of itself and 1/64 more of a neighbour.
TEST(TensorReferee, SeesAWrongWeight) {
    const auto seen = cheated([](CatmullClark& theirs) {
        auto& level = theirs.levels[2];
        const auto from = std::find_if(level.ancestors.begin(), level.ancestors.end(),
                                       [](const auto& ancestor) { return ancestor.count == 1; });
        const auto& parents = theirs.levels[1].positions;
        const auto v = static_cast<std::size_t>(from->vertices[0]);
        level.positions[static_cast<std::size_t>(from - level.ancestors.begin())] +=
            (parents[v == 0 ? 1 : 0] - parents[v]) / 64.0;
    });
    EXPECT_EQ(seen.verdict, Verdict::Differs);
    EXPECT_TRUE(contains(seen.note, "level 2 the positions")) << seen.note;
}

TEST(TensorReferee, SeesThreeTimesTheRounding) {
    const auto seen = cheated([](CatmullClark& theirs) {
        theirs.levels[1].positions[3].y +=
            3 * position_bound(1, 1, kCatmullClarkStepRoundings, Precision::Double);
    });
    EXPECT_EQ(seen.verdict, Verdict::Differs);
}

TEST(TensorReferee, SeesSwappedVertices) {
    const auto positions = cheated([](CatmullClark& theirs) {
        std::swap(theirs.levels[2].positions[5], theirs.levels[2].positions[17]);
    });
    EXPECT_EQ(positions.verdict, Verdict::Differs);
    const auto ancestors = cheated([](CatmullClark& theirs) {
        std::swap(theirs.levels[2].ancestors[5], theirs.levels[2].ancestors[17]);
    });
    EXPECT_EQ(ancestors.verdict, Verdict::Differs);
    const auto limits = cheated([](CatmullClark& theirs) {
        std::swap(theirs.levels[1].limit.positions[5], theirs.levels[1].limit.positions[17]);
    });
    EXPECT_TRUE(contains(limits.note, "level 1 the limit positions")) << limits.note;
}

TEST(TensorReferee, SeesANan) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(cheated([&](CatmullClark& c) { c.levels[0].positions[0].x = nan; }).verdict, Verdict::Differs);
    EXPECT_EQ(cheated([&](CatmullClark& c) { c.levels[2].positions[1].z = nan; }).verdict, Verdict::Differs);
    EXPECT_EQ(cheated([&](CatmullClark& c) { c.levels[1].limit.positions[1].y = nan; }).verdict,
              Verdict::Differs);
    EXPECT_EQ(cheated([&](CatmullClark& c) { c.levels[1].limit.tangent2[1].x = nan; }).verdict,
              Verdict::Differs);
}

TEST(TensorReferee, SeesATurnedAndATiltedNormal) {
    const auto turned = cheated(
        [](CatmullClark& c) { std::swap(c.levels[1].limit.tangent1[4], c.levels[1].limit.tangent2[4]); });
    EXPECT_EQ(turned.verdict, Verdict::Differs);
    EXPECT_TRUE(contains(turned.note, "limit normals")) << turned.note;
    EXPECT_GT(turned.levels[1].normal.difference, 3.14);
    const auto tilted =
        cheated([](CatmullClark& c) { c.levels[2].limit.tangent1[9] += dvec3(1e-6, -1e-6, 2e-6); });
    EXPECT_EQ(tilted.verdict, Verdict::Differs);
}

TEST(TensorReferee, RefusesVerticesThatAreNotThoseOfTheGrid) {
    const auto verdict = [](auto cheat) { return cheated(cheat).verdict; };
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels.clear(); }), Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels[0].positions.pop_back(); }), Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels[2].limit.tangent1.pop_back(); }), Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels[1].ancestors.pop_back(); }), Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels[2].ancestors[3] = c.levels[2].ancestors[4]; }),
              Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) {
                  c.levels[1].ancestors[0] = {2, {0, 7, -1, -1}};
              }),
              Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) {
                  c.levels[1].ancestors[0] = {2, {0, 0, -1, -1}};
              }),
              Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) {
                  c.levels[1].ancestors[0] = {1, {99, -1, -1, -1}};
              }),
              Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) {
                  c.levels[1].ancestors[0] = {4, {0, 1, 2, 3}};
              }),
              Verdict::Failed);
    EXPECT_EQ(verdict([](CatmullClark& c) { c.levels[1].ancestors[0].count = 9; }), Verdict::Failed);
}

TEST(TensorComparison, RefusesWhatItCannotCompare) {
    const auto code = [](const Grid<dvec3>& grid, const TensorCase& what) {
        return error_of(compare_tensor(grid, what)).code;
    };
    Grid<dvec3> grid = random_grid(4, 4);
    EXPECT_EQ(code(grid, {.u = Ends::Open}), ErrorCode::Unsupported);
    EXPECT_EQ(code(grid, {.v = Ends::Clamped}), ErrorCode::Unsupported);
    EXPECT_EQ(code(grid, {.levels = -1}), ErrorCode::Unsupported);
    EXPECT_EQ(code(grid, {.levels = 99}), ErrorCode::Unsupported);
    EXPECT_EQ(code({1, 4, std::vector<dvec3>(4)}, {}), ErrorCode::TooFewPoints);
    EXPECT_EQ(code({2, 2, std::vector<dvec3>(5)}, {}), ErrorCode::Unsupported);
    grid.points[5].y = std::nan("");
    EXPECT_EQ(code(grid, {}), ErrorCode::NotFinite);
    grid.points[5].y = 1e35;
    EXPECT_EQ(code(grid, {.precision = Precision::Float}), ErrorCode::NotFinite);
    grid.points[5].y = 1e39;
    EXPECT_EQ(code(grid, {.precision = Precision::Float}), ErrorCode::NotFinite);
}

}  // namespace
}  // namespace loopcheck::compare
