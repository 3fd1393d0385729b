#include <fmt/format.h>

#include <cmath>

#include "compare/surface/surface_comparison.h"
#include "core/loop/error_bound.h"

namespace loopcheck::compare {
namespace {

std::string missing_in_words(const KnownDeviation& deviation, const DeviationCount& seen) {
    return fmt::format(
        "The known deviation {} must show at {} places and does not at {}: is it mended? Then it must leave "
        "the "
        "list.",
        deviation.name, seen.expected, seen.missing > 0 ? seen.missing : seen.expected);
}

std::string shown_in_words(const KnownDeviation& deviation, const DeviationCount& seen) {
    return fmt::format(
        "{}: {} Shows at {} of {} places where it may, and nowhere else; up to {:.3g} in weights.",
        deviation.name, deviation.what, seen.shown, std::max(seen.expected, seen.possible), seen.largest);
}

std::string beyond_in_words(const SurfaceComparison& c) {
    std::string out;
    for (const auto& [face_class, stats] : c.classes)
        if (stats.beyond > 0)
            out += fmt::format("{}{}: {} of {} samples", out.empty() ? "" : "; ", to_string(face_class),
                               stats.beyond, stats.samples);
    return out.empty() ? out : "Beyond what is predicted: " + out + ".";
}

}  // namespace

void give_verdict(SurfaceComparison& c, std::span<const KnownDeviation> list) {
    std::size_t samples = 0;
    for (const auto& [face_class, stats] : c.classes) samples += stats.samples;
    if (samples == 0) {
        c.verdict = Verdict::NotSupported;
        c.notes = {"No face has a limit surface; nothing was compared."};
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
        c.notes.push_back(fmt::format("{} faces have a surface and should have none.", c.unwanted_surface));
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
        c.notes.push_back(shown_in_words(*deviation, seen));
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

SurfaceComparison compare_surface_with_rates(const core::TriangleMesh& mesh,
                                             const core::SchemeOptions& options, const SurfaceCheck& check,
                                             const SurfaceEvaluator& evaluate,
                                             const SurfaceProgress& progress) {
    LocalErrors local(check.way, evaluate);
    SurfaceComparison out = compare_surface(mesh, options, check, evaluate, local, progress);
    if (out.classes.empty() || check.sharp_level + 2 > reference::kOpensubdivMaxSurfaceLevel) return out;
    SurfaceCheck deeper_check = check;
    deeper_check.smooth_level += 2;
    deeper_check.sharp_level += 2;
    const SurfaceComparison deeper = compare_surface(mesh, options, deeper_check, evaluate, local, progress);
    const double rounding = 1000 * core::unit_roundoff(core::Precision::Double) * out.largest_coordinate;
    for (auto& [face_class, stats] : out.classes) {
        const auto found = deeper.classes.find(face_class);
        if (found != deeper.classes.end() && stats.position > rounding && found->second.position > rounding)
            stats.rate = std::sqrt(found->second.position / stats.position);
    }
    if (exit_code(deeper.verdict) > 0) {
        out.verdict =
            worse_exit_code(exit_code(out.verdict), exit_code(deeper.verdict)) == exit_code(deeper.verdict)
                ? deeper.verdict
                : out.verdict;
        for (const std::string& note : deeper.notes)
            out.notes.push_back(fmt::format("At the levels {} and {}: {}", deeper_check.smooth_level,
                                            deeper_check.sharp_level, note));
    }
    return out;
}

}  // namespace loopcheck::compare
