#include "core/loop/masks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::error_of_value;
using tests::Observed;
using Point = Mask::Point;
using Places = std::vector<int>;
using Fractions = std::vector<Rational>;

Fractions loop_fractions(const Mask& mask) {
    return weights_of<Rational>(mask, Weights::Loop);
}

// A list of numerators over one denominator.
Fractions over(int denominator, const std::vector<int>& numerators) {
    Fractions out;
    for (const int n : numerators) out.push_back(Rational(n, denominator));
    return out;
}

constexpr Mask kSmoothEdge{.point = Point::Edge};
constexpr Mask kCreaseEdge{.point = Point::Edge, .parent = VertexRule::Crease, .child = VertexRule::Crease};

constexpr Mask blended_edge(float share) {
    return {.point = Point::Edge, .parent = VertexRule::Crease, .child = VertexRule::Smooth, .share = share};
}
constexpr Mask vertex_mask(VertexRule rule, int ring, Mask::Ends crease = {}) {
    return {.parent = rule, .child = rule, .ring = ring, .parent_crease = crease};
}
constexpr Mask blended_vertex(VertexRule parent, VertexRule child, int ring, float share,
                              Mask::Ends parent_crease = {}, Mask::Ends child_crease = {}) {
    return {.parent = parent,
            .child = child,
            .ring = ring,
            .parent_crease = parent_crease,
            .child_crease = child_crease,
            .share = share};
}

TEST(EdgeMask, SmoothIsThreeEighthsAndOneEighth) {
    EXPECT_EQ(places_of(kSmoothEdge), (Places{0, 1, 2, 3}));
    EXPECT_EQ(loop_fractions(kSmoothEdge), over(8, {3, 3, 1, 1}));
}

TEST(EdgeMask, BoundaryAndCreaseAreHalves) {
    EXPECT_EQ(places_of(kCreaseEdge), (Places{0, 1}));
    EXPECT_EQ(loop_fractions(kCreaseEdge), over(2, {1, 1}));
}

TEST(EdgeMask, SemiSharpIsAShareOfBoth) {
    EXPECT_EQ(places_of(blended_edge(0.25F)), (Places{0, 1, 2, 3}));
    EXPECT_EQ(loop_fractions(blended_edge(0.25F)), over(32, {13, 13, 3, 3}));
    EXPECT_EQ(loop_fractions(blended_edge(0.5F)), over(16, {7, 7, 1, 1}));
    EXPECT_EQ(loop_fractions(blended_edge(0.75F)), over(32, {15, 15, 1, 1}));
}

// OpenSubdiv's share of a Chaikin crease of 1.2: .525 .525 -.025 -.025, but for the rounding of 1.2 to float.
TEST(EdgeMask, AShareAboveOneWeighsTheSmoothRuleNegatively) {
    const auto w = loop_fractions(blended_edge(1.2F));
    const Rational rounding = Rational(12, 10) - Rational(1.2F);
    EXPECT_EQ(w[0], Rational(525, 1000) - rounding / 8);
    EXPECT_EQ(w[1], w[0]);
    EXPECT_EQ(w[2], Rational(-25, 1000) + rounding / 8);
    EXPECT_EQ(w[3], w[2]);
}

TEST(VertexMask, SmoothIsLoopsRing) {
    EXPECT_EQ(loop_fractions(vertex_mask(VertexRule::Smooth, 2)), over(128, {39, 39, 50}));
    EXPECT_EQ(loop_fractions(vertex_mask(VertexRule::Smooth, 3)), over(16, {3, 3, 3, 7}));
    EXPECT_EQ(loop_fractions(vertex_mask(VertexRule::Smooth, 4)), over(256, {31, 31, 31, 31, 132}));
    EXPECT_EQ(loop_fractions(vertex_mask(VertexRule::Smooth, 6)), over(16, {1, 1, 1, 1, 1, 1, 10}));
    EXPECT_EQ(places_of(vertex_mask(VertexRule::Smooth, 4)), (Places{0, 1, 2, 3, 4}));
}

TEST(VertexMask, SmoothIsWarrensRingWhereAsked) {
    EXPECT_EQ(weights_of<Rational>(vertex_mask(VertexRule::Smooth, 5), Weights::Warren),
              over(40, {3, 3, 3, 3, 3, 25}));
    EXPECT_EQ(weights_of<Rational>(vertex_mask(VertexRule::Smooth, 3), Weights::Warren),
              over(16, {3, 3, 3, 7}));
}

TEST(VertexMask, DartIsLikeSmooth) {
    for (const int n : {3, 4, 6}) {
        const Mask dart = vertex_mask(VertexRule::Dart, n), smooth = vertex_mask(VertexRule::Smooth, n);
        EXPECT_EQ(places_of(dart), places_of(smooth));
        EXPECT_EQ(loop_fractions(dart), loop_fractions(smooth));
    }
}

