#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "compare/report/report.h"
#include "compare/report/table.h"
#include "compare/words.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

std::vector<std::string> header(const std::string& first, const Comparison& c) {
    return {first,         "vertices",           "identical",
            "max |a-b|",   "/ diagonal",         "/ (u M)",
            "rms / (u M)", c.subject + "-exact", c.reference + "-exact",
            "bound used"};
}

std::vector<std::string> stats_row(const std::string& first, const ClassStats& stats, const Comparison& c) {
    const auto number = [](double value) {
        return value == 0 ? std::string("0") : fmt::format("{:.3g}", value);
    };
    const ErrorStats& d = stats.difference;
    const auto largest = [&](const ErrorStats& e, double per) {
        return e.not_finite > 0 ? fmt::format("{} not finite", e.not_finite) : number(e.max / per);
    };
    const double diagonal = c.diagonal > 0 ? c.diagonal : 1;
    return {first,
            fmt::format("{}", d.count),
            fmt::format("{}", d.identical),
            largest(d, 1),
            number(d.max / diagonal),
            number(d.max / c.unit()),
            number(d.rms() / c.unit()),
            largest(stats.subject_error, c.unit()),
            largest(stats.reference_error, c.unit()),
            number(stats.largest_bound_use)};
}

// The level to look at: the first that differs, else the last.
const LevelResult& level_of_interest(const Comparison& c) {
    for (const LevelResult& level : c.levels)
        if (level.verdict == Verdict::Differs) return level;
    return c.levels.back();
}

