// loopcheck compare: two subjects on some models.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "compare/cli/adaptive_flags.h"
#include "compare/memory.h"
#include "compare/referee.h"
#include "compare/report/bits.h"
#include "compare/report/html/mesh_case.h"
#include "compare/report/html/report_page.h"
#include "compare/report/refinement.h"
#include "compare/report/report.h"

namespace loopcheck::compare {
namespace {

struct CompareFlags {
    std::vector<std::string> models;
    std::string subject = "ours", reference = "opensubdiv", precision = "double";
    RuleFlags rules;
    MeshFlags mesh;
    WorkFlags work;
    AdaptiveFlags adaptive;
    HtmlFlags html;
    std::string json, csv, ply;
    int top = 1, jobs = 1;
    bool limit = false, bits = false;

    /// Whether something is wanted that takes all vertices of all levels.
    bool wants_vertices() const { return limit || !csv.empty() || !ply.empty() || html.wanted(); }
};

// What the per-vertex reports have gathered so far.
struct VertexReports {
    CsvReport csv;
    std::optional<PlyReport> ply;
    SuiteResult shown;  // for HTML
};

std::size_t to_count(double size) {
    return static_cast<std::size_t>(size);
}

// Bytes per vertex of the last level.
double bytes_per_vertex(const CompareFlags& flags, const core::TriangleMesh& mesh,
                        const core::SchemeOptions& options, const Subject& a, const Subject& b) {
    const std::array both{&a, &b};
    const Scope scope = flags.limit ? Scope::Limits : Scope::Refinement;
    return referee_bytes_per_vertex(both, options, scope) + (flags.csv.empty() ? 0 : kCsvBytesPerVertex) +
           (flags.ply.empty() ? 0 : kPlyBytesPerVertex) +
           (flags.html.wanted() ? shown_bytes(mesh, flags.work.levels, flags.html.vertices, 1, scope) /
                                      level_size(mesh, flags.work.levels).vertices
                                : 0);
}

// Leaves the first `top` of the worst vertices of each level.
template <class Levels>
void keep_top(Levels& levels, int top) {
    for (auto& level : levels)
        if (level.worst.size() > to_count(top)) level.worst.resize(to_count(top));
}

core::Result<ModelReport> compare_model(const Context& context, const CompareFlags& flags,
                                        const std::string& path, const LoadedModel& model, const Subject& a,
                                        const Subject& b, VertexReports& reports) {
    const core::SchemeOptions options = flags.rules.for_model(model.model);
    if (auto error =
            check_memory(model.mesh, flags.work.levels, bytes_per_vertex(flags, model.mesh, options, a, b),
                         flags.work.memory_limit())) {
        complain(context, path, *error);
        return tl::unexpected(std::move(*error));
    }
    Progress progress(context);
    progress.show(fmt::format("{}: refining {} levels", path, flags.work.levels));
    Referee referee(model.mesh, options, flags.work.levels);
    const double unit = error_unit(model.mesh.largest_coordinate(), a.precision, b.precision);
    if (!flags.ply.empty())
        reports.ply.emplace(flags.work.levels, to_count(level_size(model.mesh, flags.work.levels).vertices));
    if (!flags.csv.empty()) {
        double rows = 0;
        for (int l = 0; l <= flags.work.levels; ++l) rows += level_size(model.mesh, l).vertices;
        reports.csv.reserve(to_count(rows));
    }
    std::optional<MeshCase> shown;
    if (flags.html.wanted()) {
        shown.emplace(model.mesh, shown_levels(model.mesh, flags.work.levels, flags.html.vertices));
        shown->begin(a, b);
    }
    VertexVisitor visit;
    if (!flags.csv.empty() || reports.ply || shown)
        visit = [&](const VertexRecord& record) {
            if (!flags.csv.empty()) reports.csv.add(path, record, unit);
            if (reports.ply) reports.ply->add(record);
            if (shown) shown->add(record);
        };
    LimitVisitor visit_limit;
    if (shown) visit_limit = [&](const LimitRecord& record) { shown->add(record); };
    const int top = shown ? std::max(flags.top, kWorstListed) : flags.top;
    auto comparison = referee.judge(a, b, top, visit);
    std::optional<LimitComparison> limits;
    if (flags.limit) {
        progress.show(fmt::format("{}: limits of {} levels", path, flags.work.levels));
        limits = referee.judge_limits(a, b, top, visit_limit);
    }
    if (shown) {
        progress.show(fmt::format("{}: gathering what the page shows", path));
        shown->end(comparison, limits);
        keep_top(comparison.levels, flags.top);
        if (limits) keep_top(limits->levels, flags.top);
        SuiteCase& one = reports.shown.cases.emplace_back(make_case(path, model.mesh, options));
        one.rows = 1;
        if (const auto& exact = referee.exact(a)) one.chunk = std::move(*shown).chunk(*exact);
        reports.shown.rows.push_back({path, comparison, limits});
    }
    return make_report(path, model.mesh, std::move(comparison), std::move(limits));
}

// The faces of the last level, in our order, for the PLY report.
std::vector<core::Triangle> last_triangles(const core::TriangleMesh& mesh, int levels) {
    core::Topology topology = mesh.topology();
    for (int l = 0; l < levels; ++l) topology = core::split(topology).value();
    return std::move(topology.triangles);
}

// Our adaptive refinement of one model against the uniform one of `b`.
int run_adaptive(const Context& context, const CompareFlags& flags, const Subject& ours, const Subject& b) {
    if (ours.family != "ours") {
        context.err << fmt::format("{} has no adaptive refinement.\n", ours.name);
        return kExitFailed;
    }
    const std::string& path = flags.models.front();
    auto model = load_or_complain(context, path, flags.work.triangulate);
    if (!model) return kExitUsage;
    const auto creases = flags.mesh.apply_to(model->mesh);
    const auto criterion = flags.adaptive.criterion(context, model->mesh);
    if (!criterion) return kExitUsage;
    const core::SchemeOptions options = flags.rules.for_model(model->model);
    const std::array both{&ours, &b};
    const double limit = flags.work.memory_limit();
    // The adaptive levels have fewer faces together than 4/3 of the last uniform one, which has 2 a vertex.
    const double bytes = referee_bytes_per_vertex(both, options) + kUniformLevelsBytesPerVertex +
                         2 * 4.0 / 3 * kAdaptiveBytesPerFace;
    if (const auto error = check_memory(model->mesh, flags.work.levels, bytes, limit)) {
        complain(context, path, *error);
        return kExitUsage;
    }
    Progress progress(context);
    progress.show(fmt::format("{}: refining {} levels", path, flags.work.levels));
    const auto refined =
        refine_adaptively(model->mesh, options, *criterion, ours.precision, flags.work.levels, limit);
    if (!refined) {
        complain(context, path, refined.error());
        return exit_code_of(refined.error());
    }
    const AdaptiveReport report{path, creases, flags.adaptive.in_words(),
                                compare_adaptive(model->mesh, options, *refined, ours, b)};
    context.out << adaptive_as_text(report, b.version);
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, adaptive_as_json(report, context.subjects)))
        return kExitUsage;
    return exit_code(report.comparison.verdict);
}

