// loopcheck suite: every model of a folder.
#include "compare/suite.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <memory>

#include "compare/cli/command.h"
#include "compare/report/html/report_page.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

struct SuiteFlags {
    std::vector<std::string> paths{"models"};
    WorkFlags work;
    HtmlFlags html;
    std::string json, junit, shard;
    int jobs = 1;
    bool no_limit = false;
};

// i/n, with 0 <= i < n.
std::optional<Shard> parse_shard(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    const auto index = core::parse_integer(text.substr(0, slash)),
               of = core::parse_integer(text.substr(slash + 1));
    if (!index || !of || *index < 0 || *index >= *of || *of > std::numeric_limits<int>::max())
        return std::nullopt;
    return Shard{static_cast<int>(*index), static_cast<int>(*of)};
}

int run_suite_command(const Context& context, const SuiteFlags& flags) {
    if (!flags.html.check(context)) return kExitUsage;
    const std::array outputs{flags.json, flags.junit, flags.html.path};
    if (outputs_clash(context, outputs, flags.paths)) return kExitUsage;
    std::vector<std::filesystem::path> models;
    for (const std::string& path : flags.paths) {
        if (!std::filesystem::exists(path)) {
            complain(context, path, {core::ErrorCode::CannotRead, "There is no such file or folder."});
            return kExitUsage;
        }
        if (!std::filesystem::is_directory(path)) {
            models.emplace_back(path);
            continue;
        }
        auto found = find_models(path);
        if (!found) {
            complain(context, path, found.error());
            return kExitUsage;
        }
        models.insert(models.end(), found->begin(), found->end());
    }
    if (models.empty()) {
        context.err << "There are no OBJ, OFF, PLY or STL files; subfolders are not searched.\n";
        return kExitUsage;
    }
    SuiteResult result;
    {
        Progress progress(context);
        result = run_suite(models, context.subjects,
                           {flags.work.levels, flags.jobs, flags.work.triangulate,
                            flags.no_limit ? Scope::Refinement : Scope::Limits, flags.work.memory_limit(),
                            flags.html.wanted() ? flags.html.vertices : 0, parse_shard(flags.shard)},
                           [&](std::size_t done, std::size_t of, const std::string& model) {
                               progress.show(fmt::format("[{}/{}] {}", done, of, model));
                           });
    }
    context.out << suite_as_text(result, context.subjects);
    bool written = true;
    if (!flags.json.empty())
        written = write_or_complain(context, flags.json, suite_as_json(result, context.subjects)) && written;
    if (!flags.junit.empty())
        written = write_or_complain(context, flags.junit, suite_as_junit(result)) && written;
    const int code = result.exit_code();
    if (flags.html.wanted())
        written = write_or_complain(context, flags.html.path,
                                    suite_as_html(std::move(result), "suite", code, context.subjects)) &&
                  written;
    return written ? code : kExitUsage;
}

}  // namespace

Command add_suite(CLI::App& program) {
    auto flags = std::make_shared<SuiteFlags>();
    CLI::App* command = program.add_subcommand(
        "suite", "Compare ours with every peer, on every model under every boundary option");
    command->add_option("path", flags->paths, "folders of models, or model files")->capture_default_str();
    flags->work.add_to(*command);
    command->add_option("--jobs", flags->jobs, "cases (a model under one boundary option) at the same time")
        ->capture_default_str()
        ->check(CLI::Range(1, 1024));
    command->add_flag("--no-limit", flags->no_limit, "compare refinements only, not limits");
    command
        ->add_option("--shard", flags->shard,
                     "i/n, i from 0: compare every n-th case only; merge puts the JSON reports together")
        ->check([](const std::string& text) {
            return parse_shard(text) ? std::string()
                                     : text + " is no shard: the first of four is 0/4, the last 3/4";
        });
    command->add_option("--json", flags->json, "write the report as JSON");
    command->add_option("--junit", flags->junit, "write the report as JUnit XML");
    flags->html.add_to(*command, 1000);
    return [flags](const Context& context) { return run_suite_command(context, *flags); };
}

}  // namespace loopcheck::compare
