// The command line: what is printed where, which files are written, and the exit code.
#include "compare/cli/cli.h"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/model.h"
#include "tests/compare/support.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using test::loopcheck;
using test::model_path;

#define EXPECT_SAYS(text, what) EXPECT_NE((text).find(what), std::string::npos) << (text)

TEST(CommandLine, ExitsWithZeroWhereSubjectsAgree) {
    const auto r = loopcheck({"compare", model_path("cow"), "--levels", "2"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_SAYS(r.out, "verdict: identical");
    EXPECT_EQ(r.err, "") << "no progress where standard error is no terminal";
}

TEST(CommandLine, ExitsWithOneWhereTheyDiffer) {
    const auto r = loopcheck({"compare", model_path("cow"), "--levels", "1", "--weights", "warren"});
    EXPECT_EQ(r.code, 1);
    EXPECT_SAYS(r.out, "verdict: differs");
}

TEST(CommandLine, ExitsWithTwoOnBadUsage) {
    const std::vector<std::vector<std::string>> bad{
        {},
        {"compare"},
        {"frobnicate"},
        {"compare", model_path("cow"), "--levels", "-1"},
        {"compare", model_path("cow"), "--levels", "many"},
        {"compare", model_path("cow"), "--boundary", "sharp"},
        {"compare", model_path("cow"), "--with", "nobody"},
        {"compare", model_path("cow"), model_path("torus"), "--ply", "x.ply"},
        {"suite", "/no/such/folder"},
        {"suite", model_path("fan-1"), "--shard", "4/4"},
        {"suite", model_path("fan-1"), "--shard", "-1/4"},
        {"suite", model_path("fan-1"), "--shard", "0/0"},
        {"suite", model_path("fan-1"), "--shard", "2"},
        {"suite", model_path("fan-1"), "--shard", "0/4294967297"},
        {"merge"},
        {"explain", model_path("cow")},
        {"explain", model_path("cow"), "--vertex", "5000"},
        {"refine", model_path("cow"), "-o", "/no/such/folder/x.obj"},
        {"refine", model_path("cow"), "-o", "x.docx"}};
    for (const auto& arguments : bad) {
        const auto r = loopcheck(arguments);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(arguments);
        EXPECT_NE(r.err, "") << testing::PrintToString(arguments);
    }
}

TEST(CommandLine, ExitsWithTwoAndThePlaceOnUnreadableInput) {
    const std::string path = std::string(LOOPCHECK_MODELS_DIR) + "/reject/repeated-vertex.obj";
    const auto r = loopcheck({"compare", path});
    EXPECT_EQ(r.code, 2);
    EXPECT_SAYS(r.err, path + ": line ");
    EXPECT_SAYS(r.err, "appears twice. [repeated-vertex]");
    EXPECT_EQ(loopcheck({"compare", "/no/such/file.obj"}).code, 2);
}

TEST(CommandLine, ExitsWithThreeWhereASubjectFailsOrCannotDoIt) {
    EXPECT_EQ(loopcheck({"compare", model_path("cow"), "--levels", "1", "--with", "broken"},
                        {test::subject("ours"), test::cheat("broken", [](auto& r) { r.levels.pop_back(); })})
                  .code,
              3);
    EXPECT_EQ(loopcheck({"compare", model_path("cow"), "--subject", "opensubdiv", "--with", "openmesh",
                         "--weights", "warren"})
                  .code,
              3);
    EXPECT_EQ(loopcheck({"refine", model_path("cow"), "-o", "x.obj", "--scheme", "opensubdiv", "--weights",
                         "warren"})
                  .code,
              3);
}

TEST(CommandLine, GivesTheWorstExitCodeOfSeveralModels) {
    const std::string bad = std::string(LOOPCHECK_MODELS_DIR) + "/reject/repeated-vertex.obj";
    EXPECT_EQ(loopcheck({"compare", model_path("cow"), bad, model_path("torus"), "--levels", "1"}).code, 2);
    EXPECT_EQ(loopcheck({"compare", model_path("icosahedron"), model_path("tetrahedron"), "--levels", "1",
                         "--weights", "warren"})
                  .code,
              1);
}

TEST(CommandLine, RefusesALevelThatCannotFit) {
    const auto r = loopcheck({"compare", model_path("cow"), "--levels", "9", "--memory", "1"});
    EXPECT_EQ(r.code, 2);
    EXPECT_SAYS(r.err, "1 GiB may be used (--memory sets the limit). [out-of-memory]");
}

TEST(CommandLine, TakesTagsOfTheFileUnlessToldOtherwise) {
    EXPECT_SAYS(loopcheck({"compare", model_path("chaikin-pair"), "--levels", "1"}).out, "creasing chaikin");
    EXPECT_SAYS(
        loopcheck({"compare", model_path("chaikin-pair"), "--levels", "1", "--creasing", "uniform"}).out,
        "creasing uniform");
    EXPECT_SAYS(loopcheck({"compare", model_path("boundary-edge-only"), "--levels", "1"}).out,
                "boundary edge-only");
    EXPECT_SAYS(loopcheck({"compare", model_path("cow"), "--levels", "1"}).out, "boundary edge-and-corner");
}

TEST(CommandLine, ComparesInFloatWhenAsked) {
    const auto r = loopcheck({"compare", model_path("cow"), "--levels", "2", "--precision", "float"});
    EXPECT_EQ(r.code, 0);
    EXPECT_SAYS(r.out, "a = ours-float");
    EXPECT_SAYS(r.out, "b = opensubdiv-float");
    EXPECT_SAYS(r.out, "verdict: identical");
}

TEST(CommandLine, ComparesLimitsWhenAsked) {
    const auto r = loopcheck({"compare", model_path("dart-valence-06"), "--levels", "1", "--limit", "--csv",
                              (tests::TemporaryFolder() / "x.csv").string()});
    EXPECT_SAYS(r.out, "verdict: identical");
    EXPECT_SAYS(r.out, "verdict on limits: known deviation");
    EXPECT_SAYS(r.out, "normal, class at level 0");
    EXPECT_SAYS(r.out, "limit-dart: ");
    EXPECT_SAYS(r.err, "--csv and --ply have the refinement only");
    EXPECT_EQ(loopcheck({"compare", model_path("dart-valence-06"), "--levels", "1"}).out.find("limit"),
              std::string::npos);
    // The worse of the two verdicts decides.
    EXPECT_EQ(loopcheck({"compare", model_path("cow"), "--levels", "1", "--limit"}).code, 0);
    EXPECT_EQ(loopcheck({"compare", model_path("cow"), "--boundary", "edge-only", "--levels", "1", "--limit",
                         "--with", "openmesh"})
                  .code,
              3);
    EXPECT_EQ(
        loopcheck({"compare", model_path("cow"), "--levels", "1", "--limit", "--with", "off"},
                  {test::subject("ours"),
                   test::cheat_limits("off", [](core::Limits& limits,
                                                const auto&) { limits.levels[0].positions[0].x += 1e-9; })})
            .code,
        1);
}

TEST(CommandLine, LeavesLimitsOutOfASuiteWhenAsked) {
    EXPECT_SAYS(loopcheck({"suite", model_path("fan-2"), "--levels", "1"}).out, "and 6 of limits");
    EXPECT_EQ(loopcheck({"suite", model_path("fan-2"), "--levels", "1", "--no-limit"}).out.find("of limits"),
              std::string::npos);
}

TEST(CommandLine, WritesTheReportsItIsAskedFor) {
    const tests::TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder / name).string(); };
    const auto r = loopcheck({"compare", model_path("cow"), "--levels", "1", "--json", at("r.json"), "--csv",
                              at("r.csv"), "--ply", at("r.ply")});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(nlohmann::json::parse(core::read_file(at("r.json")).value()).at("command"), "compare");
    const auto csv = core::read_file(at("r.csv")).value();
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 240 + 954);
    EXPECT_EQ(core::read_model(at("r.ply")).value().data.positions.size(), 954U);
    EXPECT_EQ(
        loopcheck({"compare", model_path("cow"), "--levels", "1", "--json", "/no/such/folder/r.json"}).code,
        2);

    EXPECT_EQ(loopcheck({"suite", model_path("fan-2"), "--levels", "1", "--json", at("s.json"), "--junit",
                         at("s.xml")})
                  .code,
              0);
    EXPECT_EQ(nlohmann::json::parse(core::read_file(at("s.json")).value()).at("command"), "suite");
    EXPECT_SAYS(core::read_file(at("s.xml")).value(), "<testsuite name=\"fan-2.obj\"");
}

