// loopcheck grid: a bicubic B-spline surface, and the same as a Catmull-Clark surface.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>

#include "compare/cli/command.h"
#include "compare/memory.h"
#include "compare/report/grid.h"
#include "core/bspline/points_file.h"
#include "reference/opensubdiv/opensubdiv.h"

namespace loopcheck::compare {
namespace {

struct GridFlags {
    std::string points, json;
    std::size_t columns = 0;
    bool closed_u = false, closed_v = false;
    WorkFlags work;
};

core::Ends ends_of(bool closed) {
    return closed ? core::Ends::Closed : core::Ends::Natural;
}

// Why the points are no such grid, or too many.
std::optional<core::Error> check_grid(const core::PointsFile& file, const GridFlags& flags) {
    if (file.points.size() % flags.columns != 0)
        return core::Error{
            core::ErrorCode::BadSyntax,
            fmt::format("{} points are no whole number of rows of {}.", file.points.size(), flags.columns)};
    const double vertices = std::ldexp(static_cast<double>(file.points.size()), 2 * flags.work.levels);
    const std::size_t rows = file.points.size() / flags.columns;
    const double lines = std::ldexp(static_cast<double>(rows + flags.columns), flags.work.levels);
    const double bytes = vertices * kGridBytesPerVertex + lines * kGridBytesPerLine;
    return check_memory(fmt::format("Level {} has up to {:.0f} vertices", flags.work.levels, vertices), bytes,
                        flags.work.memory_limit());
}

int run_grid(const Context& context, const GridFlags& flags) {
    const std::array outputs{flags.json};
    const std::array inputs{flags.points};
    if (outputs_clash(context, outputs, inputs)) return kExitUsage;
    const auto file = core::read_points(flags.points);
    const auto error = file ? check_grid(*file, flags) : file.error();
    if (error) {
        complain(context, flags.points, *error);
        return kExitUsage;
    }
    const core::Grid<glm::dvec3> grid{file->points.size() / flags.columns, flags.columns, file->points};
    GridReport report{flags.points,
                      grid.rows,
                      grid.columns,
                      ends_of(flags.closed_u),
                      ends_of(flags.closed_v),
                      core::largest_coordinate(grid.points),
                      {}};
    for (const auto precision : {core::Precision::Double, core::Precision::Float}) {
        Progress progress(context);
        progress.show(
            fmt::format("{}: {} levels in {}", flags.points, flags.work.levels, core::name(precision)));
        auto compared = compare_tensor(
            grid, {.u = report.u, .v = report.v, .levels = flags.work.levels, .precision = precision});
        if (!compared) {
            core::Error why = on_its_line(compared.error(), *file);
            why.sentence = fmt::format("In {}: {}", core::name(precision), why.sentence);
            complain(context, flags.points, why);
            return why.code == core::ErrorCode::SubjectFailed ? kExitFailed : kExitUsage;
        }
        report.comparisons.push_back({precision, std::move(*compared)});
    }
    context.out << grid_as_text(report, reference::opensubdiv_version());
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, grid_as_json(report, context.subjects)))
        return kExitUsage;
    return exit_code(report.worst());
}

}  // namespace

Command add_grid(CLI::App& program) {
    auto flags = std::make_shared<GridFlags>();
    flags->work.levels = 4;
    CLI::App* command = program.add_subcommand(
        "grid", "Hold a bicubic B-spline surface against OpenSubdiv's Catmull-Clark scheme on the same grid");
    command->add_option("points", flags->points, "a text file of points, row after row")->required();
    command->add_option("--columns", flags->columns, "points in a row")
        ->required()
        ->check(CLI::Range(std::size_t{2}, std::size_t{1} << 24));
    command->add_flag("--closed-u", flags->closed_u, "join the ends of every row");
    command->add_flag("--closed-v", flags->closed_v, "join the first row and the last");
    flags->work.add_levels_to(*command);
    command->add_option("--json", flags->json, "write the report as JSON");
    return [flags](const Context& context) { return run_grid(context, *flags); };
}

}  // namespace loopcheck::compare
