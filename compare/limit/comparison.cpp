#include "compare/limit/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <memory>

namespace loopcheck::compare {
namespace {

using core::Index;
using core::NoNormal;
using glm::dvec3;

// What a value is found to be, worst last.
enum class Standing : std::uint8_t {
    Right,        // within the bound of the exact value
    AsDeviation,  // as a known deviation predicts, and not exact too
    Vanished,     // exact where a known deviation predicts otherwise, beyond rounding
    Wrong,
};

// A value that may be exact or as predicted, the two being apart by more than rounding or not.
Standing standing(bool exact, bool as_predicted, bool apart) {
    if (as_predicted && (apart || !exact)) return Standing::AsDeviation;
    if (!exact) return Standing::Wrong;
    return apart ? Standing::Vanished : Standing::Right;
}

// One side at one vertex.
struct Judged {
    dvec3 observed{0};
    Plane plane;  // observed
    ExactLimit truth, done;
    const KnownDeviation* deviation = nullptr;  // that applies, whether it shows or not
    Standing position = Standing::Right, normal = Standing::Right;

    Standing worst() const { return std::max(position, normal); }
    bool is(Standing s) const { return position == s || normal == s; }
};

// What the next level needs to know of a side at a vertex.
struct Kept {
    dvec3 position{0}, bound{0};
    Plane plane;            // observed, with the bound of the exact one
    bool compared = false;  // its normal
    bool deviates = false;  // as predicted
};

// A vertex of valence 2, whose second tangent the ring says is 0.
const core::LimitMasks<core::HighPrecision>& valence_two_masks() {
    static const core::LimitMasks<core::HighPrecision> masks{
        {0, 0, 1}, {{{0, 2}, NoNormal::ValenceTwo, {1, -1, 0}, {0, 0, 0}}}};
    return masks;
}

// One side of one level.
class SideLevel {
  public:
    SideLevel(const LimitSide& side, std::span<const KnownDeviation> deviations, int level)
        : side_(side),
          limits_(side.limits->levels[level]),
          vertex_of_(side.match->vertex_of[level]),
          level_(side.witness->levels[level]),
          scheme_(level_.scheme),
          truth_(side.witness->levels[level], side.witness->options),
          done_(side.done->levels[level], side.done->options),
          masks_(deviations, side.subject->family) {}

    // `truth` where it is known already.
    Judged judge(Index v, const ExactLimit* truth) {
        const core::Precision precision = side_.subject->precision;
        const Index own = vertex_of_[v];
        Judged out;
        out.observed = limits_.positions[own];
        out.plane = plane_of(limits_.tangent1[own], limits_.tangent2[own]);
        out.truth = truth != nullptr ? *truth : truth_.limit(v, precision);
        const auto& found = masks_.at(limit_vertex(scheme_, v));
        out.deviation = found.deviation != nullptr ? found.deviation : side_.refinement_deviation;
        if (found.deviation != nullptr)
            out.done = done_.limit(v, found.masks, precision);
        else
            out.done = side_.done == side_.witness ? out.truth : done_.limit(v, precision);
        out.position = position_standing(out);
        out.normal = out.truth.no_normal == NoNormal::ValenceTwo
                         ? noise_standing(v, limits_.tangent2[own], found.deviation)
                         : normal_standing(out);
        return out;
    }

    Index own(Index v) const { return vertex_of_[v]; }

  private:
    static Standing position_standing(const Judged& j) {
        const bool exact = is_within(distance_from_exact(j.truth, j.observed), j.truth.bound);
        if (j.deviation == nullptr) return standing(exact, false, false);
        return standing(
            exact, is_within(distance_from_exact(j.done, j.observed), j.done.bound),
            !is_within(distance_from_exact(j.truth, j.done.position), j.truth.bound + j.done.bound));
    }

    static Standing normal_standing(const Judged& j) {
        if (j.truth.no_normal != NoNormal::None) return Standing::Right;
        if (!(std::isfinite(j.truth.plane.bound) && std::isfinite(j.done.plane.bound)))
            return Standing::Right;
        const bool exact = angle_between(j.plane, j.truth.plane) <= j.truth.plane.bound;
        if (j.deviation == nullptr) return standing(exact, false, false);
        return standing(
            exact, angle_between(j.plane, j.done.plane) <= j.done.plane.bound,
            angle_between(j.truth.plane, j.done.plane) > j.truth.plane.bound + j.done.plane.bound);
    }