std::string vertex_as_text(const VertexRecord& r, const Comparison& c) {
    std::string out =
        fmt::format("  vertex {} of level {} ({}; {}; rule: {}): |a-b| = {:.6g} = {}, bound used {:.3g}\n",
                    r.vertex, r.level, ancestry_in_words(r), core::to_string(r.vertex_class),
                    rule_in_words(r), r.error, in_units(r.error, c.unit()), r.bound_use);
    const auto position = [](const std::string& who, const glm::dvec3& p) {
        std::vector<std::string> decimal, hex;
        for (int i = 0; i < 3; ++i) {
            decimal.push_back(core::shortest(p[i]));
            hex.push_back(core::hexfloat(p[i]));
        }
        return fmt::format("    {:<18} {}   [{}]\n", who, fmt::join(decimal, " "), fmt::join(hex, " "));
    };
    out += position(c.subject, r.subject) + position(c.reference, r.reference) + position("exact", r.exact);
    if (r.subject_vertex != r.vertex)
        out += fmt::format("    {} calls it vertex {}\n", c.subject, r.subject_vertex);
    if (r.reference_vertex != r.vertex)
        out += fmt::format("    {} calls it vertex {}\n", c.reference, r.reference_vertex);
    return out;
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

// One peer's column for one model: what came out under its boundary options.
std::string cell(const std::vector<const Comparison*>& comparisons) {
    std::map<Verdict, int> verdicts;
    double largest = 0;
    for (const Comparison* c : comparisons) {
        ++verdicts[c->verdict];
        for (const LevelResult& level : c->levels)
            largest = std::max(largest, total(level).difference.max / c->unit());
    }
    std::vector<std::string> parts;
    for (const auto& [verdict, count] : verdicts) {
        std::string part(verdict == Verdict::NotSupported ? "n/a" : name(verdict));
        if (verdict == Verdict::WithinRounding) part = fmt::format("within {:.2g} u M", largest);
        parts.push_back(verdicts.size() == 1 ? part : fmt::format("{} {}", count, part));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

// The rows of one verdict.  What is to be said of several rows of a model is said once, below all of them.
std::string details(const SuiteResult& suite, Verdict verdict, const std::string& heading) {
    std::string out;
    const SuiteRow* previous = nullptr;
    const auto notes_of = [](const SuiteRow& row) {
        std::string notes;
        for (const std::string& note : row.comparison.notes) notes += fmt::format("    {}\n", note);
        return notes;
    };
    for (const SuiteRow& row : suite.rows) {
        const Comparison& c = row.comparison;
        if (c.verdict != verdict) continue;
        const bool same =
            previous != nullptr && previous->model == row.model && previous->comparison.notes == c.notes;
        if (previous != nullptr && !same) out += notes_of(*previous);
        out += fmt::format("  {} ({}): {} against {}\n", printable(row.model), rules_in_words(c.options),
                           c.subject, c.reference);
        previous = &row;
    }
    return previous == nullptr ? out : fmt::format("{}\n{}{}\n", heading, out, notes_of(*previous));
}

}  // namespace

ModelReport make_report(std::string model, const core::TriangleMesh& mesh, Comparison comparison) {
    const core::Topology& t = mesh.topology();
    const auto boundary = std::count_if(t.edge_faces.begin(), t.edge_faces.end(),
                                        [](const auto& faces) { return faces[1] == core::kNone; });
    return {std::move(model), static_cast<std::size_t>(t.vertex_count), t.triangles.size(),
            static_cast<std::size_t>(boundary), std::move(comparison)};
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
    if (!c.levels.empty()) {
        out += fmt::format(
            "M = {:.6g}, diagonal = {:.6g}, u M = {:.3g}; exact: the same rules with 38 digits, in u M\n\n",
            c.largest_coordinate, c.diagonal, c.unit());
        std::vector<std::vector<std::string>> rows{header("level", c)};
        for (const LevelResult& level : c.levels)
            rows.push_back(stats_row(fmt::format("{}", level.level), total(level), c));
        out += table(rows);

        const LevelResult& level = level_of_interest(c);
        rows = {header(fmt::format("class at level {}", level.level), c)};
        for (const auto& [vertex_class, stats] : level.classes)
            rows.push_back(stats_row(core::to_string(vertex_class), stats, c));
        out += "\n" + table(rows);

        std::string worst;
        for (const VertexRecord& record : level.worst)
            if (record.error != 0) worst += vertex_as_text(record, c);
        if (!worst.empty()) out += "\nworst\n" + worst;
    }
    out += fmt::format("\nverdict: {}\n", name(c.verdict));
    for (const std::string& note : c.notes) out += fmt::format("  {}\n", note);
    return out;
}

std::string suite_summary(const SuiteResult& suite) {
    std::vector<std::string> parts;
    for (const Verdict verdict : {Verdict::Failed, Verdict::Differs, Verdict::KnownDeviation,
                                  Verdict::WithinRounding, Verdict::Identical, Verdict::NotSupported})
        parts.push_back(fmt::format("{} {}", suite.count(verdict), name(verdict)));
    return fmt::format(
        "{}: {} comparisons of {} models, levels 0 to {}: {}{}", suite.exit_code() == 0 ? "agree" : "FAIL",
        suite.rows.size(), suite.models, suite.levels, fmt::join(parts, ", "),
        suite.unreadable.empty() ? "" : fmt::format(", {} models not compared", suite.unreadable.size()));
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

    std::vector<std::string> peers;
    std::map<std::string, std::map<std::string, std::vector<const Comparison*>>> by_model;
    for (const SuiteRow& row : suite.rows) {
        by_model[row.model][row.comparison.reference].push_back(&row.comparison);
        if (std::find(peers.begin(), peers.end(), row.comparison.reference) == peers.end())
            peers.push_back(row.comparison.reference);
    }
    std::vector<std::vector<std::string>> rows{{"ours against"}};
    for (const std::string& peer : peers) {
        const Subject* subject = find_subject(subjects, peer);
        rows[0].push_back(subject == nullptr ? peer : fmt::format("{} {}", peer, subject->version));
    }
    for (const auto& [model, by_peer] : by_model) {
        rows.push_back({printable(model)});
        for (const std::string& peer : peers) rows.back().push_back(cell(by_peer.at(peer)));
    }
    if (!by_model.empty()) out += table(rows) + "\n";
    return out + suite_summary(suite) + "\n";
}

}  // namespace loopcheck::compare
