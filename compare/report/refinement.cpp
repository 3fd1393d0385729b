#include "compare/report/refinement.h"

#include <fmt/format.h>

#include "compare/report/document.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(std::size_t count) {
    return fmt::format("{}", count);
}

std::string percent(double part, double whole) {
    return fmt::format("{:.3g} %", 100 * part / whole);
}

std::string level_table(std::span<const AdaptiveLevelResult> levels) {
    std::vector<std::vector<std::string>> rows{{"level", "vertices", "faces", "of uniform", "subdividable",
                                                "edges split", "into 4", "into 3", "into 2", "kept"}};
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const AdaptiveLevelResult& level = levels[l];
        std::vector<std::string> row{cell(l), cell(level.vertices), cell(level.faces),
                                     percent(static_cast<double>(level.faces), level.uniform_faces)};
        if (l > 0) {
            row.push_back(cell(level.subdividable));
            row.push_back(cell(level.counts.split_edges));
            for (const std::size_t count : level.counts.faces_with_unsplit) row.push_back(cell(count));
        }
        row.resize(rows.front().size());
        rows.push_back(std::move(row));
    }
    return table(rows);
}

std::vector<std::string> stats_header(const std::string& first) {
    return {first,  "checked", "identical", "held", "same", "max |a-b|/diagonal", "RMS |a-b|/diagonal",
            "apart"};
}

std::vector<std::string> stats_row(const std::string& first, const AdaptiveStats& s, double diagonal) {
    const double per = diagonal > 0 ? diagonal : 1;  // of a mesh that is one point nothing moves
    return {first,
            cell(s.checked.count),
            cell(s.checked.identical),
            cell(s.held.count),
            cell(s.held.identical),
            number_cell(s.held.max / per),
            number_cell(s.held.rms() / per),
            cell(s.apart)};
}

Json json_of(const ErrorStats& stats) {
    return {
        {"vertices", stats.count}, {"identical", stats.identical}, {"max", stats.max}, {"rms", stats.rms()}};
}

Json json_of(const AdaptiveStats& stats) {
    return {{"checked", json_of(stats.checked)}, {"held", json_of(stats.held)}, {"apart", stats.apart}};
}

Json sizes(const AdaptiveLevelResult& level, std::size_t number) {
    return {{"level", number},
            {"vertices", level.vertices},
            {"faces", level.faces},
            {"uniform_faces", level.uniform_faces}};
}

// What was tagged, as a line and as two members.
std::string creases_line(const std::optional<CreaseTags>& creases) {
    return creases ? creases_in_words(*creases) + "\n" : "";
}
void add_creases(Json& json, const std::optional<CreaseTags>& creases) {
    if (!creases) return;
    json["crease_angle"] = creases->degrees;
    json["crease_edges"] = creases->edges;
}

Json with_counts(Json json, const AdaptiveLevelResult& level) {
    json["subdividable"] = level.subdividable;
    json["split_edges"] = level.counts.split_edges;
    json["faces_with_unsplit"] = level.counts.faces_with_unsplit;
    return json;
}

std::string tolerance_as_text(const ToleranceOutcome& t) {
    std::vector<std::vector<std::string>> rows{{"level", "triangles"}};
    for (std::size_t l = 0; l < t.leaves.size(); ++l)
        if (t.leaves[l] > 0) rows.push_back({cell(l), cell(t.leaves[l])});
    std::string out = table(rows);
    out += "levels before the neighbours of finer triangles are cut\n";
    out += fmt::format(
        "proven, but for rounding: no point of the limit surface is further than {:.6g} from the mesh; "
        "measured: {:.6g}, at {} "
        "points\n",
        t.bound, t.measured.largest, t.measured.samples);
    out +=
        fmt::format("uniform refinement to level {}: {:.0f} faces\n", t.leaves.size() - 1, t.uniform_faces);
    if (t.without_surface > 0)
        out += fmt::format("faces without a limit surface, left out: {}\n", t.without_surface);
    if (!t.no_uniform.empty())
        out += fmt::format("first uniform level within the tolerance: not found. {}\n", t.no_uniform);
    if (t.uniform)
        out += fmt::format("first uniform level within the tolerance: {}, with {} faces, within {:.6g}\n",
                           t.uniform->level, t.uniform->triangles, t.uniform->bound);
    return out;
}

Json json_of(const ToleranceOutcome& t) {
    Json out{{"tolerance", t.tolerance},
             {"bound", t.bound},
             {"measured", t.measured.largest},
             {"samples", t.measured.samples},
             {"leaves", t.leaves},
             {"uniform_faces", t.uniform_faces},
             {"without_surface", t.without_surface}};
    if (!t.no_uniform.empty()) out["no_uniform"] = t.no_uniform;
    if (t.uniform)
        out["uniform"] = {
            {"level", t.uniform->level}, {"faces", t.uniform->triangles}, {"bound", t.uniform->bound}};
    return out;
}

}  // namespace

