// Meshes that are in no file: random triangulations with random sharpness, compared with every peer.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "compare/referee.h"
#include "tests/support/models.h"
#include "tests/support/random_meshes.h"

namespace loopcheck::compare {
namespace {

class RandomMeshes : public testing::TestWithParam<unsigned> {};

TEST_P(RandomMeshes, AgreeWithEveryPeer) {
    tests::Random random(GetParam());
    const auto subjects = built_in_subjects();
    std::size_t identical = 0, deviations = 0, within = 0, limit_deviations = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const core::TriangleMesh mesh = tests::random_mesh(random, trial % 3 != 0);
        const core::SchemeOptions options = tests::random_options(random);
        Referee referee(mesh, options, tests::levels_up_to(4));
        for (const Subject& peer : subjects) {
            if (peer.family == "ours") continue;
            const Subject* ours = in_precision(subjects, *find_subject(subjects, "ours"), peer.precision);
            const Comparison c = referee.judge(*ours, peer);
            identical += c.verdict == Verdict::Identical ? 1 : 0;
            deviations += c.verdict == Verdict::KnownDeviation ? 1 : 0;
            within += c.verdict == Verdict::WithinRounding ? 1 : 0;
            const bool right =
                peer.family == "opensubdiv"
                    ? c.verdict == Verdict::Identical || c.verdict == Verdict::KnownDeviation
                    : c.verdict <= Verdict::WithinRounding || c.verdict == Verdict::NotSupported;
            if (peer.limit) {
                const LimitComparison limits = referee.judge_limits(*ours, peer);
                limit_deviations += limits.verdict == Verdict::KnownDeviation ? 1 : 0;
                EXPECT_LE(limits.verdict, Verdict::KnownDeviation) << fmt::format(
                    "trial {}: limits of {}: {}", trial, peer.name, fmt::join(limits.notes, "\n"));
            }
            EXPECT_TRUE(right) << fmt::format("trial {}: {} against {}: {} {}", trial, c.subject, c.reference,
                                              name(c.verdict), c.notes.empty() ? "" : c.notes.front());
        }
    }
    fmt::print("{} identical, {} within rounding, {} known deviations; {} of limits\n", identical, within,
               deviations, limit_deviations);
    EXPECT_GT(limit_deviations, 60U);
    EXPECT_GT(identical, 60U);
    EXPECT_GT(deviations, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMeshes, testing::Range(1U, 5U));

}  // namespace
}  // namespace loopcheck::compare
