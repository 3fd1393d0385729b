#include "compare/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "compare/adaptive/adaptive_comparison.h"
#include "compare/curve/curve_comparison.h"
#include "compare/curve/tensor_comparison.h"
#include "compare/referee.h"
#include "compare/report/html/curve_case.h"
#include "compare/report/html/mesh_levels.h"
#include "compare/report/html/page.h"
#include "compare/report/report.h"
#include "core/loop/lattice/refiner.h"
#include "core/mesh/io/atomic_file.h"
#include "tests/compare/support.h"

namespace loopcheck::compare {
namespace {

using test::model_mesh;
using test::model_path;
using test::subject;

TEST(LevelSize, IsWhatRefinementMakes) {
    for (const char* name : {"cow", "grid-4x4", "pillow", "isolated-vertex-middle"}) {
        const auto mesh = model_mesh(name);
        const auto made = subject("ours").refine(mesh, {}, 3);
        ASSERT_TRUE(made);
        for (int l = 0; l <= 3; ++l) {
            EXPECT_EQ(level_size(mesh, l).vertices, static_cast<double>(made->levels[l].positions.size()))
                << name;
            EXPECT_EQ(level_size(mesh, l).faces, static_cast<double>(made->levels[l].triangles.size()))
                << name;
        }
    }
}

TEST(CheckMemory, RefusesALevelThatCannotFitWithTheNumber) {
    const auto mesh = model_mesh("cow");
    EXPECT_FALSE(check_memory(mesh, 5, 1000, 1e9));
    const auto error = check_memory(mesh, 6, 1000, 9e8);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, core::ErrorCode::OutOfMemory);
    EXPECT_NE(error->sentence.find("974850 vertices"), std::string::npos) << error->sentence;
    EXPECT_NE(error->sentence.find("0.908 GiB"), std::string::npos) << error->sentence;
}

TEST(CheckMemory, RefusesALevelThatCannotBeNumbered) {
    const auto error = check_memory(model_mesh("cow"), 30, 1, 1e300);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, core::ErrorCode::TooLarge);
}

TEST(AvailableMemory, IsPositiveAndFinite) {
    EXPECT_GT(available_memory(), 1e7);
    EXPECT_LT(available_memory(), 1e15);
}

// Peak resident memory of a process that does `work` and ends with the code it returns, in bytes.
double peak_memory(const std::function<int()>& work) {
    const pid_t child = fork();
    if (child == 0) _exit(work());
    int status = 0;
    rusage usage{};
    EXPECT_EQ(wait4(child, &status, 0, &usage), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) <= 1) << status;
    return static_cast<double>(usage.ru_maxrss) * 1024;
}

// The same of the program run with these arguments.
double peak_memory(const std::vector<std::string>& arguments) {
    return peak_memory([&] {
        std::vector<char*> argv;
        static std::string program = LOOPCHECK_PROGRAM;
        argv.push_back(program.data());
        std::vector<std::string> copy = arguments;
        for (std::string& a : copy) argv.push_back(a.data());
        argv.push_back(nullptr);
        if (freopen("/dev/null", "w", stdout) != nullptr) execv(argv[0], argv.data());
        return 127;
    });
}

// The constants per vertex are measured ones: the estimate must cover the peak and not exceed it by more than
// half.
void expect_covers(double bytes_per_vertex, const std::vector<std::string>& arguments, double vertices) {
    const double estimate = bytes_per_vertex * vertices;
    const double peak = peak_memory(arguments);
    std::printf("%s: peak %.0f bytes a vertex, estimate %.0f\n", arguments[0].c_str(), peak / vertices,
                bytes_per_vertex);
    EXPECT_LE(peak, estimate);
    EXPECT_GE(1.5 * peak, estimate);
}

void expect_covers(double bytes_per_vertex, const std::vector<std::string>& arguments,
                   const core::TriangleMesh& mesh, int level) {
    expect_covers(bytes_per_vertex, arguments, level_size(mesh, level).vertices);
}

// 10^9 vertices in all; memory does not depend on how many faces are visited.
TEST(LatticeRefiner, StreamsLevel11OfTheCowInLessThanAQuarterGigabyte) {
    const auto mesh = model_mesh("cow");
    constexpr core::Index kFaces = 12;
    const double peak = peak_memory([&] {
        const auto refiner = core::LatticeRefiner::make(mesh, {}, 11).value();
        const std::size_t points_of_face = 2049 * 2050 / 2;
        core::Index visited = 0;
        refiner.refine_by_face<double>(mesh.positions(), {0, kFaces},
                                       [&](core::Index, std::span<const glm::dvec3> points) {
                                           visited += points.size() == points_of_face;
                                       });
        return visited == kFaces ? 0 : 2;
    });
    std::printf("level 11, face by face: peak %.0f MB\n", peak / 1e6);
    EXPECT_LT(peak, 256e6);
}

