// The referee of limits is cheated, one way at a time, and must give the right verdict and exit code.
#include "compare/referee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "compare/limit/words.h"
#include "tests/compare/support.h"
#include "tests/support/meshes.h"

namespace loopcheck::compare {
namespace {

using core::Index;
using core::NoNormal;
using core::VertexClass;
using glm::dvec3;
using test::cheat_limits;
using test::in_the_name_of_opensubdiv;
using test::model_mesh;
using test::subject;

constexpr int kLevels = 2;

LimitComparison judge(const core::TriangleMesh& mesh, const Subject& a, const Subject& b,
                      core::SchemeOptions options = {}) {
    return Referee(mesh, options, kLevels).judge_limits(a, b, 3);
}

void expect_verdict(const LimitComparison& comparison, Verdict verdict, int code) {
    EXPECT_EQ(comparison.verdict, verdict) << name(comparison.verdict) << "\n" << test::notes(comparison);
    EXPECT_EQ(exit_code(comparison.verdict), code);
    EXPECT_FALSE(comparison.notes.empty());
}

void expect_says(const LimitComparison& comparison, const std::string& what) {
    EXPECT_NE(test::notes(comparison).find(what), std::string::npos) << what << "\n"
                                                                     << test::notes(comparison);
}

TEST(LimitReferee, FindsOpensubdivRightWithinRoundingWhereNothingIsSharp) {
    const auto c = judge(model_mesh("cow"), subject("ours"), subject("opensubdiv"));
    expect_verdict(c, Verdict::WithinRounding, 0);
    const LimitStats all = total(c);
    EXPECT_GT(all.position.difference.count, 1000U);
    EXPECT_EQ(all.normal.difference.count, all.position.difference.count);
    EXPECT_EQ(all.position.subject_wrong + all.position.reference_wrong, 0U);
    EXPECT_EQ(all.normal.subject_wrong + all.normal.reference_wrong, 0U);
    EXPECT_TRUE(c.deviations.empty());
}

TEST(LimitReferee, FindsOneWrongPosition) {
    const auto off = cheat_limits("off", [](core::Limits& limits, const auto&) {
        auto& p = limits.levels[1].positions[100];
        p.z = test::ulps_off(p.z, 1000);
    });
    const auto c = judge(model_mesh("cow"), subject("opensubdiv"), off);
    expect_verdict(c, Verdict::Differs, 1);
    EXPECT_EQ(total(c.levels[1]).position.unexplained, 1U);
    EXPECT_EQ(total(c.levels[1]).position.reference_wrong, 1U);
    EXPECT_EQ(total(c.levels[0]).position.unexplained, 0U);
    ASSERT_FALSE(c.levels[1].worst.empty());
    EXPECT_EQ(c.levels[1].worst.front().position.vertex, 100);
    expect_says(c, "opensubdiv is within rounding of the exact limit; off is not");
}

TEST(LimitReferee, FindsTheBoundaryMaskOfAnotherEdgeRule) {
    // 1/5, 3/5, 1/5 is 6/5 of 1/6, 2/3, 1/6 less 1/5 of the vertex.
    const auto other = cheat_limits("other", [](core::Limits& limits, const core::Refinement& refined) {
        for (std::size_t l = 0; l < limits.levels.size(); ++l)
            for (std::size_t v = 0; v < limits.levels[l].positions.size(); ++v) {
                const auto& made = refined.levels[l];
                if (!made.tags[v].boundary || made.tags[v].rule != core::VertexRule::Crease) continue;
                dvec3& p = limits.levels[l].positions[v];
                p = (6.0 * p - made.positions[v]) / 5.0;
            }
    });
    const auto c = judge(model_mesh("grid-4x4"), other, subject("opensubdiv"));
    expect_verdict(c, Verdict::Differs, 1);
    for (const auto& [vertex_class, stats] : c.levels[1].classes)
        EXPECT_EQ(stats.position.unexplained > 0, vertex_class.kind == VertexClass::Kind::Boundary)
            << core::to_string(vertex_class);
}

TEST(LimitReferee, TakesNormalsForPlanesAndFindsATurnedOne) {
    const auto flipped = cheat_limits("flipped", [](core::Limits& limits, const auto&) {
        for (auto& level : limits.levels) std::swap(level.tangent1, level.tangent2);
        for (auto& t : limits.levels[1].tangent1) t *= 1e5;
    });
    EXPECT_LE(judge(model_mesh("cow"), flipped, subject("opensubdiv")).verdict, Verdict::WithinRounding);

    const auto turned = cheat_limits("turned", [](core::Limits& limits, const auto&) {
        auto& level = limits.levels[1];
        const dvec3 normal = glm::normalize(glm::cross(level.tangent1[50], level.tangent2[50]));
        level.tangent1[50] += 1e-9 * glm::length(level.tangent1[50]) * normal;
    });
    const auto c = judge(model_mesh("cow"), turned, subject("opensubdiv"));
    expect_verdict(c, Verdict::Differs, 1);
    EXPECT_EQ(total(c).normal.unexplained, 1U);
    EXPECT_EQ(total(c).position.unexplained, 0U);
    EXPECT_GT(total(c).normal.difference.max, 1e-9 - 1e-12);
    EXPECT_LT(total(c).normal.difference.max, 2e-9) << "more where the tangents are not at right angles";
}

TEST(LimitReferee, NeverLetsNotANumberPass) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        const auto position = cheat_limits(
            "position", [bad](auto& limits, const auto&) { limits.levels[1].positions[7].y = bad; });
        const auto tangent = cheat_limits(
            "tangent", [bad](auto& limits, const auto&) { limits.levels[1].tangent2[7].y = bad; });
        for (const Subject* spoiled : {&position, &tangent}) {
            expect_verdict(judge(model_mesh("cow"), *spoiled, subject("opensubdiv")), Verdict::Differs, 1);
            // The same bits on both sides are no excuse.
            expect_verdict(judge(model_mesh("cow"), *spoiled, *spoiled), Verdict::Differs, 1);
        }
    }
}

