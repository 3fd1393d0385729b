// Curves on the command line: against their limit, 38 digits, and the meshes that carry them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "compare/curve/curve_comparison.h"
#include "compare/curve/lab_report.h"
#include "compare/report/curve.h"
#include "core/bspline/points_file.h"
#include "core/mesh/io/atomic_file.h"
#include "core/mesh/rounding.h"
#include "tests/compare/support.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using core::CurveShape;
using core::Ends;
using test::Outcome;
using tests::contains;

constexpr double kPlenty = 1e11;  // bytes

std::string curve_path(const std::string& name) {
    return LOOPCHECK_MODELS_DIR "/curves/" + name + ".txt";
}

core::Curve<glm::dvec3> curve_of(const std::string& path, const CurveShape& shape) {
    return core::Curve<glm::dvec3>::make(core::read_points(path).value().points, shape).value();
}

void quietly(const std::string&) {}

Outcome loopcheck_curve(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "curve");
    return test::loopcheck(arguments);
}

// ---- every curve of models/curves

// Coordinates and lengths of two distances that are exact before, and their quotient.
constexpr double kFactorRounding =
    4 * core::rounding_of(2 * (1 + core::kNormRoundings) + 1, core::Precision::Double);

class EveryCurve : public testing::TestWithParam<std::string> {};

TEST_P(EveryCurve, IsWhatItsLimitAndItsBoundsSayWithEveryEnd) {
    const auto points = core::read_points(GetParam()).value().points;
    for (int degree = 1; degree <= 5; ++degree)
        for (const Ends ends : {Ends::Natural, Ends::Closed, Ends::Open, Ends::Clamped}) {
            const CurveShape shape{degree, ends};
            if (core::check_shape(shape, points.size())) continue;
            const auto c = compare_curve(core::Curve<glm::dvec3>::make(points, shape).value(),
                                         tests::levels_up_to(4), quietly);
            EXPECT_EQ(c.own, Verdict::WithinRounding)
                << degree << " " << core::name(ends) << ": " << testing::PrintToString(c.notes);
            for (std::size_t l = 1; l < c.polygons.size() && degree == 3 && ends != Ends::Clamped; ++l) {
                const double before = c.polygons[l - 1].distance, now = c.polygons[l].distance;
                if (ends != Ends::Open && now > 0) {
                    EXPECT_NEAR(before / now, 4, kFactorRounding) << core::name(ends);
                }
            }
        }
}

