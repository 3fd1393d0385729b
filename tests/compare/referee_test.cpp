// The referee is cheated, one way at a time, and must give the right verdict and exit code.
#include "compare/referee.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/loop/refine.h"
#include "core/loop/weights.h"
#include "tests/compare/support.h"

namespace loopcheck::compare {
namespace {

using core::Index;
using core::VertexClass;
using test::cheat;
using test::cheat_rules;
using test::in_the_name_of_opensubdiv;
using test::model_mesh;
using test::subject;

constexpr int kLevels = 3;

Comparison judge(const core::TriangleMesh& mesh, const Subject& a, const Subject& b,
                 core::SchemeOptions options = {}, int levels = kLevels) {
    return Referee(mesh, options, levels).judge(a, b, 3);
}

void expect_verdict(const Comparison& comparison, Verdict verdict, int code) {
    EXPECT_EQ(comparison.verdict, verdict) << name(comparison.verdict) << "\n" << test::notes(comparison);
    EXPECT_EQ(exit_code(comparison.verdict), code);
    EXPECT_FALSE(comparison.notes.empty());
}

TEST(Referee, CallsTheSameBitsIdentical) {
    expect_verdict(judge(model_mesh("cow"), subject("ours"), subject("opensubdiv")), Verdict::Identical, 0);
}

TEST(Referee, FindsWarrensWeightsByThePredictedAmountAndNowhereElse) {
    const auto mesh = model_mesh("mixed-valence");
    core::SchemeOptions options;
    options.weights = core::Weights::Warren;
    std::vector<VertexRecord> level1;
    const auto comparison =
        Referee(mesh, options, 1)
            .judge(subject("ours"), subject("opensubdiv"), 0, [&](const VertexRecord& record) {
                if (record.level == 1) level1.push_back(record);
            });
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_NE(test::notes(comparison).find("every difference is the predicted one"), std::string::npos);

    std::set<int> differing;
    double worst = 0;
    for (const VertexRecord& r : level1) {
        const bool may_differ = r.vertex < mesh.vertex_count() &&
                                r.vertex_class.kind == VertexClass::Kind::Interior &&
                                r.vertex_class.valence != 3 && r.vertex_class.valence != 6;
        if (!may_differ) {
            EXPECT_LE(r.bound_use, 1) << "vertex " << r.vertex;
            continue;
        }
        // (b_Warren - b_Loop) * sum (e_i - v), from the definition.
        const int n = r.vertex_class.valence;
        const double change = core::warren_weight<double>(n) - core::loop_weight<double>(n);
        glm::dvec3 sum(0);
        for (const Index e : mesh.topology().ring(r.vertex))
            sum += mesh.positions()[mesh.topology().other_end(e, r.vertex)] - mesh.positions()[r.vertex];
        for (int i = 0; i < 3; ++i) {
            const double off = std::abs((r.subject[i] - r.reference[i]) - change * sum[i]);
            worst = std::max(worst, off);
            // Both sums have at most 10 terms of size M, each with a few roundings.
            EXPECT_LE(off, 64 * 0x1p-53 * mesh.largest_coordinate());
        }
        if (r.bound_use > 1) differing.insert(n);
    }
    EXPECT_EQ(differing, (std::set<int>{4, 5, 7, 8, 9}));
    RecordProperty("largest_deviation_from_prediction", std::to_string(worst));
}

TEST(Referee, FindsASwappedBoundaryRule) {
    const auto swapped =
        cheat_rules("swapped", [](auto& options) { options.boundary = core::BoundaryRule::EdgeOnly; });
    const auto comparison = judge(model_mesh("single-triangle"), swapped, subject("opensubdiv"));
    expect_verdict(comparison, Verdict::Differs, 1);
    const LevelResult& level1 = comparison.levels[1];
    EXPECT_EQ(level1.classes.at({VertexClass::Kind::Corner, 0}).beyond_bound, 3U);
    EXPECT_GT(total(level1).rule_mismatches, 0U);
    EXPECT_NE(test::notes(comparison).find("swapped is not within rounding of its exact rules"),
              std::string::npos)
        << test::notes(comparison);
}

TEST(Referee, FindsRulesThatDifferWhereNoPositionDoes) {
    const auto liar = cheat("liar", [](core::Refinement& r) { r.levels[2].tags[5].boundary ^= true; });
    const auto comparison = judge(model_mesh("icosahedron"), liar, subject("opensubdiv"));
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_NE(test::notes(comparison).find("rule or boundary tag"), std::string::npos);
}

TEST(Referee, NeverLetsNotANumberPass) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto spoiled =
            cheat("spoiled", [bad](core::Refinement& r) { r.levels[1].positions[7].y = bad; });
        expect_verdict(judge(model_mesh("cow"), spoiled, subject("opensubdiv"), {}, 1), Verdict::Differs, 1);
        // The same bits on both sides are no excuse.
        expect_verdict(judge(model_mesh("cow"), spoiled, spoiled, {}, 1), Verdict::Differs, 1);
    }
}