    // At valence 2 the ring has no second tangent: one that is not 0 but no larger than the rounding errors
    // of the sum is noise, and expected where limit-valence-2 says so.  A larger one is from elsewhere and
    // cannot be judged.  None at all shows that it is mended where the noise, sin(pi) times the second
    // neighbour, would be there.
    Standing noise_standing(Index v, const dvec3& tangent, const KnownDeviation* deviation) {
        if (deviation != nullptr && deviation->name != "limit-valence-2") return Standing::Right;
        const core::Precision precision = side_.subject->precision;
        const dvec3 bound = truth_.limit(v, valence_two_masks(), precision).tangent2_bound;
        const bool listed = deviation != nullptr;
        if (!is_within(glm::abs(tangent), bound)) return listed ? Standing::Wrong : Standing::Right;
        if (tangent != dvec3(0)) return listed ? Standing::AsDeviation : Standing::Wrong;
        return listed && has_noise(v, precision) ? Standing::Vanished : Standing::Right;
    }

    bool has_noise(Index v, core::Precision precision) const {
        const core::Topology& t = level_.scheme.topology;
        const Index second = t.other_end(t.ring(v)[1], v);
        const double reach = largest(glm::abs(level_.exact[second]) - level_.bound(precision)[second]);
        return core::unit_roundoff(core::Precision::Double) * reach > core::smallest_subnormal(precision);
    }

    const LimitSide& side_;
    const core::LimitLevel& limits_;
    const std::vector<Index>& vertex_of_;
    const WitnessLevel& level_;
    const core::SchemeLevel& scheme_;
    LimitOracle truth_, done_;
    DeviatingMasks masks_;
};

bool worse(const LimitRecord& a, const LimitRecord& b) {
    const auto use = [](const LimitRecord& r) { return std::max(r.position.bound_use, r.normal.bound_use); };
    if (use(a) != use(b)) return use(a) > use(b);
    return a.position.vertex < b.position.vertex;
}

NormalStatus status_of(const Judged& a, const Judged& b) {
    if (a.truth.no_normal != NoNormal::None || b.truth.no_normal != NoNormal::None)
        return NormalStatus::Undefined;
    for (const Judged* j : {&a, &b})
        if (!std::isfinite(j->truth.plane.bound) || !std::isfinite(j->done.plane.bound))
            return NormalStatus::Undetermined;
    return NormalStatus::Compared;
}

// Compares one level; goes on from the level before, for the drift.
class LimitLevelComparer {
  public:
    LimitLevelComparer(const LimitSide& subject, const LimitSide& reference,
                       std::span<const KnownDeviation> deviations, int level)
        : sides_{&subject, &reference},
          truth_(subject.witness->levels[level]),
          a_(subject, deviations, level),
          b_(reference, deviations, level),
          same_truth_(subject.witness == reference.witness &&
                      subject.subject->precision == reference.subject->precision) {
        out_.level = level;
    }

    void run(int top, const LimitVisitor& visit, std::vector<DeviationSeen>& seen) {
        const Index count = truth_.scheme.topology.vertex_count;
        for (auto& kept : kept_) kept.reserve(count);
        for (Index v = 0; v < count; ++v) {
            const Judged a = a_.judge(v, nullptr);
            const Judged b = b_.judge(v, same_truth_ ? &a.truth : nullptr);
            LimitRecord r;
            r.position = position_record(v, a, b);
            r.normal = normal_record(a, b);
            LimitStats& stats = out_.classes[r.position.vertex_class];
            count_position(r.position, a, b, stats.position);
            count_normal(r.normal, a, b, stats);
            count_standing(r, a, b, stats);
            note_deviation(r, 0, a, seen);
            note_deviation(r, 1, b, seen);
            keep(r.normal, a, b);
            if (visit) visit(r);
            keep_worst(out_.worst, r, static_cast<std::size_t>(top), worse);
        }
        std::sort(out_.worst.begin(), out_.worst.end(), worse);
    }

    // The limits of the level before against those of their vertex points here.
    void add_drift(LimitLevelComparer& before) const {
        for (Index v = 0; v < before.truth_.scheme.topology.vertex_count; ++v) {
            LimitStats& stats = before.out_.classes[before.truth_.scheme.classes[v]];
            count_drift(before.kept_[0][v], kept_[0][v], stats.subject_drift);
            count_drift(before.kept_[1][v], kept_[1][v], stats.reference_drift);
        }
    }

    LimitLevelResult finish() && {
        out_.verdict = verdict();
        return std::move(out_);
    }

  private:
    VertexRecord position_record(Index v, const Judged& a, const Judged& b) const {
        VertexRecord r;
        r.level = out_.level;
        r.vertex = v;
        r.subject_vertex = a_.own(v);
        r.reference_vertex = b_.own(v);
        if (out_.level > 0) {
            r.ancestor = truth_.ancestors[v];
            r.mask = truth_.rows.mask(v);
        }
        r.vertex_class = truth_.scheme.classes[v];
        r.subject = a.observed;
        r.reference = b.observed;
        r.exact = a.truth.position;
        r.subject_error = largest(distance_from_exact(a.truth, a.observed));
        r.reference_error = largest(distance_from_exact(b.truth, b.observed));
        const PointDifference d =
            difference_between(a.observed, b.observed, a.truth.bound + b.truth.bound, dvec3(0));
        r.identical = d.identical;
        r.error = d.error;
        r.bound = d.bound;
        r.bound_use = d.bound_use;
        return r;
    }

