// What `refine` writes, straight from the control mesh.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/model.h"
#include "tests/compare/support.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using test::model_path;
using tests::contains;

// Ours as it is, but for `refine` one of the subjects that refine level by level.
std::vector<Subject> ours_by_levels() {
    std::vector<Subject> subjects{test::subject("ours"), test::subject("ours-float")};
    for (Subject& subject : subjects) subject.family = "by levels";
    return subjects;
}

TEST(Refine, WritesTheBytesOfTheLastOfAllLevels) {
    const tests::TemporaryFolder folder;
    const std::vector<std::vector<std::string>> formats{
        {"obj"}, {"off"}, {"stl"}, {"ply"}, {"ply", "--binary"}};
    for (const char* model : {"cow-creased", "hole-open", "crease-on-boundary", "semi-sharp-three-ends",
                              "corner-boundary", "isolated-vertex-middle", "boundary-none"})
        for (const char* boundary : {"edge-and-corner", "edge-only", "none"})
            for (const auto& format : formats) {
                const std::string level = std::to_string(format.size() + (*boundary == 'n' ? 1 : 0));
                std::vector<std::string> arguments{
                    "refine", model_path(model), "--levels", level, "--boundary",
                    boundary, "--creasing",      "chaikin",  "-o",  folder.path() / ("out." + format[0])};
                arguments.insert(arguments.end(), format.begin() + 1, format.end());
                std::array<std::string, 2> bytes, said;
                for (const bool straight : {false, true}) {
                    const auto r =
                        straight ? test::loopcheck(arguments) : test::loopcheck(arguments, ours_by_levels());
                    ASSERT_EQ(r.code, 0) << r.err;
                    bytes[straight] = core::read_file(arguments[9]).value();
                    said[straight] = r.out + r.err;
                }
                EXPECT_TRUE(bytes[0] == bytes[1]) << testing::PrintToString(arguments);
                EXPECT_EQ(said[0], said[1]);
            }
}

TEST(Refine, WritesTheOrderOfTheLatticeAndSaysSo) {
    const tests::TemporaryFolder folder;
    const std::string out = folder.path() / "out.obj", json = folder.path() / "out.json";
    const auto r = test::loopcheck({"refine", model_path("cow-creased"), "-o", out, "--levels", "2",
                                    "--order", "lattice", "--precision", "float", "--json", json});
    ASSERT_EQ(r.code, 0) << r.err;
    const auto model = core::read_model(out).value();
    EXPECT_PRED2(contains, model.description, "refined 2 levels, in the order of the lattice, by ours");
    EXPECT_FALSE(model.data.creases.empty());
    EXPECT_EQ(nlohmann::json::parse(core::read_file(json).value())["refinement"]["order"], "lattice");
    // A mesh of its own, with the creases on edges that exist.
    EXPECT_TRUE(core::TriangleMesh::make(model.data));
}

TEST(Refine, RefusesAnOrderThatASubjectDoesNotHave) {
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--scheme", "opensubdiv"}, {"--adaptive"}, {"--tolerance", "0.1"}}) {
        std::vector<std::string> arguments{"refine",          model_path("torus"), "-o",
                                           "/dev/null/x.obj", "--order",           "lattice"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto r = test::loopcheck(arguments);
        EXPECT_EQ(r.code, 2);
        EXPECT_PRED2(contains, r.err, "--order");
    }
}

}  // namespace
}  // namespace loopcheck::compare
