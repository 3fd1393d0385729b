#include "compare/comparison.h"

#include <algorithm>
#include <glm/common.hpp>

namespace loopcheck::compare {
namespace {

using core::Index;
using glm::dvec3;

bool worse(const VertexRecord& a, const VertexRecord& b) {
    if (a.error != b.error) return a.error > b.error;
    if (a.bound_use != b.bound_use) return a.bound_use > b.bound_use;
    return a.vertex < b.vertex;
}

class LevelComparer {
  public:
    LevelComparer(const Side& subject, const Side& reference, int level)
        : a_(subject),
          b_(reference),
          truth_a_(subject.witness->levels[level]),
          truth_b_(reference.witness->levels[level]),
          made_a_(subject.refinement->levels[level]),
          made_b_(reference.refinement->levels[level]),
          rules_(core::vertex_rules(truth_a_.scheme.topology, truth_a_.scheme.sharpness)) {
        out_.level = level;
        out_.faces = truth_a_.scheme.topology.triangles.size();
    }

    LevelResult run(int top, const VertexVisitor& visit) {
        for (Index v = 0; v < truth_a_.scheme.topology.vertex_count; ++v) {
            const VertexRecord record = compare_vertex(v);
            if (visit) visit(record);
            keep_worst(out_.worst, record, static_cast<std::size_t>(top), worse);
        }
        std::sort(out_.worst.begin(), out_.worst.end(), worse);
        return std::move(out_);
    }

  private:
    VertexRecord compare_vertex(Index v) {
        VertexRecord r;
        r.level = out_.level;
        r.vertex = v;
        r.subject_vertex = a_.match->vertex_of[out_.level][v];
        r.reference_vertex = b_.match->vertex_of[out_.level][v];
        if (out_.level > 0) {
            r.ancestor = truth_a_.ancestors[v];
            r.mask = truth_a_.rows.mask(v);
        }
        r.vertex_class = truth_a_.scheme.classes[v];
        r.subject = made_a_.positions[r.subject_vertex];
        r.reference = made_b_.positions[r.reference_vertex];
        r.exact = truth_a_.exact[v];
        const dvec3 from_exact_a = distance_from_exact(truth_a_, v, r.subject);
        const dvec3 from_exact_b = distance_from_exact(truth_b_, v, r.reference);
        r.subject_error = largest(from_exact_a);
        r.reference_error = largest(from_exact_b);

        const dvec3 predicted =
            (truth_a_.exact[v] - truth_b_.exact[v]) + (truth_a_.exact_rest[v] - truth_b_.exact_rest[v]);
        const dvec3& bound_a = truth_a_.bound(a_.subject->precision)[v];
        const dvec3& bound_b = truth_b_.bound(b_.subject->precision)[v];
        const PointDifference d = difference_between(r.subject, r.reference, bound_a + bound_b, predicted);
        r.identical = d.identical;
        r.error = d.error;
        r.bound = d.bound;
        r.bound_use = d.bound_use;
        ClassStats& stats = out_.classes[r.vertex_class];
        if (!(r.bound_use <= 1)) ++stats.beyond_bound;
        if (!d.as_predicted) ++stats.unexplained;
        if (!is_within(from_exact_a, bound_a)) ++stats.subject_wrong;
        if (!is_within(from_exact_b, bound_b)) ++stats.reference_wrong;
        stats.largest_bound = std::max(stats.largest_bound, largest(bound_a + bound_b));
        stats.predicted = std::max(stats.predicted, largest(glm::abs(predicted)));
        count(r, stats);
        return r;
    }

    void count(const VertexRecord& r, ClassStats& stats) const {
        stats.difference.add(r.error, r.identical);
        stats.subject_error.add(r.subject_error, same_bits(r.subject, truth_a_.exact[r.vertex]));
        stats.reference_error.add(r.reference_error, same_bits(r.reference, truth_b_.exact[r.vertex]));
        stats.largest_bound_use = std::max(stats.largest_bound_use, r.bound_use);
        const core::VertexTag tag{rules_[r.vertex], truth_a_.scheme.topology.is_boundary_vertex(r.vertex)};
        const auto mismatch = [&](const core::RefinedLevel& made, Index v) {
            return !made.tags.empty() && made.tags[v] != tag;
        };
        if (mismatch(made_a_, r.subject_vertex) || mismatch(made_b_, r.reference_vertex))
            ++stats.rule_mismatches;
    }

    const Side& a_;
    const Side& b_;
    const WitnessLevel& truth_a_;
    const WitnessLevel& truth_b_;
    const core::RefinedLevel& made_a_;
    const core::RefinedLevel& made_b_;
    std::vector<core::VertexRule> rules_;
    LevelResult out_;
};

Verdict level_verdict(const LevelResult& level) {
    const ClassStats all = total(level);
    if (all.beyond_bound > 0 || all.rule_mismatches > 0) return Verdict::Differs;
    return all.difference.identical == all.difference.count ? Verdict::Identical : Verdict::WithinRounding;
}

}  // namespace

ClassStats total(const LevelResult& level) {
    ClassStats all;
    for (const auto& [vertex_class, stats] : level.classes) all.add(stats);
    return all;
}

Comparison compare(const Side& subject, const Side& reference, int top, const VertexVisitor& visit) {
    Comparison out;
    out.subject = subject.subject->name;
    out.reference = reference.subject->name;
    out.subject_precision = subject.subject->precision;
    out.reference_precision = reference.subject->precision;
    out.options = subject.witness->options;
    out.largest_coordinate = subject.witness->largest_coordinate;
    out.diagonal = subject.witness->diagonal;
    for (std::size_t l = 0; l < subject.witness->levels.size(); ++l) {
        LevelResult level = LevelComparer(subject, reference, static_cast<int>(l)).run(top, visit);
        level.verdict = level_verdict(level);
        out.verdict = std::max(out.verdict, level.verdict);
        out.levels.push_back(std::move(level));
    }
    return out;
}

}  // namespace loopcheck::compare
