// Shards of a suite on the command line, and the suite put together again.
#include "compare/report/merge.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>

#include "compare/report/document.h"
#include "compare/report/json.h"
#include "core/mesh/io/atomic_file.h"
#include "tests/compare/support.h"
#include "tests/support/models.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;
using test::loopcheck;
using test::model_path;

#define EXPECT_SAYS(text, what) EXPECT_NE((text).find(what), std::string::npos) << (text)

/// A suite, run by shards into a folder.
struct Suite {
    std::vector<std::string> arguments;  ///< models and options
    std::vector<Subject> subjects = built_in_subjects();
    tests::TemporaryFolder folder = {};

    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string part(int i) const { return at("part-" + std::to_string(i) + ".json"); }
    std::string read(const std::string& name) const { return core::read_file(folder / name).value(); }

    test::Outcome run(const std::vector<std::string>& more) const {
        std::vector<std::string> all{"suite"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        all.insert(all.end(), more.begin(), more.end());
        return loopcheck(all, subjects);
    }
    test::Outcome run_shard(int i, int n, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"--shard", std::to_string(i) + "/" + std::to_string(n), "--json",
                                     part(i)};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
    test::Outcome merge(const std::vector<int>& parts) const {
        std::vector<std::string> all{"merge", "--json", at("merged.json"), "--junit", at("merged.xml")};
        for (const int i : parts) all.push_back(part(i));
        return loopcheck(all, subjects);
    }
    /// Runs n shards; their numbers, last first.
    std::vector<int> run_shards(int n) const {
        std::vector<int> out;
        for (int i = n - 1; i >= 0; --i) {
            run_shard(i, n);
            out.push_back(i);
        }
        return out;
    }
};

/// One run, and n shards put together, say the same.
void expect_same(const Suite& suite, std::initializer_list<int> numbers) {
    const auto whole = suite.run({"--json", suite.at("whole.json"), "--junit", suite.at("whole.xml")});
    for (const int n : numbers) {
        const auto merged = suite.merge(suite.run_shards(n));
        EXPECT_EQ(merged.code, whole.code) << n << " shards: " << merged.err;
        EXPECT_EQ(merged.out, whole.out);
        EXPECT_EQ(merged.err, "");
        EXPECT_TRUE(suite.read("merged.json") == suite.read("whole.json")) << n << " shards";
        EXPECT_TRUE(suite.read("merged.xml") == suite.read("whole.xml")) << n << " shards";
    }
}

TEST(Merge, GivesTheReportsAndTheExitCodeOfOneRun) {
    expect_same({{model_path("chaikin-overweight"), model_path("dart-valence-06"), model_path("fan-2"),
                  model_path("magnitude-small"), "--levels", "1"}},
                {1, 5, 13});
}

TEST(Merge, GivesThemWhereModelsAreUnreadableOrSubjectsDifferAndFail) {
    const std::string reject = std::string(LOOPCHECK_MODELS_DIR) + "/reject/";
    Suite suite{{reject + "repeated-vertex.obj", model_path("icosahedron"), reject + "not-finite-inf.obj",
                 model_path("fan-3"), "--levels", "1"}};
    const auto add = [&](Subject subject) { suite.subjects.push_back(std::move(subject)); };
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    add(test::cheat("nan", [](core::Refinement& r) { r.levels[1].positions[1].x = kNan; }));
    add(test::cheat("short", [](core::Refinement& r) { r.levels[1].positions.pop_back(); }));
    add(test::in_the_name_of_opensubdiv(test::cheat_limits(
        "limits", [](core::Limits& limits, const auto&) { limits.levels[0].positions[0].y = kNan; })));
    expect_same(suite, {1, 4});
}

TEST(Merge, GivesThemWithOptions) {
    expect_same({{model_path("fan-1"), std::string(LOOPCHECK_MODELS_DIR) + "/reject/not-a-triangle-quad.obj",
                  "--levels", "0", "--no-limit", "--triangulate"}},
                {3});
    expect_same({{model_path("cow"), model_path("fan-1"), "--levels", "4", "--memory", "0.001"}}, {2});
}

/// Two models at level 0 in three shards.
Suite small_suite() {
    return {{model_path("tetrahedron"), model_path("fan-1"), "--levels", "0", "--no-limit"}};
}

TEST(Merge, ListsShardsThatAreMissing) {
    const auto suite = small_suite();
    suite.run_shards(5);
    const auto r = suite.merge({3, 1});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(r.err, "Missing: shard 0/5, 2/5, 4/5.\n");
    EXPECT_FALSE(std::filesystem::exists(suite.at("merged.json")));

    suite.run_shard(7, 2'000'000'000);
    EXPECT_SAYS(suite.merge({7}).err, "19/2000000000, 20/2000000000 and 1999999979 more.");
}

TEST(Merge, RefusesAShardThatIsThereTwice) {
    const auto suite = small_suite();
    const auto r = suite.merge([&] {
        auto parts = suite.run_shards(2);
        parts.push_back(0);
        return parts;
    }());
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.err, suite.part(0) + " and " + suite.part(0) + " are both shard 0/2.\n");
}

TEST(Merge, RefusesShardsOfDifferentSuites) {
    const tests::TemporaryFolder folder;
    const std::string model = (folder / "fan.obj").string();
    std::filesystem::copy_file(model_path("fan-1"), model);
    Suite suite{{model, "--levels", "0"}};
    suite.run_shards(2);
    const auto after = [&](const std::vector<std::string>& more, const std::string& what) {
        EXPECT_NE(suite.run_shard(1, 2, more).code, 2);
        const auto r = suite.merge({0, 1});
        EXPECT_EQ(r.code, 2);
        EXPECT_SAYS(r.err, suite.part(1) + " is of another suite than " + suite.part(0) + ": " + what);
        EXPECT_SAYS(r.err, "Missing: shard 1/2.");
    };
    after({"--no-limit"}, "without limits, not with limits.");
    after({"--triangulate"}, "with --triangulate, not without --triangulate.");
    after({model_path("fan-2")}, "2 models, not 1 model.");
    suite.subjects.pop_back();
    after({}, "ours 0.1.0, ours-float 0.1.0, ");
    suite.subjects = built_in_subjects();
    std::ofstream(model, std::ios::app) << "# A comment\n";
    after({}, "fan.obj is another file.");
    suite.run_shard(0, 2);
    EXPECT_EQ(suite.merge({0, 1}).code, 0) << "both of the new file";
    suite.run_shard(1, 3);
    EXPECT_SAYS(suite.merge({0, 1}).err, "3 shards, not 2 shards.");
    suite.arguments[2] = "1";
    after({}, "levels 0 to 1, not levels 0 to 0.");
}

TEST(Merge, RefusesAModelThatSomeShardsHaveComparedAndOthersNot) {
    const Suite suite{{model_path("fan-1"), "--levels", "1", "--no-limit"}};
    for (int i = 0; i < 3; ++i) suite.run_shard(i, 3, {"--memory", i == 1 ? "0.000001" : "1"});
    const auto r = suite.merge({0, 1, 2});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.err, "fan-1.obj was compared in " + suite.part(0) + ", and not in " + suite.part(1) +
                         ": run both again, with the same --memory.\n");
}

