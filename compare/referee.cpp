#include "compare/referee.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

double referee_bytes_per_vertex(std::span<const Subject* const> subjects,
                                const core::SchemeOptions& options) {
    double refining = 0;
    bool two_rules = options.creasing == core::Creasing::Chaikin;  // of which a deviation is known
    for (const Subject* subject : subjects) {
        refining = std::max(refining, subject->bytes_per_vertex);
        two_rules = two_rules || options_for(*subject, options) != options;
    }
    return (two_rules ? 2 : 1) * kWitnessBytesPerVertex + refining +
           static_cast<double>(subjects.size()) * kResultBytesPerVertex;
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

    const auto& truth_a = witness(options_for(subject, options_));
    const auto& truth_b = witness(options_for(reference, options_));
    for (const auto* truth : {&truth_a, &truth_b})
        if (!*truth) return stop(Verdict::NotSupported, core::to_string(truth->error()));

    std::array<const Made*, 2> results{};
    for (int i = 0; i < 2; ++i) {
        const Subject& who = i == 0 ? subject : reference;
        results[i] = &made(who, i == 0 ? *truth_a : *truth_b);
        if (!results[i]->error) continue;
        const core::Error& error = *results[i]->error;
        const bool refusal = error.code == core::ErrorCode::Unsupported ||
                             error.code == core::ErrorCode::NotFinite ||
                             error.code == core::ErrorCode::TooLarge;
        return stop(refusal ? Verdict::NotSupported : Verdict::Failed,
                    fmt::format("{}: {}", who.name, core::to_string(error)));
    }

    const Side a{&subject, &results[0]->refinement, &results[0]->match, &*truth_a};
    const Side b{&reference, &results[1]->refinement, &results[1]->match, &*truth_b};
    out = compare(a, b, top, visit);
    judge_deviations(out, a, b);
    if (out.notes.empty()) out.notes = verdict_in_words(out, a.witness->options, b.witness->options);
    return out;
}

void Referee::judge_deviations(Comparison& comparison, Side subject, Side reference) {
    for (const KnownDeviation& deviation : known_deviations())
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

}  // namespace loopcheck::compare