TEST(Referee, FindsOneVertexTooFew) {
    const auto missing = cheat("missing", [](core::Refinement& r) {
        r.levels[2].positions.pop_back();
        r.levels[2].ancestors.pop_back();
        r.levels[2].tags.pop_back();
    });
    expect_verdict(judge(model_mesh("cow"), missing, subject("opensubdiv")), Verdict::Failed, 3);
}

TEST(Referee, FindsOneLevelTooFew) {
    const auto shallow = cheat("shallow", [](core::Refinement& r) { r.levels.pop_back(); });
    expect_verdict(judge(model_mesh("cow"), shallow, subject("opensubdiv")), Verdict::Failed, 3);
}

TEST(Referee, AllowsTwoUnitsInTheLastPlaceButDoesNotCallThemIdentical) {
    const auto off = cheat("off", [](core::Refinement& r) {
        auto& p = r.levels[1].positions[100];
        p.x = test::ulps_off(p.x, 2);
    });
    const auto comparison = judge(model_mesh("cow"), off, subject("opensubdiv"), {}, 1);
    expect_verdict(comparison, Verdict::WithinRounding, 0);
    EXPECT_EQ(total(comparison.levels[1]).difference.count - total(comparison.levels[1]).difference.identical,
              1U);
    ASSERT_FALSE(comparison.levels[1].worst.empty());
    EXPECT_EQ(comparison.levels[1].worst.front().vertex, 100);
}

TEST(Referee, AllowsNoUnitAtAVertexThatIsOnlyCopied) {
    const auto off = cheat("off", [](core::Refinement& r) {
        auto& p = r.levels[1].positions[0];
        p.x = test::ulps_off(p.x, 1);
    });
    expect_verdict(judge(model_mesh("single-triangle"), off, subject("opensubdiv"), {}, 1), Verdict::Differs,
                   1);
}

TEST(Referee, FindsOneVertexAThousandUnitsOff) {
    const auto off = cheat("off", [](core::Refinement& r) {
        auto& p = r.levels[3].positions[5000];
        p.z = test::ulps_off(p.z, 1000);
    });
    const auto comparison = judge(model_mesh("cow"), off, subject("opensubdiv"));
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_EQ(total(comparison.levels[3]).beyond_bound, 1U);
    EXPECT_EQ(total(comparison.levels[3]).subject_wrong, 1U);
    EXPECT_EQ(total(comparison.levels[3]).reference_wrong, 0U);
}

