#include "compare/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "compare/memory.h"
#include "compare/referee.h"
#include "compare/report/html/mesh_case.h"

namespace loopcheck::compare {
namespace {

struct Case {
    std::string name;
    const LoadedModel* model;
    core::SchemeOptions options;
};

struct CaseResult {
    std::vector<SuiteRow> rows;
    std::optional<std::string> chunk;
};

// The row of one pair, kept for the report too where there is one.
SuiteRow run_pair(const std::string& name, Referee& referee, const Subject& ours, const Subject& peer,
                  Scope scope, MeshCase* shown) {
    const bool limits = scope == Scope::Limits && ours.limit && peer.limit;
    SuiteRow row{name, {}, std::nullopt};
    if (shown == nullptr) {
        row.comparison = referee.judge(ours, peer);
        if (limits) row.limits = referee.judge_limits(ours, peer);
        return row;
    }
    shown->begin(ours, peer);
    const auto keep = [&](const auto& record) { shown->add(record); };
    row.comparison = referee.judge(ours, peer, kWorstListedInSuite, keep);
    if (limits) row.limits = referee.judge_limits(ours, peer, kWorstListedInSuite, keep);
    shown->end(row.comparison, row.limits);
    for (LevelResult& level : row.comparison.levels) level.worst = {};
    if (row.limits)
        for (LimitLevelResult& level : row.limits->levels) level.worst = {};
    return row;
}

CaseResult run_case(const Case& one, std::span<const Subject> subjects, const SuiteOptions& options) {
    const core::TriangleMesh& mesh = one.model->mesh;
    Referee referee(mesh, one.options, options.levels);
    std::optional<MeshCase> shown;
    if (options.shown_vertices > 0)
        shown.emplace(mesh, shown_levels(mesh, options.levels, options.shown_vertices));
    CaseResult out;
    for (const Subject& peer : subjects) {
        const Subject* ours = in_precision(subjects, subjects.front(), peer.precision);
        if (ours == nullptr || peer.family == ours->family) continue;
        out.rows.push_back(
            run_pair(one.name, referee, *ours, peer, options.scope, shown ? &*shown : nullptr));
    }
    if (shown)
        if (const auto& exact = referee.exact(subjects.front())) out.chunk = std::move(*shown).chunk(*exact);
    return out;
}

std::vector<std::filesystem::path> without_repetition(std::span<const std::filesystem::path> paths) {
    std::vector<std::filesystem::path> out;
    std::set<std::filesystem::path> seen;
    for (const auto& path : paths) {
        std::error_code ignored;
        if (seen.insert(std::filesystem::weakly_canonical(path, ignored)).second) out.push_back(path);
    }
    return out;
}

// The file name of each model, or its path where another model has the same file name.
std::vector<std::string> names_of(std::span<const std::filesystem::path> models) {
    std::map<std::filesystem::path, int> count;
    for (const auto& model : models) ++count[model.filename()];
    std::vector<std::string> out;
    for (const auto& model : models)
        out.push_back(count[model.filename()] == 1 ? model.filename().string() : model.string());
    return out;
}

std::vector<CorpusModel> corpus_of(std::span<const std::filesystem::path> models,
                                   std::span<const std::string> names) {
    std::vector<CorpusModel> out;
    for (std::size_t m = 0; m < models.size(); ++m) out.push_back({names[m], fingerprint(models[m])});
    return out;
}

// On another machine the same file may be read and fit.
bool depends_on_machine(core::ErrorCode code) {
    return code == core::ErrorCode::CannotRead || code == core::ErrorCode::OutOfMemory;
}

double bytes_per_vertex(std::span<const Subject> subjects, const core::SchemeOptions& rules,
                        const SuiteOptions& options, const core::TriangleMesh& mesh) {
    std::vector<const Subject*> all;
    for (const Subject& subject : subjects) all.push_back(&subject);
    const double shown =
        options.shown_vertices > 0
            ? shown_bytes(mesh, options.levels, options.shown_vertices, all.size(), options.scope)
            : 0;
    return referee_bytes_per_vertex(all, rules, options.scope) +
           shown / level_size(mesh, options.levels).vertices;
}

}  // namespace

SuiteCase make_case(std::string model, const core::TriangleMesh& mesh, const core::SchemeOptions& options) {
    const core::Topology& t = mesh.topology();
    std::size_t boundary = 0;
    for (core::Index e = 0; e < t.edge_count(); ++e)
        if (t.is_boundary_edge(e)) ++boundary;
    return {std::move(model), options, static_cast<std::size_t>(t.vertex_count), t.triangles.size(),
            boundary};
}

std::size_t SuiteResult::limit_rows() const {
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const SuiteRow& row) { return row.limits.has_value(); }));
}

