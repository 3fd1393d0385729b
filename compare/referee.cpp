#include "compare/referee.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/limit/words.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

bool is_agreement(Verdict verdict) {
    return verdict <= Verdict::WithinRounding;
}

// True where every difference is the one that the two sides' declared rules predict.
bool all_explained(const Comparison& comparison) {
    return std::all_of(comparison.levels.begin(), comparison.levels.end(), [](const LevelResult& level) {
        const ClassStats all = total(level);
        return all.unexplained == 0 && all.rule_mismatches == 0;
    });
}

// A refusal is no failure.
Verdict verdict_of(const core::Error& error) {
    const bool refusal = error.code == core::ErrorCode::Unsupported ||
                         error.code == core::ErrorCode::NotFinite || error.code == core::ErrorCode::TooLarge;
    return refusal ? Verdict::NotSupported : Verdict::Failed;
}

// What a subject said of the limit must have a value for every vertex of every level.
std::optional<core::Error> check_shape(const core::Limits& limits, const Witness& witness) {
    const auto failed = [](std::string sentence) {
        return core::Error{core::ErrorCode::SubjectFailed, std::move(sentence)};
    };
    if (limits.levels.size() != witness.levels.size())
        return failed(
            fmt::format("There are limits of {} levels where {} were asked for, the control mesh included.",
                        limits.levels.size(), witness.levels.size()));
    for (std::size_t l = 0; l < limits.levels.size(); ++l) {
        const auto count = static_cast<std::size_t>(witness.levels[l].scheme.topology.vertex_count);
        for (const auto* list :
             {&limits.levels[l].positions, &limits.levels[l].tangent1, &limits.levels[l].tangent2})
            if (list->size() != count)
                return failed(
                    fmt::format("At level {} there are {} limit positions or tangents where {} must be.", l,
                                list->size(), count));
    }
    return std::nullopt;
}

}  // namespace

double referee_bytes_per_vertex(std::span<const Subject* const> subjects, const core::SchemeOptions& options,
                                Scope scope) {
    double refining = 0;
    bool two_rules = options.creasing == core::Creasing::Chaikin;  // of which a deviation is known
    for (const Subject* subject : subjects) {
        refining = std::max(refining, subject->bytes_per_vertex);
        if (scope == Scope::Limits) refining = std::max(refining, subject->limit_bytes_per_vertex);
        two_rules = two_rules || options_for(*subject, options) != options;
    }
    const double result = kResultBytesPerVertex + (scope == Scope::Limits ? kLimitsBytesPerVertex : 0);
    return (two_rules ? 2 : 1) * kWitnessBytesPerVertex + refining +
           static_cast<double>(subjects.size()) * result;
}

const core::Result<Witness>& Referee::witness(const core::SchemeOptions& options) {
    for (const auto& known : witnesses_)
        if (known->first == options) return known->second;
    witnesses_.push_back(std::make_unique<std::pair<core::SchemeOptions, core::Result<Witness>>>(
        options, make_witness(mesh_, options, levels_)));
    return witnesses_.back()->second;
}

const Referee::Made& Referee::made(const Subject& subject, const Witness& witness) {
    auto& slot = made_[subject.name];
    if (slot) return *slot;
    slot = std::make_unique<Made>();
    auto refinement = subject.refine(mesh_, options_for(subject, options_), levels_);
    if (!refinement) {
        slot->error = refinement.error();
        return *slot;
    }
    slot->refinement = std::move(*refinement);
    auto pairing = match(witness, slot->refinement);
    if (pairing)
        slot->match = std::move(*pairing);
    else
        slot->error = pairing.error();
    return *slot;
}

std::optional<Referee::Obstacle> Referee::obstacle(const Subject& subject) {
    const auto& truth = exact(subject);
    if (!truth) return Obstacle{Verdict::NotSupported, core::to_string(truth.error())};
    if (const auto& error = made(subject, *truth).error)
        return Obstacle{verdict_of(*error), fmt::format("{}: {}", subject.name, core::to_string(*error))};
    return std::nullopt;
}