    static void count_position(const VertexRecord& r, const Judged& a, const Judged& b, ClassStats& stats) {
        stats.difference.add(r.error, r.identical);
        stats.subject_error.add(r.subject_error, same_bits(r.subject, a.truth.position));
        stats.reference_error.add(r.reference_error, same_bits(r.reference, b.truth.position));
        stats.largest_bound_use = std::max(stats.largest_bound_use, r.bound_use);
        stats.largest_bound = std::max(stats.largest_bound, largest(a.truth.bound + b.truth.bound));
        stats.predicted = std::max(stats.predicted, largest(glm::abs(a.done.position - b.done.position)));
        if (!(r.bound_use <= 1)) ++stats.beyond_bound;
        if (std::max(a.position, b.position) == Standing::Wrong) ++stats.unexplained;
        if (!is_within(distance_from_exact(a.truth, a.observed), a.truth.bound)) ++stats.subject_wrong;
        if (!is_within(distance_from_exact(b.truth, b.observed), b.truth.bound)) ++stats.reference_wrong;
    }

    static NormalRecord normal_record(const Judged& a, const Judged& b) {
        NormalRecord r;
        r.status = status_of(a, b);
        r.reason = a.truth.no_normal;
        r.subject = a.plane.normal;
        r.reference = b.plane.normal;
        r.exact = a.truth.plane.normal;
        if (r.status != NormalStatus::Compared) return r;
        r.error = angle_between(a.plane, b.plane);
        r.subject_error = angle_between(a.plane, a.truth.plane);
        r.reference_error = angle_between(b.plane, b.truth.plane);
        r.bound = a.truth.plane.bound + b.truth.plane.bound;
        r.bound_use = use_of(r.error, r.bound);
        return r;
    }

    static void count_normal(const NormalRecord& r, const Judged& a, const Judged& b, LimitStats& all) {
        if (r.status == NormalStatus::Undefined) ++all.undefined[r.reason];
        if (r.status == NormalStatus::Undetermined) ++all.undetermined;
        if (r.status != NormalStatus::Compared) return;
        ClassStats& stats = all.normal;
        stats.difference.add(r.error, same_bits(r.subject, r.reference));
        stats.subject_error.add(r.subject_error, same_bits(r.subject, r.exact));
        stats.reference_error.add(r.reference_error, same_bits(r.reference, b.truth.plane.normal));
        stats.largest_bound_use = std::max(stats.largest_bound_use, r.bound_use);
        stats.predicted = std::max(stats.predicted, angle_between(a.done.plane, b.done.plane));
        if (!(r.bound_use <= 1)) ++stats.beyond_bound;
        if (std::max(a.normal, b.normal) == Standing::Wrong) ++stats.unexplained;
        if (!(r.subject_error <= a.truth.plane.bound)) ++stats.subject_wrong;
        if (!(r.reference_error <= b.truth.plane.bound)) ++stats.reference_wrong;
    }

    void count_standing(const LimitRecord& r, const Judged& a, const Judged& b, LimitStats& stats) const {
        const bool deviates = a.is(Standing::AsDeviation) || b.is(Standing::AsDeviation);
        if (deviates) ++stats.as_deviation;
        if (a.is(Standing::Vanished) || b.is(Standing::Vanished)) ++stats.vanished;
        // Noise at valence 2 that is not noise is not counted with the normals that were compared.
        if (r.normal.status != NormalStatus::Compared && std::max(a.normal, b.normal) == Standing::Wrong)
            ++stats.normal.unexplained;
        const bool beyond = !(r.position.bound_use <= 1) || !(r.normal.bound_use <= 1);
        if (beyond && !deviates && std::max(a.worst(), b.worst()) == Standing::Right) ++stats.by_declaration;
    }

    void note_deviation(LimitRecord& r, int side, const Judged& j, std::vector<DeviationSeen>& seen) const {
        const bool shows = j.is(Standing::AsDeviation), vanished = j.is(Standing::Vanished);
        if (!shows && !vanished) return;
        DeviationSeen here{j.deviation, sides_[side]->subject->name, shows ? 1U : 0U, vanished ? 1U : 0U};
        if (j.position == Standing::AsDeviation) {
            here.predicted_position = largest(distance_from_exact(j.truth, j.done.position));
            here.observed_position = largest(distance_from_exact(j.truth, j.observed));
        }
        if (j.normal == Standing::AsDeviation && j.truth.no_normal == NoNormal::None) {
            here.predicted_angle = angle_between(j.truth.plane, j.done.plane);
            here.observed_angle = angle_between(j.truth.plane, j.plane);
        }
        if (shows) r.deviation = j.deviation->name;
        const auto found = std::find_if(seen.begin(), seen.end(), [&](const DeviationSeen& s) {
            return s.deviation == here.deviation && s.subject == here.subject;
        });
        if (found == seen.end())
            seen.push_back(here);
        else
            found->add(here);
    }