TEST(LimitReferee, FindsNoTangentsWhereThereIsANormal) {
    const auto none = cheat_limits("none", [](auto& limits, const auto&) {
        limits.levels[1].tangent2[7] = limits.levels[1].tangent1[7];
    });
    expect_verdict(judge(model_mesh("cow"), none, subject("opensubdiv")), Verdict::Differs, 1);
}

TEST(LimitReferee, FindsTooFewLevelsOrValues) {
    const auto shallow = cheat_limits("shallow", [](auto& limits, const auto&) { limits.levels.pop_back(); });
    const auto few =
        cheat_limits("few", [](auto& limits, const auto&) { limits.levels[1].positions.pop_back(); });
    const auto flat =
        cheat_limits("flat", [](auto& limits, const auto&) { limits.levels[2].tangent1.clear(); });
    for (const Subject* bad : {&shallow, &few, &flat})
        expect_verdict(judge(model_mesh("cow"), *bad, subject("opensubdiv")), Verdict::Failed, 3);
}

TEST(LimitReferee, FindsALimitThatDriftsFromLevelToLevel) {
    const auto drifting = cheat_limits("drifting", [](core::Limits& limits, const auto&) {
        for (std::size_t l = 0; l < limits.levels.size(); ++l)
            for (dvec3& p : limits.levels[l].positions) p.x += 1e-9 * static_cast<double>(l);
    });
    const auto mesh = model_mesh("cow");
    const auto c = judge(mesh, drifting, subject("opensubdiv"));
    expect_verdict(c, Verdict::Differs, 1);
    const DriftStats drift = total(c).subject_drift;
    EXPECT_NEAR(drift.position.max, 1e-9, 1e-12);
    EXPECT_EQ(drift.unexplained,
              total(c.levels[0]).position.difference.count + total(c.levels[1]).position.difference.count);
    EXPECT_EQ(total(c).reference_drift.unexplained, 0U);
    expect_says(c, "by more than rounding, which no known deviation predicts");
}

TEST(LimitReferee, SaysWhereTheSubjectHasNoLimitsAndWhereItsRefinementFailed) {
    Subject none = subject("ours");
    none.name = none.family = "none";
    none.limit = {};
    const auto c = judge(model_mesh("cow"), subject("ours"), none);
    expect_verdict(c, Verdict::NotSupported, 3);
    expect_says(c, "none: It has no limits. [unsupported]");

    const auto broken = test::cheat("broken", [](core::Refinement& r) { r.levels.pop_back(); });
    expect_verdict(judge(model_mesh("cow"), subject("ours"), broken), Verdict::Failed, 3);

    Subject refusing = subject("ours");
    refusing.name = refusing.family = "refusing";
    refusing.limit = [](const auto&, const auto&, int) -> core::Result<core::Limits> {
        return core::fail(core::ErrorCode::Unsupported, "Not today.");
    };
    expect_says(judge(model_mesh("cow"), refusing, subject("ours")), "Not today.");
}

