#include "compare/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

const LevelResult& first_difference(const Comparison& comparison) {
    return *std::find_if(comparison.levels.begin(), comparison.levels.end(),
                         [](const LevelResult& level) { return level.verdict == Verdict::Differs; });
}

// "interior 4 (2 vertices, up to 0.0123), interior 5 (...)": the classes of a level that differ.
std::string classes_in_words(const LevelResult& level) {
    std::vector<std::string> out;
    for (const auto& [vertex_class, stats] : level.classes)
        if (stats.beyond_bound > 0)
            out.push_back(fmt::format("{} ({} of {} vertices, by up to {:.3g})",
                                      core::to_string(vertex_class), stats.beyond_bound,
                                      stats.difference.count, stats.difference.max));
    return fmt::format("{}", fmt::join(out, ", "));
}

std::string where_it_differs(const Comparison& comparison) {
    const LevelResult& level = first_difference(comparison);
    const ClassStats all = total(level);
    if (all.beyond_bound == 0) return {};
    const bool elsewhere = all.beyond_bound < all.difference.count;
    return fmt::format("At level {}, the first that differs: {}{}.", level.level, classes_in_words(level),
                       elsewhere ? "; all other vertices agree" : "");
}

std::string who_is_right(const Comparison& comparison) {
    std::size_t a = 0, b = 0;
    for (const LevelResult& level : comparison.levels) {
        const ClassStats all = total(level);
        a += all.subject_wrong;
        b += all.reference_wrong;
    }
    const auto describe = [](std::string_view name, std::size_t wrong) {
        return wrong == 0
                   ? fmt::format("{} is within rounding of its exact rules", name)
                   : fmt::format("{} is not within rounding of its exact rules at {} vertices", name, wrong);
    };
    return fmt::format("{}; {}.", describe(comparison.subject, a), describe(comparison.reference, b));
}

}  // namespace

std::string printable(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return name;
}

std::string in_units(double error, double unit) {
    return fmt::format("{:.3g} u M", error / unit);
}

std::vector<std::string> verdict_in_words(const Comparison& comparison,
                                          const core::SchemeOptions& subject_rules,
                                          const core::SchemeOptions& reference_rules) {
    std::vector<std::string> out;
    double largest = 0, use = 0;
    std::size_t mismatches = 0, unexplained = 0;
    for (const LevelResult& level : comparison.levels) {
        const ClassStats all = total(level);
        largest = std::max(largest, all.difference.max);
        use = std::max(use, all.largest_bound_use);
        mismatches += all.rule_mismatches;
        unexplained += all.unexplained;
    }
    if (comparison.verdict == Verdict::Identical) {
        out.push_back(fmt::format("Every coordinate of {} and {} has the same bits.", comparison.subject,
                                  comparison.reference));
        return out;
    }
    if (comparison.verdict == Verdict::WithinRounding) {
        out.push_back(
            fmt::format("{} and {} differ by at most {}; rounding explains every difference (largest use of "
                        "the bound: {:.2f}).",
                        comparison.subject, comparison.reference, in_units(largest, comparison.unit()), use));
        return out;
    }
    if (subject_rules.weights != reference_rules.weights)
        out.push_back(fmt::format(
            "The rules differ by declaration: {} has the weights of {}, {} those of {}; {}.",
            comparison.subject, core::name(subject_rules.weights), comparison.reference,
            core::name(reference_rules.weights),
            unexplained == 0 ? "every difference is the predicted one"
                             : fmt::format("{} differences are not the predicted ones", unexplained)));
    if (auto where = where_it_differs(comparison); !where.empty()) out.push_back(std::move(where));
    if (mismatches > 0)
        out.push_back(fmt::format("At {} vertices the rule or boundary tag reported is not the right one.",
                                  mismatches));
    out.push_back(who_is_right(comparison));
    return out;
}

std::string_view agreement_in_words(Verdict verdict) {
    return verdict <= Verdict::KnownDeviation ? "agree" : name(verdict);
}

std::string deviation_in_words(const KnownDeviation& deviation, const Comparison& predicted) {
    double observed = 0, expected = 0;
    for (const LevelResult& level : predicted.levels) {
        const ClassStats all = total(level);
        observed = std::max(observed, all.difference.max);
        expected = std::max(expected, all.predicted);
    }
    return fmt::format(
        "{}: {} Predicted: up to {:.6g}; observed: up to {:.6g}; as predicted at every vertex. See {}.",
        deviation.name, deviation.what, expected, observed, page_of(deviation));
}

std::string creases_in_words(const CreaseTags& creases) {
    return fmt::format("--crease-angle {}: {} edges tagged as creases", core::shortest(creases.degrees),
                       creases.edges);
}

std::string ancestry_in_words(const VertexRecord& record) {
    if (record.level == 0) return "control vertex";
    return record.ancestor.kind == core::Ancestor::Kind::Vertex
               ? fmt::format("vertex point of {}", record.ancestor.index)
               : fmt::format("edge point of face {} edge {}", record.ancestor.index / 3,
                             record.ancestor.index % 3);
}

std::string rule_in_words(const VertexRecord& record) {
    return record.mask ? core::to_string(*record.mask) : std::string("none, it is given");
}

std::string position_in_words(std::string_view who, const glm::dvec3& p) {
    std::string decimal, hex;
    for (int i = 0; i < 3; ++i) {
        decimal += fmt::format("{:<24}", core::shortest(p[i]));
        hex += " " + core::hexfloat(p[i]);
    }
    return fmt::format("  {:<17} {}{}\n", who, decimal, hex);
}

}  // namespace loopcheck::compare