TEST_P(EveryCurve, HasTheBitsOfOpenSubdivInFloatAndDouble) {
    const auto points = core::read_points(GetParam()).value().points;
    for (const Ends ends : {Ends::Natural, Ends::Closed}) {
        if (core::check_shape({3, ends}, points.size())) continue;
        const auto curve = core::Curve<glm::dvec3>::make(points, {3, ends}).value();
        for (const char* name : {"opensubdiv", "opensubdiv-float"}) {
            const auto all =
                compare_carried(curve, tests::levels_up_to(5), test::subject(name), kPlenty, quietly);
            EXPECT_EQ(all.size(), 2U);
            for (const CarriedComparison& c : all) {
                EXPECT_EQ(c.verdict, Verdict::Identical)
                    << name << ", " << compare::name(c.carrier) << c.note;
                EXPECT_EQ(c.levels.size(), static_cast<std::size_t>(tests::levels_up_to(5)) + 1);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, EveryCurve,
                         testing::ValuesIn(tests::files_in(LOOPCHECK_MODELS_DIR "/curves", {".txt"})),
                         tests::model_test_name);

TEST(CarriedCurve, HasTheBitsOfOpenSubdivToLevel8) {
    for (const auto& [name, ends] : {std::pair{"lab", Ends::Natural}, {"ring", Ends::Closed}})
        for (const char* precision : {"opensubdiv", "opensubdiv-float"})
            for (const auto& c :
                 compare_carried(curve_of(curve_path(name), {3, ends}), tests::levels_up_to(8),
                                 test::subject(precision), kPlenty, quietly)) {
                EXPECT_EQ(c.verdict, Verdict::Identical) << name << c.note;
                EXPECT_EQ(c.levels.back().difference.identical, c.levels.back().difference.count);
            }
}

// Two implementations of ours that share no line: rows of masks over a mesh, and the rules of a curve.
TEST(CarriedCurve, HasTheBitsOfOurOwnBoundariesAndCreases) {
    for (const Ends ends : {Ends::Natural, Ends::Closed})
        for (const char* name : {"ours", "ours-float"})
            for (const auto& c : compare_carried(curve_of(curve_path("wandering"), {3, ends}), 4,
                                                 test::subject(name), kPlenty, quietly))
                EXPECT_EQ(c.verdict, Verdict::Identical) << c.note;
}

// ---- the referee is cheated

CarriedComparison carried(const Subject& subject, CarrierKind kind = CarrierKind::Rim) {
    const Ends ends = kind == CarrierKind::Rim || kind == CarrierKind::Crease ? Ends::Closed : Ends::Natural;
    for (auto& c : compare_carried(curve_of(curve_path("helix"), {3, ends}), 3, subject, kPlenty, quietly))
        if (c.carrier == kind) return c;
    return {};
}

TEST(CarriedCurve, SeesAPointThatIsOff) {
    const auto c = carried(test::cheat(
        "a point moved", [](core::Refinement& r) { r.levels[1].positions[0] += glm::dvec3(1e-12, 0, 0); }));
    EXPECT_EQ(c.verdict, Verdict::Differs);
    EXPECT_GT(c.levels[1].bound_use, 1);
    EXPECT_EQ(c.levels[0].difference.identical, c.levels[0].difference.count);
}

TEST(CarriedCurve, SeesOneBitWithinRounding) {
    const auto c = carried(test::cheat("one bit", [](core::Refinement& r) {
        r.levels[2].positions[0].x = test::ulps_off(r.levels[2].positions[0].x, 1);
    }));
    EXPECT_EQ(c.verdict, Verdict::WithinRounding);
    EXPECT_EQ(c.levels[2].difference.identical + 1, c.levels[2].difference.count);
}

TEST(CarriedCurve, SeesNaN) {
    const auto c = carried(test::cheat("nan", [](core::Refinement& r) {
        r.levels[3].positions[5].y = std::numeric_limits<double>::quiet_NaN();
    }));
    EXPECT_EQ(c.verdict, Verdict::Differs);
}

TEST(CarriedCurve, SeesALevelThatIsMissing) {
    const auto c = carried(test::cheat("no last level", [](core::Refinement& r) { r.levels.pop_back(); }));
    EXPECT_EQ(c.verdict, Verdict::Failed);
}

TEST(CarriedCurve, SeesAncestryThatLeadsNowhere) {
    const auto c = carried(test::cheat(
        "wrong ancestor", [](core::Refinement& r) { r.levels[1].ancestors[0] = r.levels[1].ancestors[1]; }));
    EXPECT_EQ(c.verdict, Verdict::Failed);
    EXPECT_TRUE(contains(c.note, "ancestry")) << c.note;
}

TEST(CarriedCurve, PairsByAncestryAndNotByIndex) {
    const auto c = carried(test::cheat("swapped vertices", [](core::Refinement& r) {
        core::RefinedLevel& last = r.levels.back();
        std::swap(last.positions[3], last.positions[40]);
        std::swap(last.ancestors[3], last.ancestors[40]);
        for (core::Triangle& t : last.triangles)
            for (core::Index& v : t) v = v == 3 ? 40 : v == 40 ? 3 : v;
    }));
    EXPECT_EQ(c.verdict, Verdict::Identical) << c.note;
}

TEST(CarriedCurve, NeedsCornersAtOpenEnds) {
    Subject without = test::subject("ours");
    without.refine = [](const core::TriangleMesh& mesh, core::SchemeOptions options, int levels) {
        options.boundary = core::BoundaryRule::EdgeOnly;  // ends of one face are no corners now
        return core::refine<double>(mesh, options, levels);
    };
    EXPECT_EQ(carried(without, CarrierKind::StripOneFace).verdict, Verdict::Differs);
    EXPECT_EQ(carried(without, CarrierKind::StripWithCorners).verdict, Verdict::Identical);
}

TEST(CarriedCurve, SaysWhatNoMeshCanCarry) {
    const auto c = compare_carried(curve_of(curve_path("lab"), {3, Ends::Clamped}), 2,
                                   test::subject("opensubdiv"), kPlenty, quietly);
    ASSERT_EQ(c.size(), 1U);
    EXPECT_EQ(c[0].verdict, Verdict::NotSupported);
}

TEST(CarriedCurve, IsRefusedWhereMemoryIsShort) {
    const auto c = compare_carried(curve_of(curve_path("lab"), {3, Ends::Natural}), 5,
                                   test::subject("opensubdiv"), 1e5, quietly);
    EXPECT_EQ(c.at(0).verdict, Verdict::Failed);
    EXPECT_TRUE(contains(c.at(0).note, "out-of-memory")) << c[0].note;
}

// ---- the referee of our own curve

TEST(CompareCurve, AgreesWhereCoordinatesAreSubnormal) {
    for (const double scale : {0x1p-1022, 0x1p-1030, 0x1p-1060, 0x1p-1072})
        for (int degree = 1; degree <= 8; ++degree)
            for (const Ends ends : {Ends::Natural, Ends::Closed, Ends::Open, Ends::Clamped}) {
                std::vector<glm::dvec3> points;
                for (int i = 0; i < 12; ++i)
                    points.push_back({scale * std::cos(1.7 * i), scale * std::sin(2.3 * i), scale * i});
                if (core::check_shape({degree, ends}, points.size())) continue;
                const auto curve = core::Curve<glm::dvec3>::make(points, {degree, ends}).value();
                const auto c = compare_curve(curve, 3, quietly);
                EXPECT_EQ(c.own, Verdict::WithinRounding)
                    << scale << degree << core::name(ends) << ": " << testing::PrintToString(c.notes);
            }
}

// ---- the lab report

TEST(LabReport, CountsWhatTheReportCounted) {
    const auto counts = lab_counts();
    ASSERT_EQ(counts.size(), 3U);
    const std::int64_t expected[][3]{{500, 4000, 1999}, {500, 4000, 1995}, {501, 4008, 2003}};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        EXPECT_EQ(counts[i].samples, expected[i][0]) << counts[i].stepping;
        EXPECT_EQ(counts[i].all_points, expected[i][1]) << counts[i].stepping;
        EXPECT_EQ(counts[i].local, expected[i][2]) << counts[i].stepping;
        EXPECT_TRUE(counts[i].same_points) << counts[i].stepping;
    }
}

// Off from the limit at t = 0, where the basis functions are 4/6 and 1/6: exactly |c_1 - c_0| times 1 less
// 5/6 and so on, or at the other end where the last side of the polygon is longer.
TEST(LabReport, EndsAreOffByWhatTheBasisSays) {
    const auto ends = lab_ends();
    ASSERT_EQ(ends.size(), 4U);
    const auto c = lab_points();
    const double last_side = core::norm(c[7] - c[6]);
    const double phantom = core::norm(2.0 * c[0] - c[1]) / 6;
    // A difference of two evaluations, of coordinates below 6/5, over the sum of the basis where that is done
    // (5/6 or more): 2 sqrt(3) (6/5) < 5.
    const double rounding =
        5 * core::rounding_of(core::evaluation_roundings(3) + 12, core::Precision::Double);
    EXPECT_LE(ends[0].at_ends, rounding);
    EXPECT_NEAR(ends[1].at_ends, std::max(phantom, core::norm(2.0 * c[7] - c[6]) / 6), rounding);
    EXPECT_NEAR(ends[2].at_ends, last_side / 5, rounding);
    EXPECT_NEAR(ends[3].at_ends, last_side / 6, rounding);
    for (const LabEnd& end : ends) EXPECT_LE(end.inside, rounding) << end.treatment;
}

TEST(LabReport, HasEverySectionByName) {
    const std::string all = lab_report_as_text("");
    for (const std::string_view section : lab_report_sections()) {
        const std::string text = lab_report_as_text(section);
        EXPECT_FALSE(text.empty());
        EXPECT_TRUE(contains(all, text)) << section;
        EXPECT_EQ(loopcheck_curve({"--lab-report", "--section", std::string(section)}).out, text);
    }
    EXPECT_TRUE(contains(lab_report_as_text("basis"), "0.229167"));
    EXPECT_TRUE(contains(lab_report_as_text("orders"), "0.75"));
}

// ---- the command

TEST(CurveCommand, RefusesEveryBadFileWithItsCodeAndLine) {
    const auto files = tests::files_in(LOOPCHECK_MODELS_DIR "/reject", {".txt"});
    EXPECT_GE(files.size(), 10U);
    for (const std::string& file : files) {
        const auto bytes = core::read_file(file).value();
        const std::string code = bytes.substr(10, bytes.find(':', 10) - 10);  // "# reject: code: why"
        const Outcome r = loopcheck_curve({file});
        EXPECT_EQ(r.code, 2) << file;
        EXPECT_EQ(r.out, "") << file;
        EXPECT_TRUE(contains(r.err, "[" + code + "]")) << r.err;
        EXPECT_EQ(contains(r.err, ": line "), code != "too-few-points") << r.err;
    }
}

TEST(CurveCommand, ExitsWithTwoOnBadUsage) {
    const std::string lab = curve_path("lab");
    const std::vector<std::vector<std::string>> bad{
        {},
        {"/no/such/file.txt"},
        {lab, "--degree", "0"},
        {lab, "--degree", "21"},
        {lab, "--degree", "2"},
        {lab, "--ends", "loose"},
        {lab, "--ends", "open", "--closed"},
        {lab, "--levels", "-1"},
        {lab, "--levels", "30"},
        {lab, "--levels", "0", "--memory", "1e-5", "--matrix", "/dev/null"},
        {lab, "--tolerance", "0"},
        {lab, "--tolerance", "nan"},
        {lab, "--magnify", "5"},
        {lab, "--compare", "nobody"},
        {lab, "--csv", lab},
        {lab, "--svg", "/no/such/folder/x.svg"},
        {"--section", "ends"},
        {"--lab-report", "--section", "eq99"}};
    for (const auto& arguments : bad) {
        const Outcome r = loopcheck_curve(arguments);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(arguments);
        EXPECT_NE(r.err, "") << testing::PrintToString(arguments);
    }
}

TEST(CurveCommand, ExitsWithThreeWhereThePeerCannotDoIt) {
    const Outcome r =
        loopcheck_curve({curve_path("lab"), "--ends", "clamped", "--levels", "2", "--compare", "opensubdiv"});
    EXPECT_EQ(r.code, 3);
    EXPECT_TRUE(contains(r.out, "verdict: not supported")) << r.out;
}

TEST(CurveCommand, WritesWhatItSays) {
    const tests::TemporaryFolder folder;
    const std::string csv = folder / "c.csv", json = folder / "c.json", svg = folder / "c.svg",
                      matrix = folder / "c.mtx";
    const Outcome r = loopcheck_curve({curve_path("lab"), "--levels", "3", "--compare", "opensubdiv",
                                       "--tolerance", "0.001", "--csv", csv, "--json", json, "--svg", svg,
                                       "--magnify", "20", "--matrix", matrix});
    ASSERT_EQ(r.code, 0) << r.err << r.out;
    EXPECT_EQ(r.err, "");

    const auto report = nlohmann::json::parse(core::read_file(json).value());
    EXPECT_EQ(report["command"], "curve");
    EXPECT_EQ(report["exit_code"], 0);
    const auto& curve = report["curve"];
    EXPECT_EQ(curve["points"], 8);
    EXPECT_EQ(curve["dimension"], 2);
    ASSERT_EQ(curve["levels"].size(), 4U);
    EXPECT_EQ(curve["levels"][3]["points"], 57);
    EXPECT_NEAR(curve["levels"][3]["distance"].get<double>(), std::sqrt(2.0) / 6 / 64, 1e-15);
    EXPECT_EQ(curve["carried"].size(), 4U);
    EXPECT_EQ(curve["tolerance"]["level"], 4);
    EXPECT_EQ(curve["tolerance"]["level_points"], 113);

    std::istringstream lines(core::read_file(csv).value());
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "level,index,t,x,y,z,curve_x,curve_y,curve_z,distance");
    int count = 0;
    while (std::getline(lines, line)) {
        ++count;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 9) << line;
    }
    EXPECT_EQ(count, 8 + 15 + 29 + 57);

    EXPECT_TRUE(contains(core::read_file(svg).value(), "level 3, distance from the curve x 20"));
    EXPECT_TRUE(contains(core::read_file(matrix).value(), "\n15 8 "));
}

