// loopcheck refine: writes the refined mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "compare/cli/adaptive_flags.h"
#include "compare/memory.h"
#include "compare/report/refinement.h"
#include "core/loop/evaluate.h"
#include "core/loop/lattice/refined_mesh.h"
#include "core/loop/refine.h"
#include "core/loop/tessellation/lattice.h"
#include "core/loop/tessellation/tessellate.h"

namespace loopcheck::compare {
namespace {

struct RefineFlags {
    std::string model, output, scheme = "ours", precision = "double", order = "opensubdiv", json;
    RuleFlags rules;
    MeshFlags mesh;
    AdaptiveFlags adaptive;
    WorkFlags work;
    bool binary = false;
    std::optional<double> tolerance;
    bool uniform = false;
};

// A refined mesh, ready to be written, and what is said of it.
struct Refined {
    core::Model model;
    RefinementReport report;
};

// The sharpness that is left at the last level, where the file cannot infer it: not that of the boundary.
void add_tags(core::Model& out, const core::SchemeLevel& level, core::BoundaryRule boundary) {
    const core::Topology& t = level.topology;
    for (core::Index e = 0; e < t.edge_count(); ++e)
        if (!t.is_boundary_edge(e) && core::is_sharp(level.sharpness.edge[e]))
            out.data.creases.push_back({t.edge_ends[e][0], t.edge_ends[e][1], level.sharpness.edge[e]});
    for (core::Index v = 0; v < t.vertex_count; ++v) {
        const bool is_inferred = boundary == core::BoundaryRule::EdgeAndCorner && t.is_boundary_vertex(v) &&
                                 t.face_count_at(v) == 1;
        if (!t.is_isolated(v) && !is_inferred && core::is_sharp(level.sharpness.vertex[v]))
            out.data.corners.push_back({v, level.sharpness.vertex[v]});
    }
}

// What the file says of the rules.
core::Model model_under(const core::TriangleMesh& mesh, const core::SchemeOptions& options) {
    core::Model out;
    const auto& faces = mesh.topology().edge_faces;
    if (std::any_of(faces.begin(), faces.end(), [](const auto& pair) { return pair[1] == core::kNone; }))
        out.boundary = options.boundary;
    if (options.creasing == core::Creasing::Chaikin) out.creasing = options.creasing;
    return out;
}

core::Model model_of(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                     const core::RefinedLevel& last) {
    core::Model out = model_under(mesh, options);
    out.data.positions = last.positions;
    for (const core::Triangle& triangle : last.triangles) out.data.add_face(triangle);
    return out;
}

bool is_tagged(const core::TriangleMesh& mesh) {
    const auto is_sharp = [](float s) { return core::is_sharp(s); };
    return std::any_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_sharp) ||
           std::any_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_sharp);
}

// All levels of a subject, of which the last is written.
core::Result<core::Model> refine_by_levels(const Subject& subject, const core::TriangleMesh& mesh,
                                           const core::SchemeOptions& options, int levels) {
    const auto refined = subject.refine(mesh, options, levels);
    if (!refined) return tl::unexpected(refined.error());
    core::Model out = model_of(mesh, options, refined->levels.back());
    if (is_tagged(mesh)) {
        core::SchemeLevel level = core::control_level(mesh, options.boundary);
        for (int l = 0; l < levels; ++l) level = core::next_level(level, options).value().child;
        add_tags(out, level, options.boundary);
    }
    const core::Index children = core::Index{1} << (2 * levels);
    for (core::Index f = 0; f < mesh.face_count(); ++f)
        for (core::Index k = 0; mesh.holes()[f] && k < children; ++k)
            out.data.holes.push_back(f * children + k);
    return out;
}

// Ours without the levels before the last.
core::Result<core::Model> refine_straight(const RefineFlags& flags, core::Precision precision,
                                          const core::TriangleMesh& mesh,
                                          const core::SchemeOptions& options) {
    auto data =
        core::refined_mesh(mesh, options, precision, flags.work.levels,
                           flags.order == "lattice" ? core::LevelOrder::Lattice : core::LevelOrder::Split);
    if (!data) return tl::unexpected(data.error());
    core::Model out = model_under(mesh, options);
    out.data = std::move(*data);
    return out;
}

