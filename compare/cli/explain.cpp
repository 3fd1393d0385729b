// loopcheck explain: why a vertex is where it is.
#include "compare/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compare/cli/command.h"
#include "compare/demonstration.h"
#include "compare/memory.h"
#include "compare/witness.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

struct ExplainFlags {
    std::string model, deviation;
    RuleFlags rules;
    bool triangulate = false;
    std::optional<int> level;
    std::optional<core::Index> vertex;
    bool from_one = false, limit = false;
};

int explain_deviation(const Context& context, std::string_view name) {
    const KnownDeviation* deviation = find_deviation(known_deviations(), name);
    if (deviation == nullptr) {
        context.err << fmt::format("There is no known deviation {}; 'loopcheck deviations' lists them.\n",
                                   printable(std::string(name)));
        return kExitUsage;
    }
    const auto demonstration = demonstrate(*deviation);
    if (!demonstration) {
        complain(context, std::string(name), demonstration.error());
        return kExitFailed;
    }
    const Subject* subject = find_subject(context.subjects, deviation->family);
    context.out << demonstration_as_text(*demonstration, subject == nullptr ? "" : subject->version);
    return demonstration->status == DeviationStatus::AsPredicted ? 0 : 1;
}

int run_explain(const Context& context, const ExplainFlags& flags) {
    if (!flags.deviation.empty()) {
        if (flags.model.empty() && !flags.vertex) return explain_deviation(context, flags.deviation);
        context.err << "--deviation brings its own mesh: no model or --vertex goes with it.\n";
        return kExitUsage;
    }
    if (flags.model.empty() || !flags.vertex) {
        context.err << "explain takes a model and --vertex, or --deviation.\n";
        return kExitUsage;
    }
    const int level = flags.level.value_or(flags.limit ? 0 : 1);
    if (level == 0 && !flags.limit) {
        context.err << "A vertex of level 0 is given, and no rule made it; --limit explains its limit.\n";
        return kExitUsage;
    }
    const auto model = load_or_complain(context, flags.model, flags.triangulate);
    if (!model) return kExitUsage;
    if (const auto error = check_memory(model->mesh, level, kWitnessBytesPerVertex + kResultBytesPerVertex,
                                        available_memory())) {
        complain(context, flags.model, *error);
        return kExitUsage;
    }
    const CountFrom from = flags.from_one ? CountFrom::One : CountFrom::Zero;
    const core::SchemeOptions options = flags.rules.for_model(model->model);
    const core::Index vertex = *flags.vertex - static_cast<core::Index>(from);
    const auto text = flags.limit ? explain_limit(model->mesh, options, level, vertex, from)
                                  : explain(model->mesh, options, level, vertex, context.subjects, from);
    if (!text) {
        complain(context, flags.model, text.error());
        return kExitUsage;
    }
    context.out << *text;
    return 0;
}

}  // namespace

Command add_explain(CLI::App& program) {
    auto flags = std::make_shared<ExplainFlags>();
    CLI::App* command =
        program.add_subcommand("explain", "Show the rule and mask of a vertex, and what subjects compute");
    command->add_option("model", flags->model, "an OBJ, OFF, PLY or STL file");
    command->add_option("--vertex", flags->vertex, "the vertex, counted from 0 (or from 1 with --from-one)");
    command->add_option("--deviation", flags->deviation,
                        "instead: a known deviation of a peer, on the smallest mesh that shows it");
    command
        ->add_option(
            "--level", flags->level,
            "the level it belongs to; level 1, the default, begins with the control vertices' points; "
            "with --limit also 0, then the default")
        ->check(CLI::Range(0, 12));
    command->add_flag("--limit", flags->limit, "explain its limit: position and tangent masks");
    command->add_flag("--from-one", flags->from_one,
                      "count vertices from 1, like the f lines of an OBJ file");
    command->add_flag("--triangulate", flags->triangulate, "split polygons by a fan from their first corner");
    flags->rules.add_to(*command);
    return [flags](const Context& context) { return run_explain(context, *flags); };
}

}  // namespace loopcheck::compare