TEST(Merge, RefusesOtherReportsAndOtherPrograms) {
    const auto suite = small_suite();
    suite.run({"--json", suite.part(0)});
    EXPECT_SAYS(suite.merge({0}).err, "no report of `suite --shard --json`");
    suite.run_shard(0, 1);
    auto report = Json::parse(suite.read("part-0.json"));
    report["loopcheck"] = "9.9";
    EXPECT_EQ(read_shard("", dump(report), 1e9).error().sentence,
              "It was written by loopcheck 9.9; this is 0.1.0.");
    EXPECT_EQ(suite.merge({5}).code, 2) << "no such file";
}

TEST(Merge, NeverWritesOverAShard) {
    const auto suite = small_suite();
    suite.run_shards(1);
    const auto before = suite.read("part-0.json");
    const auto r = loopcheck({"merge", suite.part(0), "--json", suite.part(0)});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(suite.read("part-0.json"), before);
}

TEST(Merge, SeesEveryCutAndEveryFlippedBit) {
    const auto suite = small_suite();
    suite.run_shards(1);
    const std::string whole = suite.read("part-0.json");
    ASSERT_TRUE(read_shard("", whole, 1e9));
    constexpr std::size_t kSteps = 100;
    for (std::size_t step = 0; step < kSteps; ++step) {
        const std::size_t at = step * (whole.size() - 2) / kSteps;
        EXPECT_FALSE(read_shard("", whole.substr(0, at), 1e9)) << "cut at " << at;
        std::string flipped = whole;
        flipped[at] = static_cast<char>(flipped[at] ^ 1);
        EXPECT_FALSE(read_shard("", flipped, 1e9)) << "bit flipped at " << at;
    }
}

