#include "reference/opensubdiv/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/observed.h"

namespace loopcheck::reference {
namespace {

using core::Index;
using core::SurfaceLocation;
using core::SurfaceRows;
using enum SurfaceMethod;
using namespace tests;

constexpr SurfaceMethod kMethods[]{Bfr, PatchGregory, PatchBox, PatchLinear};
using Surfaces = std::vector<std::optional<SurfaceRows>>;

core::Result<Surfaces> surface(const core::MeshData& data, SurfaceSettings settings,
                               const std::vector<SurfaceLocation>& locations,
                               core::SchemeOptions options = {}) {
    return opensubdiv_surface(mesh_of(data), options, settings, locations);
}

// A grid of n (n + 1) / 2 parameters in each face, corners included.
std::vector<SurfaceLocation> grid(Index faces, int n) {
    std::vector<SurfaceLocation> out;
    for (Index f = 0; f < faces; ++f)
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
                out.push_back({f, static_cast<double>(i) / (n - 1), static_cast<double>(j) / (n - 1)});
    return out;
}

glm::dvec3 apply(const SurfaceRows& rows, const core::MeshData& data, int derivative) {
    glm::dvec3 sum(0);
    for (std::size_t j = 0; j < rows.columns.size(); ++j)
        sum += rows.weights[derivative][j] * data.positions[rows.columns[j]];
    return sum;
}

// Sum of |weight of a - weight of b|.
double distance(const SurfaceRows& a, const SurfaceRows& b, int derivative) {
    std::map<Index, double> difference;
    for (std::size_t j = 0; j < a.columns.size(); ++j) difference[a.columns[j]] += a.weights[derivative][j];
    for (std::size_t j = 0; j < b.columns.size(); ++j) difference[b.columns[j]] -= b.weights[derivative][j];
    double sum = 0;
    for (const auto& [column, weight] : difference) sum += std::abs(weight);
    return sum;
}

double largest_distance(const Surfaces& a, const Surfaces& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, distance(*a[i], *b[i], 0));
    return largest;
}

// Creases that end, meet and turn, semi-sharp and not, with a corner, on irregular vertices.
core::MeshData tagged() {
    core::MeshData data = bipyramid(7);
    data.creases = {{0, 2, 10}, {2, 3, 10}, {0, 5, 1.5F}, {1, 4, 0.5F}};
    data.corners = {{6, 10}, {7, 2.5F}};
    return data;
}

TEST(OpensubdivSurface, HasPositionRowsThatSumToOneAndDerivativeRowsToZero) {
    // Rounding only.  A chain of 32 roundings; the derivatives of a quartic basis in Bernstein form add up to
    // 8 and 48 at most; a patch of level l has 2^l and 4^l as factors.  The box end cap converts with six
    // digits.
    constexpr double kBasis[]{1, 8, 48};
    for (const auto method : kMethods) {
        const SurfaceSettings settings{method, 2, 4};
        const auto rows = surface(tagged(), settings, grid(14, 9));
        ASSERT_TRUE(rows);
        for (int d = 0; d < core::kDerivatives; ++d) {
            const int order = d == 0 ? 0 : d < 3 ? 1 : 2;
            const double rounding = method == PatchBox ? 1e-6 : 32 * 0x1p-53;
            Observed seen(
                fmt::format("{} {} row sum", name(method), core::name(static_cast<core::Derivative>(d))),
                "location", std::ldexp(rounding * kBasis[order], order * settings.sharp_level));
            for (std::size_t i = 0; i < rows->size(); ++i) {
                const auto& w = (*rows)[i]->weights[d];
                const double wanted = d == 0 ? 1 : 0, sum = std::accumulate(w.begin(), w.end(), 0.);
                seen.add(std::abs(sum - wanted), static_cast<std::int64_t>(i), sum, wanted);
            }
            seen.check();
        }
    }
}

TEST(OpensubdivSurface, HasAscendingColumnsAndAWeightForEach) {
    for (const auto method : kMethods) {
        const auto rows = surface(tagged(), {method, 2, 4}, grid(14, 3));
        ASSERT_TRUE(rows);
        for (const auto& row : *rows) {
            ASSERT_TRUE(row);
            EXPECT_TRUE(std::is_sorted(row->columns.begin(), row->columns.end(), std::less_equal<>()));
            for (const auto& weights : row->weights) EXPECT_EQ(weights.size(), row->columns.size());
        }
    }
}

TEST(OpensubdivSurface, AtACornerOfARegularFaceIsTheLimitMask) {
    const LoadedModel torus = load_model(model_path("torus"));
    const auto& t = torus.mesh.topology();
    const std::vector<SurfaceLocation> corners{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto method : kMethods) {
        const auto rows = opensubdiv_surface(torus.mesh, torus.options, {method}, corners);
        ASSERT_TRUE(rows);
        for (int i = 0; i < 3; ++i) {
            const Index v = t.triangles[0][i];
            SurfaceRows mask{{v}, {}};
            mask.weights[0] = {1. / 2};
            for (const Index e : t.ring(v)) {
                mask.columns.push_back(t.other_end(e, v));
                mask.weights[0].push_back(1. / 12);
            }
            // 12 weights, each of a few roundings of numbers below 1.
            EXPECT_LE(distance(*(*rows)[i], mask, 0), 12 * 4 * 0x1p-53) << name(method) << " corner " << i;
        }
    }
}

TEST(OpensubdivSurface, OfARegularFaceIsTheSameByEveryMethod) {
    const LoadedModel torus = load_model(model_path("torus"));
    const auto locations = grid(torus.mesh.face_count(), 5);
    const auto bfr = opensubdiv_surface(torus.mesh, torus.options, {Bfr}, locations);
    for (const auto method : {PatchGregory, PatchBox, PatchLinear}) {
        const auto rows = opensubdiv_surface(torus.mesh, torus.options, {method}, locations);
        ASSERT_TRUE(bfr && rows);
        for (std::size_t i = 0; i < locations.size(); ++i)
            for (int d = 0; d < core::kDerivatives; ++d)
                EXPECT_LE(distance(*(*bfr)[i], *(*rows)[i], d), 1e-14)
                    << name(method) << " " << i << " " << d;
    }
}

TEST(OpensubdivSurface, OfBfrIsThatOfGregoryPatchesWithExactSharpness) {
    const auto locations = grid(14, 9);
    const auto bfr = surface(tagged(), {Bfr, 2, 4}, locations);
    const auto exact = surface(tagged(), {PatchGregory, 2, 4, PatchSharpness::Exact}, locations);
    const auto as_it_comes = surface(tagged(), {PatchGregory, 2, 4, PatchSharpness::Default}, locations);
    ASSERT_TRUE(bfr && exact && as_it_comes);
    EXPECT_LE(largest_distance(*bfr, *exact), 1e-14);
    EXPECT_GT(largest_distance(*bfr, *as_it_comes), 1e-2);
}

TEST(OpensubdivSurface, OfBfrMissesHowChaikinEvensOutACrease) {
    // Bfr looks at the edges around the vertices of a face.  Chaikin's rule moves the sharpness of an edge
    // towards those of its neighbours on the crease, some of which are further away.
    const core::MeshData data = core::read_model(model_path("chaikin-graded"))->data;
    const auto locations = grid(static_cast<Index>(data.face_sizes.size()), 9);
    for (const auto& [creasing, least, most] :
         {std::tuple{core::Creasing::Uniform, 0., 1e-14}, {core::Creasing::Chaikin, 1e-3, 1.}}) {
        const core::SchemeOptions options{.creasing = creasing};
        const auto bfr = surface(data, {Bfr, 6, 6}, locations, options);
        const auto patches = surface(data, {PatchGregory, 6, 6, PatchSharpness::Exact}, locations, options);
        ASSERT_TRUE(bfr && patches);
        EXPECT_GE(largest_distance(*bfr, *patches), least);
        EXPECT_LE(largest_distance(*bfr, *patches), most);
    }
}

// The location and its neighbours at a distance h in u and v, on one face of the bipyramid of valence 5.
struct Around {
    const double h = 1e-5;
    core::MeshData data = bipyramid(5);
    Surfaces rows;

