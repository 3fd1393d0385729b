#include "compare/suite.h"

#include <gtest/gtest.h>

#include <fstream>

#include "compare/report/report.h"
#include "tests/compare/support.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using test::model_path;

SuiteResult run(const std::vector<std::string>& models, std::span<const Subject> subjects,
                const SuiteOptions& options) {
    const std::vector<std::filesystem::path> paths(models.begin(), models.end());
    return run_suite(paths, subjects, options, [](auto, auto, const auto&) {});
}

SuiteResult run(const std::vector<std::string>& models, std::span<const Subject> subjects, int jobs = 1) {
    return run(models, subjects, {.levels = 2, .jobs = jobs, .memory_limit = 1e10});
}

std::string reject_path(const std::string& name) {
    return std::string(LOOPCHECK_MODELS_DIR) + "/reject/" + name + ".obj";
}

TEST(Suite, ComparesEveryModelUnderEveryBoundaryOptionWithEveryPeer) {
    const auto subjects = built_in_subjects();
    const auto result = run({model_path("cow"), model_path("fan-1")}, subjects);
    const std::size_t peers = subjects.size() - 2;
    EXPECT_EQ(result.rows.size(), 2 * 3 * peers);
    EXPECT_EQ(result.exit_code(), 0);
    EXPECT_EQ(result.count(Verdict::Identical), 2 * 3 * 2U);
}

TEST(Suite, TakesTheCreasingThatTheModelDeclares) {
    const auto subjects = built_in_subjects();
    const auto result = run({model_path("chaikin-overweight")}, subjects);
    EXPECT_EQ(result.count(Verdict::KnownDeviation), 6U + 6U) << "refinements and limits";
    for (const SuiteRow& row : result.rows)
        EXPECT_EQ(row.comparison.options.creasing, core::Creasing::Chaikin);
}

TEST(Suite, ComparesLimitsWherePeersHaveThemAndCountsThem) {
    const auto subjects = built_in_subjects();
    const auto result = run({model_path("dart-valence-06")}, subjects);
    EXPECT_EQ(result.limit_rows(), 3 * 2U);
    EXPECT_EQ(result.count(Verdict::KnownDeviation), 6U);
    EXPECT_EQ(result.exit_code(), 0);
    for (const SuiteRow& row : result.rows)
        EXPECT_EQ(row.limits.has_value(), row.comparison.reference.rfind("opensubdiv", 0) == 0);
    const auto text = suite_as_text(result, subjects);
    EXPECT_NE(text.find("opensubdiv limits"), std::string::npos) << text;
    EXPECT_NE(text.find("and 6 of limits of 1 model"), std::string::npos) << text;
    EXPECT_NE(text.find("limit-dart"), std::string::npos) << text;
    const auto xml = suite_as_junit(result);
    EXPECT_NE(xml.find("name=\"limits of ours against opensubdiv, "), std::string::npos) << xml;
}

TEST(Suite, FailsWhenOnlyALimitDiffers) {
    auto subjects = built_in_subjects();
    subjects.push_back(test::cheat_limits(
        "cheat", [](core::Limits& limits, const auto&) { limits.levels[0].positions[3].x += 1e-9; }));
    const auto result = run({model_path("icosahedron")}, subjects);
    EXPECT_EQ(result.count(Verdict::Differs), 3U);
    EXPECT_EQ(result.exit_code(), 1);
    const auto text = suite_as_text(result, subjects);
    EXPECT_EQ(text.rfind("differs\n  icosahedron.obj", 0), 0U) << "failures first:\n" << text;
    EXPECT_NE(text.find("limits: At level 0"), std::string::npos) << text;
    EXPECT_NE(suite_as_junit(result).find("failures=\"3\""), std::string::npos);
}

TEST(Suite, GivesTheSameReportOnAnyNumberOfJobs) {
    const auto subjects = built_in_subjects();
    const std::vector<std::string> models{model_path("cow"), model_path("fan-3"), model_path("crease-loop"),
                                          model_path("torus"), model_path("pillow")};
    EXPECT_EQ(suite_as_json(run(models, subjects, 1), subjects),
              suite_as_json(run(models, subjects, 4), subjects));
}

TEST(Suite, FailsWhenASubjectDiffers) {
    auto subjects = built_in_subjects();
    auto cheat = test::cheat_rules("cheat", [](auto& options) { options.weights = core::Weights::Warren; });
    cheat.has_weight_option = false;
    subjects.push_back(cheat);
    const auto result = run({model_path("icosahedron"), model_path("tetrahedron")}, subjects);
    EXPECT_EQ(result.count(Verdict::Differs), 3U) << "valence 5 differs, valence 3 and then 6 do not";
    EXPECT_EQ(result.exit_code(), 1);
    const auto text = suite_as_text(result, subjects);
    EXPECT_EQ(text.rfind("differs\n  icosahedron.obj", 0), 0U) << "failures first:\n" << text;
    EXPECT_NE(text.find("\nFAIL: "), std::string::npos) << text;
}

TEST(Suite, FailsWhenASubjectFailsButNotWhenItCannotDoAModel) {
    auto subjects = built_in_subjects();
    subjects.push_back(test::cheat("broken", [](core::Refinement& r) { r.levels[1].positions.pop_back(); }));
    EXPECT_EQ(run({model_path("cow")}, subjects).exit_code(), 3);
    Subject refusing = test::subject("ours");
    refusing.name = refusing.family = "refusing";
    refusing.refine = [](const auto&, const auto&, int) -> core::Result<core::Refinement> {
        return core::fail(core::ErrorCode::Unsupported, "No.");
    };
    subjects.back() = refusing;
    EXPECT_EQ(run({model_path("cow")}, subjects).exit_code(), 0);
}

