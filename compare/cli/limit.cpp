// loopcheck limit: OpenSubdiv's surfaces of one model against exact evaluation.
#include <fmt/format.h>

#include <array>
#include <memory>

#include "compare/cli/command.h"
#include "compare/cli/surface_flags.h"
#include "compare/report/html/surface_case.h"
#include "reference/opensubdiv/opensubdiv.h"

namespace loopcheck::compare {
namespace {

struct LimitFlags {
    std::string model, json;
    WayFlag way{"all"};
    RuleFlags rules;
    HtmlFlags html;
    SurfaceCheck check;
    bool triangulate = false;
};

int run_limit(const Context& context, const LimitFlags& flags) {
    if (flags.check.smooth_level > flags.check.sharp_level) {
        context.err << "--approx-smooth must not be above --approx-sharp.\n";
        return kExitUsage;
    }
    if (!flags.html.check(context)) return kExitUsage;
    const std::array outputs{flags.json, flags.html.path};
    const std::array inputs{flags.model};
    if (outputs_clash(context, outputs, inputs)) return kExitUsage;
    const auto model = load_or_complain(context, flags.model, flags.triangulate);
    if (!model) return kExitUsage;
    const core::SchemeOptions options = flags.rules.for_model(model->model);
    SurfaceReport report{flags.model,
                         static_cast<std::size_t>(model->mesh.vertex_count()),
                         static_cast<std::size_t>(model->mesh.face_count()),
                         {}};
    {
        Progress progress(context);
        const auto ways = flags.way.ways();
        std::vector<SurfaceCheck> checks(ways.size(), flags.check);
        for (std::size_t i = 0; i < ways.size(); ++i) checks[i].way = ways[i];
        LocalErrors local(ways, reference::opensubdiv_surface);
        report.comparisons =
            compare_surfaces_with_rates(model->mesh, options, checks, reference::opensubdiv_surface, local,
                                        [&](std::size_t face, std::size_t of) {
                                            if (face % 64 == 0)
                                                progress.show(fmt::format("face {} of {}", face, of));
                                        });
    }
    context.out << surface_as_text(report, reference::opensubdiv_version());
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, surface_as_json(report, context.subjects)))
        return kExitUsage;
    if (flags.html.wanted() && !write_or_complain(context, flags.html.path,
                                                  surface_as_html(report, model->mesh, options,
                                                                  flags.html.vertices, context.subjects)))
        return kExitUsage;
    return report.exit_code();
}

}  // namespace

Command add_limit(CLI::App& program) {
    auto flags = std::make_shared<LimitFlags>();
    CLI::App* command = program.add_subcommand(
        "limit", "Compare OpenSubdiv's surfaces of a model with the exact limit surface");
    command->add_option("model", flags->model, "an OBJ, OFF, PLY or STL file")->required();
    flags->way.add_to(*command);
    flags->rules.add_to(*command);
    const auto level = CLI::Range(1, reference::kOpensubdivMaxSurfaceLevel);
    command
        ->add_option("--approx-smooth", flags->check.smooth_level,
                     "OpenSubdiv's last level at smooth features")
        ->capture_default_str()
        ->check(level);
    command->add_option("--approx-sharp", flags->check.sharp_level, "and at sharp ones")
        ->capture_default_str()
        ->check(level);
    command
        ->add_option("--samples", flags->check.samples,
                     fmt::format("parameters a face, at most; about {} in all", kMostSamples))
        ->capture_default_str()
        ->check(CLI::Range(kLeastSamples, kMostSamples));
    command->add_flag("--triangulate", flags->triangulate, "split polygons by a fan from their first corner");
    command->add_option("--json", flags->json, "write the report as JSON");
    flags->html.add_to(*command, 100'000);
    return [flags](const Context& context) { return run_limit(context, *flags); };
}

}  // namespace loopcheck::compare
