// The limit surface of OpenSubdiv on models: right as predicted, and every cheat is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "compare/report/surface.h"
#include "tests/compare/support.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/observed.h"

namespace loopcheck::compare {
namespace {

using core::SurfaceRows;
using Rows = std::vector<std::optional<SurfaceRows>>;

SurfaceReport report_of(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                        std::string_view way, const SurfaceEvaluator& evaluate, int samples = 24) {
    SurfaceReport out{"model", 0, 0, {}};
    SurfaceCheck check{*find_way(way)};
    check.samples = samples;
    LocalErrors local(std::array{check.way}, evaluate);
    out.comparisons = compare_surfaces_with_rates(mesh, options, std::array{check}, evaluate, local);
    return out;
}

// OpenSubdiv on a whole run, with its rows changed afterwards where there is only one mesh: the local meshes
// of the atlas are left alone, as those of a subject that has always been as it is.
SurfaceEvaluator cheat(const core::TriangleMesh& mesh, std::function<void(Rows&)> spoil) {
    return [&mesh, spoil = std::move(spoil)](
               const core::TriangleMesh& asked, const core::SchemeOptions& options,
               const reference::SurfaceSettings& settings, std::span<const core::SurfaceLocation> locations) {
        auto rows = reference::opensubdiv_surface(asked, options, settings, locations);
        if (&asked == &mesh && rows) spoil(*rows);
        return rows;
    };
}

Verdict verdict_of_cheat(const std::string& model, std::function<void(Rows&)> spoil) {
    const core::TriangleMesh mesh = test::model_mesh(model);
    const auto report = report_of(mesh, {}, "bfr", cheat(mesh, std::move(spoil)));
    const Verdict verdict = report.comparisons[0].verdict;
    EXPECT_EQ(report.exit_code(), exit_code(verdict));
    return verdict;
}

TEST(SurfaceComparison, SeesOneWeightThatIsOffOnARegularFace) {
    EXPECT_EQ(verdict_of_cheat("torus", [](Rows&) {}), Verdict::WithinRounding);
    EXPECT_EQ(verdict_of_cheat("torus", [](Rows& rows) { rows[3]->weights[0][2] += 1e-9; }),
              Verdict::Differs);
    EXPECT_EQ(verdict_of_cheat("torus", [](Rows& rows) { rows[3]->weights[1][2] += 1e-9; }),
              Verdict::Differs);
}

TEST(SurfaceComparison, SeesNotANumber) {
    EXPECT_EQ(verdict_of_cheat("torus", [](Rows& rows) { rows[0]->weights[0][0] = std::nan(""); }),
              Verdict::Differs);
    EXPECT_EQ(verdict_of_cheat("icosahedron", [](Rows& rows) { rows.back()->weights[0][0] = std::nan(""); }),
              Verdict::Differs);
}

TEST(SurfaceComparison, SeesAMissingSurface) {
    EXPECT_EQ(verdict_of_cheat("torus", [](Rows& rows) { rows[0].reset(); }), Verdict::Differs);
}

TEST(SurfaceComparison, SeesAnErrorLargerThanPredicted) {
    // Twice what OpenSubdiv is off by anyway, at most: a tenth of the mesh is not.
    EXPECT_EQ(verdict_of_cheat("icosahedron",
                               [](Rows& rows) {
                                   for (auto& row : rows) row->weights[0][0] += 0.1;
                               }),
              Verdict::Differs);
}

TEST(SurfaceComparison, SaysWhereADeviationIsMended) {
    // The sign turned back wherever it can be: exact second derivatives on the triangles that are regular.
    const core::TriangleMesh mesh = test::model_mesh("icosahedron");
    core::LimitSurface<double> exact(mesh, {});
    const SurfaceEvaluator mended = [&](const core::TriangleMesh& asked, const core::SchemeOptions& options,
                                        const reference::SurfaceSettings& settings,
                                        std::span<const core::SurfaceLocation> locations) {
        auto rows = reference::opensubdiv_surface(asked, options, settings, locations);
        if (&asked != &mesh) return rows;
        for (std::size_t i = 0; i < locations.size(); ++i) {
            const auto at = exact.stencil(locations[i].face, locations[i].u, locations[i].v);
            SurfaceRows truth = core::as_rows(*at);
            if (at->smoothness == core::Smoothness::Regular && truth.columns == (*rows)[i]->columns)
                for (int d = 3; d <= 5; ++d) (*rows)[i]->weights[d] = truth.weights[d];
        }
        return rows;
    };
    const auto report = report_of(mesh, {}, "bfr", mended);
    EXPECT_EQ(report.comparisons[0].verdict, Verdict::Differs);
    EXPECT_EQ(report.exit_code(), 1);
    std::string notes;
    for (const auto& note : report.comparisons[0].notes) notes += note + "\n";
    EXPECT_NE(notes.find("second-derivative-sign must show"), std::string::npos) << notes;
}

TEST(SurfaceComparison, FindsTheSignWhereItIsPredictedAndNowhereElse) {
    const core::TriangleMesh mesh = test::model_mesh("icosahedron");
    const auto report = report_of(mesh, {}, "bfr", reference::opensubdiv_surface);
    const auto& seen =
        report.comparisons[0].deviations[static_cast<int>(SurfaceDeviationId::SecondDerivativeSign)];
    EXPECT_GT(seen.expected, 0U);
    EXPECT_EQ(seen.shown, seen.expected);
    EXPECT_EQ(report.comparisons[0].verdict, Verdict::KnownDeviation);
    EXPECT_EQ(report.exit_code(), 0);
}

TEST(SurfaceComparison, RefusesAValenceThatTakesTooLong) {
    const auto report =
        report_of(tests::mesh_of(tests::bipyramid(800)), {}, "bfr", reference::opensubdiv_surface);
    EXPECT_EQ(report.comparisons[0].verdict, Verdict::NotSupported);
    EXPECT_NE(report.comparisons[0].notes.at(0).find("Too many edges"), std::string::npos);
    EXPECT_EQ(report.exit_code(), 3);
}

// Every way; in a short run Bfr's and the one with most deviations.
std::vector<SurfaceWay> ways_to_test() {
    if (tests::is_short_run()) return {*find_way("bfr"), *find_way("patch-default")};
    return {surface_ways().begin(), surface_ways().end()};
}

std::vector<SurfaceCheck> checks_of_every_way() {
    std::vector<SurfaceCheck> out;
    for (const SurfaceWay& way : ways_to_test()) {
        out.push_back({way});
        out.back().samples = tests::is_short_run() ? kLeastSamples : 8;
    }
    return out;
}

class LimitEveryModel : public testing::TestWithParam<std::string> {};

TEST_P(LimitEveryModel, IsAsPredictedByEveryWay) {
    static LocalErrors local(surface_ways(), reference::opensubdiv_surface);  // those of all models
    const auto model = tests::load_model(GetParam());
    SurfaceReport report{model.name, 0, 0, {}};
    report.comparisons = compare_surfaces_with_rates(model.mesh, model.options, checks_of_every_way(),
                                                     reference::opensubdiv_surface, local);
    for (const SurfaceComparison& c : report.comparisons) {
        EXPECT_FALSE(c.notes.empty());
        if (c.verdict == Verdict::NotSupported) continue;
        EXPECT_EQ(exit_code(c.verdict), 0) << surface_as_text(report, "");
        tests::Observed use(model.name + " " + std::string(c.check.way.name) + ": error over bound", "class",
                            1);
        for (const auto& [face_class, stats] : c.classes) use.add(stats.bound_use, face_class.corner.faces);
        use.check();
    }
}

INSTANTIATE_TEST_SUITE_P(Models, LimitEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(SurfaceComparison, FailsWhereWhatShowsIsNotOnTheList) {
    const core::TriangleMesh mesh = test::model_mesh("icosahedron");
    SurfaceComparison c = report_of(mesh, {}, "bfr", reference::opensubdiv_surface).comparisons[0];
    ASSERT_EQ(c.verdict, Verdict::KnownDeviation);
    for (const auto id : {SurfaceDeviationId::Approximation, SurfaceDeviationId::SecondDerivativeSign}) {
        std::vector<KnownDeviation> shorter;
        for (const KnownDeviation& deviation : known_deviations())
            if (deviation.name != name(id)) shorter.push_back(deviation);
        ASSERT_EQ(shorter.size() + 1, known_deviations().size());
        c.notes.clear();
        give_verdict(c, shorter);
        EXPECT_EQ(c.verdict, Verdict::Differs) << name(id);
        const bool said = std::any_of(c.notes.begin(), c.notes.end(), [](const std::string& note) {
            return note.find("not on the list") != std::string::npos;
        });
        EXPECT_TRUE(said) << c.notes[0];
    }
}

// A double cone or a fan with random sharpness on its edges and, at times, a vertex.
core::MeshData random_sharp_mesh(std::minstd_rand& random) {
    const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    const auto sharpness = [&] {
        constexpr std::array kSpecial{10.F, 1.F, 2.F, 0.5F, 1.2F, 0.001F, 9.999F};
        return pick(2) == 0 ? kSpecial[static_cast<std::size_t>(pick(kSpecial.size()))]
                            : static_cast<float>(pick(4000)) / 1000;
    };
    const int n = 3 + pick(6);
    core::MeshData data = pick(2) == 0 ? tests::bipyramid(n) : tests::open_fan(n);
    const core::TriangleMesh mesh = tests::mesh_of(data);
    const int share = 1 + pick(4);  // of 4
    for (const auto& [a, b] : mesh.topology().edge_ends)
        if (pick(4) < share) data.creases.push_back({a, b, sharpness()});
    if (pick(3) == 0) data.corners.push_back({static_cast<core::Index>(pick(n)), sharpness()});
    return data;
}

class LimitOfRandomSharpness : public testing::TestWithParam<int> {};

TEST_P(LimitOfRandomSharpness, IsAsPredictedByEveryWay) {
    std::minstd_rand random(static_cast<unsigned>(GetParam()));
    const int meshes = tests::is_short_run() ? 4 : 12;
    for (int i = 0; i < meshes; ++i) {
        const core::TriangleMesh mesh = tests::mesh_of(random_sharp_mesh(random));
        core::SchemeOptions options;
        options.creasing = i % 2 == 0 ? core::Creasing::Uniform : core::Creasing::Chaikin;
        for (const SurfaceWay& way : ways_to_test()) {
            const SurfaceReport report =
                report_of(mesh, options, way.name, reference::opensubdiv_surface, 16);
            const SurfaceComparison& c = report.comparisons[0];
            EXPECT_LE(exit_code(c.verdict), 0) << way.name << ", mesh " << i << ": " << c.notes[0];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, LimitOfRandomSharpness, testing::Range(1, 5));

// The box-spline end cap is not translation invariant, and no verdict may depend on that.
TEST(SurfaceComparison, GivesTheSameVerdictFarFromTheOrigin) {
    for (const std::string model : {"semi-sharp-edge-2.5", "icosahedron", "cow-creased"}) {
        auto read = core::read_model(test::model_path(model));
        for (auto& p : read->data.positions) p += glm::dvec3(1000, -500, 250);
        const core::TriangleMesh moved = tests::mesh_of(std::move(read->data));
        for (const SurfaceWay& way : ways_to_test())
            EXPECT_EQ(report_of(moved, {}, way.name, reference::opensubdiv_surface, 8).exit_code(), 0)
                << model << " " << way.name;
    }
}

TEST(LimitCommand, ExitsWithTwoOnBadUsage) {
    const std::string model = test::model_path("icosahedron");
    const std::vector<std::vector<std::string>> bad{{"limit"},
                                                    {"limit", "/no/such/file.obj"},
                                                    {"limit", model, "--method", "nurbs"},
                                                    {"limit", model, "--samples", "0"},
                                                    {"limit", model, "--approx-smooth", "0"},
                                                    {"limit", model, "--approx-sharp", "11"},
                                                    {"limit", model, "--approx-smooth", "7"},
                                                    {"atlas", "--levels", "0"},
                                                    {"atlas", "--levels", "2,x"},
                                                    {"atlas", "--method", "nurbs"}};
    for (const auto& arguments : bad) {
        const auto r = test::loopcheck(arguments);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(arguments);
        EXPECT_NE(r.err, "") << testing::PrintToString(arguments);
    }
}

TEST(LimitCommand, ExitsWithThreeWhereNothingCanBeCompared) {
    const auto r = test::loopcheck({"limit", test::model_path("boundary-none"), "--method", "bfr"});
    EXPECT_EQ(r.code, 3);
    EXPECT_NE(r.out.find("with the boundary option none there is no surface there"), std::string::npos)
        << r.out;
    EXPECT_EQ(test::loopcheck({"limit", test::model_path("icosahedron"), "--weights", "warren"}).code, 3);
}

TEST(LimitCommand, SaysWhatItFound) {
    const auto r =
        test::loopcheck({"limit", test::model_path("icosahedron"), "--method", "bfr", "--samples", "12"});
    EXPECT_EQ(r.code, 0) << r.out;
    EXPECT_NE(r.out.find("interior 5"), std::string::npos) << r.out;
    EXPECT_NE(r.out.find("verdict: known deviation"), std::string::npos) << r.out;
    EXPECT_EQ(r.err, "");
}

}  // namespace
}  // namespace loopcheck::compare
