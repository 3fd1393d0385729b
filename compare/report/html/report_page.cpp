#include "compare/report/html/report_page.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "compare/report/document.h"
#include "compare/report/html/chunk.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;
using Result = CaseSummary::Result;

Json json_of(const Result& r) {
    Json out{{"subject", r.subject},
             {"reference", r.reference},
             {"what", r.what},
             {"verdict", name(r.verdict)},
             {"deviations", r.deviations}};
    out["largest"] = r.largest ? Json(*r.largest) : Json();
    out["largest_in_uM"] = r.largest ? Json(*r.largest / r.unit) : Json();
    out["notes"] = r.notes;
    return out;
}

Json json_of(const CaseSummary& c, const std::optional<std::string>& chunk) {
    Json out{{"model", c.of.model}};
    if (chunk) out["chunk"] = *chunk;
    out.update({{"boundary", core::name(c.of.options.boundary)},
                {"creasing", core::name(c.of.options.creasing)},
                {"weights", core::name(c.of.options.weights)},
                {"vertices", c.of.vertices},
                {"faces", c.of.faces},
                {"boundary_edges", c.of.boundary_edges},
                {"results", Json::array()}});
    for (const Result& result : c.results) out["results"].push_back(json_of(result));
    return out;
}

Json deviations_json(const std::vector<CaseSummary>& cases) {
    std::set<std::string> seen;
    for (const CaseSummary& c : cases)
        for (const Result& result : c.results)
            seen.insert(result.deviations.begin(), result.deviations.end());
    Json out = Json::array();
    for (const KnownDeviation& deviation : known_deviations())
        if (seen.contains(std::string(deviation.name)))
            out.push_back({{"name", deviation.name},
                           {"kind", name(deviation.kind)},
                           {"family", deviation.family},
                           {"what", deviation.what},
                           {"versions", deviation.versions},
                           {"page", page_of(deviation)}});
    return out;
}

Json subjects_json(std::span<const Subject> subjects) {
    Json out = Json::array();
    for (const Subject& subject : subjects)
        out.push_back({{"name", subject.name},
                       {"version", subject.version},
                       {"precision", core::name(subject.precision)},
                       {"supports", subject.supports}});
    return out;
}

// Of levels of refinement or of limits; `stats_of` gives the statistics of positions of one.
template <class Levels, class StatsOf>
std::optional<double> largest_difference(const Levels& levels, StatsOf stats_of) {
    std::vector<double> differences;
    for (const auto& level : levels) {
        const ErrorStats stats = stats_of(total(level)).difference;
        differences.push_back(stats.not_finite > 0 ? std::numeric_limits<double>::infinity() : stats.max);
    }
    return largest_of(differences);
}

void add_results(const SuiteRow& row, std::vector<Result>& results) {
    const Comparison& c = row.comparison;
    Result refinement{c.subject, c.reference, "refinement", c.verdict, {}, {}, c.unit(), c.notes};
    if (c.verdict == Verdict::KnownDeviation) refinement.deviations.push_back(c.deviation);
    refinement.largest = largest_difference(c.levels, [](const ClassStats& all) { return all; });
    results.push_back(std::move(refinement));
    if (!row.limits) return;
    Result limits{c.subject, c.reference, "limits", row.limits->verdict, {}, {}, c.unit(), row.limits->notes};
    for (const DeviationSeen& seen : row.limits->deviations)
        if (seen.vertices > 0) limits.deviations.emplace_back(seen.deviation->name);
    limits.largest =
        largest_difference(row.limits->levels, [](const LimitStats& all) { return all.position; });
    results.push_back(std::move(limits));
}

}  // namespace

std::optional<double> largest_of(std::span<const double> differences) {
    std::optional<double> out;
    for (const double difference : differences) {
        if (!std::isfinite(difference)) return std::nullopt;
        out = std::max(out.value_or(0), difference);
    }
    return out;
}

std::string report_page(const ReportHead& head, std::vector<CaseSummary> cases) {
    Json header{{"version", LOOPCHECK_VERSION},
                {"command", head.command},
                {"exit_code", head.exit_code},
                {"sentence", head.sentence},
                {"levels", head.levels},
                {"subjects", subjects_json(head.subjects)},
                {"deviations", deviations_json(cases)},
                {"cases", Json::array()},
                {"unreadable", Json::array()}};
    for (const UnreadableModel& bad : head.unreadable) header["unreadable"].push_back(compare::json_of(bad));
    ChunkList list;
    for (CaseSummary& c : cases) {
        std::optional<std::string> id;
        if (c.of.chunk) id = list.add(std::move(*c.of.chunk));
        header["cases"].push_back(json_of(c, id));
    }
    std::vector<NamedChunk> chunks = std::move(list).chunks();
    chunks.insert(chunks.begin(), {"report", ChunkWriter().text(std::move(header))});
    return page_with(chunks);
}

std::string suite_as_html(SuiteResult suite, std::string_view command, int exit_code,
                          std::span<const Subject> subjects) {
    std::vector<CaseSummary> cases;
    std::size_t row = 0;
    for (SuiteCase& one : suite.cases) {
        CaseSummary& summary = cases.emplace_back(CaseSummary{std::move(one), {}});
        for (std::size_t i = 0; i < summary.of.rows; ++i) add_results(suite.rows[row++], summary.results);
    }
    return report_page(
        {command, exit_code, summary_in_words(suite, exit_code), suite.levels, subjects, suite.unreadable},
        std::move(cases));
}

}  // namespace loopcheck::compare