TEST(MemoryEstimate, CoversComparisons) {
    const auto mesh = model_mesh("cow");
    const std::string model = model_path("cow");
    for (const auto& subject : built_in_subjects()) {
        if (subject.family == "ours" || subject.precision == core::Precision::Float) continue;
        const std::array both{&test::subject("ours"), &subject};
        expect_covers(referee_bytes_per_vertex(both, {}),
                      {"compare", model, "--levels", "5", "--with", subject.name}, mesh, 5);
    }
    const std::array pair{&subject("ours"), &subject("opensubdiv")};
    expect_covers(referee_bytes_per_vertex(pair, {}) + kCsvBytesPerVertex + kPlyBytesPerVertex,
                  {"compare", model, "--levels", "5", "--csv", testing::TempDir() + "memory.csv", "--ply",
                   testing::TempDir() + "memory.ply"},
                  mesh, 5);
    core::SchemeOptions warren;
    warren.weights = core::Weights::Warren;
    expect_covers(referee_bytes_per_vertex(pair, warren),
                  {"compare", model, "--levels", "5", "--weights", "warren"}, mesh, 5);
}

TEST(MemoryEstimate, CoversLimits) {
    const auto mesh = model_mesh("cow");
    const std::array pair{&subject("ours"), &subject("opensubdiv")};
    expect_covers(referee_bytes_per_vertex(pair, {}, Scope::Limits),
                  {"compare", model_path("cow"), "--levels", "5", "--limit"}, mesh, 5);
    const std::array ours{&subject("ours"), &subject("ours-float")};
    expect_covers(referee_bytes_per_vertex(ours, {}, Scope::Limits),
                  {"compare", model_path("cow"), "--levels", "5", "--limit", "--with", "ours-float"}, mesh,
                  5);
}

// What is allowed is used, and no more.
TEST(MemoryEstimate, CoversBlocksOfBits) {
    constexpr double kGib = 1024.0 * 1024 * 1024;
    for (const auto& [memory, jobs] : {std::pair{0.12, 1}, {0.2, 2}})
        expect_covers(memory * kGib,
                      {"compare", model_path("cow"), "--bits", "--levels", "6", "--memory",
                       std::to_string(memory), "--jobs", std::to_string(jobs)},
                      1);
}

TEST(MemoryEstimate, CoversAnHtmlReport) {
    if (!why_no_page().empty()) GTEST_SKIP() << why_no_page();  // a build without npm
    const auto mesh = model_mesh("cow");
    const std::array pair{&subject("ours"), &subject("opensubdiv")};
    const std::string html = testing::TempDir() + "memory.html";
    expect_covers(
        referee_bytes_per_vertex(pair, {}) + kShownBytesPerVertex + kComparedBytesPerVertex,
        {"compare", model_path("cow"), "--levels", "5", "--html", html, "--html-vertices", "1000000"}, mesh,
        5);
    expect_covers(referee_bytes_per_vertex(pair, {}, Scope::Limits) + kShownBytesPerVertex +
                      kComparedBytesPerVertex + kComparedLimitsBytesPerVertex,
                  {"compare", model_path("cow"), "--levels", "5", "--limit", "--html", html,
                   "--html-vertices", "1000000"},
                  mesh, 5);
    constexpr int kPoints = 60, kLevel = 13;  // of wandering.txt
    expect_covers(kCurveBytesPerPoint + kShownBytesPerPoint,
                  {"curve", std::string(LOOPCHECK_MODELS_DIR) + "/curves/wandering.txt", "--levels",
                   std::to_string(kLevel), "--html", html, "--html-vertices", "1000000"},
                  std::ldexp(kPoints, kLevel));
}

TEST(MemoryEstimate, CoversWritingAMesh) {
    const auto mesh = model_mesh("cow");
    for (const auto& subject : built_in_subjects()) {
        if (subject.precision == core::Precision::Float) continue;
        expect_covers(subject.family == "ours" ? kWrittenStraightBytesPerVertex
                                               : subject.bytes_per_vertex + kWrittenBytesPerVertex,
                      {"refine", model_path("cow"), "-o", testing::TempDir() + "memory.obj", "--levels", "5",
                       "--scheme", subject.name},
                      mesh, 5);
    }
}

