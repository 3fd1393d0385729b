#include "compare/fractions.h"

#include <gtest/gtest.h>
#include <boost/math/constants/constants.hpp>

#include <numeric>

namespace loopcheck::compare {
namespace {

using High = core::HighPrecision;

std::string text(const High& value) {
    return as_fraction(value).value_or("none");
}

TEST(Fraction, IsFoundForEveryFractionOfSmallNumbers) {
    for (int q = 1; q <= 60; ++q)
        for (int p = -2 * q; p <= 2 * q; ++p) {
            if (std::gcd(p, q) != 1) continue;
            const auto wanted = q == 1 ? std::to_string(p) : std::to_string(p) + "/" + std::to_string(q);
            EXPECT_EQ(text(High(p) / q), wanted);
        }
    EXPECT_EQ(text(High(7) / 71), "7/71");
    EXPECT_EQ(text(High(123456) / 999983), "123456/999983");
}

TEST(Fraction, IsNotSeenInWhatIsNone) {
    EXPECT_EQ(text(sqrt(High(2))), "none");
    EXPECT_EQ(text(boost::math::constants::pi<High>()), "none");
    EXPECT_EQ(text(High(1) / 1000003), "none");
    EXPECT_EQ(text(High(1) / 3 + High("1e-25")), "none");
    EXPECT_EQ(text(High("1e-35")), "none");
}

}  // namespace
}  // namespace loopcheck::compare
