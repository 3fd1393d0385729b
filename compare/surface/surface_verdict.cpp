#include <fmt/format.h>

#include <cmath>

#include "compare/surface/surface_comparison.h"
#include "core/loop/error_bound.h"

namespace loopcheck::compare {
namespace {

std::string missing_in_words(const KnownDeviation& deviation, const DeviationCount& seen) {
    return fmt::format(
        "The known deviation {} must show at {} places and does not at {}: is it mended? Then it must "
        "leave the list.",
        deviation.name, seen.expected, seen.missing > 0 ? seen.missing : seen.expected);
}

std::string shown_in_words(const KnownDeviation& deviation, const DeviationCount& seen,
                           std::string_view where) {
    return fmt::format("{}: {} Shows at {} of {} places where it may{}; up to {:.3g} in weights.",
                       deviation.name, deviation.what, seen.shown, std::max(seen.expected, seen.possible),
                       where, seen.largest);
}

std::string beyond_in_words(const SurfaceComparison& c) {
    std::string out;
    for (const auto& [face_class, stats] : c.classes)
        if (stats.beyond > 0)
            out += fmt::format("{}{}: {} of {} samples", out.empty() ? "" : "; ", to_string(face_class),
                               stats.beyond, stats.samples);
    return out.empty() ? out : "Beyond what is predicted: " + out + ".";
}

// The rates, and what is wrong two levels deeper.
void add_deeper(SurfaceComparison& out, const SurfaceComparison& deeper) {
    if (out.classes.empty()) return;
    const double rounding = 1000 * core::unit_roundoff(core::Precision::Double) * out.largest_coordinate;
    for (auto& [face_class, stats] : out.classes) {
        const auto found = deeper.classes.find(face_class);
        if (found != deeper.classes.end() && stats.position > rounding && found->second.position > rounding)
            stats.rate = std::sqrt(found->second.position / stats.position);
    }
    if (exit_code(deeper.verdict) == 0) return;
    if (worse_exit_code(exit_code(out.verdict), exit_code(deeper.verdict)) == exit_code(deeper.verdict))
        out.verdict = deeper.verdict;
    std::vector<std::string> notes;  // what failed comes first
    for (const std::string& note : deeper.notes)
        notes.push_back(fmt::format("At the levels {} and {}: {}", deeper.check.smooth_level,
                                    deeper.check.sharp_level, note));
    out.notes.insert(out.notes.begin(), notes.begin(), notes.end());
}

}  // namespace

void give_verdict(SurfaceComparison& c, std::span<const KnownDeviation> list) {
    std::size_t samples = 0;
    for (const auto& [face_class, stats] : c.classes) samples += stats.samples;
    if (samples == 0) {
        c.verdict = Verdict::NotSupported;
        c.notes = {c.reason.empty()
                       ? "The mesh has no face; nothing was compared."
                       : fmt::format("No face that was looked at has a limit surface.  {}", c.reason)};
        return;
    }
    c.verdict = Verdict::WithinRounding;
    bool wrong = false;
    if (auto beyond = beyond_in_words(c); !beyond.empty()) {
        wrong = true;
        c.notes.push_back(std::move(beyond));
    }
    if (c.unwanted_surface > 0) {
        wrong = true;
        c.notes.push_back(
            fmt::format("Faces that have a surface and should have none: {}.", c.unwanted_surface));
    }
    for (int i = 0; i < kSurfaceDeviations; ++i) {
        const DeviationCount& seen = c.deviations[i];
        const std::string_view called = name(static_cast<SurfaceDeviationId>(i));
        const KnownDeviation* deviation = find_deviation(list, called);
        if (deviation == nullptr) {
            if (seen.shown == 0) continue;
            wrong = true;
            c.notes.push_back(
                fmt::format("{} places differ as {} would, which is not on the list of known deviations.",
                            seen.shown, called));
            continue;
        }
        if (seen.missing > 0 || (seen.expected > 0 && seen.shown == 0)) {
            wrong = true;
            c.notes.push_back(missing_in_words(*deviation, seen));
        }
        if (seen.shown == 0) continue;
        c.verdict = Verdict::KnownDeviation;
        c.notes.push_back(shown_in_words(*deviation, seen, wrong ? "" : ", and nowhere else"));
    }
    if (c.overweight) {
        c.verdict = Verdict::KnownDeviation;
        c.notes.push_back(
            "chaikin-overweight: refinement deviates here, and the surface is that of the rules as "
            "OpenSubdiv follows them.");
    }
    if (wrong) c.verdict = Verdict::Differs;
    if (c.verdict == Verdict::WithinRounding) c.notes.push_back("Rounding explains every difference.");
}

std::vector<SurfaceComparison> compare_surfaces_with_rates(
    const core::TriangleMesh& mesh, const core::SchemeOptions& options, std::span<const SurfaceCheck> checks,
    const SurfaceEvaluator& evaluate, LocalErrors& local, const SurfaceProgress& progress) {
    // First those asked for, then the deeper ones, with what they belong to.
    std::vector<SurfaceCheck> all(checks.begin(), checks.end());
    std::vector<std::size_t> shallower;
    for (std::size_t i = 0; i < checks.size(); ++i) {
        if (checks[i].sharp_level + 2 > reference::kOpensubdivMaxSurfaceLevel) continue;
        SurfaceCheck& deeper = all.emplace_back(checks[i]);
        deeper.smooth_level += 2;
        deeper.sharp_level += 2;
        shallower.push_back(i);
    }
    auto out = compare_surfaces(mesh, options, all, evaluate, local, progress);
    for (std::size_t i = 0; i < shallower.size(); ++i) add_deeper(out[shallower[i]], out[checks.size() + i]);
    out.resize(checks.size());
    return out;
}

}  // namespace loopcheck::compare
