#include "core/mesh/face_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/mesh/high_precision.h"
#include "tests/support/meshes.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::Observed;
using Exact = Vec3<HighPrecision>;
using Corners = std::array<glm::dvec3, 3>;

constexpr double kU = unit_roundoff(Precision::Double);

Exact exact(const glm::dvec3& p) {
    return {HighPrecision(p.x), HighPrecision(p.y), HighPrecision(p.z)};
}
HighPrecision length(const Exact& v) {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
Exact cross(const Exact& a, const Exact& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Exact unit(const Exact& v) {
    return (1 / length(v)) * v;
}

// The normal with 38 digits, and the sine of the largest angle: that of the law of sines, over the two
// shorter sides.
struct ExactNormal {
    Exact normal;
    double sine;
};
ExactNormal exact_normal(const Corners& t) {
    const Exact a = exact(t[0]), b = exact(t[1]), c = exact(t[2]);
    std::array<HighPrecision, 3> sides{length(c - b), length(a - c), length(b - a)};
    std::sort(sides.begin(), sides.end());
    const Exact normal = cross(b - a, c - a);
    return {unit(normal), static_cast<double>(length(normal) / (sides[0] * sides[1]))};
}

// Coordinates in [-1, 1].
glm::dvec3 random_point(std::mt19937_64& random) {
    const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
    const double x = number(), y = number(), z = number();
    return {x, y, z};
}

// A needle or a cap: the third corner is near one end, or near the middle, of the side between the others.
Corners sliver(std::mt19937_64& random, double width) {
    const glm::dvec3 a = random_point(random), b = random_point(random);
    const double along = random() % 2 == 0 ? 0 : std::ldexp(static_cast<double>(random() >> 11), -53);
    Corners t{a, b, a + along * (b - a) + width * random_point(random)};
    std::rotate(t.begin(), t.begin() + static_cast<int>(random() % 3), t.end());
    return t;
}

// Shares of the bound that `make(random)` takes.
template <class Make>
void expect_within_the_bound(const std::string& what, Make make) {
    std::mt19937_64 random(1);
    Observed use(what + ": share of the bound", "triangle", 1);
    for (int i = 0; i < 3000; ++i) {
        const Corners t = make(random);
        const auto normal = unit_normal(t[0], t[1], t[2]);
        if (!normal) continue;
        const ExactNormal e = exact_normal(t);
        use.add(static_cast<double>(length(exact(*normal) - e.normal)) / unit_normal_error(e.sine), i);
    }
    use.check();
}

TEST(UnitNormal, IsWithinTheBoundForAnyTriangle) {
    const auto any = [](std::mt19937_64& random) {
        return Corners{random_point(random), random_point(random), random_point(random)};
    };
    expect_within_the_bound("coordinates near 1", any);
    for (const double scale : {1e300, 1e-300})
        expect_within_the_bound("coordinates near " + shortest(scale), [&](std::mt19937_64& random) {
            Corners t = any(random);
            for (auto& p : t) p *= scale;
            return t;
        });
    expect_within_the_bound("one short side", [&](std::mt19937_64& random) {
        return Corners{1e-300 * random_point(random), 1e-300 * random_point(random), random_point(random)};
    });
}

TEST(UnitNormal, IsWithinTheBoundForSlivers) {
    for (const double width : {1e-4, 1e-8, 1e-12, 1e-14, 1e-15, 2e-16})
        expect_within_the_bound("slivers " + shortest(width) + " wide",
                                [&](std::mt19937_64& random) { return sliver(random, width); });
}

// At its tip the cross product of a needle would have lost most of its digits.
TEST(UnitNormal, OfANeedleIsAsAccurateAsOfAnyTriangle) {
    std::mt19937_64 random(1);
    Observed error("error of the normal of a needle 1e-9 wide, in u", "needle", 7 / std::sqrt(0.5) + 5);
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 tip = random_point(random), side = 1e-9 * random_point(random);
        const glm::dvec3 end{0.0, 0.0, 0.0};
        const Corners t{tip, end, end + side};
        const ExactNormal e = exact_normal(t);
        if (e.sine < std::sqrt(0.5)) continue;
        error.add(static_cast<double>(length(exact(unit_normal(t[0], t[1], t[2]).value()) - e.normal)) / kU,
                  i);
    }
    error.check();
}

TEST(UnitNormal, KeepsItsBitsWhereCornersAreTurnedAndIsNegatedWhereTwoAreSwapped) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto [a, b, c] = sliver(random, std::ldexp(1, -(i % 55)));
        const auto normal = unit_normal(a, b, c);
        EXPECT_EQ(unit_normal(b, c, a), normal) << i;
        EXPECT_EQ(unit_normal(c, a, b), normal) << i;
        const auto swapped = unit_normal(b, a, c);
        ASSERT_EQ(swapped.has_value(), normal.has_value()) << i;
        if (!normal) continue;
        EXPECT_EQ(*swapped, -*normal) << i;
    }
}