std::optional<Refined> refine_uniformly(const Context& context, const RefineFlags& flags,
                                        const Subject& subject, const core::TriangleMesh& mesh,
                                        const core::SchemeOptions& options, int& code) {
    code = kExitUsage;
    const int levels = flags.work.levels;
    const bool is_ours = subject.family == "ours";
    if (flags.order == "lattice" && !is_ours) {
        context.err << "--order lattice is an order of ours.\n";
        return std::nullopt;
    }
    const double bytes = is_ours ? kWrittenStraightBytesPerVertex + kControlBytesPerFace * mesh.face_count() /
                                                                        level_size(mesh, levels).vertices
                                 : subject.bytes_per_vertex + kWrittenBytesPerVertex;
    if (const auto error = check_memory(mesh, levels, bytes, flags.work.memory_limit())) {
        complain(context, flags.model, *error);
        return std::nullopt;
    }
    code = kExitFailed;
    if (options.weights != options_for(subject, options).weights) {
        context.err << fmt::format("{} has Loop's weights only.\n", subject.name);
        return std::nullopt;
    }
    auto refined = [&] {
        Progress progress(context);
        progress.show(fmt::format("{}: refining {} levels", flags.model, levels));
        return is_ours ? refine_straight(flags, subject.precision, mesh, options)
                       : refine_by_levels(subject, mesh, options, levels);
    }();
    if (!refined) {
        complain(context, flags.model, refined.error());
        code = exit_code_of(refined.error());
        return std::nullopt;
    }
    Refined out{std::move(*refined), {}};
    if (flags.order == "lattice") out.report.order = flags.order;
    for (int l = 0; l <= levels; ++l) {
        const LevelSize size = level_size(mesh, l);
        out.report.levels.push_back({.vertices = static_cast<std::size_t>(size.vertices),
                                     .faces = static_cast<std::size_t>(size.faces),
                                     .uniform_faces = size.faces});
    }
    return out;
}

std::optional<Refined> refine_only_some(const Context& context, const RefineFlags& flags,
                                        const Subject& subject, const core::TriangleMesh& mesh,
                                        const core::SchemeOptions& options, int& code) {
    code = kExitUsage;
    const auto criterion = flags.adaptive.criterion(context, mesh);
    if (!criterion) return std::nullopt;
    code = kExitFailed;
    if (subject.family != "ours") {
        context.err << fmt::format("{} has no adaptive refinement.\n", subject.name);
        return std::nullopt;
    }
    const auto refined = [&] {
        Progress progress(context);
        progress.show(fmt::format("{}: refining {} levels", flags.model, flags.work.levels));
        return refine_adaptively(mesh, options, *criterion, subject.precision, flags.work.levels,
                                 flags.work.memory_limit());
    }();
    if (!refined) {
        complain(context, flags.model, refined.error());
        code = exit_code_of(refined.error());
        return std::nullopt;
    }
    Refined out{model_of(mesh, options, refined->refinement.levels.back()), {}};
    add_tags(out.model, refined->last.scheme, options.boundary);
    for (std::size_t f = 0; f < refined->last.control_face.size(); ++f)
        if (mesh.holes()[refined->last.control_face[f]])
            out.model.data.holes.push_back(static_cast<core::Index>(f));
    out.report.rule = flags.adaptive.in_words();
    out.report.levels = adaptive_levels(mesh, *refined);
    return out;
}

// Points on each edge of a triangle at which a tessellation is measured, less one.
constexpr int kMeasuredSteps = 3;

std::optional<Refined> refine_within_tolerance(const Context& context, const RefineFlags& flags,
                                               const Subject& subject, const core::TriangleMesh& mesh,
                                               const core::SchemeOptions& options, int& code) {
    code = kExitFailed;
    if (subject.family != "ours" || subject.precision != core::Precision::Double) {
        context.err << fmt::format("{} has no exact limit in double; --tolerance is for ours.\n",
                                   subject.name);
        return std::nullopt;
    }
    const core::TessellationLimits limits{.most_levels = core::kMostLevels,
                                          .most_triangles = static_cast<std::size_t>(std::min(
                                              flags.work.memory_limit() / kTessellationBytesPerTriangle,
                                              static_cast<double>(core::kMostTessellationTriangles)))};
    Progress progress(context);
    const auto tessellate = [&](core::Splitting splitting) {
        return core::tessellate(mesh, options, *flags.tolerance, limits, splitting,
                                [&](std::size_t triangles) {
                                    progress.show(fmt::format("{}: {} triangles", flags.model, triangles));
                                });
    };
    const auto made = tessellate(core::Splitting::WhereNeeded);
    if (!made) {
        complain(context, flags.model, made.error());
        code = exit_code_of(made.error());
        return std::nullopt;
    }
    progress.show(fmt::format("{}: measuring {} triangles", flags.model, made->triangles.size()));
    Refined out;
    out.model.data.positions = made->positions;
    for (const auto& triangle : made->triangles) out.model.data.add_face(triangle.vertices);
    out.report.levels = {{.vertices = made->positions.size(), .faces = made->triangles.size()}};
    core::Index with_surface = 0;
    for (core::Index f = 0; f < mesh.face_count(); ++f)
        with_surface += core::no_limit_surface(mesh, options.boundary, f) ? 0 : 1;
    ToleranceOutcome& outcome = out.report.tolerance.emplace();
    outcome.tolerance = *flags.tolerance;
    outcome.bound = made->bound;
    outcome.measured = core::measure(mesh, options, *made, kMeasuredSteps);
    outcome.leaves = made->leaves;
    outcome.uniform_faces = std::ldexp(with_surface, 2 * made->deepest_level());
    outcome.without_surface = mesh.face_count() - with_surface;
    if (!flags.uniform) return out;
    const auto uniform = tessellate(core::Splitting::Everywhere);
    if (uniform)
        outcome.uniform = {uniform->deepest_level(), uniform->triangles.size(), uniform->bound};
    else
        outcome.no_uniform = core::to_string(uniform.error());
    return out;
}