// Where most of it is the control mesh.
TEST(MemoryEstimate, CoversWritingALargeMeshAgain) {
    const std::string large = testing::TempDir() + "memory-large.ply";
    peak_memory({"refine", model_path("cow"), "-o", large, "--binary", "--levels", "4"});
    const LevelSize control = level_size(model_mesh("cow"), 4), refined = level_size(model_mesh("cow"), 5);
    for (const auto& [levels, vertices] : {std::pair{"0", control.vertices}, {"1", refined.vertices}})
        expect_covers(
            kWrittenStraightBytesPerVertex * vertices + kControlBytesPerFace * control.faces,
            {"refine", large, "-o", testing::TempDir() + "memory.ply", "--binary", "--levels", levels}, 1);
}

TEST(MemoryEstimate, CoversAdaptiveRefinement) {
    const auto mesh = model_mesh("cow");
    constexpr int kLevels = 5;
    double faces = 0;
    for (int l = 0; l <= kLevels; ++l) faces += level_size(mesh, l).faces;
    const std::string levels = std::to_string(kLevels);
    expect_covers(kAdaptiveBytesPerFace,
                  {"refine", model_path("cow"), "-o", testing::TempDir() + "memory.obj", "--adaptive",
                   "--angle", "180", "--levels", levels},
                  faces);
    const std::array pair{&subject("ours"), &subject("opensubdiv")};
    expect_covers(referee_bytes_per_vertex(pair, {}) + kUniformLevelsBytesPerVertex +
                      kAdaptiveBytesPerFace * faces / level_size(mesh, kLevels).vertices,
                  {"compare", model_path("cow"), "--adaptive", "--angle", "180", "--levels", levels}, mesh,
                  kLevels);
}

TEST(MemoryEstimate, CoversATessellation) {
    const std::string json = testing::TempDir() + "memory.json";
    const std::vector<std::string> arguments{
        "refine",      model_path("cow"), "-o",     testing::TempDir() + "memory.obj",
        "--tolerance", "0.0004",          "--json", json};
    ASSERT_EQ(test::loopcheck(arguments).code, 0);
    const auto report = nlohmann::json::parse(core::read_file(json).value());
    expect_covers(kTessellationBytesPerTriangle, arguments, report["refinement"]["faces"].get<double>());
}

TEST(MemoryEstimate, CoversACurve) {
    constexpr int kPoints = 60, kLevel = 13;  // of wandering.txt
    expect_covers(kCurveBytesPerPoint,
                  {"curve", std::string(LOOPCHECK_MODELS_DIR) + "/curves/wandering.txt", "--levels",
                   std::to_string(kLevel), "--csv", testing::TempDir() + "memory.csv"},
                  std::ldexp(kPoints, kLevel));
}

// At level 0, where the least is shared, and the rows of the matrix, which are in fractions.
TEST(MemoryEstimate, CoversACurveOfManyPointsAndItsMatrix) {
    constexpr int kPoints = 40'000, kDegree = 7;
    const std::string points = testing::TempDir() + "memory.txt";
    std::string text;
    for (int i = 0; i < kPoints; ++i) text += std::to_string(std::cos(i)) + " " + std::to_string(i) + "\n";
    ASSERT_TRUE(core::write_file(points, text));
    std::vector<std::string> arguments{"curve", points, "--levels", "0", "--degree", std::to_string(kDegree)};
    expect_covers(kCurveBytesPerPoint * 1.25, arguments, kPoints);  // a quarter is the program itself
    arguments.insert(arguments.end(), {"--matrix", "/dev/null"});
    expect_covers(kCurveBytesPerPoint + (kDegree + 1) * kMatrixBytesPerWeight, arguments, kPoints);
}

TEST(MemoryEstimate, CoversAGridThatIsAllRows) {
    constexpr int kRows = 4000;
    const std::string points = testing::TempDir() + "memory.txt";
    std::string text;
    for (int i = 0; i < 2 * kRows; ++i) text += std::to_string(i % 2) + " " + std::to_string(i / 2) + "\n";
    ASSERT_TRUE(core::write_file(points, text));
    const double program = 8e6;  // bytes
    expect_covers(kGridBytesPerVertex + (kGridBytesPerLine * (kRows + 2) + program) / (2 * kRows),
                  {"grid", points, "--columns", "2", "--levels", "0"}, 2 * kRows);
}

TEST(MemoryEstimate, CoversAGrid) {
    constexpr int kPoints = 28, kLevel = 6;
    expect_covers(kGridBytesPerVertex,
                  {"grid", std::string(LOOPCHECK_MODELS_DIR) + "/grids/ring-7x4.txt", "--columns", "4",
                   "--closed-u", "--closed-v", "--levels", std::to_string(kLevel)},
                  std::ldexp(kPoints, 2 * kLevel));
}

}  // namespace
}  // namespace loopcheck::compare
