// The referee: has subjects refine a mesh and gives the verdict, in numbers and in words.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "compare/comparison.h"
#include "compare/deviations.h"
#include "compare/limit/comparison.h"

namespace loopcheck::compare {

/// What is compared.
enum class Scope : std::uint8_t {
    Refinement,
    Limits,  ///< and the refinement
};

/// Peak memory of comparing `subjects` pair by pair under one choice of rules, in bytes per vertex of the
/// last level.
double referee_bytes_per_vertex(std::span<const Subject* const> subjects, const core::SchemeOptions& options,
                                Scope scope = Scope::Refinement);

/// Judges subjects on one mesh under one choice of rules.  What a subject made and what is exact is kept, so
/// that several comparisons of the same case share the work.
class Referee {
  public:
    Referee(const core::TriangleMesh& mesh, const core::SchemeOptions& options, int levels,
            std::span<const KnownDeviation> deviations = known_deviations())
        : mesh_(mesh), options_(options), levels_(levels), deviations_(deviations) {}

    /// Compares two subjects.  Never throws and never fails: what goes wrong is the verdict.
    Comparison judge(const Subject& subject, const Subject& reference, int top = 0,
                     const VertexVisitor& visit = {});

    /// Compares the limits of two subjects at every level, paired as their refinements are.  Never throws and
    /// never fails either.
    LimitComparison judge_limits(const Subject& subject, const Subject& reference, int top = 0,
                                 const LimitVisitor& visit = {});

    /// What is exact under the rules that a subject is meant to follow; kept as long as this.
    /// Errors  TooLarge.
    const core::Result<Witness>& exact(const Subject& subject) {
        return witness(options_for(subject, options_));
    }

    const core::TriangleMesh& mesh() const { return mesh_; }
    int levels() const { return levels_; }

  private:
    // What a subject made of the mesh, or why it made nothing.
    struct Made {
        std::optional<core::Error> error;
        core::Refinement refinement;
        Match match;
    };

    struct MadeLimits {
        std::optional<core::Error> error;
        core::Limits limits;
    };

    // Why two subjects cannot be compared.
    struct Obstacle {
        Verdict verdict;
        std::string sentence;
    };

    const core::Result<Witness>& witness(const core::SchemeOptions& options);
    const Made& made(const Subject& subject, const Witness& witness);
    const MadeLimits& made_limits(const Subject& subject, const Witness& witness);
    std::optional<Obstacle> obstacle(const Subject& subject);
    std::optional<Obstacle> limit_obstacle(const Subject& subject);
    LimitSide limit_side(const Subject& subject);
    void judge_deviations(Comparison& comparison, Side subject, Side reference);

    const core::TriangleMesh& mesh_;
    core::SchemeOptions options_;
    int levels_;
    std::span<const KnownDeviation> deviations_;
    std::vector<std::unique_ptr<std::pair<core::SchemeOptions, core::Result<Witness>>>> witnesses_;
    std::map<std::string, std::unique_ptr<Made>> made_;
    std::map<std::string, std::unique_ptr<MadeLimits>> made_limits_;
};

}  // namespace loopcheck::compare