TEST(LimitReferee, CountsVerticesWithoutANormalByReason) {
    const auto c = judge(model_mesh("fan-7"), subject("ours"), subject("opensubdiv"));
    EXPECT_LE(c.verdict, Verdict::KnownDeviation) << test::notes(c);
    const LimitStats level0 = total(c.levels[0]);
    EXPECT_EQ(level0.undefined.at(NoNormal::FoldedCrease), 1U);
    EXPECT_EQ(level0.undefined_count() + level0.undetermined + level0.normal.difference.count,
              level0.position.difference.count);
    EXPECT_EQ(total(judge(model_mesh("isolated-vertex-last"), subject("ours"), subject("opensubdiv")))
                  .undefined.at(NoNormal::Isolated),
              1U + kLevels);
}

TEST(LimitReferee, CallsUndeterminedWhatRoundingCouldTurnAnywhere) {
    const auto c = judge(model_mesh("magnitude-large"), subject("ours-float"), subject("opensubdiv-float"));
    EXPECT_LE(c.verdict, Verdict::WithinRounding);
    EXPECT_EQ(total(c).undetermined, total(c).position.difference.count);
    EXPECT_EQ(
        total(judge(model_mesh("magnitude-large"), subject("ours"), subject("opensubdiv"))).undetermined, 0U);
}

TEST(LimitReferee, HoldsEachSideToItsOwnWeights) {
    core::SchemeOptions options;
    options.weights = core::Weights::Warren;
    const auto c = judge(model_mesh("icosahedron"), subject("ours"), subject("opensubdiv"), options);
    expect_verdict(c, Verdict::Differs, 1);
    EXPECT_GT(total(c).by_declaration, 0U);
    EXPECT_EQ(total(c).position.unexplained + total(c).normal.unexplained, 0U);
    expect_says(c, "The rules differ by declaration");
}

TEST(LimitReferee, ComparesFloatWithDouble) {
    EXPECT_LE(judge(model_mesh("cow"), subject("ours"), subject("opensubdiv-float")).verdict,
              Verdict::WithinRounding);
}

// -- Known deviations.

// A deviation and the smallest model that shows it.
struct Known {
    std::string deviation, model;
    core::Creasing creasing = core::Creasing::Uniform;
};

class KnownLimitDeviation : public testing::TestWithParam<Known> {
  protected:
    static core::SchemeOptions options() {
        core::SchemeOptions out;
        out.creasing = GetParam().creasing;
        return out;
    }
};

TEST_P(KnownLimitDeviation, ShowsAsPredicted) {
    const auto c = judge(model_mesh(GetParam().model), subject("ours"), subject("opensubdiv"), options());
    expect_verdict(c, Verdict::KnownDeviation, 0);
    expect_says(c, GetParam().deviation + ": ");
    const auto seen = std::find_if(c.deviations.begin(), c.deviations.end(), [](const DeviationSeen& s) {
        return s.deviation->name == GetParam().deviation;
    });
    ASSERT_NE(seen, c.deviations.end());
    EXPECT_GT(seen->vertices, 0U);
    EXPECT_EQ(seen->vanished, 0U);
    EXPECT_NEAR(seen->observed_position, seen->predicted_position, 1e-12);
    EXPECT_NEAR(seen->observed_angle, seen->predicted_angle, 1e-9);
    std::printf("%s at %zu vertices: %s\n", GetParam().deviation.c_str(), seen->vertices,
                amounts_in_words(*seen, 1).c_str());
}

TEST_P(KnownLimitDeviation, FailsWhenItIsNotOnTheList) {
    std::vector<KnownDeviation> list(known_deviations().begin(), known_deviations().end());
    std::erase_if(list, [](const KnownDeviation& d) { return d.name == GetParam().deviation; });
    ASSERT_EQ(list.size() + 1, known_deviations().size());
    const auto mesh = model_mesh(GetParam().model);
    const auto c =
        Referee(mesh, options(), kLevels, list).judge_limits(subject("ours"), subject("opensubdiv"));
    expect_verdict(c, Verdict::Differs, 1);
    expect_says(c, "neither exact nor as a known deviation predicts");
}

TEST_P(KnownLimitDeviation, FailsWhenItIsMended) {
    const auto mended = in_the_name_of_opensubdiv(cheat_limits("mended", [](auto&, const auto&) {}));
    const auto c = judge(model_mesh(GetParam().model), subject("ours"), mended, options());
    expect_verdict(c, Verdict::Differs, 1);
    expect_says(c, "The known deviation " + GetParam().deviation + " of mended must show at ");
    expect_says(c, "must leave the list");
    EXPECT_EQ(total(c).position.unexplained + total(c).normal.unexplained, 0U) << "mended, not wrong";
}