// The command that judges this model by the exact rules, at the deepest level that memory allows.
std::string next_command(const CompareFlags& flags, const std::string& path, const LoadedModel& model,
                         const core::SchemeOptions& options, const Subject& a, const Subject& b) {
    const std::array both{&a, &b};
    int levels = flags.work.levels;
    while (levels > 1 && check_memory(model.mesh, levels, referee_bytes_per_vertex(both, options),
                                      flags.work.memory_limit()))
        --levels;
    std::string out =
        fmt::format("loopcheck compare {} --subject {} --with {} --levels {}", path, a.name, b.name, levels);
    if (!flags.rules.boundary.empty()) out += " --boundary " + flags.rules.boundary;
    if (!flags.rules.creasing.empty()) out += " --creasing " + flags.rules.creasing;
    if (flags.rules.weights != "loop") out += " --weights " + flags.rules.weights;
    if (flags.mesh.crease_angle) out += fmt::format(" --crease-angle {}", *flags.mesh.crease_angle);
    if (flags.work.triangulate) out += " --triangulate";
    return out;
}

core::Result<BitReport> compare_bits_of(const Context& context, const CompareFlags& flags,
                                        const std::string& path, LoadedModel& model, const Subject& a,
                                        const Subject& b) {
    const auto creases = flags.mesh.apply_to(model.mesh);
    const core::SchemeOptions options = flags.rules.for_model(model.model);
    const BlockLimits limits{flags.work.memory_limit(), flags.jobs,
                             (model.mesh.face_count() - 1) / flags.jobs + 1};
    Progress progress(context);
    progress.show(fmt::format("{}: dividing {} faces", path, model.mesh.face_count()));
    auto comparison = compare_bits(model.mesh, options, a.precision, flags.work.levels, limits,
                                   [&](std::size_t done, std::size_t of) {
                                       progress.show(fmt::format("{}: block {} of {}", path, done, of));
                                   });
    if (!comparison) return tl::unexpected(comparison.error());
    BitReport out{path, creases, *comparison, {}};
    if (comparison->verdict() != Verdict::Identical)
        out.next = next_command(flags, path, model, options, a, b);
    return out;
}

