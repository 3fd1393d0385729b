#include "compare/cli/cli.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <new>
#include <ostream>

#include "compare/cli/command.h"
#include "compare/memory.h"
#include "compare/report/html/page.h"
#include "compare/words.h"
#include "core/mesh/io/atomic_file.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {

void RuleFlags::add_to(CLI::App& command) {
    command
        .add_option("--boundary", boundary,
                    "edge-and-corner, edge-only or none; default: what the model says, else edge-and-corner")
        ->check(CLI::IsMember({"edge-and-corner", "edge-only", "none"}));
    command
        .add_option("--creasing", creasing, "uniform or chaikin; default: what the model says, else uniform")
        ->check(CLI::IsMember({"uniform", "chaikin"}));
    command.add_option("--weights", weights, "our weights at interior vertices: loop or warren")
        ->capture_default_str()
        ->check(CLI::IsMember({"loop", "warren"}));
}

core::SchemeOptions RuleFlags::for_model(const core::Model& model) const {
    return options_for_model(model, core::parse_boundary_rule(boundary), core::parse_creasing(creasing),
                             core::parse_weights(weights).value_or(core::Weights::Loop));
}

int exit_code_of(const core::Error& error) {
    const bool is_refusal =
        error.code == core::ErrorCode::SubjectFailed || error.code == core::ErrorCode::Unsupported;
    return is_refusal ? kExitFailed : kExitUsage;
}

namespace {

void add_memory(CLI::App& command, double& gib) {
    command.add_option("--memory", gib, "GiB that may be used; default: what is available")
        ->check([](const std::string& text) {
            const auto value = core::parse_double(text);
            return value && *value > 0 && std::isfinite(*value) ? std::string()
                                                                : text + " is not a positive number of GiB";
        });
}

void add_triangulate(CLI::App& command, bool& triangulate) {
    command.add_flag("--triangulate", triangulate, "split polygons by a fan from their first corner");
}

}  // namespace

void WorkFlags::add_to(CLI::App& command) {
    add_levels_to(command);
    add_triangulate(command, triangulate);
}

void WorkFlags::add_levels_to(CLI::App& command) {
    command.add_option("--levels", levels, "levels of refinement")
        ->capture_default_str()
        ->check(CLI::Range(0, 30));
    add_memory(command, memory_gib);
}

void WorkFlags::add_memory_to(CLI::App& command) {
    add_memory(command, memory_gib);
    add_triangulate(command, triangulate);
}

double WorkFlags::memory_limit() const {
    return memory_gib > 0 ? memory_gib * 1024 * 1024 * 1024 : available_memory();
}

std::string check_positive(const std::string& text) {
    const auto value = core::parse_double(text);
    return value && *value > 0 && std::isfinite(*value) ? std::string() : text + " is not a positive number";
}

std::string check_degrees(const std::string& text) {
    const auto value = core::parse_double(text);
    return value && *value >= 0 && *value <= 180 ? std::string()
                                                 : text + " is not an angle from 0 to 180 degrees";
}

void MeshFlags::add_to(CLI::App& command) {
    command
        .add_option("--crease-angle", crease_angle,
                    "make edges infinitely sharp where faces meet at more than so many degrees, 0 to 180")
        ->check(check_degrees);
}

std::optional<CreaseTags> MeshFlags::apply_to(core::TriangleMesh& mesh) const {
    if (!crease_angle) return std::nullopt;
    return tag_creases(mesh, *crease_angle + 0.0);  // -0 is 0
}

void HtmlFlags::add_to(CLI::App& command, std::size_t most_vertices) {
    vertices = most_vertices;
    CLI::Option* html =
        command.add_option("--html", path, "write the report as a page to look at, one HTML file");
    command
        .add_option("--html-vertices", vertices,
                    "in that file, levels of at most so many vertices; the others are named")
        ->capture_default_str()
        ->check(CLI::Range(1, 100'000'000))
        ->needs(html);
}

bool HtmlFlags::check(const Context& context) const {
    if (!wanted() || why_no_page().empty()) return true;
    context.err << why_no_page() << "\n";
    return false;
}

const Subject* find_or_complain(const Context& context, std::string_view name, const std::string& precision) {
    const Subject* subject = find_subject(context.subjects, name);
    if (subject != nullptr && precision == "float")
        subject = in_precision(context.subjects, *subject, core::Precision::Float);
    if (subject == nullptr)
        context.err << fmt::format("There is no subject {}; 'loopcheck subjects' lists what there is.\n",
                                   name);
    return subject;
}

