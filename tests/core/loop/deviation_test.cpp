#include "core/loop/tessellation/deviation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/mesh/rounding.h"

namespace loopcheck::core {
namespace {

const PlacedTriangle kTriangle = placed_triangle({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}});
const double kInfinity = std::numeric_limits<double>::infinity();

TEST(DistanceToTriangle, IsThatToItsInsideItsEdgesOrItsCorners) {
    EXPECT_EQ(distance_to(kTriangle, {1, 1, 0}), 0);
    EXPECT_EQ(distance_to(kTriangle, {1, 1, -3}), 3);
    EXPECT_EQ(distance_to(kTriangle, {2, -3, 4}), 5);                  // the edge y = 0
    EXPECT_EQ(distance_to(kTriangle, {-3, -4, 12}), 13);               // the corner 0
    EXPECT_EQ(distance_to(kTriangle, {7, -4, 0}), 5);                  // the corner (4, 0)
    EXPECT_EQ(distance_to(kTriangle, {4, 4, 0}), 2 * std::sqrt(2.0));  // nothing but the root is rounded
}

TEST(DistanceToTriangle, HoldsForDegenerateTriangles) {
    const PlacedTriangle segment = placed_triangle({{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}});
    EXPECT_FALSE(segment.normal);
    EXPECT_EQ(distance_to(segment, {2, 3, 4}), 5);
    EXPECT_EQ(distance_to(segment, {7, 0, 4}), 5);
    const PlacedTriangle point = placed_triangle({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}});
    EXPECT_EQ(distance_to(point, {4, 5, 1}), 5);
}

TEST(Deviation, IsTheLargestOfTheHull) {
    const std::vector<glm::dvec3> hull{{1, 1, 2}, {2, -3, -1}, {1, 0, 0}};
    const Deviation deviation = deviation_of(hull, kTriangle);
    EXPECT_EQ(deviation.distance, std::sqrt(10.0));
    EXPECT_EQ(deviation.height, 2);
    EXPECT_EQ(deviation.aside, 3);
    const PlacedTriangle segment = placed_triangle({{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}});
    EXPECT_EQ(deviation_of(hull, segment).height, deviation_of(hull, segment).distance);
}

// The lattice around kTriangle, bent along its edges by `rise` outside.
struct BentStar {
    std::vector<PlacedTriangle> triangles;
    std::vector<BorderEdge> border;
};
BentStar bent_star(double rise) {
    const std::vector<glm::dvec3> ring{{-4, 0, rise}, {0, -4, rise}, {4, -4, rise},
                                       {8, -4, rise}, {8, 0, rise},  {4, 4, rise},
                                       {0, 8, rise},  {-4, 8, rise}, {-4, 4, rise}};
    // Which corner each border edge sees.
    const std::array<int, 9> corner{0, 0, 1, 1, 1, 2, 2, 2, 0};
    BentStar out{{kTriangle}, {}};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3& a = ring[i];
        const glm::dvec3& b = ring[(i + 1) % ring.size()];
        out.border.push_back({a, b});
        out.triangles.push_back(placed_triangle({kTriangle.corners[corner[i]], a, b}));
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        out.triangles.push_back(placed_triangle({kTriangle.corners[j], kTriangle.corners[i],
                                                 ring[i == 0   ? 2
                                                      : i == 1 ? 5
                                                               : 8]}));
    }
    return out;
}

double bound(const Deviation& deviation, double rise) {
    const BentStar around = bent_star(rise);
    return distance_to_star(deviation, kTriangle, around.triangles, around.border);
}

TEST(DistanceToStar, IsTheHeightWhereTheStarIsFlat) {
    EXPECT_EQ(bound({9, 0.5, 1}, 0), 0.5);
}

TEST(DistanceToStar, AddsTheClimb) {
    // The steepest rises 1 over the distance of the corner (0, 0) from the line x + y = -4.  Its largest
    // angle and that of kTriangle are nearly right, so their normals are off by 12.1 u at most; the sine and
    // the cosine, 0.94, of their angle by 24.2 u and 3 roundings, and the slope by 27.2 (1 + 0.36) / 0.94 u
    // and one more.
    EXPECT_NEAR(bound({9, 0.5, 1}, 1), 0.5 + std::sqrt(2.0) / 4, 41 * unit_roundoff(Precision::Double));
}

TEST(DistanceToStar, SaysNothingBeyondTheBorder) {
    const double border = 2 * std::sqrt(2.0);  // of the lattice: x + y = -4 from the corner, and the others
    EXPECT_EQ(bound({9, 0.5, border * 0.999}, 0), 0.5);
    EXPECT_EQ(bound({9, 0.5, border * 1.001}, 0), kInfinity);
}

TEST(DistanceToStar, SaysNothingWhereItIsSteepOrDegenerate) {
    EXPECT_LT(bound({9, 0.5, 1}, 16), kInfinity);  // the slope is 16 / sqrt(8), 79.98 degrees
    EXPECT_EQ(bound({9, 0.5, 1}, 17), kInfinity);
    BentStar around = bent_star(0);
    around.triangles.push_back(placed_triangle({{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}}}));
    EXPECT_EQ(distance_to_star({9, 0.5, 1}, kTriangle, around.triangles, around.border), kInfinity);
    const PlacedTriangle flipped = placed_triangle({{{0, 0, 0}, {0, 4, 0}, {4, 0, 0}}});
    around = bent_star(0);
    around.triangles.push_back(flipped);
    EXPECT_EQ(distance_to_star({9, 0.5, 1}, kTriangle, around.triangles, around.border), kInfinity);
}

}  // namespace
}  // namespace loopcheck::core
