// Adaptive refinement against OpenSubdiv's uniform one, and the commands around it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/adaptive/adaptive_comparison.h"
#include "compare/suite.h"
#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/model.h"
#include "tests/compare/support.h"
#include "tests/support/angles.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/temporary_folder.h"

namespace loopcheck::compare {
namespace {

using core::Neighbours;
using core::where_bent;
using core::where_smooth;
using tests::contains;
using tests::kDegree;

constexpr double kMany = 1e9;

core::AdaptiveRefinement refined(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                 const core::Criterion& criterion, core::Precision precision, int levels) {
    return precision == core::Precision::Float
               ? tests::value_of(core::refine_adaptively<float>(mesh, options, criterion, levels, kMany))
               : tests::value_of(core::refine_adaptively<double>(mesh, options, criterion, levels, kMany));
}

// Bit for bit, but where a known deviation of OpenSubdiv shows: there as predicted.
TEST(AdaptiveComparison, OfEveryModelAgreesWithOpenSubdivInBothPrecisions) {
    const int levels = tests::levels_up_to(3);
    std::size_t checked = 0, held = 0, elsewhere = 0;
    for (const std::string& file : tests::model_files()) {
        const tests::LoadedModel model = tests::load_model(file);
        for (const auto& criterion : {where_smooth(core::kReportAngle, Neighbours::Edge),
                                      where_bent(10 * kDegree, Neighbours::Vertex)})
            for (const char* precision : {"", "-float"}) {
                const Subject &ours = test::subject(std::string("ours") + precision),
                              &opensubdiv = test::subject(std::string("opensubdiv") + precision);
                const auto c = compare_adaptive(
                    model.mesh, model.options,
                    refined(model.mesh, model.options, criterion, ours.precision, levels), ours, opensubdiv);
                const bool deviates = contains(model.name, "chaikin-overweight");
                EXPECT_LE(c.verdict, deviates ? Verdict::KnownDeviation : Verdict::Identical)
                    << model.name << " " << opensubdiv.name << ": " << c.notes.front();
                for (const auto& level : c.levels) {
                    const AdaptiveStats all = total(level);
                    checked += all.checked.count;
                    held += all.held.count;
                    elsewhere += all.held.count - all.held.identical;
                }
            }
    }
    fmt::print("[ OBSERVED ] {} vertices checked, {} held, {} of those elsewhere\n", checked, held,
               elsewhere);
    EXPECT_GT(checked, 10000U);
    EXPECT_GT(elsewhere, 1000U) << "what is held moves";
}

TEST(AdaptiveComparison, SeesASubjectThatIsOff) {
    const auto mesh = test::model_mesh("icosahedron");
    const Subject off = test::cheat("off", [](core::Refinement& r) { r.levels[2].positions[5].y += 1e-9; });
    const auto adaptive =
        refined(mesh, {}, where_smooth(120 * kDegree, Neighbours::Edge), core::Precision::Double, 2);
    const auto c = compare_adaptive(mesh, {}, adaptive, test::subject("ours"), off);
    EXPECT_EQ(c.verdict, Verdict::Differs);
    ASSERT_FALSE(c.notes.empty());
    EXPECT_EQ(total(c.levels[2]).checked.identical + 1, total(c.levels[2]).checked.count);
}

TEST(AdaptiveComparison, SeesAnAdaptiveVertexThatIsNotOurOwn) {
    const auto mesh = test::model_mesh("icosahedron");
    auto adaptive =
        refined(mesh, {}, where_smooth(120 * kDegree, Neighbours::Edge), core::Precision::Double, 2);
    adaptive.refinement.levels[1].positions[0].x += 1e-12;
    const auto c = compare_adaptive(mesh, {}, adaptive, test::subject("ours"), test::subject("opensubdiv"));
    EXPECT_EQ(c.verdict, Verdict::Differs);
    EXPECT_TRUE(contains(c.notes.front(), "1 vertices of the adaptive mesh")) << c.notes.front();
}

TEST(AdaptiveComparison, SaysWhatASubjectDoesNotSupport) {
    const auto model = tests::load_model(tests::model_path("crease-loop"));
    const auto adaptive =
        refined(model.mesh, model.options, where_smooth(core::kReportAngle, Neighbours::Edge),
                core::Precision::Double, 1);
    Subject refuses = test::subject("opensubdiv");
    refuses.refine = [](const core::TriangleMesh&, const core::SchemeOptions&,
                        int) -> core::Result<core::Refinement> {
        return core::fail(core::ErrorCode::Unsupported, "No creases.");
    };
    const auto c = compare_adaptive(model.mesh, model.options, adaptive, test::subject("ours"), refuses);
    EXPECT_EQ(c.verdict, Verdict::NotSupported);
    EXPECT_TRUE(contains(c.notes.front(), "No creases.")) << c.notes.front();
}

TEST(AdaptiveComparison, CountsFromLevel1AndSaysWhereNothingWasCompared) {
    const auto cube = tests::mesh_of(tests::cube());
    const auto note = [&](double degrees, int levels) {
        const auto adaptive = refined(cube, {}, where_smooth(degrees * kDegree, Neighbours::Edge),
                                      core::Precision::Double, levels);
        const auto c =
            compare_adaptive(cube, {}, adaptive, test::subject("ours"), test::subject("opensubdiv"));
        EXPECT_EQ(c.verdict, Verdict::Identical);
        return c.notes.front();
    };
    EXPECT_TRUE(contains(note(180, 0), "nothing was compared")) << note(180, 0);
    EXPECT_TRUE(contains(note(60, 2), "nothing was compared")) << note(60, 2);
    EXPECT_TRUE(contains(note(180, 1), "All 26 vertices after level 0")) << note(180, 1);
}

class AdaptiveCommand : public testing::Test {
  protected:
    test::Outcome run(std::vector<std::string> arguments) const { return test::loopcheck(arguments); }