// The bits of the last level of ours and OpenSubdiv's.
int run_bits(const Context& context, const CompareFlags& flags, const Subject& a, const Subject& b) {
    if (a.family != "ours" || b.family != "opensubdiv" || a.precision != b.precision) {
        context.err << "--bits compares ours with opensubdiv, in one precision.\n";
        return kExitUsage;
    }
    int code = 0;
    std::vector<BitReport> reports;
    for (const std::string& path : flags.models) {
        auto model = load_or_complain(context, path, flags.work.triangulate);
        if (!model) {
            code = worse_exit_code(code, kExitUsage);
            continue;
        }
        auto report = compare_bits_of(context, flags, path, *model, a, b);
        if (!report) {
            complain(context, path, report.error());
            code = worse_exit_code(code, exit_code_of(report.error()));
            continue;
        }
        code = worse_exit_code(code, exit_code(report->comparison.verdict()));
        context.out << (reports.empty() ? "" : "\n") << bits_as_text(*report, a, b);
        reports.push_back(std::move(*report));
    }
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, bits_as_json(reports, context.subjects, code)))
        return kExitUsage;
    return code;
}

int run_compare(const Context& context, const CompareFlags& flags) {
    if (!flags.html.check(context)) return kExitUsage;
    const Subject* a = find_or_complain(context, flags.subject, flags.precision);
    const Subject* b = find_or_complain(context, flags.reference, flags.precision);
    if (a == nullptr || b == nullptr) return kExitUsage;
    if (!flags.ply.empty() && flags.models.size() > 1) {
        context.err << "--ply takes one model.\n";
        return kExitUsage;
    }
    if (flags.rules.weights != "loop" && !a->has_weight_option && !b->has_weight_option) {
        context.err << fmt::format("{} and {} have Loop's weights only.\n", a->name, b->name);
        return kExitFailed;
    }
    if (flags.limit && !(flags.csv.empty() && flags.ply.empty()))
        context.err << "--csv and --ply have the refinement only, not the limits.\n";
    const std::array outputs{flags.json, flags.csv, flags.ply, flags.html.path};
    if (outputs_clash(context, outputs, flags.models)) return kExitUsage;
    if (flags.adaptive.on) {
        if (flags.models.size() > 1 || flags.wants_vertices()) {
            context.err << "--adaptive takes one model, and goes without --limit, --csv, --ply and --html.\n";
            return kExitUsage;
        }
        return run_adaptive(context, flags, *a, *b);
    }
    if (flags.bits) {
        if (flags.wants_vertices()) {
            context.err << "--bits goes without --limit, --csv, --ply and --html.\n";
            return kExitUsage;
        }
        return run_bits(context, flags, *a, *b);
    }
    int code = 0;
    VertexReports vertices;
    std::vector<ModelReport> reports;
    for (const std::string& path : flags.models) {
        auto model = load_or_complain(context, path, flags.work.triangulate);
        const auto creases = model ? flags.mesh.apply_to(model->mesh) : std::nullopt;
        auto report = model ? compare_model(context, flags, path, *model, *a, *b, vertices)
                            : core::Result<ModelReport>(tl::unexpected(model.error()));
        if (!report) {
            vertices.shown.unreadable.push_back({path, report.error()});
            code = worse_exit_code(code, kExitUsage);
            continue;
        }
        report->creases = creases;
        code = worse_exit_code(code, exit_code(report->comparison.verdict));
        if (report->limits) code = worse_exit_code(code, exit_code(report->limits->verdict));
        reports.push_back(std::move(*report));
        context.out << (reports.size() > 1 ? "\n" : "")
                    << comparison_as_text(reports.back(), context.subjects);
        const bool compared = !reports.back().comparison.levels.empty();
        if (vertices.ply && compared &&
            !write_or_complain(
                context, flags.ply,
                vertices.ply->text(last_triangles(model->mesh, flags.work.levels),
                                   fmt::format("quality: |{} - {}| in model units", a->name, b->name))))
            code = kExitUsage;
    }
    if (!flags.csv.empty() && !write_or_complain(context, flags.csv, vertices.csv.text())) code = kExitUsage;
    if (!flags.json.empty() &&
        !write_or_complain(context, flags.json, comparisons_as_json(reports, context.subjects, code)))
        code = kExitUsage;
    if (flags.html.wanted()) {
        vertices.shown.models = flags.models.size();
        vertices.shown.levels = flags.work.levels;
        const std::string page = suite_as_html(std::move(vertices.shown), "compare", code, context.subjects);
        if (!write_or_complain(context, flags.html.path, page)) code = kExitUsage;
    }
    return code;
}

}  // namespace

