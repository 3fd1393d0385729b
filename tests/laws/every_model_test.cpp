// Every model, under every boundary option, by every peer, at every level: the exact tier and the bounded
// tier.  A new file in models/ is a new test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "compare/limit/words.h"
#include "compare/loading.h"
#include "compare/referee.h"
#include "compare/suite.h"
#include "compare/words.h"
#include "tests/support/models.h"

namespace loopcheck::compare {
namespace {

int levels() {
    return tests::levels_up_to(5);
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    const auto found = find_models(LOOPCHECK_MODELS_DIR).value();
    for (const auto& path : found) names.push_back(path.filename().string());
    return tests::is_short_run() ? tests::ends_of_series(names) : names;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string out = info.param.substr(0, info.param.rfind('.'));
    std::replace_if(
        out.begin(), out.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return out;
}

class EveryModel : public testing::TestWithParam<std::string> {};

// True where a known deviation says that this comparison must differ.
bool is_expected_to_deviate(const Referee& referee, const core::SchemeOptions& options, const Subject& peer) {
    const auto list = known_deviations();
    return std::any_of(list.begin(), list.end(), [&](const KnownDeviation& deviation) {
        return deviation.family == peer.family &&
               is_predicted(deviation, referee.mesh(), options, referee.levels());
    });
}

void expect_right(const Comparison& c, const Referee& referee, const Subject& peer) {
    const std::string what = fmt::format("{} against {}, {}: {}", c.subject, c.reference,
                                         core::name(c.options.boundary), fmt::format("{}", name(c.verdict)));
    if (is_expected_to_deviate(referee, c.options, peer)) {
        EXPECT_EQ(c.verdict, Verdict::KnownDeviation) << what;
        return;
    }
    if (peer.family == "opensubdiv") {
        EXPECT_EQ(c.verdict, Verdict::Identical) << what;
    } else if (c.verdict != Verdict::NotSupported) {
        EXPECT_LE(c.verdict, Verdict::WithinRounding) << what;
    }
    double use = 0;
    for (const LevelResult& level : c.levels) {
        const ClassStats all = total(level);
        use = std::max(use, all.largest_bound_use);
        EXPECT_EQ(all.subject_wrong, 0U) << what << " level " << level.level;
        EXPECT_EQ(all.reference_wrong, 0U) << what << " level " << level.level;
        EXPECT_EQ(all.rule_mismatches, 0U) << what << " level " << level.level;
    }
    fmt::print("{}; largest use of the bound {:.3f}\n", what, use);
}

void expect_right_limits(const LimitComparison& c, const Subject& peer) {
    std::string notes;
    for (const std::string& note : c.notes) notes += note + "\n";
    EXPECT_LE(c.verdict, Verdict::KnownDeviation) << peer.name << "\n" << notes;
    EXPECT_EQ(c.verdict == Verdict::KnownDeviation, !c.deviations.empty()) << peer.name << "\n" << notes;
    const LimitStats all = total(c);
    EXPECT_EQ(all.position.subject_wrong + all.normal.subject_wrong, 0U)
        << "ours against " << peer.name << "\n"
        << notes;
    EXPECT_EQ(all.subject_drift.unexplained + all.reference_drift.unexplained, 0U) << peer.name << "\n"
                                                                                   << notes;
    fmt::print("limits of {}: {}; {} normals compared, {} undefined, {} undetermined\n{}", peer.name,
               name(c.verdict), all.normal.difference.count, all.undefined_count(), all.undetermined, notes);
}

// Calls visit(referee, ours, peer) for every peer, under every boundary option.
template <class Visit>
void for_each_peer(const std::string& name, int levels, Visit visit) {
    const auto model = load_model(std::string(LOOPCHECK_MODELS_DIR) + "/" + name, false);
    ASSERT_TRUE(model) << core::to_string(model.error());
    const auto subjects = built_in_subjects();
    for (const auto boundary :
         {core::BoundaryRule::EdgeAndCorner, core::BoundaryRule::EdgeOnly, core::BoundaryRule::None}) {
        Referee referee(model->mesh,
                        options_for_model(model->model, boundary, std::nullopt, core::Weights::Loop), levels);
        for (const Subject& peer : subjects)
            if (peer.family != "ours")
                visit(referee, *in_precision(subjects, *find_subject(subjects, "ours"), peer.precision),
                      peer);
    }
}

TEST_P(EveryModel, AgreesWithEveryPeer) {
    for_each_peer(GetParam(), levels(), [](Referee& referee, const Subject& ours, const Subject& peer) {
        expect_right(referee.judge(ours, peer), referee, peer);
    });
}

// Limits: exact within the bound, or as a known deviation predicts, at every vertex; and each subject's limit
// of a vertex is that of its vertex point.
TEST_P(EveryModel, HasTheLimitsThatEveryPeerShouldHave) {
    for_each_peer(GetParam(), std::min(levels(), 3),
                  [](Referee& referee, const Subject& ours, const Subject& peer) {
                      if (peer.limit) expect_right_limits(referee.judge_limits(ours, peer), peer);
                  });
}

// The lab report keeps sharp features by not refining them.  Tagged as creases they are refined by the rules
// of the scheme, and OpenSubdiv says the same.
TEST_P(EveryModel, WithCreasesByAngleIsOpenSubdivs) {
    const auto model = load_model(std::string(LOOPCHECK_MODELS_DIR) + "/" + GetParam(), false);
    ASSERT_TRUE(model) << core::to_string(model.error());
    const auto options = options_for_model(model->model, std::nullopt, std::nullopt, core::Weights::Loop);
    const auto subjects = built_in_subjects();
    for (const double degrees : {30.0, 60.0}) {
        core::TriangleMesh mesh = model->mesh;
        const CreaseTags creases = tag_creases(mesh, degrees);
        fmt::print("{}\n", creases_in_words(creases));
        Referee referee(mesh, options, std::min(levels(), 3));
        for (const auto precision : {core::Precision::Double, core::Precision::Float}) {
            const auto named = [&](const char* name) {
                return in_precision(subjects, *find_subject(subjects, name), precision);
            };
            const Subject& peer = *named("opensubdiv");
            expect_right(referee.judge(*named("ours"), peer), referee, peer);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel, testing::ValuesIn(model_names()), test_name);

}  // namespace
}  // namespace loopcheck::compare
