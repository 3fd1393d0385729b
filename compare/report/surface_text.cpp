#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/report/surface.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

std::string number(double value) {
    if (value == 0) return "0";
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "not finite";
}

std::string rate(std::optional<double> value) {
    return value ? fmt::format("{:.4f}", *value) : "";
}

std::vector<std::string> atlas_line(const AtlasRow& row) {
    std::vector<std::string> out{to_string(row.corner)};
    for (const auto& level : row.levels) {
        if (!level) {
            out.insert(out.end(), {"n/a", "", ""});
        } else if (level->is_rounding()) {
            out.insert(out.end(), {"exact", "", ""});
        } else {
            out.push_back(number(level->largest[0]));
            for (int order = 1; order < kOrders; ++order)
                out.push_back(fmt::format("{:.2g}", level->relative[order]));
        }
    }
    out.push_back(rate(row.rate));
    out.push_back(rate(row.lambda));
    return out;
}

std::vector<std::string> class_line(const FaceClass& face_class, const SurfaceStats& s,
                                    const SurfaceComparison& c) {
    return {to_string(face_class),
            fmt::format("{}", s.faces),
            fmt::format("{}", s.samples),
            number(s.position),
            number(c.diagonal > 0 ? s.position / c.diagonal : s.position),
            s.predicted > 0 ? number(s.predicted) : "rounding",
            fmt::format("{:.2f}", s.bound_use),
            number(s.normal),
            fmt::format("{:.2g}", s.first),
            fmt::format("{:.2g}", s.second),
            rate(s.rate),
            rate(s.lambda)};
}

std::string comparison_as_text(const SurfaceComparison& c) {
    std::string out = fmt::format("\n{}, smooth level {}, sharp level {}\n", c.check.way.name,
                                  c.check.smooth_level, c.check.sharp_level);
    if (!c.classes.empty()) {
        std::vector<std::vector<std::string>> rows{{"face class", "faces", "samples", "max |a-b|",
                                                    "/ diagonal", "predicted", "bound used", "normal", "d1",
                                                    "d2", "rate", "lambda"}};
        for (const auto& [face_class, stats] : c.classes) rows.push_back(class_line(face_class, stats, c));
        out += table(rows);
    }
    if (c.stride > 1) out += fmt::format("  one face in {} was looked at\n", c.stride);
    if (c.without_surface > 0) out += fmt::format("  faces without a surface: {}\n", c.without_surface);
    out += fmt::format("verdict: {}\n", name(c.verdict));
    for (const std::string& note : c.notes) out += fmt::format("  {}\n", note);
    return out;
}

}  // namespace

std::string atlas_as_text(const Atlas& atlas, std::string_view version) {
    std::string out = fmt::format(
        "Surfaces of OpenSubdiv {} around one irregular vertex, against exact evaluation\n"
        "sum |w - exact w|: the largest position error for control points in [-1, 1]; d1, d2: of first and "
        "second\n"
        "derivatives in the outer half of the last patch, over their size; rate: of the position a level\n",
        version);
    std::string way;
    std::vector<std::vector<std::string>> rows;
    const auto flush = [&] {
        if (!rows.empty()) out += "\n" + table(rows);
        rows.clear();
    };
    for (const AtlasRow& row : atlas.rows) {
        if (row.way != way) {
            flush();
            way = row.way;
            rows.push_back({way});
            for (const int level : atlas.levels) {
                rows.back().push_back(fmt::format("level {}", level));
                rows.back().insert(rows.back().end(), {"d1", "d2"});
            }
            rows.back().insert(rows.back().end(), {"rate", "lambda"});
        }
        rows.push_back(atlas_line(row));
    }
    flush();
    return out;
}

int SurfaceReport::exit_code() const {
    int code = 0;
    bool compared = false;
    for (const SurfaceComparison& c : comparisons) {
        if (c.verdict == Verdict::NotSupported) continue;
        compared = true;
        code = worse_exit_code(code, compare::exit_code(c.verdict));
    }
    return compared ? code : compare::exit_code(Verdict::NotSupported);
}

std::string surface_as_text(const SurfaceReport& report, std::string_view version) {
    std::string out = fmt::format("{}: {} vertices, {} faces\na = opensubdiv {}, b = exact\n",
                                  printable(report.model), report.vertices, report.faces, version);
    if (!report.comparisons.empty()) {
        const core::SchemeOptions& options = report.comparisons.front().options;
        out += fmt::format("boundary {}, creasing {}\n", core::name(options.boundary),
                           core::name(options.creasing));
    }
    for (const SurfaceComparison& c : report.comparisons) out += comparison_as_text(c);
    return out;
}

}  // namespace loopcheck::compare
