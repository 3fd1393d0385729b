#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "compare/limit/words.h"
#include "compare/report/report.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

// The level to look at: the first that differs, else the last.
const LevelResult& level_of_interest(const Comparison& c) {
    for (const LevelResult& level : c.levels)
        if (level.verdict == Verdict::Differs) return level;
    return c.levels.back();
}

std::string vertex_as_text(const VertexRecord& r, const Comparison& c) {
    return fmt::format("  {}: |a-b| = {:.6g} = {}, bound used {:.3g}\n", vertex_in_words(r), r.error,
                       in_units(r.error, c.unit()), r.bound_use) +
           positions_as_text(r, c);
}

std::string subject_in_words(std::string_view name, std::span<const Subject> subjects) {
    const Subject* subject = find_subject(subjects, name);
    return subject == nullptr
               ? std::string(name)
               : fmt::format("{} {} ({})", name, subject->version, core::name(subject->precision));
}

std::string rules_in_words(const core::SchemeOptions& options) {
    return fmt::format("boundary {}, creasing {}, weights {}", core::name(options.boundary),
                       core::name(options.creasing), core::name(options.weights));
}

// One verdict, and the largest difference in u M.
struct Outcome {
    Verdict verdict;
    double largest = 0;
};

Outcome refinement_of(const SuiteRow& row) {
    Outcome out{row.comparison.verdict};
    for (const LevelResult& level : row.comparison.levels)
        out.largest = std::max(out.largest, total(level).difference.max / row.comparison.unit());
    return out;
}

Outcome limits_of(const SuiteRow& row) {
    const double unit = row.comparison.unit();
    return {row.limits->verdict, total(*row.limits).position.difference.max / unit};
}

