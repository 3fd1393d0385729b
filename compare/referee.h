// The referee: has subjects refine a mesh and gives the verdict, in numbers and in words.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "compare/comparison.h"
#include "compare/deviations.h"

namespace loopcheck::compare {

/// Peak memory of comparing `subjects` pair by pair under one choice of rules, in bytes per vertex of the
/// last level.
double referee_bytes_per_vertex(std::span<const Subject* const> subjects, const core::SchemeOptions& options);

/// Judges subjects on one mesh under one choice of rules.  What a subject made and what is exact is kept, so
/// that several comparisons of the same case share the work.
class Referee {
  public:
    Referee(const core::TriangleMesh& mesh, const core::SchemeOptions& options, int levels)
        : mesh_(mesh), options_(options), levels_(levels) {}

    /// Compares two subjects.  Never throws and never fails: what goes wrong is the verdict.
    Comparison judge(const Subject& subject, const Subject& reference, int top = 0,
                     const VertexVisitor& visit = {});

    const core::TriangleMesh& mesh() const { return mesh_; }
    int levels() const { return levels_; }

  private:
    // What a subject made of the mesh, or why it made nothing.
    struct Made {
        std::optional<core::Error> error;
        core::Refinement refinement;
        Match match;
    };

    const core::Result<Witness>& witness(const core::SchemeOptions& options);
    const Made& made(const Subject& subject, const Witness& witness);
    void judge_deviations(Comparison& comparison, Side subject, Side reference);

    const core::TriangleMesh& mesh_;
    core::SchemeOptions options_;
    int levels_;
    std::vector<std::unique_ptr<std::pair<core::SchemeOptions, core::Result<Witness>>>> witnesses_;
    std::map<std::string, std::unique_ptr<Made>> made_;
};

}  // namespace loopcheck::compare