    const tests::TemporaryFolder folder_;
    const std::string out_ = folder_ / "out.obj", json_ = folder_ / "report.json";
};

TEST_F(AdaptiveCommand, WritesAMeshThatCanBeReadAndItsCounts) {
    const auto r =
        run({"refine", test::model_path("cow"), "--adaptive", "--levels", "2", "-o", out_, "--json", json_});
    ASSERT_EQ(r.code, 0) << r.err;
    const auto mesh = load_model(out_, false);
    ASSERT_TRUE(mesh) << core::to_string(mesh.error());
    const auto report = nlohmann::json::parse(core::read_file(json_).value());
    const auto& levels = report["refinement"]["levels"];
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[2]["faces"], mesh->mesh.face_count());
    EXPECT_EQ(levels[2]["vertices"], mesh->mesh.vertex_count());
    EXPECT_EQ(levels[2]["uniform_faces"], 476 * 16);
    const auto& c = levels[2]["faces_with_unsplit"];
    EXPECT_EQ(4 * c[0].get<int>() + 3 * c[1].get<int>() + 2 * c[2].get<int>() + c[3].get<int>(),
              levels[2]["faces"]);
    EXPECT_TRUE(contains(r.out, "faces are split where their normal is at most 60 degrees")) << r.out;
}

// By their ends: a file that is read has another order of edges.
std::map<std::pair<core::Index, core::Index>, float> sharp_edges(const core::SchemeLevel& level) {
    std::map<std::pair<core::Index, core::Index>, float> out;
    for (core::Index e = 0; e < level.topology.edge_count(); ++e)
        if (core::is_sharp(level.sharpness.edge[e])) {
            const auto& [a, b] = level.topology.edge_ends[e];
            out[std::minmax(a, b)] = level.sharpness.edge[e];
        }
    return out;
}

TEST_F(AdaptiveCommand, KeepsHolesTagsAndWhatTheBoundaryRulePinned) {
    for (const char* name : {"hole-open", "hole-at-crease", "semi-sharp-edge-1.5", "crease-loop-one-face",
                             "semi-sharp-at-boundary"}) {
        const std::string path = test::model_path(name);
        const auto control = load_model(path, false);
        ASSERT_TRUE(control) << name;
        ASSERT_EQ(run({"refine", path, "--adaptive", "--angle", "30", "--levels", "2", "-o", out_}).code, 0);
        const auto mesh = load_model(out_, false);
        ASSERT_TRUE(mesh) << name << core::to_string(mesh.error());
        const auto options =
            options_for_model(control->model, std::nullopt, std::nullopt, core::Weights::Loop);
        const auto direct = refined(control->mesh, options, where_smooth(30 * kDegree, Neighbours::Edge),
                                    core::Precision::Double, 2);
        const auto read_again = core::control_level(mesh->mesh, options.boundary);
        EXPECT_EQ(read_again.sharpness.vertex, direct.last.scheme.sharpness.vertex) << name;
        EXPECT_EQ(sharp_edges(read_again), sharp_edges(direct.last.scheme)) << name;
        std::size_t holes = 0;
        for (const core::Index f : direct.last.control_face) holes += control->mesh.holes()[f];
        EXPECT_EQ(
            static_cast<std::size_t>(std::count(mesh->mesh.holes().begin(), mesh->mesh.holes().end(), 1)),
            holes)
            << name;
    }
}

TEST_F(AdaptiveCommand, ComparesAndPointsOutEveryClass) {
    const auto r = run({"compare", test::model_path("cow"), "--adaptive", "--levels", "2", "--json", json_});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "verdict: agree")) << r.out;
    EXPECT_TRUE(contains(r.out, "bit for bit")) << r.out;
    const auto report = nlohmann::json::parse(core::read_file(json_).value());
    const auto& level = report["adaptive"]["levels"][2];
    std::size_t vertices = 0;
    for (const auto& row : level["classes"])
        vertices += row["checked"]["vertices"].get<std::size_t>() +
                    row["held"]["vertices"].get<std::size_t>() + row["apart"].get<std::size_t>();
    EXPECT_EQ(vertices, level["vertices"].get<std::size_t>());
}

