#include "core/loop/tessellation/quartic_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/meshes.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

std::array<glm::dvec3, kPatchPoints> scattered_patch() {
    std::array<glm::dvec3, kPatchPoints> out;
    const auto points = tests::scattered(kPatchPoints);
    std::copy(points.begin(), points.end(), out.begin());
    return out;
}

glm::dvec3 value(const std::array<glm::dvec3, kPatchPoints>& patch, const Barycentric& at) {
    const auto basis = patch_basis(at[1], at[2]);
    glm::dvec3 sum(0);
    for (int p = 0; p < kPatchPoints; ++p) sum += basis[0][p] * patch[p];
    return sum;
}

// The point of the quartic: restricted to a triangle that is that point.
glm::dvec3 value(const QuarticTriangle& quartic, const Barycentric& at) {
    return restricted(quartic, {at, at, at}).points[7];
}

Barycentric mix(const SubTriangle& corners, const Barycentric& at) {
    Barycentric out{0, 0, 0};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) out[k] += at[i] * corners[i][k];
    return out;
}

const std::vector<Barycentric> kPlaces{{1, 0, 0},          {0, 1, 0},       {0, 0, 1},
                                       {0.5, 0.25, 0.25},  {0, 0.75, 0.25}, {0.125, 0.25, 0.625},
                                       {0.375, 0.625, 0.0}};

// Numbers are below 2; a value is a sum of 12 terms, or four steps of three.
constexpr double kRounding = 2 * (12 + kBasisRoundings + 8) * 0x1p-53;

TEST(QuarticTriangle, IsTheSurfaceOfItsTwelvePoints) {
    const auto patch = scattered_patch();
    const QuarticTriangle quartic = quartic_triangle(patch);
    tests::Observed observed("difference of a point", "scattered", kRounding);
    for (const Barycentric& at : kPlaces) {
        const glm::dvec3 off = value(quartic, at) - value(patch, at);
        for (int axis = 0; axis < 3; ++axis) observed.add(std::abs(off[axis]), axis);
    }
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 off = quartic.corner(i) - value(patch, kWholeTriangle[i]);
        for (int axis = 0; axis < 3; ++axis) observed.add(std::abs(off[axis]), axis);
    }
    observed.check();
}

TEST(QuarticTriangle, IsTheSameSurfaceWhereItIsRestricted) {
    const QuarticTriangle quartic = quartic_triangle(scattered_patch());
    tests::Observed observed("difference of a point", "scattered", kRounding);
    std::vector<SubTriangle> parts(kChildTriangles.begin(), kChildTriangles.end());
    parts.push_back(kWholeTriangle);
    parts.push_back({{{1, 0, 0}, {0.5, 0.5, 0}, {0, 0, 1}}});
    parts.push_back({{{0.125, 0.375, 0.5}, {0.75, 0.25, 0}, {0.5, 0, 0.5}}});
    for (const SubTriangle& part : parts) {
        const QuarticTriangle inside = restricted(quartic, part);
        for (const Barycentric& at : kPlaces) {
            const glm::dvec3 off = value(inside, at) - value(quartic, mix(part, at));
            for (int axis = 0; axis < 3; ++axis) observed.add(std::abs(off[axis]), axis);
        }
    }
    observed.check();
}

// Bernstein points of a linear surface are on a grid.
TEST(QuarticTriangle, KeepsWhatIsLinear) {
    std::array<glm::dvec3, kPatchPoints> patch{{{0, 0, 1},
                                                {12, 0, 1},
                                                {0, 12, 1},
                                                {12, -12, 1},
                                                {12, 12, 1},
                                                {-12, 12, 1},
                                                {-12, 0, 1},
                                                {0, -12, 1},
                                                {24, -12, 1},
                                                {24, 0, 1},
                                                {0, 24, 1},
                                                {-12, 24, 1}}};
    const QuarticTriangle quartic = quartic_triangle(patch);
    constexpr auto monomials = detail::monomials();
    for (int j = 0; j < detail::kMonomials; ++j)
        EXPECT_EQ(quartic.points[j], glm::dvec3(3.0 * monomials[j].b, 3.0 * monomials[j].c, 1)) << j;
}

}  // namespace
}  // namespace loopcheck::core