std::size_t SuiteResult::count(Verdict verdict) const {
    std::size_t out = 0;
    for (const SuiteRow& row : rows) {
        if (row.comparison.verdict == verdict) ++out;
        if (row.limits && row.limits->verdict == verdict) ++out;
    }
    return out;
}

int SuiteResult::exit_code() const {
    int code = unreadable.empty() ? 0 : 2;
    for (const SuiteRow& row : rows)
        for (const Verdict verdict : {row.comparison.verdict, row.limit_verdict()})
            if (verdict != Verdict::NotSupported) code = worse_exit_code(code, compare::exit_code(verdict));
    return code;
}

core::Result<std::vector<std::filesystem::path>> find_models(const std::filesystem::path& folder) {
    std::error_code code;
    std::vector<std::filesystem::path> out;
    for (std::filesystem::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
        if (it->is_regular_file() && core::format_of(it->path())) out.push_back(it->path());
    if (code)
        return core::fail(core::ErrorCode::CannotRead,
                          fmt::format("The folder {} cannot be read: {}.", folder.string(), code.message()));
    std::sort(out.begin(), out.end());
    return out;
}

SuiteResult run_suite(std::span<const std::filesystem::path> paths, std::span<const Subject> subjects,
                      const SuiteOptions& options, const SuiteProgress& progress) {
    const auto models = without_repetition(paths);
    const auto names = names_of(models);
    const Shard shard = options.shard.value_or(Shard{});
    SuiteResult result;
    result.levels = options.levels;

    std::vector<std::unique_ptr<LoadedModel>> loaded;
    std::vector<Case> cases;
    std::size_t owned = 0;
    for (std::size_t m = 0; m < models.size(); ++m) {
        std::vector<core::BoundaryRule> boundaries;
        for (std::size_t b = 0; b < kSuiteBoundaries.size(); ++b)
            if (shard.has(m, b)) boundaries.push_back(kSuiteBoundaries[b]);
        if (boundaries.empty()) continue;
        owned += boundaries.size();
        ++result.models;
        auto model = load_model(models[m], options.triangulate);
        std::optional<core::Error> error;
        if (!model)
            error = model.error();
        else
            error = check_memory(
                model->mesh, options.levels,
                bytes_per_vertex(subjects, options_for_model(model->model, {}, {}, core::Weights::Loop),
                                 options, model->mesh),
                options.memory_limit / options.jobs);
        if (error) {
            if (shard.has(m, 0) || depends_on_machine(error->code))
                result.unreadable.push_back({names[m], *error});
            continue;
        }
        loaded.push_back(std::make_unique<LoadedModel>(std::move(*model)));
        for (const auto boundary : boundaries)
            cases.push_back(
                {names[m], loaded.back().get(),
                 options_for_model(loaded.back()->model, boundary, std::nullopt, core::Weights::Loop)});
    }
    if (options.shard)
        result.shard = {shard, owned, options.scope, options.triangulate, corpus_of(models, names)};

    std::vector<CaseResult> outcomes(cases.size());
    std::atomic<std::size_t> next = 0;
    std::size_t done = 0;
    std::mutex progress_mutex;
    const auto work = [&] {
        for (std::size_t i = next++; i < cases.size(); i = next++) {
            outcomes[i] = run_case(cases[i], subjects, options);
            const std::lock_guard lock(progress_mutex);
            progress(++done, cases.size(), cases[i].name);
        }
    };
    std::vector<std::future<void>> workers;
    for (int j = 0; j < options.jobs; ++j) workers.push_back(std::async(std::launch::async, work));
    for (auto& worker : workers) worker.get();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SuiteCase& done_case =
            result.cases.emplace_back(make_case(cases[i].name, cases[i].model->mesh, cases[i].options));
        done_case.rows = outcomes[i].rows.size();
        done_case.chunk = std::move(outcomes[i].chunk);
        std::move(outcomes[i].rows.begin(), outcomes[i].rows.end(), std::back_inserter(result.rows));
    }
    return result;
}

}  // namespace loopcheck::compare
