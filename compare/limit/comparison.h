// Two subjects' limits on one mesh: positions and normals, vertex by vertex, and the verdict.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/deviations.h"
#include "compare/limit/oracle.h"

namespace loopcheck::compare {

/// Whether the normals at a vertex were compared.
enum class NormalStatus : std::uint8_t {
    Compared,
    Undefined,     ///< the limit surface has none there: ExactLimit::no_normal says why
    Undetermined,  ///< rounding alone could turn it anywhere: the exact one, or the one a deviation predicts
};

/// The normals at a vertex.  Angles are between planes, in [0, pi/2] radians.
struct NormalRecord {
    NormalStatus status = NormalStatus::Undefined;
    core::NoNormal reason = core::NoNormal::None;
    glm::dvec3 subject{0}, reference{0}, exact{0};  ///< unit vectors; zero where there is none
    double error = 0;                               ///< angle between subject and reference
    double subject_error = 0, reference_error = 0;  ///< against the exact normal
    double bound = 0;                               ///< of the angle, for both together
    double bound_use = 0;                           ///< error / bound
};

/// Everything known of the limit of one vertex.
struct LimitRecord {
    VertexRecord position;  ///< the positions in it are limits
    NormalRecord normal;
    std::string deviation;  ///< the known deviation that shows here, as predicted; empty where none does
};

/// How far the limit of a vertex is from that of its vertex point in the next level; they are one point.
struct DriftStats {
    ErrorStats position;  ///< model units
    ErrorStats normal;    ///< radians, where it was compared at both levels
    std::size_t unexplained =
        0;  ///< vertices that drift by more than rounding, where no known deviation says so

    void add(const DriftStats& other);
};

/// Statistics of one vertex class.  Radians in `normal`, model units in `position`.
struct LimitStats {
    ClassStats position;
    ClassStats normal;                                ///< of the vertices whose normals were compared
    std::map<core::NoNormal, std::size_t> undefined;  ///< vertices without a limit normal, by reason
    std::size_t undetermined = 0;
    std::size_t as_deviation = 0;    ///< vertices where a known deviation shows, as predicted
    std::size_t vanished = 0;        ///< vertices where one must show and the limit is right
    std::size_t by_declaration = 0;  ///< vertices that differ because the two sides' declared rules do
    DriftStats subject_drift, reference_drift;  ///< from this level to the next

    std::size_t undefined_count() const;
    void add(const LimitStats& other);
};

struct LimitLevelResult {
    int level = 0;
    Verdict verdict = Verdict::Identical;
    std::map<core::VertexClass, LimitStats> classes;
    std::vector<LimitRecord> worst;  ///< largest use of a bound first
};
LimitStats total(const LimitLevelResult& level);

/// A known deviation of one of the two sides: what was predicted and what was seen, over all levels.
struct DeviationSeen {
    const KnownDeviation* deviation = nullptr;
    std::string subject;                                   ///< whose
    std::size_t vertices = 0;                              ///< where it shows, as predicted
    std::size_t vanished = 0;                              ///< where it must show and does not
    double predicted_position = 0, observed_position = 0;  ///< distance from the exact limit, model units
    double predicted_angle = 0, observed_angle = 0;        ///< from the exact normal, radians

    void add(const DeviationSeen& other);
};

struct LimitComparison {
    Verdict verdict = Verdict::Identical;
    std::vector<std::string> notes;  ///< the verdict in words, a sentence each
    std::vector<LimitLevelResult> levels;
    std::vector<DeviationSeen> deviations;  ///< those that were predicted somewhere, in the order of the list
};

/// A subject with the limits it gave and what is true of them.
struct LimitSide {
    const Subject* subject = nullptr;
    const core::Limits* limits = nullptr;
    const Match* match = nullptr;
    const Witness* witness = nullptr;  ///< of the rules it is meant to follow
    const Witness* done =
        nullptr;  ///< of those it really follows in refinement: the same, but for a deviation
    const KnownDeviation* refinement_deviation = nullptr;  ///< that deviation, or null
};

using LimitVisitor = std::function<void(const LimitRecord&)>;

/// Compares two matched limits with each other, with the exact limit and each with itself at the next level.
///
/// A vertex at which a deviation of the list applies must be as the deviation's masks predict, wherever that
/// is farther from the exact limit than rounding; every other vertex must be right.  `top` is the number of
/// worst vertices kept a level; `visit` is called for every vertex in order, if given.
LimitComparison compare_limits(const LimitSide& subject, const LimitSide& reference,
                               std::span<const KnownDeviation> deviations, int top,
                               const LimitVisitor& visit = {});

}  // namespace loopcheck::compare