TEST_P(KnownLimitDeviation, FailsWhenItIsLargerOrElsewhere) {
    const auto mesh = model_mesh(GetParam().model);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        Subject more = subject("opensubdiv");
        more.name = "more";
        more.limit = [v](const core::TriangleMesh& m, const core::SchemeOptions& o, int levels) {
            auto made = subject("opensubdiv").limit(m, o, levels);
            made->levels[0].positions[v].x += 1e-9;
            return made;
        };
        const auto c = judge(mesh, subject("ours"), more, options());
        expect_verdict(c, Verdict::Differs, 1);
        EXPECT_EQ(total(c).position.unexplained, 1U) << "vertex " << v;
    }
}

// The noise of sin(pi) is that of the second neighbour: none where that is the origin, and none is meant
// where a sharp edge makes the vertex something else.
TEST(LimitReferee, IsNotMisledByAPillow) {
    core::MeshData plain = tests::data_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
    core::MeshData with_dart = plain, with_chaikin = plain;
    with_dart.creases = {{0, 1, core::kInfiniteSharpness}};
    with_chaikin.creases = {{0, 1, 2.5F}, {1, 2, 1.2F}};
    core::SchemeOptions chaikin;
    chaikin.creasing = core::Creasing::Chaikin;
    for (const auto& [data, rules] :
         {std::pair{plain, core::SchemeOptions{}}, std::pair{with_dart, core::SchemeOptions{}},
          std::pair{with_chaikin, chaikin}}) {
        const auto mesh = tests::mesh_of(data);
        for (const std::string precision : {"", "-float"}) {
            const auto c = judge(mesh, subject("ours" + precision), subject("opensubdiv" + precision), rules);
            EXPECT_EQ(exit_code(c.verdict), 0) << testing::PrintToString(c.notes);
        }
    }
}

std::string known_name(const testing::TestParamInfo<Known>& info) {
    std::string out = info.param.deviation;
    std::replace(out.begin(), out.end(), '-', '_');
    return out;
}

INSTANTIATE_TEST_SUITE_P(
    List, KnownLimitDeviation,
    testing::Values(Known{"chaikin-overweight", "chaikin-overweight", core::Creasing::Chaikin},
                    Known{"limit-semi-sharp", "semi-sharp-edge-1.5"}, Known{"limit-dart", "dart-valence-06"},
                    Known{"limit-crease-tangent", "fan-5"}, Known{"limit-corner-tangent", "crease-crossing"},
                    Known{"limit-valence-2", "pillow"}),
    known_name);

TEST(KnownLimitDeviations, AreGoneOnceSharpnessHasDecayed) {
    const auto mesh = model_mesh("semi-sharp-edge-1.5");
    const auto c = Referee(mesh, {}, 3).judge_limits(subject("ours"), subject("opensubdiv"));
    EXPECT_EQ(c.levels[0].verdict, Verdict::KnownDeviation);
    EXPECT_EQ(c.levels[1].verdict, Verdict::KnownDeviation);
    EXPECT_LE(c.levels[2].verdict, Verdict::WithinRounding);
    EXPECT_GT(total(c).reference_drift.position.max, 1e-3) << "OpenSubdiv's limit changes until then";
    EXPECT_EQ(total(c).reference_drift.unexplained, 0U);
}

// Raised by 1 the far end of the sharp edge lifts a regular dart by 7/71; the smooth mask says 1/12.
TEST(KnownLimitDeviations, MeetTheFractionsOfARegularDart) {
    const auto mesh = model_mesh("dart-valence-06");
    core::MeshData flat;
    for (const auto& p : mesh.positions()) flat.positions.emplace_back(p.x, p.y, 0);
    for (const auto& t : mesh.topology().triangles) flat.add_face(t);
    const auto& topology = mesh.topology();
    Index dart = core::kNone, end = core::kNone;
    for (Index e = 0; e < topology.edge_count(); ++e) {
        if (mesh.edge_sharpness()[e] == 0) continue;
        const auto& [a, b] = topology.edge_ends[e];
        flat.creases.push_back({a, b, 10});
        for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)})
            if (topology.ring(v).size() == 6) {
                dart = v;
                end = other;
            }
    }
    ASSERT_NE(dart, core::kNone);
    flat.positions[end].z = 1;
    const auto raised = core::TriangleMesh::make(flat).value();
    Referee referee(raised, {}, 0);
    const auto c = referee.judge_limits(subject("ours"), subject("opensubdiv"), 100);
    for (const LimitRecord& r : c.levels[0].worst)
        if (r.position.vertex == dart) {
            EXPECT_DOUBLE_EQ(r.position.exact.z, 7.0 / 71);
            EXPECT_DOUBLE_EQ(r.position.reference.z, 1.0 / 12);
            EXPECT_EQ(r.deviation, "limit-dart");
            return;
        }
    FAIL() << "the dart was not compared";
}

}  // namespace
}  // namespace loopcheck::compare
