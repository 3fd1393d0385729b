#include "compare/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/mesh/io/model.h"
#include "core/mesh/io/number.h"
#include "tests/compare/support.h"

namespace loopcheck::compare {
namespace {

using nlohmann::json;
using test::model_mesh;
using test::subject;

ModelReport warren_report(const std::string& model, int levels) {
    const auto mesh = model_mesh(model);
    core::SchemeOptions options;
    options.weights = core::Weights::Warren;
    return make_report(model, mesh,
                       Referee(mesh, options, levels).judge(subject("ours"), subject("opensubdiv"), 2));
}

json as_json(const ModelReport& report) {
    return json::parse(comparisons_as_json(std::array{report}, built_in_subjects(), 1));
}

TEST(JsonReport, SaysWhatTheComparisonSays) {
    const auto report = warren_report("icosahedron", 2);
    const json document = as_json(report);
    const json& entry = document.at("comparisons").at(0);
    EXPECT_EQ(document.at("exit_code"), 1);
    EXPECT_EQ(entry.at("verdict"), "differs");
    EXPECT_EQ(entry.at("levels").size(), 3U);
    const json& level1 = entry.at("levels").at(1);
    EXPECT_EQ(level1.at("all").at("vertices"), 42);
    EXPECT_EQ(level1.at("all").at("difference").at("identical"), 30);
    EXPECT_EQ(level1.at("all").at("beyond_bound"), 12);
    const json& worst = level1.at("worst").at(0);
    EXPECT_EQ(worst.at("class"), "interior 5");
    EXPECT_EQ(worst.at("error").get<double>(), report.comparison.levels[1].worst[0].error);
    // Decimal and hexfloat are the same double.
    EXPECT_EQ(std::stod(worst.at("subject").at("hex").at(1).get<std::string>()),
              worst.at("subject").at("decimal").at(1).get<double>());
}

TEST(JsonReport, WritesNotANumberAsNullAndCountsIt) {
    const auto mesh = model_mesh("icosahedron");
    const auto spoiled =
        test::cheat("spoiled", [](core::Refinement& r) { r.levels[1].positions[7].y = NAN; });
    const json document =
        as_json(make_report("x", mesh, Referee(mesh, {}, 1).judge(spoiled, subject("opensubdiv"), 1)));
    const json& level1 = document.at("comparisons").at(0).at("levels").at(1);
    EXPECT_EQ(level1.at("all").at("difference").at("not_finite"), 1);
    EXPECT_TRUE(level1.at("worst").at(0).at("error").is_null());
}

TEST(JsonReport, SurvivesAnyFileName) {
    auto report = warren_report("tetrahedron", 1);
    report.model = "<script>\"\xff\n.obj";
    EXPECT_NE(as_json(report).at("comparisons").at(0).at("model").get<std::string>().find("<script>\""),
              std::string::npos);
}

TEST(TextReport, ShowsTheVerdictTheClassesAndTheWorstVertexInHexfloat) {
    const auto report = warren_report("icosahedron", 2);
    const auto text = comparison_as_text(report, built_in_subjects());
    for (const char* part :
         {"verdict: differs", "class at level 1", "interior 5", "worst", "0x1.", "opensubdiv 3."})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(JsonReport, SaysWhatWasPredictedOfLimitsAndWhatWasSeen) {
    const auto mesh = model_mesh("dart-valence-06");
    Referee referee(mesh, {}, 1);
    const json entry = as_json(make_report("x", mesh, referee.judge(subject("ours"), subject("opensubdiv")),
                                           referee.judge_limits(subject("ours"), subject("opensubdiv"), 1)))
                           .at("comparisons")
                           .at(0)
                           .at("limits");
    EXPECT_EQ(entry.at("verdict"), "known deviation");
    const json& seen = entry.at("deviations").at(0);
    EXPECT_EQ(seen.at("name"), "limit-dart");
    EXPECT_EQ(seen.at("kind"), "error");
    EXPECT_EQ(seen.at("vertices"), 4);
    EXPECT_NEAR(seen.at("position").at("predicted"), seen.at("position").at("observed"), 1e-14);
    EXPECT_GT(seen.at("normal").at("observed"), 10) << "degrees";
    EXPECT_EQ(entry.at("levels").at(0).at("all").at("as_deviation"), 2);
    EXPECT_EQ(entry.at("levels").at(0).at("worst").at(0).at("deviation"), "limit-dart");
}

TEST(CsvReport, HasOneLineAVertexAndTheSameDoubles) {
    const auto mesh = model_mesh("fan-3");
    CsvReport csv;
    std::vector<VertexRecord> records;
    const auto comparison =
        Referee(mesh, {}, 2)
            .judge(subject("ours"), subject("opensubdiv"), 0, [&](const VertexRecord& record) {
                records.push_back(record);
                csv.add("a,\"b\".obj", record, 1e-16);
            });
    std::istringstream lines(csv.text());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 15);
    std::size_t count = 0;
    for (; std::getline(lines, line); ++count) {
        EXPECT_EQ(line.rfind("\"a,\"\"b\"\".obj\",", 0), 0U) << line;
        const auto& record = records[count];
        EXPECT_NE(line.find("," + core::shortest(record.subject.x) + ","), std::string::npos) << line;
    }
    EXPECT_EQ(count, records.size());
    EXPECT_EQ(count, total(comparison.levels[0]).difference.count +
                         total(comparison.levels[1]).difference.count +
                         total(comparison.levels[2]).difference.count);
}

TEST(PlyReport, IsAMeshWithTheErrorAtEveryVertex) {
    const auto mesh = model_mesh("icosahedron");
    core::SchemeOptions options;
    options.weights = core::Weights::Warren;
    PlyReport ply(1, 42);
    std::vector<VertexRecord> level1;
    Referee(mesh, options, 1)
        .judge(subject("ours"), subject("opensubdiv"), 0, [&](const VertexRecord& record) {
            ply.add(record);
            if (record.level == 1) level1.push_back(record);
        });
    const auto made = subject("ours").refine(mesh, options, 1);
    const auto text = ply.text(made->levels[1].triangles, "x");
    const auto read = core::parse_model(core::FileFormat::Ply, text);
    ASSERT_TRUE(read) << core::to_string(read.error());
    EXPECT_EQ(read->data.positions, made->levels[1].positions);
    EXPECT_EQ(read->data.face_sizes.size(), 80U);
    EXPECT_NE(text.find("property double quality"), std::string::npos);
    for (const auto& record : level1)
        EXPECT_NE(text.find(" " + core::shortest(record.error) + "\n"), std::string::npos);
}

TEST(JunitReport, EscapesNamesAndCountsOutcomes) {
    SuiteResult suite;
    suite.models = 1;
    Comparison differs;
    differs.verdict = Verdict::Differs;
    differs.notes = {"a < b & \"c\""};
    Comparison skipped;
    skipped.verdict = Verdict::NotSupported;
    suite.rows = {{"<script>.obj", differs, {}}, {"<script>.obj", skipped, {}}};
    suite.unreadable = {{"bad.obj", {core::ErrorCode::BadSyntax, "No.", {}}}};
    const auto xml = suite_as_junit(suite);
    EXPECT_EQ(xml.find("<script>"), std::string::npos) << xml;
    EXPECT_NE(xml.find("&lt;script&gt;.obj"), std::string::npos) << xml;
    suite.rows[0].model = "\xff.obj";
    EXPECT_NE(suite_as_junit(suite).find("\xef\xbf\xbd.obj"), std::string::npos) << "not UTF-8";
    EXPECT_NE(xml.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos) << xml;
    EXPECT_NE(xml.find("tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"1\""), std::string::npos) << xml;
}

TEST(ErrorStats, AgreeWithTheirDefinitions) {
    ErrorStats stats;
    for (const double e : {0.0, 3.0, 4.0}) stats.add(e, e == 0);
    EXPECT_EQ(stats.count, 3U);
    EXPECT_EQ(stats.identical, 1U);
    EXPECT_EQ(stats.max, 4);
    EXPECT_DOUBLE_EQ(stats.mean(), 7.0 / 3);
    EXPECT_DOUBLE_EQ(stats.rms(), 5 / std::sqrt(3.0));
    ErrorStats tiny;  // squares of these underflow
    tiny.add(3e-200, false);
    tiny.add(4e-200, false);
    EXPECT_NEAR(tiny.rms() / (5e-200 / std::sqrt(2.0)), 1, 1e-15);
    stats.add(std::numeric_limits<double>::quiet_NaN(), false);
    EXPECT_EQ(stats.not_finite, 1U);
    EXPECT_EQ(stats.max, 4);
}

}  // namespace
}  // namespace loopcheck::compare