/// Calls `with` while each value inside another is replaced by each of `others`.
void replace_each(Json& in, const std::vector<Json>& others, const std::function<void()>& with) {
    for (Json& value : in) {
        const Json before = value;
        for (const Json& other : others) {
            value = other;
            with();
        }
        value = before;
        if (value.is_structured()) replace_each(value, others, with);
    }
}

TEST(Merge, TakesNothingOfAWrongKindForItsReports) {
    Suite suite{{model_path("chaikin-overweight"),
                 std::string(LOOPCHECK_MODELS_DIR) + "/reject/repeated-vertex.obj", "--levels", "0"}};
    suite.subjects = {test::subject("ours"), test::subject("opensubdiv")};
    suite.run_shards(1);
    auto report = Json::parse(suite.read("part-0.json"));
    std::size_t refused = 0;
    const auto read_and_merge = [&] {
        if (!report["shard"].is_object() || !report["shard"]["checksum"].is_string()) return;
        seal(report);
        auto shard = read_shard("part", dump_compact(report), 1e9);
        if (!shard) {
            EXPECT_EQ(shard.error().code, core::ErrorCode::BadSyntax);
            ++refused;
            return;
        }
        std::vector<ShardReport> one;
        one.push_back(std::move(*shard));
        if (const auto merged = merge_shards(std::move(one))) suite_as_text(merged->suite, {});
    };
    std::vector<Json> others{18446744073709551615U, "\x01", Json::array({{}}), nullptr, -1, 1e300};
    if (tests::is_short_run()) others.resize(3);
    for (const char* part : {"subjects", "shard", "unreadable"})
        replace_each(report[part], others, read_and_merge);
    replace_each(report["comparisons"][0], others, read_and_merge);
    EXPECT_GT(refused, 50 * others.size());
    report["comparisons"][1].erase("verdict");
    seal(report);
    EXPECT_EQ(read_shard("part", dump(report), 1e9).error().sentence,
              "comparisons[1]: \"verdict\" is missing, or not as docs/report.schema.json has it.");
}

TEST(Merge, RefusesCasesThatAreLeftOutOrAdded) {
    const auto suite = small_suite();
    suite.run_shards(1);
    const auto report = Json::parse(suite.read("part-0.json"));
    const auto merge_of = [&](const std::function<void(Json&)>& change) {
        Json changed = report;
        change(changed["comparisons"]);
        seal(changed);
        std::vector<ShardReport> one;
        one.push_back(read_shard("part", dump(changed), 1e9).value());
        const auto merged = merge_shards(std::move(one));
        return merged ? std::string() : merged.error().at(0);
    };
    const std::size_t rows = report["comparisons"].size(), pairs = rows / 6;
    EXPECT_EQ(merge_of([](Json&) {}), "");
    EXPECT_SAYS(merge_of([](Json& all) { all.erase(2); }), "has not the comparisons of tetrahedron.obj");
    EXPECT_SAYS(merge_of([&](Json& all) { all.erase(all.begin(), all.begin() + static_cast<int>(pairs)); }),
                "tetrahedron.obj was compared in part, and not in part");
    EXPECT_SAYS(merge_of([](Json& all) { all.clear(); }), "is in no shard; part should have it.");
    EXPECT_SAYS(merge_of([](Json& all) { all.push_back(all[0]); }), "has what is not of its cases");
    EXPECT_SAYS(merge_of([&](Json& all) { std::swap(all[0], all[rows - 1]); }), "tetrahedron.obj");
}

TEST(Merge, EndsOnHostileReports) {
    const auto reads = [](const std::string& bytes, double memory) {
        return read_shard("", bytes, memory).has_value();
    };
    std::string keys = "{", deep(1'000'000, '['), numbers = "[0";
    for (int i = 0; i < 200'000; ++i) keys += "\"" + std::to_string(i) + "\":0,";
    for (int i = 0; i < 200'000; ++i) numbers += ",0";
    EXPECT_FALSE(reads(keys + "\"\":0}", 1e9));
    EXPECT_FALSE(reads(deep, 1e9));
    EXPECT_FALSE(reads("{\"shard\":1e999}", 1e9));
    EXPECT_EQ(read_shard("", numbers + "]", 1e6).error().code, core::ErrorCode::OutOfMemory);
}

}  // namespace
}  // namespace loopcheck::compare
