// What the benchmark programs measure with: the numbers themselves belong to a machine, what is done with
// them does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/support/agreement.h"
#include "bench/support/clock.h"
#include "bench/support/measure.h"
#include "bench/support/meshes.h"
#include "bench/support/report.h"

namespace {

using namespace loopcheck;
using bench::Case;
using bench::Subject;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr bench::Plan kPlan{
    .least_rounds = 3, .most_rounds = 3, .seconds = 0, .fresh = 0, .written = 1 << 12};

// A subject that writes down what it does, and of whose result this is said.
Subject subject(std::string name, std::vector<std::string>& log, std::string said = "", double bytes = 0) {
    return {name, 1, bytes, [=, &log](const core::TriangleMesh&) -> core::Result<bench::Run> {
                return bench::Run{[=, &log] { log.push_back(name); },
                                  [=, &log] { log.push_back("clear " + name); }, [=] { return said; }};
            }};
}

Case case_of(std::vector<Subject> subjects) {
    return {.task = "task",
            .precision = core::Precision::Double,
            .mesh = bench::plain_sphere,
            .size = 0,
            .level = 1,
            .items = 42,
            .written = 8,
            .subjects = std::move(subjects)};
}

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoThere) {
    EXPECT_EQ(bench::median({3, 1, 2}), 2);
    EXPECT_EQ(bench::median({4, 1, 2, 9}), 3);
    EXPECT_TRUE(std::isnan(bench::median({})));
}

TEST(Measure, LetsEverySubjectBeginARound) {
    std::vector<std::string> log;
    const Case c = case_of({subject("a", log), subject("b", log), subject("c", log)});
    const auto result = bench::measure(c, kPlan, {});
    const std::vector<std::string> rounds(log.begin() + 6, log.end());
    EXPECT_EQ(rounds, (std::vector<std::string>{"a", "clear a", "b", "clear b", "c", "clear c",     // first
                                                "b", "clear b", "c", "clear c", "a", "clear a",     // second
                                                "c", "clear c", "a", "clear a", "b", "clear b"}));  // third
    EXPECT_EQ(result.rounds, 3);
    EXPECT_EQ(result.subjects.front().ratio, 1);
    for (const auto& measured : result.subjects) EXPECT_GT(measured.seconds, 0) << measured.name;
}

TEST(Measure, LeavesOutWhoDisagreesFailsOrDoesNotFit) {
    std::vector<std::string> log;
    const Case c = case_of({subject("right", log),
                            subject("wrong", log, "off by one"),
                            subject("large", log, "", kInfinity),
                            {"failing", 1, 0, [](const core::TriangleMesh&) -> core::Result<bench::Run> {
                                 return core::fail(core::ErrorCode::SubjectFailed, "It broke.");
                             }}});
    const auto subjects = bench::measure(c, kPlan, {}).subjects;
    EXPECT_TRUE(subjects[0].left_out.empty());
    EXPECT_TRUE(subjects[1].differs);
    EXPECT_EQ(subjects[1].left_out, "off by one");
    EXPECT_FALSE(subjects[2].differs || subjects[2].failed);
    EXPECT_NE(subjects[2].left_out.find("GiB"), std::string::npos);
    EXPECT_TRUE(subjects[3].failed);
    for (const auto& measured : subjects) EXPECT_EQ(measured.left_out.empty(), measured.seconds > 0);
}

TEST(Measure, ComparesWithNobodyWhereTheFirstIsLeftOut) {
    std::vector<std::string> log;
    const Case c = case_of({subject("wrong", log, "off by one"), subject("right", log)});
    const auto result = bench::measure(c, kPlan, {});
    EXPECT_TRUE(std::isnan(result.subjects[1].ratio));
    const auto json = bench::as_json(result);
    EXPECT_EQ(json["subjects"][0]["left_out"], "off by one");
    EXPECT_TRUE(json["subjects"][1]["over_ours"].is_null());
    EXPECT_NE(bench::as_text(result, "vertex").find("off by one"), std::string::npos);
}

TEST(Fresh, CountsThePeakOfMemory) {
    constexpr std::size_t kBytes = 64 << 20;
    const Subject large{
        "large", 1, 0, [](const core::TriangleMesh&) -> core::Result<bench::Run> {
            return bench::Run{[] { std::vector<char>(kBytes, 'x').front() = 'y'; }, [] {}, {}};
        }};
    const auto fresh = bench::measure_here(large, bench::plain_sphere(0)).value();
    // Needs /proc/self/clear_refs, which a container may not be allowed to write; the table then shows no
    // bytes.
    if (std::isnan(fresh.bytes)) GTEST_SKIP() << "the system does not say";
    EXPECT_GT(fresh.bytes, kBytes / 2);
    EXPECT_LT(fresh.bytes, 2 * kBytes);
}

TEST(Agreement, SeesAnotherCountADistanceAndNaN) {
    const std::vector<glm::dvec3> one{{1, 2, 3}}, two{{1, 2, 3}, {1, 2, 3}}, off{{1, 2, 3.5}},
        nan{{1, std::nan(""), 3}};
    EXPECT_EQ(bench::distances("points", one, one, 0), "");
    EXPECT_NE(bench::distances("points", one, two, 1), "");
    EXPECT_EQ(bench::distances("points", off, one, 0.5), "");
    EXPECT_NE(bench::distances("points", off, one, 0.4), "");
    EXPECT_NE(bench::distances("points", nan, one, kInfinity), "");
}

TEST(Spheres, HaveTheirFacesAndValences) {
    const core::TriangleMesh& varied = bench::varied_sphere(3);
    EXPECT_EQ(varied.face_count(), bench::sphere_faces(3));
    EXPECT_EQ(varied.vertex_count(), bench::sphere_vertices(3, 0));
    int least = 100, most = 0;
    for (core::Index v = 0; v < varied.vertex_count(); ++v) {
        least = std::min(least, varied.topology().face_count_at(v));
        most = std::max(most, varied.topology().face_count_at(v));
    }
    EXPECT_EQ(least, 3);
    EXPECT_EQ(most, 14);
}

}  // namespace