TEST(CurveCommand, KnowsTheLevelWhereThePointsAreTooMany) {
    const Outcome r = loopcheck_curve({curve_path("lab"), "--levels", "1", "--tolerance", "1e-18"});
    EXPECT_EQ(r.code, 0);
    // 4^-k sqrt(2)/6 <= 1e-18 from k = 29 on; 7 intervals.
    EXPECT_TRUE(contains(r.out, "level 29 (3758096385 points)")) << r.out;
    EXPECT_TRUE(contains(r.out, "more than a million points")) << r.out;
}

TEST(CurveCommand, TakesOpenMeshWhereItHasTheRule) {
    if (find_subject(built_in_subjects(), "openmesh") == nullptr) return;  // built without it
    const Outcome r =
        loopcheck_curve({curve_path("ring"), "--closed", "--levels", "3", "--compare", "openmesh"});
    EXPECT_TRUE(contains(r.out, "within rounding")) << r.out;
    EXPECT_TRUE(contains(r.out, "not supported")) << "it has no creases\n" << r.out;
}

// A zigzag of so many points that flattening is refused: its quintic keeps to the middle, its polygon does
// not.
TEST(CurveReport, DrawsTheCurveAndNotThePolygonWhereItTakesTooManyPoints) {
    std::vector<glm::dvec3> zigzag;
    for (int i = 0; i < 100'001; ++i) zigzag.push_back({i, i % 2 == 0 ? 1e5 : -1e5, 0});
    CurveReport report{"zigzag", 2, core::Curve<glm::dvec3>::make(zigzag, {5, Ends::Open}).value(), {}, {}};
    report.comparison.levels = core::curve_levels(report.curve, 0);
    const std::string svg = curve_as_svg(report, 1);
    const std::size_t polygon = svg.find("<path"), begin = svg.find("<path", polygon + 1);
    std::istringstream path(svg.substr(begin + 10, svg.find('"', begin + 10) - begin - 10));
    // The page is 820 high, and half as wide.
    double x = 0, y = 0, low = 1e9, high = -1e9;
    for (std::string mark; path >> mark >> y;) {
        x = std::stod(mark.substr(1));
        low = std::min(low, y);
        high = std::max(high, y);
    }
    EXPECT_GT(x, 400);
    // At whole parameters the quintic is (66 - 2 x 26 + 2 x 1)/120 = 16/120 of the zigzag.
    EXPECT_NEAR(high - low, 820 * 16.0 / 120, 0.01);
}

TEST(CurveCommand, DrawsWhatIsFlatOrOnePlace) {
    const tests::TemporaryFolder folder;
    for (const char* name : {"one-place", "straight-even", "two-points"})
        for (const char* degree : {"1", "3", "5"}) {
            const std::string svg = folder / "x.svg";
            EXPECT_EQ(
                loopcheck_curve({curve_path(name), "--degree", degree, "--levels", "2", "--svg", svg}).code,
                0);
            const std::string text = core::read_file(svg).value();
            EXPECT_FALSE(contains(text, "nan") || contains(text, "inf")) << name << degree << text;
        }
}

}  // namespace
}  // namespace loopcheck::compare
