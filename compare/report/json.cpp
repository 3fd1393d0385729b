#include "compare/report/json.h"

#include <fmt/format.h>

#include "compare/limit/words.h"
#include "compare/report/document.h"
#include "compare/report/report.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ErrorStats& stats, double unit) {
    return {{"identical", stats.identical},
            {"not_finite", stats.not_finite},
            {"max", stats.max},
            {"mean", stats.mean()},
            {"rms", stats.rms()},
            {"max_in_uM", stats.max / unit}};
}

Json json_of(const ClassStats& stats, const Comparison& c) {
    Json out{{"vertices", stats.difference.count},
             {"difference", json_of(stats.difference, c.unit())},
             {"subject_error", json_of(stats.subject_error, c.unit())},
             {"reference_error", json_of(stats.reference_error, c.unit())},
             {"bound_use", stats.largest_bound_use},
             {"largest_bound_in_uM", stats.largest_bound / c.unit()},
             {"beyond_bound", stats.beyond_bound},
             {"rule_mismatches", stats.rule_mismatches},
             {"predicted", stats.predicted}};
    if (c.diagonal > 0) out["difference"]["max_over_diagonal"] = stats.difference.max / c.diagonal;
    return out;
}

Json json_of(const VertexRecord& r) {
    Json out{{"vertex", r.vertex},
             {"subject_vertex", r.subject_vertex},
             {"reference_vertex", r.reference_vertex},
             {"class", core::to_string(r.vertex_class)},
             {"rule", rule_in_words(r)},
             {"error", r.error},
             {"subject_error", r.subject_error},
             {"reference_error", r.reference_error},
             {"bound", r.bound},
             {"bound_use", r.bound_use},
             {"subject", position_json(r.subject)},
             {"reference", position_json(r.reference)},
             {"exact", position_json(r.exact)}};
    if (r.level > 0) {
        const bool vertex = r.ancestor.kind == core::Ancestor::Kind::Vertex;
        out["ancestor"] = vertex ? Json{{"vertex", r.ancestor.index}}
                                 : Json{{"face", r.ancestor.index / 3}, {"edge", r.ancestor.index % 3}};
    }
    return out;
}

Json json_of(const LimitStats& stats, const Comparison& c);
Json json_of(const LimitRecord& record);

// What a level has in detail: each class, and the worst vertices.
template <class Level>
void add_classes_and_worst(Json& out, const Level& level, const Comparison& c) {
    out["classes"] = Json::array();
    for (const auto& [vertex_class, stats] : level.classes) {
        Json entry{{"class", core::to_string(vertex_class)}};
        entry.update(json_of(stats, c));
        out["classes"].push_back(std::move(entry));
    }
    out["worst"] = Json::array();
    for (const auto& record : level.worst) out["worst"].push_back(json_of(record));
}

Json json_of(const LevelResult& level, const Comparison& c, Detail detail) {
    Json out{{"level", level.level},
             {"verdict", name(level.verdict)},
             {"faces", level.faces},
             {"all", json_of(total(level), c)}};
    if (detail == Detail::Levels) return out;
    add_classes_and_worst(out, level, c);
    return out;
}

// -- Limits.  Angles in degrees.

Json angles(const ErrorStats& stats) {
    return {{"identical", stats.identical},
            {"not_finite", stats.not_finite},
            {"max", in_degrees(stats.max)},
            {"mean", in_degrees(stats.mean())},
            {"rms", in_degrees(stats.rms())}};
}

Json normals_of(const LimitStats& all) {
    const ClassStats& stats = all.normal;
    Json out{{"compared", stats.difference.count},
             {"undefined", Json::object()},
             {"undetermined", all.undetermined},
             {"difference", angles(stats.difference)},
             {"subject_error", angles(stats.subject_error)},
             {"reference_error", angles(stats.reference_error)},
             {"bound_use", stats.largest_bound_use},
             {"beyond_bound", stats.beyond_bound},
             {"unexplained", stats.unexplained},
             {"predicted", in_degrees(stats.predicted)}};
    for (const auto& [reason, count] : all.undefined)
        out["undefined"][std::string(core::name(reason))] = count;
    return out;
}

Json json_of(const DriftStats& drift, double unit) {
    return {{"position", json_of(drift.position, unit)},
            {"normal", angles(drift.normal)},
            {"unexplained", drift.unexplained}};
}

Json json_of(const LimitStats& stats, const Comparison& c) {
    Json position = json_of(stats.position, c);
    position["unexplained"] = stats.position.unexplained;
    return {{"position", position},
            {"normal", normals_of(stats)},
            {"as_deviation", stats.as_deviation},
            {"vanished", stats.vanished},
            {"by_declaration", stats.by_declaration},
            {"subject_drift", json_of(stats.subject_drift, c.unit())},
            {"reference_drift", json_of(stats.reference_drift, c.unit())}};
}

Json json_of(const LimitRecord& r) {
    Json out{{"position", json_of(r.position)}};
    if (!r.deviation.empty()) out["deviation"] = r.deviation;
    const NormalRecord& n = r.normal;
    if (n.status == NormalStatus::Undefined) out["no_normal"] = core::name(n.reason);
    if (n.status != NormalStatus::Compared) return out;
    out["normal"] = {{"error", in_degrees(n.error)},
                     {"subject_error", in_degrees(n.subject_error)},
                     {"reference_error", in_degrees(n.reference_error)},
                     {"bound", in_degrees(n.bound)},
                     {"bound_use", n.bound_use},
                     {"subject", position_json(n.subject)},
                     {"reference", position_json(n.reference)},
                     {"exact", position_json(n.exact)}};
    return out;
}

