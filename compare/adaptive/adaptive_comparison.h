// An adaptive mesh against the uniform refinement of another subject.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compare/statistics.h"
#include "compare/subject.h"
#include "core/loop/adaptive/refine.h"

namespace loopcheck::compare {

/// The vertices of one class at one level of an adaptive mesh.
struct AdaptiveStats {
    /// Those that must have their uniform position, against the subject.
    ErrorStats checked;
    /// Those that uniform refinement has too, but that something nearby kept from moving as there: how far
    /// they are from the subject's.
    ErrorStats held;
    /// Those that uniform refinement does not have.
    std::size_t apart = 0;

    void add(const AdaptiveStats& other);
};

struct AdaptiveLevelResult {
    std::size_t vertices = 0, faces = 0;
    std::size_t subdividable = 0;  ///< faces of the level before that were
    core::AdaptiveCounts counts = {};
    double uniform_faces = 0;
    std::map<core::VertexClass, AdaptiveStats> classes = {};
};

/// All classes of a level together.
AdaptiveStats total(const AdaptiveLevelResult& level);

/// The outcome.
struct AdaptiveComparison {
    std::string subject;
    core::Precision precision = core::Precision::Double;
    core::SchemeOptions options;
    double largest_coordinate = 0, diagonal = 0;
    Verdict verdict = Verdict::Identical;
    std::vector<std::string> notes;           ///< the verdict in words, a sentence each
    std::vector<AdaptiveLevelResult> levels;  ///< one a level
};

/// What the levels of an adaptive refinement consist of, without a subject.
std::vector<AdaptiveLevelResult> adaptive_levels(const core::TriangleMesh& mesh,
                                                 const core::AdaptiveRefinement& refinement);

/// Peak memory of adaptive refinement and of writing its last level, in bytes a face of all its levels; and
/// of what comparing it keeps of two uniform refinements, per vertex of their last level.  A test measures
/// them.
inline constexpr double kAdaptiveBytesPerFace = 230;
inline constexpr double kUniformLevelsBytesPerVertex = 70;

/// Compares our adaptive refinement with the uniform refinement of a subject of the same precision: every
/// vertex that is in both, by its number there.
///
/// Verdict  Identical where all that must have their uniform position have the subject's, bit for bit.  Else
///          that of our uniform refinement against the subject's, with its notes; but Differs where ours is
///          not our own uniform position.
AdaptiveComparison compare_adaptive(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                    const core::AdaptiveRefinement& refinement, const Subject& ours,
                                    const Subject& subject);

}  // namespace loopcheck::compare