TEST(VertexMask, CreaseReadsItsTwoNeighboursAlongTheCrease) {
    const Mask mask = vertex_mask(VertexRule::Crease, 7, {2, 5});
    EXPECT_EQ(places_of(mask), (Places{2, 5, 7}));
    EXPECT_EQ(loop_fractions(mask), over(8, {1, 1, 6}));
}

TEST(VertexMask, CornerStaysWhereItIs) {
    for (const int ring : {0, 3, 9}) {
        EXPECT_EQ(places_of(vertex_mask(VertexRule::Corner, ring)), (Places{ring}));
        EXPECT_EQ(loop_fractions(vertex_mask(VertexRule::Corner, ring)), over(1, {1}));
    }
}

TEST(VertexMask, CornerToCrease) {
    const Mask mask = blended_vertex(VertexRule::Corner, VertexRule::Crease, 6, 0.5F, {}, {1, 4});
    EXPECT_EQ(places_of(mask), (Places{1, 4, 6}));
    EXPECT_EQ(loop_fractions(mask), over(16, {1, 1, 14}));
}

TEST(VertexMask, CornerToSmoothAndToDart) {
    for (const auto child : {VertexRule::Smooth, VertexRule::Dart}) {
        const Mask mask = blended_vertex(VertexRule::Corner, child, 6, 0.5F);
        EXPECT_EQ(places_of(mask), (Places{0, 1, 2, 3, 4, 5, 6}));
        EXPECT_EQ(loop_fractions(mask), over(32, {1, 1, 1, 1, 1, 1, 26}));
    }
}

// 1/4 (1/8 at the ends of the crease, 3/4) + 3/4 (1/16 all around, 5/8).
TEST(VertexMask, CreaseToDartAndToSmooth) {
    for (const auto child : {VertexRule::Smooth, VertexRule::Dart}) {
        const Mask mask = blended_vertex(VertexRule::Crease, child, 6, 0.25F, {0, 2});
        EXPECT_EQ(places_of(mask), (Places{0, 1, 2, 3, 4, 5, 6}));
        EXPECT_EQ(loop_fractions(mask), over(64, {5, 3, 5, 3, 3, 3, 42}));
    }
}

TEST(VertexMask, BlendsAtAnExtraordinaryVertex) {
    // 1/2 (1) + 1/2 (3/16, 7/16).
    EXPECT_EQ(loop_fractions(blended_vertex(VertexRule::Corner, VertexRule::Smooth, 3, 0.5F)),
              over(32, {3, 3, 3, 23}));
}

TEST(Mask, IsNamedByItsRules) {
    EXPECT_EQ(to_string(kSmoothEdge), "edge point, smooth");
    EXPECT_EQ(to_string(kCreaseEdge), "edge point, crease");
    EXPECT_EQ(to_string(vertex_mask(VertexRule::Dart, 5)), "vertex point, dart");
    EXPECT_EQ(to_string(blended_edge(0.25F)), "edge point, 0.25 crease + 0.75 smooth");
    EXPECT_EQ(to_string(blended_vertex(VertexRule::Corner, VertexRule::Crease, 6, 0.3F, {}, {1, 4})),
              "vertex point, 0.3 corner + 0.7 crease");
}

// Shares from the smallest to the largest, and some between without a short fraction.
std::vector<float> shares() {
    std::vector<float> out{1e-40F, 1e-30F, 0x1p-24F, 0.1F, 0.25F, 0.3F, 0.5F, 0.7F, 0.9F, 1 - 0x1p-24F};
    std::mt19937 random(1);
    for (int i = 0; i < 30; ++i) out.push_back(static_cast<float>(random() % 0xFFFFFF + 1) * 0x1p-24F);
    return out;
}

std::vector<int> valences() {
    std::vector<int> out(63);
    std::iota(out.begin(), out.end(), 2);
    out.insert(out.end(), {65, 111, 360, 456, 908, 1000});  // among them the worst of Loop's weights
    return out;
}

std::vector<Mask> unblended_masks() {
    std::vector<Mask> out{kSmoothEdge, kCreaseEdge, vertex_mask(VertexRule::Corner, 0)};
    for (const int n : valences()) {
        for (const auto rule : {VertexRule::Smooth, VertexRule::Dart, VertexRule::Corner})
            out.push_back(vertex_mask(rule, n));
        out.push_back(vertex_mask(VertexRule::Crease, n, {0, n - 1}));
    }
    return out;
}