// Renumbers the vertices of a level, and the ancestors and faces that name them.
void permute(core::Refinement& r, std::size_t level) {
    core::RefinedLevel& l = r.levels[level];
    std::vector<Index> new_of(l.positions.size());
    std::iota(new_of.begin(), new_of.end(), Index{0});
    std::reverse(new_of.begin(), new_of.end());
    core::RefinedLevel out = l;
    for (std::size_t v = 0; v < new_of.size(); ++v) {
        out.positions[new_of[v]] = l.positions[v];
        out.ancestors[new_of[v]] = l.ancestors[v];
        out.tags[new_of[v]] = l.tags[v];
    }
    for (auto& triangle : out.triangles)
        for (Index& v : triangle) v = new_of[v];
    l = std::move(out);
    if (level + 1 < r.levels.size())
        for (auto& ancestor : r.levels[level + 1].ancestors)
            if (ancestor.kind == core::Ancestor::Kind::Vertex) ancestor.index = new_of[ancestor.index];
}

TEST(Referee, PairsPermutedVerticesByTheirAncestry) {
    const auto permuted = cheat("permuted", [](core::Refinement& r) {
        permute(r, 1);
        permute(r, 3);
    });
    const auto comparison = judge(model_mesh("cow-creased"), permuted, subject("opensubdiv"));
    expect_verdict(comparison, Verdict::Identical, 0);
}

TEST(Referee, PairsPermutedAndRotatedFaces) {
    const auto permuted = cheat("permuted", [](core::Refinement& r) {
        auto& faces = r.levels[2].triangles;
        const auto count = static_cast<Index>(faces.size());
        std::reverse(faces.begin(), faces.end());
        for (auto& t : faces) std::rotate(t.begin(), t.begin() + 1, t.end());
        // Side 3 f + i of the old order is side 3 (count - 1 - f) + i - 1 of the new one.
        for (auto& ancestor : r.levels[3].ancestors)
            if (ancestor.kind == core::Ancestor::Kind::Edge)
                ancestor.index = 3 * (count - 1 - ancestor.index / 3) + (ancestor.index % 3 + 2) % 3;
    });
    for (const char* model : {"cow", "pillow"})
        expect_verdict(judge(model_mesh(model), permuted, subject("opensubdiv")), Verdict::Identical, 0);
}

TEST(Referee, FindsPositionsInAnotherOrderThanTheirAncestry) {
    const auto swapped = cheat("swapped", [](core::Refinement& r) {
        std::swap(r.levels[2].positions[3], r.levels[2].positions[900]);
    });
    const auto comparison = judge(model_mesh("cow"), swapped, subject("opensubdiv"));
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_EQ(total(comparison.levels[2]).beyond_bound, 2U);
}

TEST(Referee, RefusesAPairingThatIsNotProven) {
    const auto same_parent =
        cheat("same-parent", [](auto& r) { r.levels[1].ancestors[1] = r.levels[1].ancestors[0]; });
    const auto no_parent = cheat("no-parent", [](auto& r) { r.levels[1].ancestors[1].index = 1 << 30; });
    const auto other_face = cheat(
        "other-face", [](auto& r) { std::swap(r.levels[1].triangles[0][0], r.levels[1].triangles[9][0]); });
    const auto flipped = cheat(
        "flipped", [](auto& r) { std::swap(r.levels[1].triangles[0][0], r.levels[1].triangles[0][1]); });
    const auto twice = cheat("twice", [](auto& r) { r.levels[1].triangles[1] = r.levels[1].triangles[0]; });
    const auto outside = cheat("outside", [](auto& r) { r.levels[1].triangles[1][2] = -5; });
    for (const Subject* bad : {&same_parent, &no_parent, &other_face, &flipped, &twice, &outside})
        expect_verdict(judge(model_mesh("cow"), *bad, subject("opensubdiv")), Verdict::Failed, 3);
}

TEST(Referee, TellsWhoIsRight) {
    const auto midpoints = cheat("midpoints", [](core::Refinement& r) {
        // The edge rule 1/2 1/2 everywhere: linear subdivision called Loop.
        const auto& parent = r.levels[0];
        for (std::size_t v = 0; v < r.levels[1].positions.size(); ++v) {
            const auto& ancestor = r.levels[1].ancestors[v];
            if (ancestor.kind == core::Ancestor::Kind::Vertex) continue;
            const auto& t = parent.triangles[ancestor.index / 3];
            const int i = ancestor.index % 3;
            r.levels[1].positions[v] =
                0.5 * (parent.positions[t[i]] + parent.positions[t[core::next_corner(i)]]);
        }
    });
    const auto comparison = judge(model_mesh("icosahedron"), subject("opensubdiv"), midpoints, {}, 1);
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_NE(
        test::notes(comparison).find("opensubdiv is within rounding of its exact rules; midpoints is not"),
        std::string::npos)
        << test::notes(comparison);
    EXPECT_EQ(total(comparison.levels[1]).reference_wrong, 30U);
}