TEST_F(AdaptiveCommand, SplitsTheFacesItIsTold) {
    const std::vector<std::string> base{
        "refine", test::model_path("cow"), "--adaptive", "--levels", "1", "-o", out_};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), base.begin(), base.end());
        return run(more);
    };
    EXPECT_EQ(with({"--faces", "0-475"}).code, 0);
    EXPECT_EQ(load_model(out_, false)->mesh.face_count(), 4 * 476);
    EXPECT_EQ(with({"--faces", "7"}).code, 0);
    EXPECT_EQ(load_model(out_, false)->mesh.face_count(), 476) << "no neighbour agrees";
    for (const char* bad : {"476", "-1", "3-1", "a", "1,,2", "1-", "", "0-99999999999999999999"}) {
        const auto r = with({"--faces", bad});
        EXPECT_EQ(r.code, 2) << bad;
        EXPECT_FALSE(r.err.empty()) << bad;
    }
}

TEST_F(AdaptiveCommand, RefusesBadFlagsWithoutWriting) {
    const std::string model = test::model_path("cow");
    for (const std::vector<std::string>& flags :
         std::vector<std::vector<std::string>>{{"--adaptive", "--angle", "-1"},
                                               {"--adaptive", "--angle", "181"},
                                               {"--adaptive", "--angle", "nan"},
                                               {"--adaptive", "--angle", "60x"},
                                               {"--adaptive", "--neighbours", "all"},
                                               {"--adaptive", "--split", "round"},
                                               {"--adaptive", "--split", "bent", "--faces", "1"},
                                               {"--adaptive", "--angle", "30", "--faces", "1"},
                                               {"--adaptive", "--neighbours", "vertex", "--faces", "1"},
                                               {"--angle", "60"},
                                               {"--faces", "1"}}) {
        std::vector<std::string> arguments{"refine", model, "-o", out_};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        const auto r = run(arguments);
        EXPECT_EQ(r.code, 2) << fmt::format("{}", fmt::join(flags, " "));
        EXPECT_FALSE(std::filesystem::exists(out_));
    }
    EXPECT_EQ(run({"refine", model, "-o", out_, "--adaptive", "--scheme", "opensubdiv"}).code, 3);
    EXPECT_EQ(run({"refine", model, "-o", out_, "--adaptive", "--levels", "8", "--memory", "0.01"}).code, 2);
    EXPECT_EQ(run({"refine", model, "-o", out_, "--json", out_}).code, 2);
    EXPECT_FALSE(std::filesystem::exists(out_));
    EXPECT_EQ(run({"compare", model, model, "--adaptive"}).code, 2);
    EXPECT_EQ(run({"compare", model, "--adaptive", "--limit"}).code, 2);
    EXPECT_EQ(run({"compare", model, "--adaptive", "--subject", "opensubdiv"}).code, 3);
    EXPECT_EQ(run({"compare", model, "--adaptive", "--levels", "3", "--weights", "warren"}).code, 1);
}