Comparison Referee::judge(const Subject& subject, const Subject& reference, int top,
                          const VertexVisitor& visit) {
    Comparison out;
    out.subject = subject.name;
    out.reference = reference.name;
    out.subject_precision = subject.precision;
    out.reference_precision = reference.precision;
    out.options = options_for(subject, options_);
    const auto stop = [&](Verdict verdict, std::string sentence) {
        out.verdict = verdict;
        out.notes.push_back(std::move(sentence));
        return out;
    };

    for (const Subject* who : {&subject, &reference})
        if (const auto why = obstacle(*who)) return stop(why->verdict, why->sentence);

    const auto& truth_a = exact(subject);
    const auto& truth_b = exact(reference);
    const Made &made_a = made(subject, *truth_a), &made_b = made(reference, *truth_b);
    const Side a{&subject, &made_a.refinement, &made_a.match, &*truth_a};
    const Side b{&reference, &made_b.refinement, &made_b.match, &*truth_b};
    out = compare(a, b, top, visit);
    judge_deviations(out, a, b);
    if (out.notes.empty()) out.notes = verdict_in_words(out, a.witness->options, b.witness->options);
    return out;
}

void Referee::judge_deviations(Comparison& comparison, Side subject, Side reference) {
    for (const KnownDeviation& deviation : deviations_)
        for (Side* side : {&subject, &reference}) {
            if (side->subject->family != deviation.family) continue;
            const core::SchemeOptions asked = side->witness->options;
            if (!is_predicted(deviation, mesh_, asked, levels_)) continue;
            const auto& truth = witness(deviation.as_done(asked));
            if (!truth) continue;
            Side done = *side;
            done.witness = &*truth;
            const Comparison predicted =
                side == &subject ? compare(done, reference, 0) : compare(subject, done, 0);
            comparison.deviation = deviation.name;
            if (is_agreement(comparison.verdict)) {
                comparison.verdict = Verdict::Differs;
                comparison.notes.push_back(fmt::format(
                    "The known deviation {} of {} must show here and does not: is it mended in version {}? "
                    "Then it must leave the list.",
                    deviation.name, side->subject->name, side->subject->version));
            } else if (all_explained(predicted)) {
                comparison.verdict = Verdict::KnownDeviation;
                comparison.notes.push_back(deviation_in_words(deviation, predicted));
            } else {
                comparison.notes =
                    verdict_in_words(comparison, subject.witness->options, reference.witness->options);
                comparison.notes.push_back(
                    fmt::format("The known deviation {} of {} is predicted here, but does not "
                                "explain all of the difference.",
                                deviation.name, side->subject->name));
            }
        }
}

const Referee::MadeLimits& Referee::made_limits(const Subject& subject, const Witness& witness) {
    auto& slot = made_limits_[subject.name];
    if (slot) return *slot;
    slot = std::make_unique<MadeLimits>();
    auto limits = subject.limit(mesh_, options_for(subject, options_), levels_);
    if (limits) {
        slot->error = check_shape(*limits, witness);
        slot->limits = std::move(*limits);
    } else {
        slot->error = limits.error();
    }
    return *slot;
}

std::optional<Referee::Obstacle> Referee::limit_obstacle(const Subject& subject) {
    if (!subject.limit)
        return Obstacle{Verdict::NotSupported,
                        fmt::format("{}: {}", subject.name,
                                    core::to_string({core::ErrorCode::Unsupported, "It has no limits."}))};
    if (auto why = obstacle(subject)) return why;
    if (const auto& error = made_limits(subject, *exact(subject)).error)
        return Obstacle{verdict_of(*error), fmt::format("{}: {}", subject.name, core::to_string(*error))};
    return std::nullopt;
}

// Requires that nothing is in the way.
LimitSide Referee::limit_side(const Subject& subject) {
    const core::SchemeOptions asked = options_for(subject, options_);
    const Witness& truth = *witness(asked);
    LimitSide side{&subject, &made_limits(subject, truth).limits, &made(subject, truth).match, &truth,
                   &truth};
    for (const KnownDeviation& deviation : deviations_)
        if (deviation.family == subject.family && is_predicted(deviation, mesh_, asked, levels_))
            if (const auto& done = witness(deviation.as_done(asked))) {
                side.done = &*done;
                side.refinement_deviation = &deviation;
            }
    return side;
}

LimitComparison Referee::judge_limits(const Subject& subject, const Subject& reference, int top,
                                      const LimitVisitor& visit) {
    for (const Subject* who : {&subject, &reference})
        if (const auto why = limit_obstacle(*who)) {
            LimitComparison out;
            out.verdict = why->verdict;
            out.notes.push_back(why->sentence);
            return out;
        }
    const LimitSide a = limit_side(subject), b = limit_side(reference);
    LimitComparison out = compare_limits(a, b, deviations_, top, visit);
    out.notes = limits_in_words(out, a, b);
    return out;
}

}  // namespace loopcheck::compare