std::string refinement_as_text(const RefinementReport& report) {
    std::string out = creases_line(report.creases);
    if (!report.rule.empty())
        out += fmt::format("{}: {}\n{}", printable(report.model), report.rule, level_table(report.levels));
    if (report.tolerance)
        out += fmt::format("{}: the limit surface within {:.6g}\n{}", printable(report.model),
                           report.tolerance->tolerance, tolerance_as_text(*report.tolerance));
    return out + fmt::format("{}: {} vertices, {} faces\n", printable(report.output),
                             report.levels.back().vertices, report.levels.back().faces);
}

std::string refinement_as_json(const RefinementReport& report, std::span<const Subject> subjects) {
    Json out = document("refine", subjects, 0);
    out["comparisons"] = Json::array();
    out["model"] = report.model;
    Json refinement{
        {"output", report.output}, {"scheme", report.scheme}, {"precision", core::name(report.precision)}};
    add_creases(refinement, report.creases);
    if (!report.order.empty()) refinement["order"] = report.order;
    if (!report.rule.empty()) refinement["rule"] = report.rule;
    if (report.tolerance) {
        refinement["vertices"] = report.levels.back().vertices;
        refinement["faces"] = report.levels.back().faces;
        refinement["tolerance"] = json_of(*report.tolerance);
    }
    refinement["levels"] = Json::array();
    for (std::size_t l = 0; l < report.levels.size() && !report.tolerance; ++l) {
        const AdaptiveLevelResult& level = report.levels[l];
        Json entry = sizes(level, l);
        refinement["levels"].push_back(report.rule.empty() ? entry : with_counts(std::move(entry), level));
    }
    out["refinement"] = std::move(refinement);
    return dump(out);
}

std::string adaptive_as_text(const AdaptiveReport& report, std::string_view version) {
    const AdaptiveComparison& c = report.comparison;
    std::string out = fmt::format("{}: {}\n{}a = ours {}, b = {} {}, uniform; {}, boundary {}\n\n{}",
                                  printable(report.model), report.rule, creases_line(report.creases),
                                  LOOPCHECK_VERSION, c.subject, version, core::name(c.precision),
                                  core::name(c.options.boundary), level_table(c.levels));
    std::vector<std::vector<std::string>> by_level{stats_header("level")};
    std::vector<std::vector<std::string>> by_class{
        stats_header(fmt::format("class, level {}", c.levels.size() - 1))};
    for (std::size_t l = 0; l < c.levels.size(); ++l)
        by_level.push_back(stats_row(cell(l), total(c.levels[l]), c.diagonal));
    for (const auto& [vertex_class, stats] : c.levels.back().classes)
        by_class.push_back(stats_row(to_string(vertex_class), stats, c.diagonal));
    out += "\n" + table(by_level) + "\n" + table(by_class) + "\n";
    out +=
        "checked: depend on subdividable faces only, so they must be where uniform refinement has them\n"
        "held: uniform refinement has them too, but something around them stayed; apart: it does not have "
        "them\n";
    out += fmt::format("\nverdict: {}\n", agreement_in_words(c.verdict));
    for (const std::string& note : c.notes) out += fmt::format("  {}\n", note);
    return out;
}

std::string adaptive_as_json(const AdaptiveReport& report, std::span<const Subject> subjects) {
    const AdaptiveComparison& c = report.comparison;
    Json out = document("compare", subjects, exit_code(c.verdict));
    out["comparisons"] = Json::array();
    out["model"] = report.model;
    Json adaptive{{"rule", report.rule},
                  {"subject", c.subject},
                  {"precision", core::name(c.precision)},
                  {"boundary", core::name(c.options.boundary)},
                  {"creasing", core::name(c.options.creasing)},
                  {"diagonal", c.diagonal},
                  {"verdict", name(c.verdict)},
                  {"notes", c.notes}};
    add_creases(adaptive, report.creases);
    adaptive["levels"] = Json::array();
    for (std::size_t l = 0; l < c.levels.size(); ++l) {
        const AdaptiveLevelResult& level = c.levels[l];
        Json entry = with_counts(sizes(level, l), level);
        entry["classes"] = Json::array();
        for (const auto& [vertex_class, stats] : level.classes) {
            Json row{{"class", to_string(vertex_class)}};
            row.update(json_of(stats));
            entry["classes"].push_back(std::move(row));
        }
        adaptive["levels"].push_back(std::move(entry));
    }
    out["adaptive"] = std::move(adaptive);
    return dump(out);
}

}  // namespace loopcheck::compare
