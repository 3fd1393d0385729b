// The command that holds a bicubic surface against Catmull-Clark.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/mesh/io/atomic_file.h"
#include "tests/compare/support.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using test::Outcome;
using tests::contains;

std::string grid_path(const std::string& name) {
    return LOOPCHECK_MODELS_DIR "/grids/" + name + ".txt";
}

Outcome loopcheck_grid(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "grid");
    return test::loopcheck(arguments);
}

TEST(GridCommand, AgreesOnEveryModelHoweverItIsClosed) {
    const std::vector<std::vector<std::string>> ways{
        {}, {"--closed-u"}, {"--closed-v"}, {"--closed-u", "--closed-v"}};
    for (const auto& [name, columns] : {std::pair{"hill-4x5", "5"}, {"ring-7x4", "4"}})
        for (const auto& way : ways) {
            std::vector<std::string> arguments{grid_path(name), "--columns", columns, "--levels", "3"};
            arguments.insert(arguments.end(), way.begin(), way.end());
            const test::Outcome r = loopcheck_grid(arguments);
            EXPECT_EQ(r.code, 0) << r.out << r.err;
            EXPECT_TRUE(contains(r.out, "verdict: agree")) << r.out;
        }
    EXPECT_EQ(loopcheck_grid({grid_path("patch-2x2"), "--columns", "2"}).code, 0);
}

TEST(GridCommand, WritesItsNumbers) {
    const tests::TemporaryFolder folder;
    const std::string json = folder / "grid.json";
    ASSERT_EQ(loopcheck_grid({grid_path("hill-4x5"), "--columns", "5", "--levels", "2", "--json", json}).code,
              0);
    const auto report = nlohmann::json::parse(core::read_file(json).value());
    EXPECT_EQ(report["command"], "grid");
    const auto& grid = report["grid"];
    EXPECT_EQ(grid["rows"], 4);
    EXPECT_EQ(grid["columns"], 5);
    ASSERT_EQ(grid["precisions"].size(), 2U);
    for (const auto& precision : grid["precisions"]) {
        ASSERT_EQ(precision["levels"].size(), 3U);
        EXPECT_EQ(precision["levels"][2]["vertices"], 13 * 17);
        EXPECT_LE(precision["levels"][2]["position"]["bound_use"], 1);
    }
}

TEST(GridCommand, RefusesWhatIsNoGrid) {
    const std::string hill = grid_path("hill-4x5"), reject = LOOPCHECK_MODELS_DIR "/reject/";
    const std::vector<std::vector<std::string>> bad{{},
                                                    {hill},
                                                    {hill, "--columns", "0"},
                                                    {hill, "--columns", "3"},
                                                    {hill, "--columns", "20"},
                                                    {hill, "--columns", "10", "--closed-v"},
                                                    {hill, "--columns", "5", "--levels", "30"},
                                                    {hill, "--columns", "5", "--json", hill},
                                                    {"/no/such/file", "--columns", "5"},
                                                    {reject + "not-finite-point.txt", "--columns", "2"},
                                                    {reject + "not-finite-too-large.txt", "--columns", "2"}};
    for (const auto& arguments : bad) {
        const test::Outcome r = loopcheck_grid(arguments);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(arguments) << r.out;
        EXPECT_NE(r.err, "") << testing::PrintToString(arguments);
        EXPECT_EQ(r.out, "") << testing::PrintToString(arguments);
    }
    EXPECT_TRUE(
        contains(loopcheck_grid({reject + "not-finite-too-large.txt", "--columns", "2"}).err, ": line 5: "));
}

// The largest points are larger in double than in float.
TEST(GridCommand, SaysWhichPrecisionAPointIsTooLargeForAndItsLine) {
    const tests::TemporaryFolder folder;
    const std::string points = folder / "points.txt";
    for (const char* large : {"1e30", "3e38", "1e200"}) {
        ASSERT_TRUE(core::write_file(points, fmt::format("# x y\n0 0\n1 0\n\n0 {}\n1 1\n", large)));
        const Outcome r = loopcheck_grid({points, "--columns", "2"});
        EXPECT_EQ(r.code, 2) << large;
        EXPECT_TRUE(contains(r.err, ": line 5: In float: ")) << r.err;
    }
    ASSERT_TRUE(core::write_file(points, "0 0\n1 0\n0 1e300\n1 1\n"));
    const Outcome r = loopcheck_grid({points, "--columns", "2"});
    EXPECT_TRUE(contains(r.err, ": line 3: In double: ")) << r.err;
}

}  // namespace
}  // namespace loopcheck::compare