Json json_of(const LimitLevelResult& level, const Comparison& c, Detail detail) {
    Json out{{"level", level.level}, {"verdict", name(level.verdict)}, {"all", json_of(total(level), c)}};
    if (detail == Detail::Levels) return out;
    add_classes_and_worst(out, level, c);
    return out;
}

Json json_of(const DeviationSeen& seen) {
    return {
        {"name", seen.deviation->name},
        {"kind", name(seen.deviation->kind)},
        {"subject", seen.subject},
        {"vertices", seen.vertices},
        {"vanished", seen.vanished},
        {"position", {{"predicted", seen.predicted_position}, {"observed", seen.observed_position}}},
        {"normal",
         {{"predicted", in_degrees(seen.predicted_angle)}, {"observed", in_degrees(seen.observed_angle)}}}};
}

Json json_of(const LimitComparison& limits, const Comparison& c, Detail detail) {
    Json out{{"verdict", name(limits.verdict)}, {"notes", limits.notes}};
    out["deviations"] = Json::array();
    for (const DeviationSeen& seen : limits.deviations) out["deviations"].push_back(json_of(seen));
    out["levels"] = Json::array();
    for (const LimitLevelResult& level : limits.levels) out["levels"].push_back(json_of(level, c, detail));
    return out;
}

std::string hexadecimal(std::uint32_t crc32) {
    return fmt::format("{:08x}", crc32);
}

Json json_of(const ShardOfSuite& part, int levels) {
    Json out{{"index", part.shard.index},
             {"of", part.shard.of},
             {"cases", part.cases},
             {"levels", levels},
             {"limits", part.scope == Scope::Limits},
             {"triangulate", part.triangulate},
             {"corpus", Json::array()},
             {"checksum", ""}};
    for (const CorpusModel& model : part.corpus) {
        Json& entry = out["corpus"].emplace_back(Json{{"model", model.name}});
        if (model.fingerprint)
            entry.update(
                {{"bytes", model.fingerprint->bytes}, {"crc32", hexadecimal(model.fingerprint->crc32)}});
    }
    return out;
}

}  // namespace

Json json_of(const Comparison& c, const std::optional<LimitComparison>& limits, Detail detail) {
    Json out{{"subject", c.subject},
             {"reference", c.reference},
             {"boundary", core::name(c.options.boundary)},
             {"creasing", core::name(c.options.creasing)},
             {"weights", core::name(c.options.weights)},
             {"verdict", name(c.verdict)},
             {"notes", c.notes}};
    if (!c.deviation.empty()) out["deviation"] = c.deviation;
    out["largest_coordinate"] = c.largest_coordinate;
    out["diagonal"] = c.diagonal;
    out["uM"] = c.unit();
    out["levels"] = Json::array();
    for (const LevelResult& level : c.levels) out["levels"].push_back(json_of(level, c, detail));
    if (limits) out["limits"] = json_of(*limits, c, detail);
    return out;
}

Json json_of(const UnreadableModel& bad) {
    return {{"model", bad.model},
            {"code", core::code_name(bad.error.code)},
            {"error", core::to_string(bad.error)}};
}

std::string comparisons_as_json(std::span<const ModelReport> reports, std::span<const Subject> subjects,
                                int exit_code) {
    Json out = document("compare", subjects, exit_code);
    out["comparisons"] = Json::array();
    for (const ModelReport& report : reports) {
        Json entry{{"model", report.model}};
        entry.update(json_of(report.comparison, report.limits, Detail::Classes));
        entry["control_mesh"] = {{"vertices", report.vertices},
                                 {"faces", report.faces},
                                 {"boundary_edges", report.boundary_edges}};
        if (report.creases) {
            entry["crease_angle"] = report.creases->degrees;
            entry["crease_edges"] = report.creases->edges;
        }
        out["comparisons"].push_back(std::move(entry));
    }
    return dump(out);
}

nlohmann::ordered_json suite_document(const SuiteResult& suite, std::span<const Subject> subjects,
                                      Json comparisons) {
    Json out = document("suite", subjects, suite.exit_code());
    if (suite.shard) out["shard"] = json_of(*suite.shard, suite.levels);
    out["summary"] = suite_summary(suite);
    out["unreadable"] = Json::array();
    for (const UnreadableModel& bad : suite.unreadable) out["unreadable"].push_back(json_of(bad));
    out["comparisons"] = std::move(comparisons);
    return out;
}

void seal(Json& report) {
    std::string& checksum = report["shard"]["checksum"].get_ref<std::string&>();
    checksum.clear();
    checksum = hexadecimal(crc32_of(dump_compact(report)));
}

std::string suite_as_json(const SuiteResult& suite, std::span<const Subject> subjects) {
    Json comparisons = Json::array();
    for (const SuiteRow& row : suite.rows) {
        Json entry{{"model", row.model}};
        entry.update(json_of(row.comparison, row.limits, Detail::Levels));
        comparisons.push_back(std::move(entry));
    }
    Json out = suite_document(suite, subjects, std::move(comparisons));
    if (suite.shard) seal(out);
    return dump(out);
}

}  // namespace loopcheck::compare