    void keep(const NormalRecord& r, const Judged& a, const Judged& b) {
        for (const auto& [list, j] : {std::pair(&kept_[0], &a), std::pair(&kept_[1], &b)})
            list->push_back({j->observed,
                             j->truth.bound,
                             {j->plane.normal, j->truth.plane.bound},
                             r.status == NormalStatus::Compared,
                             j->is(Standing::AsDeviation)});
    }

    static void count_drift(const Kept& here, const Kept& next, DriftStats& stats) {
        const PointDifference d =
            difference_between(here.position, next.position, here.bound + next.bound, dvec3(0));
        stats.position.add(d.error, d.identical);
        bool beyond = !(d.bound_use <= 1);
        if (here.compared && next.compared) {
            const double angle = angle_between(here.plane, next.plane);
            stats.normal.add(angle, same_bits(here.plane.normal, next.plane.normal));
            beyond = beyond || !(angle <= here.plane.bound + next.plane.bound);
        }
        if (beyond && !here.deviates && !next.deviates) ++stats.unexplained;
    }

    Verdict verdict() const {
        const LimitStats all = total(out_);
        if (all.position.unexplained + all.normal.unexplained + all.vanished + all.by_declaration +
                all.subject_drift.unexplained + all.reference_drift.unexplained >
            0)
            return Verdict::Differs;
        if (all.as_deviation > 0) return Verdict::KnownDeviation;
        const auto identical = [](const ErrorStats& stats) { return stats.identical == stats.count; };
        return identical(all.position.difference) && identical(all.normal.difference)
                   ? Verdict::Identical
                   : Verdict::WithinRounding;
    }

    std::array<const LimitSide*, 2> sides_;
    const WitnessLevel& truth_;
    SideLevel a_, b_;
    bool same_truth_;
    std::array<std::vector<Kept>, 2> kept_;
    LimitLevelResult out_;
};

}  // namespace

void DriftStats::add(const DriftStats& other) {
    position.add(other.position);
    normal.add(other.normal);
    unexplained += other.unexplained;
}

std::size_t LimitStats::undefined_count() const {
    std::size_t out = 0;
    for (const auto& [reason, count] : undefined) out += count;
    return out;
}

void LimitStats::add(const LimitStats& other) {
    position.add(other.position);
    normal.add(other.normal);
    for (const auto& [reason, count] : other.undefined) undefined[reason] += count;
    undetermined += other.undetermined;
    as_deviation += other.as_deviation;
    vanished += other.vanished;
    by_declaration += other.by_declaration;
    subject_drift.add(other.subject_drift);
    reference_drift.add(other.reference_drift);
}

void DeviationSeen::add(const DeviationSeen& other) {
    vertices += other.vertices;
    vanished += other.vanished;
    predicted_position = std::max(predicted_position, other.predicted_position);
    observed_position = std::max(observed_position, other.observed_position);
    predicted_angle = std::max(predicted_angle, other.predicted_angle);
    observed_angle = std::max(observed_angle, other.observed_angle);
}

LimitStats total(const LimitLevelResult& level) {
    LimitStats all;
    for (const auto& [vertex_class, stats] : level.classes) all.add(stats);
    return all;
}

LimitComparison compare_limits(const LimitSide& subject, const LimitSide& reference,
                               std::span<const KnownDeviation> deviations, int top,
                               const LimitVisitor& visit) {
    LimitComparison out;
    std::unique_ptr<LimitLevelComparer> before;
    const auto finish = [&] {
        if (!before) return;
        out.levels.push_back(std::move(*before).finish());
        out.verdict = std::max(out.verdict, out.levels.back().verdict);
    };
    for (std::size_t l = 0; l < subject.witness->levels.size(); ++l) {
        auto level =
            std::make_unique<LimitLevelComparer>(subject, reference, deviations, static_cast<int>(l));
        level->run(top, visit, out.deviations);
        if (before) level->add_drift(*before);
        finish();
        before = std::move(level);
    }
    finish();
    std::stable_sort(
        out.deviations.begin(), out.deviations.end(),
        [](const DeviationSeen& a, const DeviationSeen& b) { return a.deviation < b.deviation; });
    return out;
}

}  // namespace loopcheck::compare