std::vector<Mask> blended_masks() {
    std::vector<Mask> out;
    for (const float share : shares()) {
        out.push_back(blended_edge(share));
        for (const int n : valences()) {
            for (const auto child : {VertexRule::Smooth, VertexRule::Dart}) {
                out.push_back(blended_vertex(VertexRule::Corner, child, n, share));
                out.push_back(blended_vertex(VertexRule::Crease, child, n, share, {0, n - 1}));
            }
            out.push_back(blended_vertex(VertexRule::Corner, VertexRule::Crease, n, share, {}, {0, n / 2}));
        }
    }
    // Chaikin's unclamped shares end at 4/3: above it, 3/4 s - 1 is not 0.
    for (const float share : {1 + 0x1p-23F, 1.05F, 1.2F, 1.27F, 4.0F / 3}) out.push_back(blended_edge(share));
    return out;
}

std::vector<Mask> all_masks() {
    auto out = unblended_masks();
    const auto blended = blended_masks();
    out.insert(out.end(), blended.begin(), blended.end());
    return out;
}

// 1e-36 is 1000 roundings of 2^-127, for a ring of 1000.
TEST(Mask, SumsToOne) {
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        Observed error(fmt::format("{} |sum - 1|", name(weights)), "mask", 1e-36);
        const auto masks = all_masks();
        for (std::size_t i = 0; i < masks.size(); ++i) {
            const auto w = weights_of<HighPrecision>(masks[i], weights);
            EXPECT_EQ(w.size(), places_of(masks[i]).size());
            error.add(error_of_value(1.0, std::accumulate(w.begin(), w.end(), HighPrecision(0))),
                      static_cast<std::int64_t>(i));
            if (masks[i].ring > 64 || !tests::is_fraction(masks[i], weights)) continue;
            const auto exact = weights_of<Rational>(masks[i], weights);
            EXPECT_EQ(std::accumulate(exact.begin(), exact.end(), Rational(0)), 1) << i;
        }
        error.check();
    }
}

// The error of every weight as a share of what `weight_ulps` allows; exact where it allows none.
template <class Real>
Observed measure(const std::vector<Mask>& masks, Weights weights, const char* what) {
    constexpr double u = std::is_same_v<Real, float> ? 0x1p-24 : 0x1p-53;
    Observed use(fmt::format("{} {} weights of {}, share of weight_ulps", name(weights),
                             std::is_same_v<Real, float> ? "float" : "double", what),
                 "valence", 1);
    for (const Mask& mask : masks) {
        const auto got = weights_of<Real>(mask, weights);
        const auto exact = weights_of<HighPrecision>(mask, weights);
        EXPECT_EQ(got.size(), exact.size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            const double allowed = weight_ulps(mask, weights) * u * std::abs(static_cast<double>(exact[i]));
            use.add(tests::share_of(error_of_value(got[i], exact[i]), allowed), mask.ring,
                    static_cast<double>(got[i]), static_cast<double>(exact[i]));
        }
    }
    return use;
}

TEST(WeightUlps, BoundsEveryWeightOfUnblendedMasks) {
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        measure<double>(unblended_masks(), weights, "one rule").check();
        measure<float>(unblended_masks(), weights, "one rule").check();
    }
}

TEST(WeightUlps, BoundsEveryWeightOfBlendedMasks) {
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        measure<double>(blended_masks(), weights, "two rules").check();
        measure<float>(blended_masks(), weights, "two rules").check();
    }
}

TEST(WeightUlps, IsZeroExactlyForFractionsOverAPowerOfTwo) {
    for (const auto weights : {Weights::Loop, Weights::Warren}) {
        EXPECT_EQ(weight_ulps(kSmoothEdge, weights), 0);
        EXPECT_EQ(weight_ulps(kCreaseEdge, weights), 0);
        EXPECT_EQ(weight_ulps(vertex_mask(VertexRule::Corner, 5), weights), 0);
        EXPECT_EQ(weight_ulps(vertex_mask(VertexRule::Crease, 5, {0, 2}), weights), 0);
        EXPECT_EQ(weight_ulps(blended_edge(0.3F), weights), 2 * kLoopWeightUlps);
        EXPECT_EQ(weight_ulps(blended_vertex(VertexRule::Corner, VertexRule::Smooth, 6, 0.3F), weights),
                  2 * kLoopWeightUlps);
    }
    for (int n = 2; n <= 100; ++n) {
        const Mask smooth = vertex_mask(VertexRule::Smooth, n);
        EXPECT_EQ(weight_ulps(smooth, Weights::Loop), n == 6 ? 0 : kLoopWeightUlps) << n;
        const auto divisor = denominator(warren_weight<Rational>(n));
        const bool dyadic = (divisor & (divisor - 1)) == 0;
        EXPECT_EQ(weight_ulps(smooth, Weights::Warren), dyadic ? 0 : kLoopWeightUlps) << n;
    }
}

}  // namespace
}  // namespace loopcheck::core