bool write_model_or_complain(const Context& context, const RefineFlags& flags, const core::Model& model) {
    const auto written =
        core::write_model(flags.output, model, flags.binary ? core::Encoding::Binary : core::Encoding::Text);
    if (!written) {
        complain(context, flags.output, written.error());
        return false;
    }
    for (const std::string& warning : *written)
        context.err << fmt::format("{}: warning: {}\n", flags.output, warning);
    return true;
}

int run_refine(const Context& context, const RefineFlags& flags) {
    const Subject* subject = find_or_complain(context, flags.scheme, flags.precision);
    if (subject == nullptr) return kExitUsage;
    const std::array inputs{flags.model};
    const std::array outputs{flags.output, flags.json};
    if (outputs_clash(context, outputs, inputs)) return kExitUsage;
    auto loaded = load_or_complain(context, flags.model, flags.work.triangulate);
    if (!loaded) return kExitUsage;
    const auto creases = flags.mesh.apply_to(loaded->mesh);
    const core::SchemeOptions options = flags.rules.for_model(loaded->model);
    const auto refine = flags.tolerance     ? refine_within_tolerance
                        : flags.adaptive.on ? refine_only_some
                                            : refine_uniformly;
    int code = 0;
    auto refined = refine(context, flags, *subject, loaded->mesh, options, code);
    if (!refined) return code;
    const std::string how =
        flags.tolerance     ? fmt::format("within {} of its limit surface", *flags.tolerance)
        : flags.adaptive.on ? fmt::format("{} levels, {}", flags.work.levels, flags.adaptive.in_words())
                            : fmt::format("{} levels{}", flags.work.levels,
                                          flags.order == "lattice" ? ", in the order of the lattice," : "");
    refined->model.description =
        fmt::format("{} refined {} by {} {}", flags.model, how, subject->name, subject->version);
    RefinementReport& report = refined->report;
    report.model = flags.model;
    report.output = flags.output;
    report.scheme = subject->name;
    report.precision = subject->precision;
    report.creases = creases;
    if (!write_model_or_complain(context, flags, refined->model)) return kExitUsage;
    context.out << refinement_as_text(report);
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, refinement_as_json(report, context.subjects)))
        return kExitUsage;
    return 0;
}

}  // namespace

Command add_refine(CLI::App& program) {
    auto flags = std::make_shared<RefineFlags>();
    CLI::App* command = program.add_subcommand("refine", "Refine a model and write the mesh");
    command->add_option("model", flags->model, "an OBJ, OFF, PLY or STL file")->required();
    command->add_option("-o,--output", flags->output, "the file to write, by its extension")->required();
    command->add_option("--scheme", flags->scheme, "the subject that refines")->capture_default_str();
    command->add_option("--precision", flags->precision, "double or float")
        ->capture_default_str()
        ->check(CLI::IsMember({"double", "float"}));
    command->add_flag("--binary", flags->binary, "binary PLY");
    flags->rules.add_to(*command);
    flags->mesh.add_to(*command);
    flags->work.add_to(*command);
    flags->adaptive.add_to(*command);
    auto* tolerance = command
                          ->add_option("--tolerance", flags->tolerance,
                                       "instead of levels: triangles of the limit surface within this "
                                       "distance of it, in model units")
                          ->check(check_positive)
                          ->excludes("--levels")
                          ->excludes("--adaptive");
    command
        ->add_option("--order", flags->order,
                     "the order of vertices and faces: opensubdiv, or lattice, by their place on the model")
        ->capture_default_str()
        ->check(CLI::IsMember({"opensubdiv", "lattice"}))
        ->excludes("--adaptive")
        ->excludes("--tolerance");
    command->add_flag("--uniform", flags->uniform, "also find the first uniform level within the tolerance")
        ->needs(tolerance);
    command->add_option("--json", flags->json, "write the report as JSON");
    return [flags](const Context& context) { return run_refine(context, *flags); };
}

}  // namespace loopcheck::compare