    Around(SurfaceMethod method, double u, double v) {
        rows = *surface(data, {method, 2, 6},
                        {{0, u, v}, {0, u + h, v}, {0, u - h, v}, {0, u, v + h}, {0, u, v - h}});
    }
    glm::dvec3 value(int d) const { return apply(*rows[0], data, d); }
    glm::dvec3 along_u(int d) const {
        return (apply(*rows[1], data, d) - apply(*rows[2], data, d)) / (2 * h);
    }
    glm::dvec3 along_v(int d) const {
        return (apply(*rows[3], data, d) - apply(*rows[4], data, d)) / (2 * h);
    }
};

// Differences over h err by h^2 times a third derivative, which is of order 10 here, and by 1e-16 / h.
constexpr double kDifferenceError = 1e-8;

TEST(OpensubdivSurface, HasTheDerivativesOfItsPositions) {
    for (const auto method : kMethods) {
        const Around at(method, 0.3, 0.05);
        EXPECT_LE(glm::distance(at.value(1), at.along_u(0)), kDifferenceError) << name(method);
        EXPECT_LE(glm::distance(at.value(2), at.along_v(0)), kDifferenceError) << name(method);
        EXPECT_LE(glm::distance(at.value(3), at.along_u(1)), kDifferenceError) << name(method);
        EXPECT_LE(glm::distance(at.value(4), at.along_v(1)), kDifferenceError) << name(method);
        EXPECT_LE(glm::distance(at.value(5), at.along_v(2)), kDifferenceError) << name(method);
    }
}

TEST(OpensubdivSurface, NegatesSecondDerivativesInCentreTriangles) {
    // The whole centre triangle of level 1 is one patch, turned by half a circle; so is that of level 2 next
    // to corner 0.
    for (const auto& [u, v] : {std::pair{0.34, 0.33}, {0.17, 0.16}})
        for (const auto method : kMethods) {
            const Around at(method, u, v);
            EXPECT_LE(glm::distance(at.value(1), at.along_u(0)), kDifferenceError) << name(method);
            EXPECT_LE(glm::distance(at.value(3), -at.along_u(1)), kDifferenceError) << name(method);
            EXPECT_LE(glm::distance(at.value(4), -at.along_v(1)), kDifferenceError) << name(method);
            EXPECT_LE(glm::distance(at.value(5), -at.along_v(2)), kDifferenceError) << name(method);
        }
}

TEST(OpensubdivSurface, IsNowhereInHolesNorAtBoundariesUnderNone) {
    core::MeshData holed = bipyramid(5);
    holed.holes = {3};
    const auto locations = grid(10, 3);
    const LoadedModel patch = load_model(model_path("grid-4x4"));
    const auto& t = patch.mesh.topology();
    const auto in_patch = grid(patch.mesh.face_count(), 2);
    for (const auto method : kMethods) {
        const auto rows = surface(holed, {method}, locations);
        ASSERT_TRUE(rows);
        for (std::size_t i = 0; i < locations.size(); ++i)
            EXPECT_EQ((*rows)[i].has_value(), locations[i].face != 3) << name(method) << " " << i;

        const auto none =
            opensubdiv_surface(patch.mesh, {.boundary = core::BoundaryRule::None}, {method}, in_patch);
        ASSERT_TRUE(none);
        int there = 0;
        for (std::size_t i = 0; i < in_patch.size(); ++i) {
            const auto& corners = t.triangles[in_patch[i].face];
            const bool inside = std::none_of(corners.begin(), corners.end(),
                                             [&](Index v) { return t.is_boundary_vertex(v); });
            EXPECT_EQ((*none)[i].has_value(), inside) << name(method) << " " << i;
            there += inside ? 1 : 0;
        }
        EXPECT_GT(there, 0);
    }
}

TEST(OpensubdivSurface, KeepsTheOrderOfTheLocations) {
    auto locations = grid(10, 4);
    const auto forward = surface(bipyramid(5), {Bfr}, locations);
    std::reverse(locations.begin(), locations.end());
    auto backward = surface(bipyramid(5), {Bfr}, locations);
    ASSERT_TRUE(forward && backward);
    std::reverse(backward->begin(), backward->end());
    EXPECT_EQ(largest_distance(*forward, *backward), 0);
}

TEST(OpensubdivSurface, TakesEveryLevelAndRefusesTheOthers) {
    for (const auto method : kMethods) {
        for (const auto& [smooth, sharp] : {std::pair{1, 1}, {1, 10}, {10, 10}}) {
            const auto rows = surface(tagged(), {method, smooth, sharp}, {{0, 0.25, 0.25}});
            ASSERT_TRUE(rows) << name(method) << " " << smooth << " " << sharp;
            EXPECT_TRUE((*rows)[0]);
        }
        for (const auto& [smooth, sharp] : {std::pair{-1, 6}, {0, 6}, {3, 2}, {2, 11}, {16, 16}}) {
            const auto rows = surface(tagged(), {method, smooth, sharp}, {{0, 0.25, 0.25}});
            ASSERT_FALSE(rows) << name(method) << " " << smooth << " " << sharp;
            EXPECT_EQ(rows.error().code, core::ErrorCode::Unsupported);
        }
    }
    core::SchemeOptions warren;
    warren.weights = core::Weights::Warren;
    EXPECT_EQ(surface(triangle(), {}, {}, warren).error().code, core::ErrorCode::Unsupported);
}

TEST(OpensubdivSurface, IsNotAskedOfBfrAtASharpVertexOfValenceTwo) {
    core::MeshData pillow = bipyramid(4);  // and next to it three vertices of valence 2
    for (int i = 0; i < 3; ++i) pillow.positions.emplace_back(i, 10, i * i);
    pillow.add_face(core::Triangle{6, 7, 8});
    pillow.add_face(core::Triangle{6, 8, 7});
    const auto locations = grid(10, 3);
    EXPECT_TRUE(surface(pillow, {Bfr}, locations));
    pillow.creases = {{7, 8, 0.5F}};
    const auto refused = surface(pillow, {Bfr}, locations);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::Unsupported);
    EXPECT_EQ(refused.error().place, (core::Place{core::Place::Kind::Vertex, 6}));
    EXPECT_TRUE(surface(pillow, {PatchGregory}, locations));
    pillow.creases.clear();
    pillow.corners = {{8, 10}};
    EXPECT_FALSE(surface(pillow, {Bfr}, locations));
}

}  // namespace
}  // namespace loopcheck::reference