TEST(CommandLine, NeverWritesOverAModelOrAnotherReport) {
    const tests::TemporaryFolder folder;
    const std::string model = (folder / "cow.obj").string(), report = (folder / "r").string();
    std::filesystem::copy_file(model_path("cow"), model);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"compare", model, "--levels", "1", "--json", model},
          {"compare", model, "--levels", "1", "--json", report, "--csv", (folder / "." / "r").string()},
          {"suite", model, "--levels", "1", "--json", report, "--junit", report}}) {
        const auto r = loopcheck(arguments);
        EXPECT_EQ(r.code, 2) << r.out;
        EXPECT_SAYS(r.err, "is read or written already");
    }
    EXPECT_EQ(core::read_file(model).value(), core::read_file(model_path("cow")).value());
    EXPECT_FALSE(std::filesystem::exists(report));
}

TEST(CommandLine, WarnsOnlyOfWhatIsLost) {
    const tests::TemporaryFolder folder;
    const auto refine = [&](const char* model) {
        return loopcheck({"refine", model_path(model), "-o", (folder / "x.ply").string(), "--levels", "1"})
            .err;
    };
    EXPECT_EQ(refine("cow"), "");
    EXPECT_SAYS(refine("fan-3"), "boundary");
    EXPECT_SAYS(refine("crease-loop"), "crease");
}