TEST(Suite, GoesOnAfterAModelThatCannotBeRead) {
    const auto subjects = built_in_subjects();
    const auto result = run({reject_path("repeated-vertex"), model_path("cow")}, subjects);
    ASSERT_EQ(result.unreadable.size(), 1U);
    EXPECT_EQ(result.unreadable[0].error.code, core::ErrorCode::RepeatedVertex);
    EXPECT_EQ(result.unreadable[0].error.place.kind, core::Place::Kind::Line);
    EXPECT_EQ(result.count(Verdict::Identical), 6U);
    EXPECT_EQ(result.exit_code(), 2);
}

TEST(Suite, TellsModelsOfOneNameApartAndCountsAFileOnce) {
    const tests::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "a");
    std::filesystem::copy_file(model_path("cow"), folder / "a" / "x.obj");
    std::filesystem::copy_file(model_path("fan-1"), folder / "x.obj");
    const auto subjects = built_in_subjects();
    const auto result = run(
        {(folder / "x.obj").string(), (folder / "a" / "x.obj").string(), (folder / "." / "x.obj").string()},
        subjects);
    EXPECT_EQ(result.models, 2U);
    EXPECT_EQ(result.rows.front().model, (folder / "x.obj").string());
    EXPECT_EQ(result.rows.back().model, (folder / "a" / "x.obj").string());
}

TEST(Suite, RefusesAModelThatDoesNotFit) {
    const auto subjects = built_in_subjects();
    const std::vector<std::filesystem::path> models{model_path("cow")};
    const auto result =
        run_suite(models, subjects, {.levels = 9, .memory_limit = 1e9}, [](auto, auto, const auto&) {});
    ASSERT_EQ(result.unreadable.size(), 1U);
    EXPECT_EQ(result.unreadable[0].error.code, core::ErrorCode::OutOfMemory);
}

TEST(Shards, HaveEveryCaseAndEveryUnreadableModelOnce) {
    const auto subjects = built_in_subjects();
    const std::vector<std::string> models{reject_path("repeated-vertex"), model_path("fan-1"),
                                          model_path("tetrahedron"), reject_path("not-finite-inf"),
                                          model_path("crease-loop")};
    const auto rows_of = [](const SuiteResult& result) {
        std::vector<std::string> out;
        for (const SuiteRow& row : result.rows)
            out.push_back(row.model + " " + std::string(core::name(row.comparison.options.boundary)) + " " +
                          row.comparison.reference);
        for (const UnreadableModel& bad : result.unreadable) out.push_back(bad.model);
        std::sort(out.begin(), out.end());
        return out;
    };
    const auto part = [&](int i, int n, int jobs) {
        return run(models, subjects,
                   {.levels = 0,
                    .jobs = jobs,
                    .scope = Scope::Refinement,
                    .memory_limit = 1e10,
                    .shard = Shard{i, n}});
    };
    const auto whole = rows_of(part(0, 1, 1));
    for (const int n : {2, 3, 4, 7, 15, 16}) {
        std::vector<std::string> all;
        std::size_t least = 15, most = 0, cases = 0;
        for (int i = 0; i < n; ++i) {
            const auto result = part(i, n, 1);
            EXPECT_EQ(suite_as_json(result, subjects), suite_as_json(part(i, n, 3), subjects));
            const auto rows = rows_of(result);
            all.insert(all.end(), rows.begin(), rows.end());
            least = std::min(least, result.shard->cases);
            most = std::max(most, result.shard->cases);
            cases += result.shard->cases;
        }
        std::sort(all.begin(), all.end());
        EXPECT_EQ(all, whole) << n << " shards";
        EXPECT_EQ(cases, 15U);
        EXPECT_LE(most - least, 1U) << "balanced";
    }
}

TEST(Shards, MayBeEmptyAndSaySo) {
    const auto subjects = built_in_subjects();
    const auto result =
        run({model_path("cow")}, subjects, {.levels = 1, .memory_limit = 1e10, .shard = Shard{3, 4}});
    EXPECT_EQ(result.exit_code(), 0);
    EXPECT_NE(suite_summary(result).find("; shard 3/4 of 1 model is empty"), std::string::npos);
    const auto other =
        run({model_path("fan-1")}, subjects, {.levels = 1, .memory_limit = 1e10, .shard = Shard{2, 4}});
    EXPECT_TRUE(suite_summary(other).ends_with("; shard 2/4 of 1 model")) << suite_summary(other);
}

TEST(Shards, FailWhereTheirMachineCannotDoAModel) {
    const auto subjects = built_in_subjects();
    for (int i = 0; i < 3; ++i) {
        const auto result =
            run({model_path("cow")}, subjects, {.levels = 5, .memory_limit = 1e6, .shard = Shard{i, 3}});
        EXPECT_EQ(result.exit_code(), 2) << i;
        EXPECT_EQ(run({"/no/such/file.obj"}, subjects, {.shard = Shard{i, 3}}).exit_code(), 2) << i;
    }
}

TEST(FindModels, TakesModelFilesSortedAndNoSubfolders) {
    const auto found = find_models(LOOPCHECK_MODELS_DIR);
    ASSERT_TRUE(found);
    EXPECT_GE(found->size(), 40U);
    EXPECT_TRUE(std::is_sorted(found->begin(), found->end()));
    for (const auto& path : *found) EXPECT_EQ(path.parent_path().filename(), "models") << path;
    EXPECT_EQ(find_models("/no/such/folder").error().code, core::ErrorCode::CannotRead);
}

}  // namespace
}  // namespace loopcheck::compare
