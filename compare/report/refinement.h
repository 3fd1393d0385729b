// Reports of what `refine` wrote, and of adaptive refinement against a subject.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/adaptive/adaptive_comparison.h"
#include "compare/loading.h"
#include "core/loop/tessellation/measure.h"

namespace loopcheck::compare {

/// The limit surface as triangles within a tolerance.
struct ToleranceOutcome {
    double tolerance = 0;
    double bound = 0;                 ///< proven of the triangles that were written
    core::MeasuredDistance measured;  ///< and seen
    std::vector<std::size_t> leaves;  ///< by level
    double uniform_faces = 0;         ///< of uniform refinement of the same faces to the deepest level
    core::Index without_surface = 0;  ///< faces that are left out: they have no limit surface
    struct Uniform {
        int level = 0;
        std::size_t triangles = 0;
        double bound = 0;
    };
    std::optional<Uniform> uniform;  ///< the first uniform level within the tolerance, where it was asked for
    std::string no_uniform;          ///< why it was not found, where it was asked for
};

/// A mesh that was refined and written.
struct RefinementReport {
    std::string model, output;
    std::string scheme;  ///< name of the subject that refined
    core::Precision precision = core::Precision::Double;
    std::optional<CreaseTags> creases = {};  ///< what --crease-angle tagged
    std::string order;                       ///< of what was written, where it is not that of `split`
    std::string rule;                        ///< adaptive: which faces are subdivided, in words; else empty
    /// Adaptive: without classes; else only the sizes.  With a tolerance one entry: what was written.
    std::vector<AdaptiveLevelResult> levels;
    std::optional<ToleranceOutcome> tolerance = {};
};

/// What was tagged; adaptive: the rule, and a line a level with its sizes and the faces by number of edges
/// that are not split; with a tolerance what is proven and what was measured.  Always the file, with counts.
std::string refinement_as_text(const RefinementReport& report);

/// The document of docs/report.schema.json.
std::string refinement_as_json(const RefinementReport& report, std::span<const Subject> subjects);

/// An adaptive mesh compared with a subject's uniform refinement.
struct AdaptiveReport {
    std::string model;
    std::optional<CreaseTags> creases;
    std::string rule;
    AdaptiveComparison comparison;
};

/// The rule, a line a level, a line a class of the last level: how many vertices were checked, and how far
/// the held ones are from where uniform refinement has them.  Then the verdict in words.
std::string adaptive_as_text(const AdaptiveReport& report, std::string_view version);

/// The document of docs/report.schema.json.
std::string adaptive_as_json(const AdaptiveReport& report, std::span<const Subject> subjects);

}  // namespace loopcheck::compare
