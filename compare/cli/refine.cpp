// loopcheck refine: writes the refined mesh.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compare/cli/command.h"
#include "compare/memory.h"
#include "core/loop/refine.h"

namespace loopcheck::compare {
namespace {

struct RefineFlags {
    std::string model, output, scheme = "ours", precision = "double";
    RuleFlags rules;
    WorkFlags work;
    bool binary = false;
};

// The sharpness that is left at the last level, where the file cannot infer it: not that of the boundary.
void add_tags(core::Model& out, const core::TriangleMesh& mesh, const core::SchemeOptions& options,
              int levels) {
    const auto is_sharp = [](float s) { return core::is_sharp(s); };
    if (std::none_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_sharp) &&
        std::none_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_sharp))
        return;
    core::SchemeLevel level = core::control_level(mesh, options.boundary);
    for (int l = 0; l < levels; ++l) level = core::next_level(level, options).value().child;
    const core::Topology& t = level.topology;
    for (core::Index e = 0; e < t.edge_count(); ++e)
        if (!t.is_boundary_edge(e) && core::is_sharp(level.sharpness.edge[e]))
            out.data.creases.push_back({t.edge_ends[e][0], t.edge_ends[e][1], level.sharpness.edge[e]});
    for (core::Index v = 0; v < t.vertex_count; ++v)
        if (!t.is_isolated(v) && core::is_sharp(level.sharpness.vertex[v]))
            out.data.corners.push_back({v, level.sharpness.vertex[v]});
}

core::Model model_of(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                     const core::Refinement& refinement) {
    const auto levels = static_cast<int>(refinement.levels.size()) - 1;
    const core::RefinedLevel& last = refinement.levels.back();
    core::Model out;
    const auto& faces = mesh.topology().edge_faces;
    if (std::any_of(faces.begin(), faces.end(), [](const auto& pair) { return pair[1] == core::kNone; }))
        out.boundary = options.boundary;
    if (options.creasing == core::Creasing::Chaikin) out.creasing = options.creasing;
    out.data.positions = last.positions;
    for (const core::Triangle& triangle : last.triangles) out.data.add_face(triangle);
    add_tags(out, mesh, options, levels);
    const core::Index children = core::Index{1} << (2 * levels);
    for (core::Index f = 0; f < mesh.face_count(); ++f)
        for (core::Index k = 0; mesh.holes()[f] && k < children; ++k)
            out.data.holes.push_back(f * children + k);
    return out;
}

int run_refine(const Context& context, const RefineFlags& flags) {
    const Subject* subject = find_or_complain(context, flags.scheme, flags.precision);
    if (subject == nullptr) return kExitUsage;
    const auto loaded = load_or_complain(context, flags.model, flags.work.triangulate);
    if (!loaded) return kExitUsage;
    const core::TriangleMesh& mesh = loaded->mesh;
    const core::SchemeOptions options = flags.rules.for_model(loaded->model);
    const double bytes = subject->bytes_per_vertex + kWrittenBytesPerVertex;
    if (const auto error = check_memory(mesh, flags.work.levels, bytes, flags.work.memory_limit())) {
        complain(context, flags.model, *error);
        return kExitUsage;
    }
    if (options.weights != options_for(*subject, options).weights) {
        context.err << fmt::format("{} has Loop's weights only.\n", subject->name);
        return kExitFailed;
    }
    core::Result<core::Refinement> refined = [&] {
        Progress progress(context);
        progress.show(fmt::format("{}: refining {} levels", flags.model, flags.work.levels));
        return subject->refine(mesh, options, flags.work.levels);
    }();
    if (!refined) {
        complain(context, flags.model, refined.error());
        return kExitFailed;
    }
    core::Model out = model_of(mesh, options, *refined);
    out.description = fmt::format("{} refined {} levels by {} {}", flags.model, flags.work.levels,
                                  subject->name, subject->version);
    const auto written =
        core::write_model(flags.output, out, flags.binary ? core::Encoding::Binary : core::Encoding::Text);
    if (!written) {
        complain(context, flags.output, written.error());
        return kExitUsage;
    }
    for (const std::string& warning : *written)
        context.err << fmt::format("{}: warning: {}\n", flags.output, warning);
    context.out << fmt::format("{}: {} vertices, {} faces\n", flags.output, out.data.positions.size(),
                               out.data.face_sizes.size());
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
    flags->work.add_to(*command);
    return [flags](const Context& context) { return run_refine(context, *flags); };
}

}  // namespace loopcheck::compare
