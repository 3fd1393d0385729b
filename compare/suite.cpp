#include "compare/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <set>

#include "compare/memory.h"
#include "compare/referee.h"

namespace loopcheck::compare {
namespace {

constexpr std::array kBoundaryRules{core::BoundaryRule::EdgeAndCorner, core::BoundaryRule::EdgeOnly,
                                    core::BoundaryRule::None};

struct Case {
    std::string name;
    const LoadedModel* model;
    core::SchemeOptions options;
};

std::vector<SuiteRow> run_case(const Case& one, std::span<const Subject> subjects,
                               const SuiteOptions& options) {
    Referee referee(one.model->mesh, one.options, options.levels);
    std::vector<SuiteRow> out;
    for (const Subject& peer : subjects) {
        const Subject* ours = in_precision(subjects, subjects.front(), peer.precision);
        if (ours == nullptr || peer.family == ours->family) continue;
        SuiteRow row{one.name, referee.judge(*ours, peer), std::nullopt};
        if (options.scope == Scope::Limits && ours->limit && peer.limit)
            row.limits = referee.judge_limits(*ours, peer);
        out.push_back(std::move(row));
    }
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

// The file name of a model, or its path where another model has the same file name.
std::string name_among(const std::vector<std::filesystem::path>& models, const std::filesystem::path& model) {
    const auto same = std::count_if(models.begin(), models.end(),
                                    [&](const auto& other) { return other.filename() == model.filename(); });
    return same == 1 ? model.filename().string() : model.string();
}

double bytes_per_vertex(std::span<const Subject> subjects, const core::SchemeOptions& options, Scope scope) {
    std::vector<const Subject*> all;
    for (const Subject& subject : subjects) all.push_back(&subject);
    return referee_bytes_per_vertex(all, options, scope);
}

}  // namespace

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
    SuiteResult result;
    result.models = models.size();
    result.levels = options.levels;

    std::vector<std::unique_ptr<LoadedModel>> loaded;
    std::vector<Case> cases;
    for (const auto& path : models) {
        const std::string name = name_among(models, path);
        auto model = load_model(path, options.triangulate);
        std::optional<core::Error> error;
        if (!model)
            error = model.error();
        else
            error = check_memory(
                model->mesh, options.levels,
                bytes_per_vertex(subjects, options_for_model(model->model, {}, {}, core::Weights::Loop),
                                 options.scope),
                options.memory_limit / options.jobs);
        if (error) {
            result.unreadable.push_back({name, *error});
            continue;
        }
        loaded.push_back(std::make_unique<LoadedModel>(std::move(*model)));
        for (const auto boundary : kBoundaryRules)
            cases.push_back(
                {name, loaded.back().get(),
                 options_for_model(loaded.back()->model, boundary, std::nullopt, core::Weights::Loop)});
    }

    std::vector<std::vector<SuiteRow>> outcomes(cases.size());
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
    for (auto& rows : outcomes)
        for (SuiteRow& row : rows) result.rows.push_back(std::move(row));
    return result;
}

}  // namespace loopcheck::compare