TEST(UnitNormal, PointsToWhereTheCornersAreCounterClockwise) {
    EXPECT_EQ(unit_normal({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), glm::dvec3(0, 0, 1));
    EXPECT_EQ(unit_normal({0, 0, 0}, {0, 5e-324, 0}, {0, 0, 5e-324}), glm::dvec3(1, 0, 0));
    EXPECT_EQ(unit_normal({8e307, 0, 0}, {0, 0, 8e307}, {-8e307, 0, 0}), glm::dvec3(0, -1, 0));
}

TEST(UnitNormal, IsNotThereForADegenerateTriangle) {
    const glm::dvec3 p{0.1, 0.2, 0.3}, q{0.7, -0.4, 0.9};
    EXPECT_EQ(unit_normal(p, p, p), std::nullopt);
    EXPECT_EQ(unit_normal(p, p, q), std::nullopt);
    EXPECT_EQ(unit_normal(p, q, p), std::nullopt);
    EXPECT_EQ(unit_normal({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), std::nullopt);
    // On one line but for rounding.
    for (const double t : {0.1, 0.3, 0.7, 3.1})
        EXPECT_EQ(unit_normal(p, q, p + t * (q - p)), std::nullopt) << t;
    EXPECT_NE(unit_normal({0, 0, 0}, {1, 0, 0}, {0.5, 1e-14, 0}), std::nullopt);
}

TEST(FaceNormals, AreThoseOfTheFacesInTheirOrder) {
    const auto mesh = tests::mesh_of(tests::tetrahedron());
    const auto normals = face_normals(mesh.topology(), mesh.positions());
    ASSERT_EQ(normals.size(), 4U);
    EXPECT_EQ(normals[0], glm::dvec3(0, 0, -1));
    EXPECT_EQ(normals[1], glm::dvec3(0, -1, 0));
    EXPECT_EQ(normals[2], glm::dvec3(-1, 0, 0));
    EXPECT_LE(glm::length(*normals[3] - glm::dvec3(std::sqrt(1.0 / 3))), unit_normal_error(std::sqrt(0.75)));
}

// With 38 digits, from the vectors over their lengths.
HighPrecision exact_angle(const glm::dvec3& m, const glm::dvec3& n) {
    const Exact a = unit(exact(m)), b = unit(exact(n));
    return 2 * atan2(length(a - b), length(a + b));
}

// Angles from 1 to 1e-18, as many from pi, and any, of vectors that are 2 u longer and shorter than they
// should be.
TEST(AngleBetween, IsWithinTheBoundAlsoNear0AndPi) {
    std::mt19937_64 random(1);
    Observed error("error of an angle, in u", "pair", kAngleError / kU);
    for (int i = 0; i < 6000; ++i) {
        const glm::dvec3 m = glm::normalize(random_point(random)),
                         other = glm::normalize(random_point(random));
        const double share = i % 3 == 0 ? 1 : std::pow(10, -(i % 19));
        const glm::dvec3 n = (i % 2 == 0 ? 1.0 : -1.0) * glm::normalize(m + share * other);
        const glm::dvec3 longer = (1 + 2 * kU) * m, shorter = (1 - 2 * kU) * n;
        const double got = angle_between(longer, shorter);
        const HighPrecision wanted = exact_angle(longer, shorter);
        error.add(tests::error_of_value(got, wanted) / kU, i, got, static_cast<double>(wanted));
        ASSERT_EQ(got, angle_between(shorter, longer));
    }
    error.check();
}

TEST(AngleBetween, IsExactWhereItCanBe) {
    const double pi = std::acos(-1.0);
    const glm::dvec3 x{1, 0, 0}, y{0, 1, 0};
    EXPECT_EQ(angle_between(x, x), 0);
    EXPECT_EQ(angle_between(x, -x), pi);
    EXPECT_EQ(angle_between(x, y), pi / 2);
    EXPECT_EQ(angle_between(x, {1, 1e-17, 0}), 1e-17);
}

}  // namespace
}  // namespace loopcheck::core
