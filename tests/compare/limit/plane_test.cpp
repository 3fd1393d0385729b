#include "compare/limit/plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "tests/support/observed.h"

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using glm::dvec3;

DoubleDouble3 widened(const dvec3& t) {
    return {{{t.x, 0}, {t.y, 0}, {t.z, 0}}};
}

double coordinate(std::mt19937& random) {
    return static_cast<double>(random()) / 0x1p31 - 1;
}

dvec3 vector(std::mt19937& random) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return {x, y, z};
}

TEST(DoubleDoubleSum, IsRightToItsBound) {
    std::mt19937 random(1);
    tests::Observed seen("error / (2^-102 m sum |w||x|)", "trial", 1);
    for (int trial = 0; trial < 20000; ++trial) {
        DoubleDouble sum;
        HighPrecision exact = 0, size = 0;
        const int m = 1 + trial % 12;
        for (int j = 0; j < m; ++j) {
            const HighPrecision w = HighPrecision(coordinate(random)) / 3;
            const DoubleDouble wide{std::ldexp(coordinate(random), static_cast<int>(random() % 40)),
                                    coordinate(random) * 0x1p-60};
            const DoubleDouble weight = to_double_double(w);
            add_product(sum, weight, wide);
            const HighPrecision term =
                (HighPrecision(weight.high) + weight.low) * (HighPrecision(wide.high) + wide.low);
            exact += term;
            size += abs(term);
        }
        const HighPrecision error = abs(HighPrecision(sum.high) + sum.low - exact);
        seen.add(static_cast<double>(HighPrecision(error / (m * size))) * 0x1p102, trial);
    }
    seen.check();
}

TEST(AngleBetween, IsRightForTheTiniestAngles) {
    const Plane flat = plane_of(dvec3(1, 0, 0), dvec3(0, 1, 0));
    for (const double angle : {0.0, 1e-300, 1e-16, 1e-9, 1e-3, 0.5, std::numbers::pi / 2 - 1e-9}) {
        const Plane turned = plane_of(dvec3(1, 0, 0), dvec3(0, std::cos(angle), std::sin(angle)));
        EXPECT_NEAR(angle_between(flat, turned), angle, 4 * 0x1p-53);
        // As planes: the other side is the same plane.
        EXPECT_NEAR(angle_between(plane_of(dvec3(0, 1, 0), dvec3(1, 0, 0)), turned), angle, 4 * 0x1p-53);
    }
    EXPECT_TRUE(std::isinf(angle_between(flat, plane_of(dvec3(1, 2, 3), dvec3(2, 4, 6)))));
    EXPECT_TRUE(std::isinf(angle_between(flat, plane_of(dvec3(1, 2, NAN), dvec3(2, 4, 6)))));
}

TEST(PlaneOf, NeitherOverflowsNorUnderflows) {
    for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
        const Plane plane = plane_of(dvec3(scale, 0, 0), dvec3(0, 3e-300, 3e-300));
        EXPECT_NEAR(angle_between(plane, plane_of(dvec3(1, 0, 0), dvec3(0, 1, 1))), 0, kAngleSlack);
    }
}

TEST(PlaneOf, BoundsTheAngleOfEveryErrorItAllows) {
    std::mt19937 random(2);
    tests::Observed seen("angle / bound", "trial", 1);
    for (int trial = 0; trial < 20000; ++trial) {
        const dvec3 t1 = vector(random),
                    e1 = std::ldexp(1.0, -10 - static_cast<int>(random() % 40)) * glm::abs(vector(random));
        // From well apart to almost parallel.
        const dvec3 t2 = t1 + std::ldexp(1.0, -static_cast<int>(random() % 12)) * vector(random);
        const dvec3 e2 = std::ldexp(1.0, -10 - static_cast<int>(random() % 40)) * glm::abs(vector(random));
        const Plane plane = plane_of(widened(t1), widened(t2), e1, e2);
        if (!std::isfinite(plane.bound)) continue;
        const auto signs = [&] { return glm::sign(vector(random)); };
        const double angle = angle_between(plane, plane_of(t1 + signs() * e1, t2 + signs() * e2));
        seen.add(angle / plane.bound, trial);
    }
    seen.check();
    EXPECT_GT(seen.largest(), 0.1) << "the bound is of the right size";
}

TEST(PlaneOf, SaysWhereRoundingCouldTurnItAnywhere) {
    const dvec3 t1(1, 0, 0), t2(1, 1e-6, 0), none(0), small(1e-8), large(1e-5);
    EXPECT_LT(plane_of(widened(t1), widened(t2), none, none).bound, 2 * kAngleSlack);
    EXPECT_TRUE(std::isfinite(plane_of(widened(t1), widened(t2), small, small).bound));
    EXPECT_TRUE(std::isinf(plane_of(widened(t1), widened(t2), large, none).bound));
    EXPECT_FALSE(plane_of(widened(t1), widened(t1), none, none).exists());
}

}  // namespace
}  // namespace loopcheck::compare