TEST(CommandLine, PrintsNoControlCharactersOfAFileName) {
    const auto r = loopcheck({"compare", "no\x1b[31m\n.obj"});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.err.find('\x1b'), std::string::npos);
}

// The exit code of the program run by a shell, which can also close or fill its output.
int shell(const std::string& arguments) {
    const int status = std::system((std::string(LOOPCHECK_PROGRAM " ") + arguments).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Program, FailsWhereItsOutputIsLost) {
    EXPECT_EQ(shell("subjects >/dev/null"), 0);
    EXPECT_EQ(shell("subjects >/dev/full 2>/dev/null"), 2);
}

TEST(Program, LeavesNothingBehindWhenItIsKilled) {
    const tests::TemporaryFolder folder;
    const std::string out = (folder / "x.obj").string();
    // More than a file may have: the write fails, with a sentence, and there is no file.
    EXPECT_EQ(shell("refine " + model_path("cow") + " -o " + out + " --levels 1 >/dev/null"), 0);
    std::filesystem::remove(out);
    const int status = std::system(("ulimit -f 100; " LOOPCHECK_PROGRAM " refine " + model_path("cow") +
                                    " -o " + out + " --levels 4 >/dev/null 2>&1")
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    std::system(("timeout -s KILL 0.4 " LOOPCHECK_PROGRAM " refine " + model_path("cow") + " -o " + out +
                 " --levels 6 >/dev/null 2>&1")
                    .c_str());
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) EXPECT_EQ(entry.path(), out);
}

TEST(CommandLine, TriangulatesWhenAskedAndSaysSo) {
    const tests::TemporaryFolder folder;
    const std::string quad = (folder / "quad.obj").string();
    ASSERT_TRUE(core::write_file(quad, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
    const auto refused = loopcheck({"compare", quad, "--levels", "1"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_SAYS(refused.err, "line 5: face 0: The face has 4 corners");
    EXPECT_SAYS(refused.err, "--triangulate");
    const auto taken = loopcheck({"compare", quad, "--levels", "1", "--triangulate"});
    EXPECT_EQ(taken.code, 0);
    EXPECT_SAYS(taken.err, "1 polygons were split by a fan");
}

TEST(CommandLine, TagsCreasesByAngleAndSaysHowMany) {
    const tests::TemporaryFolder folder;
    const std::string json = (folder / "report.json").string();
    const std::string said = "--crease-angle 20.5: 30 edges tagged as creases\n";
    const auto compared = loopcheck(
        {"compare", model_path("icosahedron"), "--levels", "2", "--crease-angle", "20.5", "--json", json});
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_SAYS(compared.out, said);
    EXPECT_SAYS(compared.out, "verdict: identical");
    const auto entry = nlohmann::json::parse(std::ifstream(json)).at("comparisons").at(0);
    EXPECT_EQ(entry.at("crease_angle"), 20.5);
    EXPECT_EQ(entry.at("crease_edges"), 30);

    // Each of the 30 edges became two.
    const std::string obj = (folder / "1.obj").string();
    const auto refined = loopcheck(
        {"refine", model_path("icosahedron"), "-o", obj, "--levels", "1", "--crease-angle", "20.5"});
    EXPECT_EQ(refined.code, 0) << refined.err;
    EXPECT_SAYS(refined.out, said);
    const auto creases = core::read_model(obj).value().data.creases;
    EXPECT_EQ(creases.size(), 60U);
    for (const auto& crease : creases) EXPECT_EQ(crease.sharpness, core::kInfiniteSharpness);
}

TEST(CommandLine, TagsCreasesBeforeItRefinesAdaptively) {
    const tests::TemporaryFolder folder;
    const std::vector<std::string> flags{model_path("icosahedron"), "--levels", "1", "--adaptive",
                                         "--crease-angle",          "20.5"};
    for (const std::string command : {"compare", "refine"}) {
        std::vector<std::string> arguments{command};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        if (command == "refine") arguments.insert(arguments.end(), {"-o", (folder / "1.obj").string()});
        const auto r = loopcheck(arguments);
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_SAYS(r.out, "--crease-angle 20.5: 30 edges tagged as creases\n");
    }
    // No two faces meet at 60 degrees: all are split, with the creases.
    EXPECT_EQ(core::read_model((folder / "1.obj").string()).value().data.creases.size(), 60U);
}

TEST(CommandLine, TagsNoCreasesUnlessAsked) {
    const tests::TemporaryFolder folder;
    const std::string json = (folder / "report.json").string();
    const auto r = loopcheck({"compare", model_path("icosahedron"), "--levels", "1", "--json", json});
    EXPECT_EQ(r.out.find("crease-angle"), std::string::npos) << r.out;
    const auto entry = nlohmann::json::parse(std::ifstream(json)).at("comparisons").at(0);
    EXPECT_FALSE(entry.contains("crease_angle"));
    EXPECT_FALSE(entry.contains("crease_edges"));
}

TEST(CommandLine, RefusesWhatIsNoCreaseAngle) {
    for (const std::string command : {"compare", "refine"})
        for (const std::string angle : {"-1", "180.5", "181", "nan", "inf", "sharp", "30deg"}) {
            std::vector<std::string> arguments{command, model_path("cow"), "--crease-angle", angle};
            if (command == "refine") arguments.insert(arguments.end(), {"-o", "x.obj"});
            const auto r = loopcheck(arguments);
            EXPECT_EQ(r.code, 2) << angle;
            EXPECT_SAYS(r.err, "--crease-angle: " + angle + " is not an angle from 0 to 180 degrees");
        }
}

// Refining 1 + 2 levels through a file is refining 3 levels: the tags that are left are in the file.
TEST(CommandLine, RefinesFromWhereAFileStopped) {
    const tests::TemporaryFolder folder;
    const auto at = [&](const char* name) { return (folder / name).string(); };
    for (const char* model : {"cow-creased", "single-triangle", "semi-sharp-edge-2.5", "semi-sharp-vertex-2",
                              "chaikin-graded", "hole-open", "boundary-none"}) {
        ASSERT_EQ(loopcheck({"refine", model_path(model), "-o", at("1.obj"), "--levels", "1"}).code, 0)
            << model;
        ASSERT_EQ(loopcheck({"refine", at("1.obj"), "-o", at("1+2.obj"), "--levels", "2"}).code, 0) << model;
        ASSERT_EQ(loopcheck({"refine", model_path(model), "-o", at("3.obj"), "--levels", "3"}).code, 0)
            << model;
        const auto split = core::read_model(at("1+2.obj")).value(),
                   whole = core::read_model(at("3.obj")).value();
        EXPECT_EQ(split.boundary, whole.boundary);
        EXPECT_EQ(split.creasing, whole.creasing);
        EXPECT_EQ(split.data.holes.size(), whole.data.holes.size());
        EXPECT_EQ(split.data.creases.size(), whole.data.creases.size());
        ASSERT_EQ(split.data.positions.size(), whole.data.positions.size());
        // Another order of vertices and of sums, but each control vertex of level 1 keeps its index.  Five
        // levels' worth of the quick bound (8 + 5 L) u M of core/loop/error_bound.h is more than enough.
        double m = 0, worst = 0;
        for (const auto& p : whole.data.positions)
            m = std::max({m, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        const auto level1 = core::read_model(at("1.obj")).value().data.positions.size();
        for (std::size_t v = 0; v < level1; ++v)
            for (int i = 0; i < 3; ++i)
                worst = std::max(worst, std::abs(split.data.positions[v][i] - whole.data.positions[v][i]));
        EXPECT_LE(worst, 2 * (8 + 5 * 3) * 0x1p-53 * m) << model;
    }
}

TEST(CommandLine, RefinesByEverySubject) {
    const tests::TemporaryFolder folder;
    for (const Subject& subject : built_in_subjects()) {
        const std::string path = (folder / (subject.name + ".ply")).string();
        const auto r = loopcheck(
            {"refine", model_path("cow"), "-o", path, "--levels", "2", "--scheme", subject.name, "--binary"});
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(core::read_model(path).value().data.positions.size(), 3810U) << subject.name;
    }
}

TEST(CommandLine, ListsSubjectsAndTheVersion) {
    const auto r = loopcheck({"subjects"});
    EXPECT_EQ(r.code, 0);
    for (const Subject& subject : built_in_subjects()) EXPECT_SAYS(r.out, subject.name + " ");
    EXPECT_SAYS(loopcheck({"--version"}).out, "loopcheck ");
    const auto help = loopcheck({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_SAYS(help.out, "Examples");
    EXPECT_SAYS(help.out, "Exit codes");
}

TEST(DeviationsCommand, ListsEveryOneAndExplainsEach) {
    const auto all = loopcheck({"deviations"});
    EXPECT_EQ(all.code, 0) << all.out << all.err;
    for (const KnownDeviation& deviation : known_deviations()) {
        EXPECT_SAYS(all.out, std::string(deviation.name) + " ");
        const auto one = loopcheck({"explain", "--deviation", std::string(deviation.name)});
        EXPECT_EQ(one.code, 0) << one.err;
        EXPECT_SAYS(one.out, deviation.what);
        EXPECT_SAYS(one.out, page_of(deviation));
        EXPECT_SAYS(one.out, "as predicted");
    }
    const auto none = loopcheck({"explain", "--deviation", "gravity"});
    EXPECT_EQ(none.code, 2);
    EXPECT_SAYS(none.err, "There is no known deviation gravity");
    EXPECT_EQ(loopcheck({"explain", model_path("cow"), "--deviation", "limit-dart"}).code, 2);
}

TEST(StencilsCommand, WritesTheRowsOfALevelOfTheLimitAndOfAPoint) {
    const tests::TemporaryFolder folder;
    const std::string file = folder / "rows.mtx";
    const auto lines = [&](const std::vector<std::string>& what) {
        std::vector<std::string> arguments{"stencils", model_path("fan-2"), "-o", file};
        arguments.insert(arguments.end(), what.begin(), what.end());
        const auto r = loopcheck(arguments);
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_SAYS(r.out, "row sums right to");
        std::istringstream in(core::read_file(file).value());
        std::vector<std::string> out;
        for (std::string line; std::getline(in, line);) out.push_back(line);
        EXPECT_EQ(out.front(), "%%MatrixMarket matrix coordinate real general");
        return std::vector<std::string>(out.begin() + 4, out.end());
    };
    // Vertex 0 of two triangles is on the boundary between 1 and 3.
    EXPECT_EQ(lines({"--level", "1"}).at(0), "9 4 20");
    const auto limit = lines({"--limit"});
    EXPECT_EQ(limit.at(0), "4 4 8");
    EXPECT_EQ(limit.at(1), "1 1 0.6666666666666666");
    EXPECT_EQ(limit.at(2), "1 2 0.16666666666666666");
    EXPECT_EQ(limit.at(3), "1 4 0.16666666666666666");
    EXPECT_EQ(lines({"--at", "0,0,1"}).at(0).substr(0, 4), "6 4 ");
}

TEST(StencilsCommand, ExitsWithTwoOnWhatItCannotDo) {
    const std::string model = model_path("hole-closed");
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad{
        {{}, "--level, --limit or --at"},
        {{"--at", ""}, "--at takes face,u,v"},
        {{"--at", "0,0.5"}, "--at takes face,u,v"},
        {{"--at", "0,0.5,0.5,0"}, "--at takes face,u,v"},
        {{"--at", "-1,0,0"}, "--at takes face,u,v"},
        {{"--at", "99999999999,0,0"}, "--at takes face,u,v"},
        {{"--at", "x,0,0"}, "--at takes face,u,v"},
        {{"--at", "0,nan,0"}, "[outside-domain]"},
        {{"--at", "0,0.75,0.5"}, "[outside-domain]"},
        {{"--at", "4711,0,0"}, "[index-out-of-range]"},
        {{"--level", "1", "--memory", "1e-6"}, "[out-of-memory]"},
        {{"--level", "1", "--at", "0,0,0"}, "excludes"},
        {{"--limit", "-o", model}, "is read or written already"},
        {{"--limit", "-o", "/no/such/folder/rows.mtx"}, "[cannot-write]"}};
    for (const auto& [arguments, message] : bad) {
        std::vector<std::string> all{"stencils", model};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const auto r = loopcheck(all);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(arguments);
        EXPECT_SAYS(r.err, message);
        EXPECT_EQ(r.out, "");
    }
    const auto hole = core::read_model(model).value().data.holes.front();
    EXPECT_SAYS(loopcheck({"stencils", model, "--at", std::to_string(hole) + ",0,0"}).err,
                "[no-limit-surface]");
}

}  // namespace
}  // namespace loopcheck::compare
