// loopcheck atlas: the error of OpenSubdiv's surfaces by vertex class, for any geometry.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compare/cli/command.h"
#include "compare/cli/surface_flags.h"
#include "compare/report/surface.h"
#include "reference/opensubdiv/opensubdiv.h"

namespace loopcheck::compare {
namespace {

struct AtlasFlags {
    WayFlag way{"bfr"};
    std::vector<int> levels{2, 6, 10};
    std::string json;
};

int run_atlas(const Context& context, const AtlasFlags& flags) {
    std::vector<int> levels = flags.levels;
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    const Atlas atlas = [&] {
        Progress progress(context);
        return make_atlas(flags.way.ways(), atlas_classes(), levels, reference::opensubdiv_surface,
                          [&](std::size_t done, std::size_t of, const std::string& what) {
                              progress.show(fmt::format("[{}/{}] {}", done, of, what));
                          });
    }();
    context.out << atlas_as_text(atlas, reference::opensubdiv_version());
    const bool failed = std::any_of(atlas.rows.begin(), atlas.rows.end(), [](const AtlasRow& row) {
        return !std::all_of(row.levels.begin(), row.levels.end(),
                            [](const auto& level) { return level.has_value(); });
    });
    const int code = failed ? kExitFailed : 0;
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, atlas_as_json(atlas, context.subjects, code)))
        return kExitUsage;
    return code;
}

}  // namespace

Command add_atlas(CLI::App& program) {
    auto flags = std::make_shared<AtlasFlags>();
    CLI::App* command = program.add_subcommand(
        "atlas", "How far OpenSubdiv's surfaces are off around each kind of vertex, for any geometry");
    flags->way.add_to(*command);
    command->add_option("--levels", flags->levels, "levels of approximation, as 2,6,10")
        ->capture_default_str()
        ->delimiter(',')
        ->check(CLI::Range(1, reference::kOpensubdivMaxSurfaceLevel));
    command->add_option("--json", flags->json, "write the table as JSON");
    return [flags](const Context& context) { return run_atlas(context, *flags); };
}

}  // namespace loopcheck::compare