TEST_F(AdaptiveCommand, WritesTheLimitSurfaceWithinATolerance) {
    for (const double tolerance : {0.1, 0.03}) {
        const auto r = run({"refine", test::model_path("cow"), "--tolerance", fmt::format("{}", tolerance),
                            "-o", out_, "--json", json_});
        ASSERT_EQ(r.code, 0) << r.err;
        const auto refinement = nlohmann::json::parse(core::read_file(json_).value())["refinement"];
        const auto& found = refinement["tolerance"];
        EXPECT_LE(found["bound"], tolerance);
        EXPECT_LE(found["measured"], found["bound"]);
        EXPECT_GT(found["measured"], 0);
        const auto mesh = load_model(out_, false);
        ASSERT_TRUE(mesh) << core::to_string(mesh.error());
        EXPECT_EQ(refinement["faces"], mesh->mesh.face_count());
        EXPECT_LE(refinement["faces"], found["uniform_faces"]);
    }
}

// The sum of two such coordinates overflows.
TEST_F(AdaptiveCommand, RefusesCoordinatesOutOfRangeAlikeInEveryWay) {
    core::Model huge;
    huge.data = tests::tetrahedron();
    huge.data.positions[1].x = 1.7e308;
    const std::string path = folder_ / "huge.obj";
    ASSERT_TRUE(core::write_model(path, huge, core::Encoding::Text));
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--levels", "1"}, {"--adaptive", "--levels", "1"}, {"--tolerance", "1"}}) {
        std::vector<std::string> arguments{"refine", path, "-o", out_};
        arguments.insert(arguments.end(), how.begin(), how.end());
        const auto r = run(arguments);
        EXPECT_EQ(r.code, 2) << how.front();
        EXPECT_TRUE(contains(r.err, "[not-finite]")) << r.err;
    }
    EXPECT_EQ(run({"compare", path, "--adaptive", "--levels", "1"}).code, 2);
    EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(AdaptiveCommand, TakesMinusZeroForZero) {
    const auto r = run({"refine", test::model_path("cow"), "--adaptive", "--angle", "-0", "--crease-angle",
                        "-0", "--levels", "1", "-o", out_});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "at most 0 degrees")) << r.out;
    EXPECT_TRUE(contains(r.out, "--crease-angle 0:")) << r.out;
}

TEST_F(AdaptiveCommand, NeverWritesOverTheModelItReads) {
    const std::string model = folder_ / "model.obj", link = folder_ / "link.obj";
    const std::string before = core::read_file(test::model_path("icosahedron")).value();
    ASSERT_TRUE(core::write_file(model, before));
    std::filesystem::create_symlink(model, link);
    for (const std::vector<std::string>& how :
         {std::vector<std::string>{"--levels", "1"}, {"--adaptive", "--levels", "1"}, {"--tolerance", "1"}})
        for (const std::vector<std::string>& where :
             {std::vector<std::string>{"-o", model}, {"-o", link}, {"-o", out_, "--json", model}}) {
            std::vector<std::string> arguments{"refine", model};
            arguments.insert(arguments.end(), how.begin(), how.end());
            arguments.insert(arguments.end(), where.begin(), where.end());
            EXPECT_EQ(run(arguments).code, 2);
            EXPECT_EQ(core::read_file(model).value(), before);
        }
}

// 2^530 overflows when it is squared, 2^-530 underflows.
TEST_F(AdaptiveCommand, MeasuresTheSameAtEveryScale) {
    const auto cow = load_model(test::model_path("cow"), false);
    const auto measured = [&](int exponent) {
        core::Model scaled;
        for (const auto& p : cow->mesh.positions())
            scaled.data.positions.push_back(core::times_power_of_two(p, exponent));
        for (const auto& t : cow->mesh.topology().triangles) scaled.data.add_face(t);
        const std::string path = folder_ / "scaled.obj";
        EXPECT_TRUE(core::write_model(path, scaled, core::Encoding::Text));
        const auto r = run({"refine", path, "--tolerance", fmt::format("{}", std::ldexp(0.0625, exponent)),
                            "-o", out_, "--json", json_});
        EXPECT_EQ(r.code, 0) << r.err;
        const auto report = nlohmann::json::parse(core::read_file(json_).value());
        return std::ldexp(report["refinement"]["tolerance"]["measured"].get<double>(), -exponent);
    };
    const double plain = measured(0);
    EXPECT_GT(plain, 0);
    EXPECT_EQ(measured(530), plain);
    EXPECT_EQ(measured(-530), plain);
}