Command add_compare(CLI::App& program) {
    auto flags = std::make_shared<CompareFlags>();
    CLI::App* command = program.add_subcommand("compare", "Compare two subjects on models, vertex by vertex");
    command->add_option("model", flags->models, "OBJ, OFF, PLY or STL files")->required();
    command->add_option("--with", flags->reference, "the reference: what to compare with")
        ->capture_default_str();
    command->add_option("--subject", flags->subject, "what is compared")->capture_default_str();
    command->add_option("--precision", flags->precision, "double or float, for both")
        ->capture_default_str()
        ->check(CLI::IsMember({"double", "float"}));
    flags->rules.add_to(*command);
    flags->mesh.add_to(*command);
    flags->work.add_to(*command);
    flags->adaptive.add_to(*command);
    CLI::Option* bits = command
                            ->add_flag("--bits", flags->bits,
                                       "the bits of the last level only, in blocks of faces and without the "
                                       "exact rules: for what does not fit into memory at once")
                            ->excludes("--adaptive");
    command->add_option("--jobs", flags->jobs, "blocks compared at the same time")
        ->capture_default_str()
        ->check(CLI::Range(1, 1024))
        ->needs(bits);
    command->add_flag("--limit", flags->limit,
                      "compare the limits of all vertices too: positions and normals");
    command->add_option("--json", flags->json, "write the report as JSON");
    command->add_option("--csv", flags->csv, "write one line a vertex");
    command->add_option("--ply", flags->ply,
                        "write the last level with the error as vertex scalar 'quality'");
    flags->html.add_to(*command, 100'000);
    command->add_option("--top", flags->top, "how many of the worst vertices to show")
        ->capture_default_str()
        ->check(CLI::Range(0, 100000));
    return [flags](const Context& context) { return run_compare(context, *flags); };
}

}  // namespace loopcheck::compare
