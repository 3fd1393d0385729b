#include "compare/adaptive/adaptive_comparison.h"

#include <fmt/format.h>

#include <utility>

#include "compare/memory.h"
#include "compare/referee.h"

namespace loopcheck::compare {
namespace {

// Uniform refinement, in our numbering.
struct UniformLevel {
    std::vector<glm::dvec3> ours, subjects;
};

std::vector<UniformLevel> uniform_levels(Referee& referee, const Subject& ours, const Subject& subject,
                                         Comparison& judged) {
    std::vector<UniformLevel> levels(static_cast<std::size_t>(referee.levels()) + 1);
    judged = referee.judge(ours, subject, 0, [&](const VertexRecord& record) {
        UniformLevel& level = levels[static_cast<std::size_t>(record.level)];
        level.ours.push_back(record.subject);
        level.subjects.push_back(record.reference);
    });
    return levels;
}

// The classes of a level; counts those that are not where our own uniform refinement has them.
std::size_t compare_level(const core::RefinedLevel& mesh, const core::AdaptiveRecord& record,
                          const UniformLevel& uniform, AdaptiveLevelResult& out) {
    std::size_t broken = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        AdaptiveStats& stats = out.classes[record.classes[v]];
        if (record.uniform_vertex[v] == core::kNone) {
            ++stats.apart;
            continue;
        }
        const auto number = static_cast<std::size_t>(record.uniform_vertex[v]);
        const auto difference =
            difference_between(mesh.positions[v], uniform.subjects[number], glm::dvec3(0), glm::dvec3(0));
        (record.same_position[v] ? stats.checked : stats.held).add(difference.error, difference.identical);
        if (record.same_position[v] && !same_bits(mesh.positions[v], uniform.ours[number])) ++broken;
    }
    return broken;
}

// `refined` counts from level 1 on: level 0 is the model itself.
std::string identical_in_words(std::size_t refined, const Subject& subject) {
    if (refined == 0)
        return "No vertex after level 0 depends on subdividable faces only, so nothing was compared.";
    return fmt::format(
        "All {} vertices after level 0 that depend on subdividable faces only have the position "
        "of {}, bit for bit.",
        refined, subject.name);
}

}  // namespace

void AdaptiveStats::add(const AdaptiveStats& other) {
    checked.add(other.checked);
    held.add(other.held);
    apart += other.apart;
}

AdaptiveStats total(const AdaptiveLevelResult& level) {
    AdaptiveStats out;
    for (const auto& [vertex_class, stats] : level.classes) out.add(stats);
    return out;
}

std::vector<AdaptiveLevelResult> adaptive_levels(const core::TriangleMesh& mesh,
                                                 const core::AdaptiveRefinement& refinement) {
    std::vector<AdaptiveLevelResult> out;
    for (std::size_t l = 0; l < refinement.records.size(); ++l) {
        const core::RefinedLevel& level = refinement.refinement.levels[l];
        out.push_back({level.positions.size(),
                       level.triangles.size(),
                       refinement.records[l].subdividable,
                       refinement.records[l].counts,
                       level_size(mesh, static_cast<int>(l)).faces,
                       {}});
    }
    return out;
}

AdaptiveComparison compare_adaptive(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                    const core::AdaptiveRefinement& refinement, const Subject& ours,
                                    const Subject& subject) {
    AdaptiveComparison out;
    out.subject = subject.name;
    out.precision = subject.precision;
    out.options = options;
    out.largest_coordinate = mesh.largest_coordinate();
    out.diagonal = mesh.diagonal();
    out.levels = adaptive_levels(mesh, refinement);
    Comparison judged;
    Referee referee(mesh, options, static_cast<int>(refinement.records.size()) - 1);
    const auto uniform = uniform_levels(referee, ours, subject, judged);
    if (judged.levels.empty()) {  // nothing was compared
        out.verdict = judged.verdict;
        out.notes = judged.notes;
        return out;
    }
    std::size_t broken = 0;
    ErrorStats checked;
    for (std::size_t l = 0; l < out.levels.size(); ++l) {
        broken +=
            compare_level(refinement.refinement.levels[l], refinement.records[l], uniform[l], out.levels[l]);
        checked.add(total(out.levels[l]).checked);
    }
    if (broken > 0) {
        out.verdict = Verdict::Differs;
        out.notes = {
            fmt::format("{} vertices of the adaptive mesh depend on subdividable faces only, but are not "
                        "where our own uniform refinement has them.",
                        broken)};
    } else if (checked.identical == checked.count) {
        out.notes = {identical_in_words(checked.count - total(out.levels.front()).checked.count, subject)};
    } else {
        out.verdict = judged.verdict;
        out.notes = std::move(judged.notes);
    }
    return out;
}

}  // namespace loopcheck::compare