TEST(Referee, SaysWhyASubjectCannotDoIt) {
    Subject refusing = subject("ours");
    refusing.name = refusing.family = "refusing";
    refusing.refine = [](const auto&, const auto&, int) -> core::Result<core::Refinement> {
        return core::fail(core::ErrorCode::Unsupported, "Not on a Sunday.");
    };
    const auto comparison = judge(model_mesh("cow"), subject("ours"), refusing);
    expect_verdict(comparison, Verdict::NotSupported, 3);
    EXPECT_NE(test::notes(comparison).find("Not on a Sunday."), std::string::npos);
    EXPECT_TRUE(comparison.levels.empty());
}

TEST(Referee, ComparesFloatWithDoubleWithinTheBoundOfFloat) {
    const auto comparison = judge(model_mesh("cow"), subject("ours-float"), subject("opensubdiv"));
    expect_verdict(comparison, Verdict::WithinRounding, 0);
    EXPECT_LT(comparison.levels[1].classes.begin()->second.largest_bound_use, 1);
    EXPECT_GT(total(comparison.levels[3]).difference.max, 0x1p-40);
}

// The known deviation of OpenSubdiv on Chaikin creases: seen as predicted, missed when absent, larger or
// elsewhere.

constexpr core::SchemeOptions kChaikin{.creasing = core::Creasing::Chaikin};

TEST(KnownDeviation, IsSeenWhereAndAsPredicted) {
    const auto comparison =
        judge(model_mesh("chaikin-overweight"), subject("ours"), subject("opensubdiv"), kChaikin);
    expect_verdict(comparison, Verdict::KnownDeviation, 0);
    EXPECT_EQ(comparison.deviation, "chaikin-overweight");
    EXPECT_GT(total(comparison.levels[1]).beyond_bound, 0U);
}

TEST(KnownDeviation, IsNotPredictedOnUniformCreases) {
    expect_verdict(judge(model_mesh("chaikin-overweight"), subject("ours"), subject("opensubdiv")),
                   Verdict::Identical, 0);
}

TEST(KnownDeviation, FailsWhenItIsAbsent) {
    const auto mended = in_the_name_of_opensubdiv(cheat("mended", [](core::Refinement&) {}));
    const auto comparison = judge(model_mesh("chaikin-overweight"), subject("ours"), mended, kChaikin);
    expect_verdict(comparison, Verdict::Differs, 1);
    EXPECT_NE(test::notes(comparison).find("must leave the list"), std::string::npos)
        << test::notes(comparison);
}

TEST(KnownDeviation, FailsWhenItIsLargerOrElsewhere) {
    for (const Index vertex : {0, 12}) {
        Subject more = in_the_name_of_opensubdiv(subject("ours"));
        more.name = "more";
        more.refine = [vertex](const core::TriangleMesh& mesh, core::SchemeOptions options, int levels) {
            options.crease_share = core::CreaseShare::Unclamped;
            auto made = core::refine<double>(mesh, options, levels);
            made->levels[1].positions[vertex].x += 1e-9;
            return made;
        };
        const auto comparison = judge(model_mesh("chaikin-overweight"), subject("ours"), more, kChaikin, 1);
        expect_verdict(comparison, Verdict::Differs, 1);
        EXPECT_NE(test::notes(comparison).find("does not explain all"), std::string::npos)
            << test::notes(comparison);
    }
}

}  // namespace
}  // namespace loopcheck::compare