TEST_F(AdaptiveCommand, WritesTheMeshAlsoWhereNoUniformLevelFits) {
    const auto r = run({"refine", test::model_path("cow"), "--tolerance", "0.05", "--uniform", "--memory",
                        "0.006", "-o", out_, "--json", json_});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "first uniform level within the tolerance: not found.")) << r.out;
    EXPECT_TRUE(load_model(out_, false));
    const auto found = nlohmann::json::parse(core::read_file(json_).value())["refinement"]["tolerance"];
    EXPECT_FALSE(found.contains("uniform"));
    EXPECT_TRUE(contains(found["no_uniform"], "[too-large]"));
}

TEST_F(AdaptiveCommand, CountsTheFacesThatHaveNoSurface) {
    const auto r = run({"refine", test::model_path("grid-4x4"), "--tolerance", "0.1", "--boundary", "none",
                        "-o", out_, "--json", json_});
    EXPECT_EQ(r.code, 0) << r.err;
    const auto found = nlohmann::json::parse(core::read_file(json_).value())["refinement"]["tolerance"];
    EXPECT_EQ(found["without_surface"], 24);
    EXPECT_EQ(found["uniform_faces"], 8 << (2 * (found["leaves"].size() - 1)));
}

TEST_F(AdaptiveCommand, ComparesAMeshThatIsOnePoint) {
    core::Model point;
    point.data = tests::tetrahedron();
    for (auto& p : point.data.positions) p = glm::dvec3(1);
    const std::string path = folder_ / "point.obj";
    ASSERT_TRUE(core::write_model(path, point, core::Encoding::Text));
    const auto r = run({"compare", path, "--adaptive", "--levels", "2"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_FALSE(contains(r.out, "nan")) << r.out;
}

TEST_F(AdaptiveCommand, FindsTheUniformLevelWithinATolerance) {
    ASSERT_EQ(run({"refine", test::model_path("cow"), "--tolerance", "0.05", "--uniform", "-o", out_,
                   "--json", json_})
                  .code,
              0);
    const auto refinement = nlohmann::json::parse(core::read_file(json_).value())["refinement"];
    const auto& uniform = refinement["tolerance"]["uniform"];
    EXPECT_LE(uniform["bound"], 0.05);
    EXPECT_EQ(uniform["faces"], 476 << (2 * uniform["level"].get<int>()));
    EXPECT_LT(2 * refinement["faces"].get<int>(), uniform["faces"]) << "less than half the faces";
}

TEST_F(AdaptiveCommand, RefusesAToleranceItCannotKeep) {
    const std::string model = test::model_path("cow");
    const auto with = [&](std::vector<std::string> flags, const std::string& path) {
        flags.insert(flags.begin(), {"refine", path, "-o", out_});
        return run(flags);
    };
    for (const char* bad : {"0", "-1", "nan", "inf", "1x", ""})
        EXPECT_EQ(with({"--tolerance", bad}, model).code, 2) << bad;
    const auto small = with({"--tolerance", "1e-9", "--memory", "0.01"}, model);
    EXPECT_EQ(small.code, 2);
    EXPECT_TRUE(contains(small.err, "[too-large]")) << small.err;
    EXPECT_EQ(with({"--tolerance", "100", "--memory", "1e-12"}, model).code, 2);
    EXPECT_EQ(with({"--tolerance", "1", "--levels", "2"}, model).code, 2);
    EXPECT_EQ(with({"--tolerance", "1", "--adaptive"}, model).code, 2);
    EXPECT_EQ(with({"--uniform"}, model).code, 2);
    EXPECT_EQ(with({"--tolerance", "1", "--precision", "float"}, model).code, 3);
    EXPECT_EQ(with({"--tolerance", "1", "--scheme", "opensubdiv"}, model).code, 3);
    EXPECT_EQ(with({"--tolerance", "1"}, test::model_path("boundary-none")).code, 2);
    EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace loopcheck::compare
