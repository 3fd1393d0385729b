#include "compare/limit/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/trigonometric.hpp>

#include "compare/words.h"

namespace loopcheck::compare {
namespace {

// "12 vertices".
std::string vertices(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

std::string deviation_sentence(const DeviationSeen& seen, double largest_coordinate) {
    return fmt::format("{}: {} At {} of {}: {}; as predicted at each. See {}.", seen.deviation->name,
                       seen.deviation->what, vertices(seen.vertices), seen.subject,
                       amounts_in_words(seen, largest_coordinate), page_of(*seen.deviation));
}

std::string vanished_sentence(const DeviationSeen& seen, const LimitSide& a, const LimitSide& b) {
    const Subject& who = seen.subject == a.subject->name ? *a.subject : *b.subject;
    return fmt::format(
        "The known deviation {} of {} must show at {} and does not: is it mended in version {}? Then "
        "it must leave the list.",
        seen.deviation->name, who.name, vertices(seen.vertices + seen.vanished), who.version);
}

// "interior 4 (positions at 2 of 6 vertices, normals at 1)": the classes of a level that differ.
std::string classes_in_words(const LimitLevelResult& level) {
    std::vector<std::string> out;
    for (const auto& [vertex_class, stats] : level.classes)
        if (stats.position.unexplained + stats.normal.unexplained > 0)
            out.push_back(fmt::format("{} (of {}: positions at {}, normals at {})",
                                      core::to_string(vertex_class),
                                      vertices(stats.position.difference.count), stats.position.unexplained,
                                      stats.normal.unexplained));
    return fmt::format("{}", fmt::join(out, ", "));
}

void add_unexplained(const LimitComparison& c, const LimitSide& a, const LimitSide& b,
                     std::vector<std::string>& out) {
    for (const LimitLevelResult& level : c.levels) {
        const std::string classes = classes_in_words(level);
        if (classes.empty()) continue;
        out.push_back(
            fmt::format("At level {}, the first where limits are neither exact nor as a known deviation "
                        "predicts: {}.",
                        level.level, classes));
        break;
    }
    const LimitStats all = total(c);
    const auto wrong = [](const std::string& who, std::size_t positions, std::size_t normals) {
        return positions + normals == 0
                   ? fmt::format("{} is within rounding of the exact limit", who)
                   : fmt::format(
                         "{} is not within rounding of the exact limit (positions at {}, normals at {})", who,
                         vertices(positions), vertices(normals));
    };
    out.push_back(
        fmt::format("{}; {}.", wrong(a.subject->name, all.position.subject_wrong, all.normal.subject_wrong),
                    wrong(b.subject->name, all.position.reference_wrong, all.normal.reference_wrong)));
}

std::string drift_sentence(const std::string& who, const DriftStats& drift, double unit) {
    const auto amount = [](const ErrorStats& stats, std::string text) {
        return stats.not_finite > 0 ? std::string("something not finite") : text;
    };
    std::string out = fmt::format(
        "From a level to the next the limits of {} change by at most {} in position and {} "
        "in normal",
        who, amount(drift.position, in_units(drift.position.max, unit)),
        amount(drift.normal, fmt::format("{:.3g} degrees", in_degrees(drift.normal.max))));
    if (drift.unexplained > 0)
        out += fmt::format("; at {} by more than rounding, which no known deviation predicts",
                           vertices(drift.unexplained));
    return out + ".";
}

double unit_of(const LimitSide& a, const LimitSide& b) {
    return error_unit(a.witness->largest_coordinate, a.subject->precision, b.subject->precision);
}

}  // namespace

double in_degrees(double radians) {
    return glm::degrees(radians);
}

LimitStats total(const LimitComparison& comparison) {
    LimitStats all;
    for (const LimitLevelResult& level : comparison.levels) all.add(total(level));
    return all;
}

std::string amounts_in_words(const DeviationSeen& seen, double largest_coordinate) {
    const auto amounts = [&](double position, double angle) {
        std::vector<std::string> parts;
        if (position > 0)
            parts.push_back(
                fmt::format("{:.6g} ({:.3g} % of M)", position, 100 * position / largest_coordinate));
        if (angle > 0) parts.push_back(fmt::format("{:.6g} degrees", in_degrees(angle)));
        return parts.empty() ? std::string("noise") : fmt::format("up to {}", fmt::join(parts, " and "));
    };
    return fmt::format("predicted {}, observed {}", amounts(seen.predicted_position, seen.predicted_angle),
                       amounts(seen.observed_position, seen.observed_angle));
}

std::vector<std::string> undefined_in_words(const LimitStats& stats) {
    std::vector<std::string> out;
    for (const auto& [reason, count] : stats.undefined)
        out.push_back(fmt::format("{}: {}", vertices(count), core::sentence(reason)));
    return out;
}

std::vector<std::string> limits_in_words(const LimitComparison& c, const LimitSide& a, const LimitSide& b) {
    const LimitStats all = total(c);
    const double unit = unit_of(a, b);
    std::vector<std::string> out;
    for (const DeviationSeen& seen : c.deviations)
        if (seen.vanished > 0) out.push_back(vanished_sentence(seen, a, b));
    if (all.by_declaration > 0)
        out.push_back(
            fmt::format("The rules differ by declaration: {} has the weights of {}, {} those of {}; so {} "
                        "differ, each side being right by its own.",
                        a.subject->name, core::name(a.witness->options.weights), b.subject->name,
                        core::name(b.witness->options.weights), vertices(all.by_declaration)));
    if (all.position.unexplained + all.normal.unexplained > 0) add_unexplained(c, a, b, out);
    if (c.verdict <= Verdict::WithinRounding)
        out.push_back(
            fmt::format("The limits of {} and {} differ by at most {} in position and {:.3g} degrees in "
                        "normal; rounding explains every difference (largest use of a bound: {:.2f}).",
                        a.subject->name, b.subject->name, in_units(all.position.difference.max, unit),
                        in_degrees(all.normal.difference.max),
                        std::max(all.position.largest_bound_use, all.normal.largest_bound_use)));
    for (const DeviationSeen& seen : c.deviations)
        if (seen.vertices > 0) out.push_back(deviation_sentence(seen, a.witness->largest_coordinate));
    out.push_back(drift_sentence(a.subject->name, all.subject_drift, unit));
    out.push_back(drift_sentence(b.subject->name, all.reference_drift, unit));
    return out;
}

}  // namespace loopcheck::compare
