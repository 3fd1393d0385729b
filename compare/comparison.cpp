#include "compare/comparison.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace loopcheck::compare {
namespace {

using core::Index;
using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// NaN and infinity count as the largest error there is, so that they can never pass for a small one.
double largest(const dvec3& v) {
    double out = 0;
    for (int i = 0; i < 3; ++i)
        if (!(v[i] <= out)) out = std::isfinite(v[i]) ? v[i] : kInfinity;
    return out;
}

bool same_bits(const dvec3& a, const dvec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    return true;
}

// How much of the allowed difference is used: above 1 it is violated.  Exact agreement uses nothing, even of
// nothing.
double use_of(double difference, double allowed) {
    if (!std::isfinite(difference)) return kInfinity;
    if (difference == 0) return 0;
    return allowed > 0 ? difference / allowed : kInfinity;
}

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
            keep_worst(record, static_cast<std::size_t>(top));
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
        r.identical = same_bits(r.subject, r.reference);

        const dvec3 signed_difference = r.subject - r.reference;
        const dvec3 difference = glm::abs(signed_difference);
        r.error = largest(difference);
        const dvec3 from_exact_a = distance_from_exact(truth_a_, v, r.subject);
        const dvec3 from_exact_b = distance_from_exact(truth_b_, v, r.reference);
        r.subject_error = largest(from_exact_a);
        r.reference_error = largest(from_exact_b);

        const dvec3 predicted =
            (truth_a_.exact[v] - truth_b_.exact[v]) + (truth_a_.exact_rest[v] - truth_b_.exact_rest[v]);
        const dvec3& bound_a = truth_a_.bound(a_.subject->precision)[v];
        const dvec3& bound_b = truth_b_.bound(b_.subject->precision)[v];
        ClassStats& stats = out_.classes[r.vertex_class];
        bool explained = true, right_a = true, right_b = true;
        for (int i = 0; i < 3; ++i) {
            const double allowed = bound_a[i] + bound_b[i];
            const double use = use_of(difference[i], allowed);
            if (i == 0 || use > r.bound_use) {
                r.bound = allowed;
                r.bound_use = use;
            }
            // The predicted difference of two doubles is itself rounded once more.
            const double slack = allowed + std::abs(predicted[i]) * 0x1p-51;
            explained = explained && std::abs(signed_difference[i] - predicted[i]) <= slack;
            right_a = right_a && from_exact_a[i] <= bound_a[i];
            right_b = right_b && from_exact_b[i] <= bound_b[i];
        }
        if (!(r.bound_use <= 1)) ++stats.beyond_bound;
        if (!explained) ++stats.unexplained;
        if (!right_a) ++stats.subject_wrong;
        if (!right_b) ++stats.reference_wrong;
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

    // Keeps the `top` worst seen so far, as a heap whose front is the least bad of them.
    void keep_worst(const VertexRecord& record, std::size_t top) {
        auto& heap = out_.worst;
        if (heap.size() >= top && (top == 0 || !worse(record, heap.front()))) return;
        heap.push_back(record);
        std::push_heap(heap.begin(), heap.end(), worse);
        if (heap.size() > top) {
            std::pop_heap(heap.begin(), heap.end(), worse);
            heap.pop_back();
        }
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

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::Identical:
            return "identical";
        case Verdict::WithinRounding:
            return "within rounding";
        case Verdict::KnownDeviation:
            return "known deviation";
        case Verdict::NotSupported:
            return "not supported";
        case Verdict::Differs:
            return "differs";
        case Verdict::Failed:
            return "failed";
    }
    return {};
}

int exit_code(Verdict verdict) {
    switch (verdict) {
        case Verdict::Identical:
        case Verdict::WithinRounding:
        case Verdict::KnownDeviation:
            return 0;
        case Verdict::Differs:
            return 1;
        case Verdict::NotSupported:
        case Verdict::Failed:
            return 3;
    }
    return 3;
}

int worse_exit_code(int a, int b) {
    constexpr std::array kWorstFirst{2, 3, 1, 0};
    for (const int code : kWorstFirst)
        if (a == code || b == code) return code;
    return a;
}

double error_unit(double largest_coordinate, core::Precision a, core::Precision b) {
    const auto unit = [&](core::Precision p) {
        return std::max(largest_coordinate * core::unit_roundoff(p), core::smallest_subnormal(p));
    };
    return std::max(unit(a), unit(b));
}

void ErrorStats::add(double error, bool same) {
    ++count;
    if (same) ++identical;
    if (!std::isfinite(error)) {
        ++not_finite;
        return;
    }
    max = std::max(max, error);
    sum += error;
    norm = std::hypot(norm, error);
}

void ErrorStats::add(const ErrorStats& other) {
    count += other.count;
    identical += other.identical;
    not_finite += other.not_finite;
    max = std::max(max, other.max);
    sum += other.sum;
    norm = std::hypot(norm, other.norm);
}

double ErrorStats::mean() const {
    return count > not_finite ? sum / static_cast<double>(count - not_finite) : 0;
}

double ErrorStats::rms() const {
    return count > not_finite ? norm / std::sqrt(static_cast<double>(count - not_finite)) : 0;
}

ClassStats total(const LevelResult& level) {
    ClassStats all;
    for (const auto& [vertex_class, stats] : level.classes) {
        all.difference.add(stats.difference);
        all.subject_error.add(stats.subject_error);
        all.reference_error.add(stats.reference_error);
        all.largest_bound_use = std::max(all.largest_bound_use, stats.largest_bound_use);
        all.predicted = std::max(all.predicted, stats.predicted);
        all.beyond_bound += stats.beyond_bound;
        all.unexplained += stats.unexplained;
        all.subject_wrong += stats.subject_wrong;
        all.reference_wrong += stats.reference_wrong;
        all.rule_mismatches += stats.rule_mismatches;
    }
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