// One peer's column for one model: what came out under its boundary options.
std::string cell(const std::vector<Outcome>& outcomes) {
    std::map<Verdict, int> verdicts;
    double largest = 0;
    for (const Outcome& outcome : outcomes) {
        ++verdicts[outcome.verdict];
        if (outcome.verdict == Verdict::WithinRounding) largest = std::max(largest, outcome.largest);
    }
    std::vector<std::string> parts;
    for (const auto& [verdict, count] : verdicts) {
        std::string part(verdict == Verdict::NotSupported ? "n/a" : name(verdict));
        // Limits may differ by the rounding of normals alone.
        if (verdict == Verdict::WithinRounding && largest > 0)
            part = fmt::format("within {:.2g} u M", largest);
        parts.push_back(verdicts.size() == 1 ? part : fmt::format("{} {}", count, part));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

// The notes of a row on what has this verdict, refinement or limits.
std::vector<std::string> notes_of(const SuiteRow& row, Verdict verdict) {
    std::vector<std::string> out;
    if (row.comparison.verdict == verdict) out = row.comparison.notes;
    if (row.limits && row.limits->verdict == verdict && row.limits->notes != out)
        for (const std::string& note : row.limits->notes) out.push_back("limits: " + note);
    return out;
}

// The rows of one verdict.  What is to be said of several rows of a model is said once, below all of them.
std::string details(const SuiteResult& suite, Verdict verdict, const std::string& heading) {
    std::string out;
    std::vector<std::string> notes;
    const SuiteRow* previous = nullptr;
    const auto said = [&] {
        std::string text;
        for (const std::string& note : notes) text += fmt::format("    {}\n", note);
        return text;
    };
    for (const SuiteRow& row : suite.rows) {
        const Comparison& c = row.comparison;
        // Known deviations of limits are many: they have a table of their own.
        const bool limits_too = verdict != Verdict::KnownDeviation && row.limit_verdict() == verdict;
        if (c.verdict != verdict && !limits_too) continue;
        auto here = limits_too ? notes_of(row, verdict) : c.notes;
        if (previous != nullptr && (previous->model != row.model || notes != here)) out += said();
        out += fmt::format("  {} ({}): {} against {}\n", printable(row.model), rules_in_words(c.options),
                           c.subject, c.reference);
        previous = &row;
        notes = std::move(here);
    }
    return previous == nullptr ? out : fmt::format("{}\n{}{}\n", heading, out, said());
}

// A line a model, a column a peer: refinements first, then limits.
std::string outcomes_as_table(const SuiteResult& suite, std::span<const Subject> subjects) {
    std::vector<std::string> columns, limit_columns;
    std::map<std::string, std::map<std::string, std::vector<Outcome>>> by_model;
    const auto add = [&](std::vector<std::string>& known, const std::string& column, const std::string& model,
                         const Outcome& outcome) {
        if (std::find(known.begin(), known.end(), column) == known.end()) known.push_back(column);
        by_model[model][column].push_back(outcome);
    };
    for (const SuiteRow& row : suite.rows) {
        const Subject* peer = find_subject(subjects, row.comparison.reference);
        const std::string& who = row.comparison.reference;
        add(columns, peer == nullptr ? who : fmt::format("{} {}", who, peer->version), row.model,
            refinement_of(row));
        if (row.limits) add(limit_columns, who + " limits", row.model, limits_of(row));
    }
    columns.insert(columns.end(), limit_columns.begin(), limit_columns.end());
    std::vector<std::vector<std::string>> rows{{"ours against"}};
    rows[0].insert(rows[0].end(), columns.begin(), columns.end());
    for (const auto& [model, by_column] : by_model) {
        rows.push_back({printable(model)});
        for (const std::string& column : columns) rows.back().push_back(cell(by_column.at(column)));
    }
    return by_model.empty() ? std::string() : table(rows) + "\n";
}

std::string shard_in_words(const ShardOfSuite& part) {
    return fmt::format("; shard {}/{} of {}{}", part.shard.index, part.shard.of,
                       counted(part.corpus.size(), "model"), part.cases == 0 ? " is empty" : "");
}

}  // namespace

ModelReport make_report(std::string model, const core::TriangleMesh& mesh, Comparison comparison,
                        std::optional<LimitComparison> limits) {
    const SuiteCase sizes = make_case(model, mesh, comparison.options);
    return {std::move(model),      sizes.vertices,    sizes.faces, sizes.boundary_edges,
            std::move(comparison), std::move(limits), std::nullopt};
}

std::string comparison_as_text(const ModelReport& report, std::span<const Subject> subjects) {
    const Comparison& c = report.comparison;
    std::string out =
        fmt::format("{}: {} vertices, {} faces, {}\n", printable(report.model), report.vertices, report.faces,
                    report.boundary_edges == 0 ? std::string("closed")
                                               : fmt::format("{} boundary edges", report.boundary_edges));
    out += fmt::format("a = {}, b = {}\n", subject_in_words(c.subject, subjects),
                       subject_in_words(c.reference, subjects));
    out += rules_in_words(c.options) + "\n";
    if (report.creases) out += creases_in_words(*report.creases) + "\n";
    if (!c.levels.empty()) {
        out += fmt::format(
            "M = {:.6g}, diagonal = {:.6g}, u M = {:.3g}; exact: the same rules with 38 digits, in u M\n\n",
            c.largest_coordinate, c.diagonal, c.unit());
        std::vector<std::vector<std::string>> rows{position_header("level", c)};
        for (const LevelResult& level : c.levels)
            rows.push_back(position_row(fmt::format("{}", level.level), total(level), c));
        out += table(rows);

        const LevelResult& level = level_of_interest(c);
        rows = {position_header(fmt::format("class at level {}", level.level), c)};
        for (const auto& [vertex_class, stats] : level.classes)
            rows.push_back(position_row(core::to_string(vertex_class), stats, c));
        out += "\n" + table(rows);

        std::string worst;
        for (const VertexRecord& record : level.worst)
            if (record.error != 0) worst += vertex_as_text(record, c);
        if (!worst.empty()) out += "\nworst\n" + worst;
    }
    out += fmt::format("\nverdict: {}\n", name(c.verdict));
    for (const std::string& note : c.notes) out += fmt::format("  {}\n", note);
    if (report.limits) out += limits_as_text(*report.limits, c);
    return out;
}

std::string verdicts_in_words(const std::function<std::size_t(Verdict)>& count) {
    std::vector<std::string> parts;
    for (const Verdict verdict : {Verdict::Failed, Verdict::Differs, Verdict::KnownDeviation,
                                  Verdict::WithinRounding, Verdict::Identical, Verdict::NotSupported})
        parts.push_back(fmt::format("{} {}", count(verdict), name(verdict)));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string counted(std::size_t n, std::string_view noun) {
    return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string summary_in_words(const SuiteResult& suite, int exit_code) {
    const std::size_t limits = suite.limit_rows();
    return fmt::format("{}: {}{} of {}, levels 0 to {}: {}{}{}", exit_code == 0 ? "agree" : "FAIL",
                       counted(suite.rows.size(), "comparison"),
                       limits > 0 ? fmt::format(" and {} of limits", limits) : "",
                       counted(suite.models, "model"), suite.levels,
                       verdicts_in_words([&](Verdict verdict) { return suite.count(verdict); }),
                       suite.unreadable.empty()
                           ? ""
                           : fmt::format(", {} not compared", counted(suite.unreadable.size(), "model")),
                       suite.shard ? shard_in_words(*suite.shard) : "");
}

std::string suite_summary(const SuiteResult& suite) {
    return summary_in_words(suite, suite.exit_code());
}

std::string suite_as_text(const SuiteResult& suite, std::span<const Subject> subjects) {
    std::string out;
    if (!suite.unreadable.empty()) {
        out += "not compared\n";
        for (const UnreadableModel& bad : suite.unreadable)
            out += fmt::format("  {}: {}\n", printable(bad.model), core::to_string(bad.error));
        out += "\n";
    }
    out += details(suite, Verdict::Failed, "failed") + details(suite, Verdict::Differs, "differs") +
           details(suite, Verdict::KnownDeviation, "known deviations");

    out += limit_deviations_as_text(suite) + outcomes_as_table(suite, subjects);
    return out + suite_summary(suite) + "\n";
}

}  // namespace loopcheck::compare
