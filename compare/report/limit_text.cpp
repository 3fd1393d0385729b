// Limits for a reader at a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "compare/limit/words.h"
#include "compare/report/report.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

std::vector<std::string> normal_header(const std::string& first, const Comparison& c) {
    return {first,     "compared", "undefined",          "undetermined",         "identical",
            "max a-b", "rms",      c.subject + "-exact", c.reference + "-exact", "bound used"};
}

std::vector<std::string> normal_row(const std::string& first, const LimitStats& all) {
    const ClassStats& stats = all.normal;
    const double degree = 1 / in_degrees(1);
    return {first,
            fmt::format("{}", stats.difference.count),
            fmt::format("{}", all.undefined_count()),
            fmt::format("{}", all.undetermined),
            fmt::format("{}", stats.difference.identical),
            largest_cell(stats.difference, degree),
            number_cell(stats.difference.rms() / degree),
            largest_cell(stats.subject_error, degree),
            largest_cell(stats.reference_error, degree),
            number_cell(stats.largest_bound_use)};
}

// The level to look at: the first that differs, else the first with a known deviation, else the last.
const LimitLevelResult& level_of_interest(const LimitComparison& limits) {
    for (const Verdict verdict : {Verdict::Differs, Verdict::KnownDeviation})
        for (const LimitLevelResult& level : limits.levels)
            if (level.verdict == verdict) return level;
    return limits.levels.back();
}

std::string normal_as_text(const NormalRecord& r, const Comparison& c) {
    if (r.status == NormalStatus::Undefined)
        return fmt::format("    no normal: {}\n", core::sentence(r.reason));
    if (r.status == NormalStatus::Undetermined)
        return "    normal undetermined: rounding alone could turn it anywhere\n";
    return fmt::format("    normals: {:.6g} degrees apart, bound used {:.3g}\n", in_degrees(r.error),
                       r.bound_use) +
           vector_as_text(c.subject, r.subject) + vector_as_text(c.reference, r.reference) +
           vector_as_text("exact", r.exact);
}

std::string worst_as_text(const LimitLevelResult& level, const Comparison& c) {
    std::string out;
    for (const LimitRecord& r : level.worst) {
        if (r.position.bound_use == 0 && r.normal.bound_use == 0) continue;
        out += fmt::format("  {}: |a-b| = {:.6g} = {}, bound used {:.3g}{}\n", vertex_in_words(r.position),
                           r.position.error, in_units(r.position.error, c.unit()), r.position.bound_use,
                           r.deviation.empty() ? "" : "; " + r.deviation + ", as predicted");
        out += positions_as_text(r.position, c) + normal_as_text(r.normal, c);
    }
    return out.empty() ? out : "\nworst limit\n" + out;
}

}  // namespace

std::string limits_as_text(const LimitComparison& limits, const Comparison& c) {
    std::string out;
    if (!limits.levels.empty()) {
        std::vector<std::vector<std::string>> positions{position_header("limit at level", c)};
        std::vector<std::vector<std::string>> normals{normal_header("normal at level", c)};
        for (const LimitLevelResult& level : limits.levels) {
            const LimitStats all = total(level);
            positions.push_back(position_row(fmt::format("{}", level.level), all.position, c));
            normals.push_back(normal_row(fmt::format("{}", level.level), all));
        }
        out += "\n" + table(positions) + "\n" + table(normals);

        const LimitLevelResult& level = level_of_interest(limits);
        positions = {position_header(fmt::format("limit, class at level {}", level.level), c)};
        normals = {normal_header(fmt::format("normal, class at level {}", level.level), c)};
        for (const auto& [vertex_class, stats] : level.classes) {
            positions.push_back(position_row(core::to_string(vertex_class), stats.position, c));
            normals.push_back(normal_row(core::to_string(vertex_class), stats));
        }
        out += "\n" + table(positions) + "\n" + table(normals);
        for (const std::string& sentence : undefined_in_words(total(level)))
            out += fmt::format("  no normal at {}\n", sentence);
        out += worst_as_text(level, c);
    }
    out += fmt::format("\nverdict on limits: {}\n", name(limits.verdict));
    for (const std::string& note : limits.notes) out += fmt::format("  {}\n", note);
    return out;
}

std::string limit_deviations_as_text(const SuiteResult& suite) {
    struct Sum {
        std::set<std::string> models;
        std::size_t comparisons = 0, vertices = 0;
        DeviationSeen largest;  // positions as shares of M
    };
    std::map<const KnownDeviation*, Sum> sums;
    for (const SuiteRow& row : suite.rows) {
        if (!row.limits) continue;
        for (DeviationSeen seen : row.limits->deviations) {
            Sum& sum = sums[seen.deviation];
            sum.models.insert(row.model);
            ++sum.comparisons;
            sum.vertices += seen.vertices;
            seen.predicted_position /= row.comparison.largest_coordinate;
            seen.observed_position /= row.comparison.largest_coordinate;
            sum.largest.add(seen);
        }
    }
    if (sums.empty()) return {};
    const auto percent = [](double share) {
        return share == 0 ? std::string("0") : fmt::format("{:.3g} %", 100 * share);
    };
    std::vector<std::vector<std::string>> rows{{"known deviation of limits", "kind", "models", "comparisons",
                                                "vertices", "position / M", "predicted", "normal, degrees",
                                                "predicted"}};
    for (const auto& [deviation, sum] : sums)
        rows.push_back({std::string(deviation->name), std::string(name(deviation->kind)),
                        fmt::format("{}", sum.models.size()), fmt::format("{}", sum.comparisons),
                        fmt::format("{}", sum.vertices), percent(sum.largest.observed_position),
                        percent(sum.largest.predicted_position),
                        number_cell(in_degrees(sum.largest.observed_angle)),
                        number_cell(in_degrees(sum.largest.predicted_angle))});
    return table(rows) + "\n";
}

}  // namespace loopcheck::compare
