#include <fmt/format.h>

#include <algorithm>

#include "compare/report/curve.h"
#include "compare/report/table.h"
#include "compare/words.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

std::string header(const CurveReport& report) {
    const auto& curve = report.curve;
    return fmt::format(
        "{}: {} points in {}, degree {}, {} ends, t from {} to {}\n"
        "ours {} (double) against 38 digits; M = {:.6g}, u M = {:.3g}\n",
        printable(report.file), curve.size(), report.dimension == 2 ? "the plane" : "space",
        curve.shape().degree, core::name(curve.shape().ends), core::shortest(curve.first()),
        core::shortest(curve.last()), LOOPCHECK_VERSION, report.comparison.largest_coordinate,
        report.comparison.unit());
}

std::string polygon_table(const CurveComparison& c) {
    std::vector<std::vector<std::string>> rows{{"level", "points", "max |c - P(t)|", "proven bound", "factor",
                                                "ours-exact", "bound used", "limits off"}};
    const PolygonStats* before = nullptr;
    for (const PolygonStats& p : c.polygons) {
        rows.push_back(
            {fmt::format("{}", p.level), fmt::format("{}", p.points), number_cell(p.distance),
             p.allowed ? number_cell(*p.allowed) : "n/a",
             before != nullptr && p.distance > 0 ? fmt::format("{:.4f}", before->distance / p.distance) : "",
             number_cell(p.error / c.unit()), fmt::format("{:.2f}", p.bound_use),
             p.limit_error ? fmt::format("{:.0e} M", *p.limit_error) : "n/a"});
        before = &p;
    }
    std::string out = "\n" + table(rows);
    if (c.stride > 1) out += fmt::format("  one point in {} was held against the curve\n", c.stride);
    return out;
}

std::string evaluation_table(const CurveComparison& c) {
    std::vector<std::vector<std::string>> rows{
        {"evaluation", "parameters", "basis evaluations", "ours-exact", "bound used"}};
    for (const EvaluationStats& e : c.evaluations)
        rows.push_back({e.method, fmt::format("{}", e.samples), fmt::format("{}", e.basis_evaluations),
                        number_cell(e.error / c.unit()), fmt::format("{:.2f}", e.bound_use)});
    return "\n" + table(rows);
}

std::string carried_table(const CurveComparison& c) {
    if (c.carried.empty()) return {};
    std::vector<std::vector<std::string>> rows{{"subject", "where the curve is", "levels", "points",
                                                "identical", "max |a-b|", "bound used", "verdict"}};
    std::string notes;
    for (const CarriedComparison& one : c.carried) {
        ErrorStats all;
        double use = 0;
        for (const CarriedLevel& level : one.levels) {
            all.add(level.difference);
            use = std::max(use, level.bound_use);
        }
        const bool compared = !one.levels.empty();
        rows.push_back({fmt::format("{} {}", one.subject, one.version),
                        compared || one.note.empty() ? std::string(name(one.carrier)) : "",
                        compared ? fmt::format("0-{}", one.levels.back().level) : "",
                        fmt::format("{}", all.count), fmt::format("{}", all.identical), number_cell(all.max),
                        fmt::format("{:.2f}", use), std::string(name(one.verdict))});
        if (!one.note.empty())
            notes += fmt::format("  {}, {}: {}\n", one.subject, name(one.carrier), one.note);
    }
    return "\n" + table(rows) + notes;
}

std::string tolerance_lines(const ToleranceReport& t) {
    std::string out = fmt::format("\nwithin {}:", core::shortest(t.tolerance));
    if (t.level)
        out += fmt::format(" level {} ({:.15g} points) is the first that is certified, at {:.3g};", *t.level,
                           t.level_points, t.distance);
    return out + (t.flat_points ? fmt::format(" {} points of the curve itself are enough\n", *t.flat_points)
                                : " the curve itself may take more than a million points\n");
}

}  // namespace

std::string curve_as_text(const CurveReport& report) {
    const CurveComparison& c = report.comparison;
    std::string out = header(report) + polygon_table(c) + evaluation_table(c) + carried_table(c);
    if (report.tolerance) out += tolerance_lines(*report.tolerance);
    out += fmt::format("\nverdict: {}\n", agreement_in_words(c.worst()));
    for (const std::string& note : c.notes) out += fmt::format("  {}\n", note);
    return out;
}

}  // namespace loopcheck::compare