core::Result<LoadedModel> load_or_complain(const Context& context, const std::string& path,
                                           bool triangulate) {
    auto model = load_model(path, triangulate);
    if (!model) {
        complain(context, path, model.error());
        return model;
    }
    for (const std::string& warning : model->model.warnings)
        context.err << fmt::format("{}: warning: {}\n", path, warning);
    return model;
}

void complain(const Context& context, const std::string& path, const core::Error& error) {
    context.err << fmt::format("{}: {}\n", printable(path), printable(core::to_string(error)));
}

core::Error on_its_line(core::Error error, const core::PointsFile& file) {
    // The vertices of a grid are its points.
    if (error.place.kind == core::Place::Kind::Point || error.place.kind == core::Place::Kind::Vertex)
        error.place = {core::Place::Kind::Line, file.lines[static_cast<std::size_t>(error.place.index)]};
    return error;
}

bool outputs_clash(const Context& context, std::span<const std::string> outputs,
                   std::span<const std::string> inputs) {
    const auto canonical = [](const std::string& path) {
        std::error_code ignored;
        return std::filesystem::weakly_canonical(path, ignored);
    };
    std::vector<std::filesystem::path> taken;
    for (const std::string& input : inputs) taken.push_back(canonical(input));
    for (const std::string& output : outputs) {
        if (output.empty() || output.starts_with("/dev/")) continue;
        if (std::find(taken.begin(), taken.end(), canonical(output)) != taken.end()) {
            context.err << fmt::format("{}: is read or written already; nothing was done.\n",
                                       printable(output));
            return true;
        }
        taken.push_back(canonical(output));
    }
    return false;
}

bool write_or_complain(const Context& context, const std::string& path, std::string_view bytes) {
    const auto written = core::write_file(path, bytes);
    if (!written) complain(context, path, written.error());
    return written.has_value();
}

Progress::Progress(const Context& context)
    : err_(context.err), on_terminal_(&context.err == &std::cerr && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    show("");
}

void Progress::show(const std::string& line) {
    if (on_terminal_) err_ << "\r\x1b[K" << line << std::flush;
}

int run(const std::vector<std::string>& arguments, std::span<const Subject> subjects, std::ostream& out,
        std::ostream& err) {
    CLI::App program("Checks Loop subdivision against OpenSubdiv and others, vertex by vertex.", "loopcheck");
    program.set_version_flag("--version", "loopcheck " LOOPCHECK_VERSION);
    program.require_subcommand(1);
    program.footer(
        "Examples\n"
        "  loopcheck compare models/cow.obj                       ours against OpenSubdiv, 5 levels\n"
        "  loopcheck compare cow.obj --weights warren --top 3     where Warren's weights differ, and by how "
        "much\n"
        "  loopcheck compare cow.obj --html cow.html              a page to look at, with every vertex\n"
        "  loopcheck suite models --jobs 2 --junit suite.xml      every model, boundary option and peer\n"
        "  loopcheck refine cow.obj -o fine.ply --levels 3        the refined mesh\n"
        "  loopcheck explain cow.obj --vertex 17                  the rule at that vertex, and why\n"
        "  loopcheck limit models/cow.obj                         OpenSubdiv's surfaces against the exact "
        "one\n"
        "  loopcheck atlas                                        how far they are off at each kind of "
        "vertex\n"
        "  loopcheck curve points.txt --compare opensubdiv        a B-spline curve, and the same in a "
        "boundary\n"
        "  loopcheck stencils cow.obj --limit -o limit.mtx        the limit of every vertex as a matrix\n"
        "\n"
        "Exit codes: 0 agree, 1 differ, 2 bad usage or unreadable input, 3 a subject failed or cannot do "
        "it.");
    const std::vector<Command> commands{add_compare(program), add_curve(program),    add_grid(program),
                                        add_suite(program),   add_merge(program),    add_refine(program),
                                        add_limit(program),   add_atlas(program),    add_deviations(program),
                                        add_explain(program), add_stencils(program), add_subjects(program)};
    try {
        program.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& error) {
        return program.exit(error, out, err) == 0 ? 0 : kExitUsage;
    }
    const Context context{subjects, out, err};
    const auto all = program.get_subcommands({});
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]->parsed()) try {
                return commands[i](context);
            } catch (const std::bad_alloc&) {
                err << "Out of memory; fewer levels or a smaller model need less.\n";
                return kExitFailed;
            }
    return kExitUsage;
}

}  // namespace loopcheck::compare
