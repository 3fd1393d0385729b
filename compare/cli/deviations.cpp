// loopcheck deviations: every known deviation, shown again.
#include <fmt/format.h>

#include <memory>

#include "compare/cli/command.h"
#include "compare/demonstration.h"
#include "compare/report/table.h"

namespace loopcheck::compare {
namespace {

struct DeviationsFlags {
    std::string json;
};

int run_deviations(const Context& context, const DeviationsFlags& flags) {
    std::vector<Demonstration> shown;
    std::vector<std::vector<std::string>> rows{{"deviation", "kind", "predicted", "observed", "status"}};
    int code = 0;
    for (const KnownDeviation& deviation : known_deviations()) {
        auto demonstration = demonstrate(deviation);
        if (!demonstration) {
            complain(context, std::string(deviation.name), demonstration.error());
            code = worse_exit_code(code, kExitFailed);
            continue;
        }
        const Demonstration& d = shown.emplace_back(std::move(*demonstration));
        rows.push_back({std::string(deviation.name), std::string(name(deviation.kind)),
                        fmt::format("{}{:.6g}", d.predicted.empty() ? "<= " : "", d.predicted_amount),
                        fmt::format("{:.6g}", d.observed_amount), std::string(name(d.status))});
        if (d.status != DeviationStatus::AsPredicted) code = worse_exit_code(code, 1);
    }
    context.out << table(rows)
                << "\nThe numbers are sums of |weight - right weight|; 'loopcheck explain --deviation NAME' "
                   "shows the "
                   "weights.\n";
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, demonstrations_as_json(shown, context.subjects, code)))
        return kExitUsage;
    return code;
}

}  // namespace

Command add_deviations(CLI::App& program) {
    auto flags = std::make_shared<DeviationsFlags>();
    CLI::App* command = program.add_subcommand(
        "deviations", "Show every known deviation again, on the smallest mesh, as predicted and as observed");
    command->add_option("--json", flags->json, "write meshes and weights as JSON");
    return [flags](const Context& context) { return run_deviations(context, *flags); };
}

}  // namespace loopcheck::compare
