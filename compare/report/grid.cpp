#include "compare/report/grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/report/document.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

std::string level_table(const TensorComparison& c, double unit) {
    std::vector<std::vector<std::string>> rows{{"level", "vertices", "max |a-b|", "a-exact", "b-exact",
                                                "bound used", "limits |a-b|", "a-exact", "b-exact",
                                                "bound used", "normals", "bound used"}};
    const auto add = [&](std::vector<std::string>& row, const TensorMeasure& m) {
        for (const double error : {m.difference, m.ours_error, m.opensubdiv_error})
            row.push_back(number_cell(error / unit));
        row.push_back(fmt::format("{:.2f}", m.bound_use));
    };
    for (const TensorLevel& level : c.levels) {
        std::vector<std::string> row{fmt::format("{}", level.level), fmt::format("{}", level.vertices)};
        add(row, level.position);
        add(row, level.limit);
        row.push_back(fmt::format("{}", level.normals));
        row.push_back(fmt::format("{:.2f}", level.normal.bound_use));
        rows.push_back(std::move(row));
    }
    return table(rows);
}

Json json_of(const TensorMeasure& m) {
    return {{"difference", m.difference},
            {"ours_error", m.ours_error},
            {"opensubdiv_error", m.opensubdiv_error},
            {"bound_use", m.bound_use}};
}

}  // namespace

Verdict GridReport::worst() const {
    Verdict out = Verdict::Identical;
    for (const Entry& entry : comparisons) out = std::max(out, entry.comparison.verdict);
    return out;
}

std::string grid_as_text(const GridReport& report, std::string_view version) {
    std::string out = fmt::format(
        "{}: {} rows of {} points, bicubic, u {}, v {}\na = ours {}, b = opensubdiv {} "
        "(Catmull-Clark); errors in u M, M = {:.6g}\n",
        printable(report.file), report.rows, report.columns, core::name(report.u), core::name(report.v),
        LOOPCHECK_VERSION, version, report.largest_coordinate);
    for (const auto& [precision, comparison] : report.comparisons) {
        out += fmt::format("\n{}: {}\n", core::name(precision), name(comparison.verdict));
        out += level_table(comparison, error_unit(report.largest_coordinate, precision, precision));
        if (!comparison.note.empty()) out += fmt::format("  {}\n", comparison.note);
    }
    return out + fmt::format("\nverdict: {}\n", agreement_in_words(report.worst()));
}

std::string grid_as_json(const GridReport& report, std::span<const Subject> subjects) {
    Json out = document("grid", subjects, exit_code(report.worst()));
    out["comparisons"] = Json::array();
    out["model"] = report.file;
    Json grid{{"rows", report.rows},
              {"columns", report.columns},
              {"u", core::name(report.u)},
              {"v", core::name(report.v)},
              {"largest_coordinate", report.largest_coordinate}};
    grid["precisions"] = Json::array();
    for (const auto& [precision, comparison] : report.comparisons) {
        Json entry{{"precision", core::name(precision)},
                   {"verdict", name(comparison.verdict)},
                   {"note", comparison.note}};
        entry["levels"] = Json::array();
        for (const TensorLevel& level : comparison.levels)
            entry["levels"].push_back({{"level", level.level},
                                       {"vertices", level.vertices},
                                       {"position", json_of(level.position)},
                                       {"limit", json_of(level.limit)},
                                       {"normals", level.normals},
                                       {"normal", json_of(level.normal)}});
        grid["precisions"].push_back(std::move(entry));
    }
    out["grid"] = std::move(grid);
    return dump(out);
}

}  // namespace loopcheck::compare
