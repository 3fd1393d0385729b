// Adaptive Loop refinement: the lab report's scheme, with any criterion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/loop/adaptive/criterion.h"
#include "core/loop/adaptive/split.h"

namespace loopcheck::core {

/// What one step did.
struct AdaptiveCounts {
    /// c0 to c3: faces with 0 to 3 edges that are not split.
    std::array<std::size_t, 4> faces_with_unsplit{};
    std::size_t split_edges = 0;
};

/// The way from an adaptive level to the next.
struct AdaptiveStep {
    Rows rows;
    std::vector<Ancestor> ancestors;
    AdaptiveCounts counts;
    AdaptiveLevel child;  ///< with its positions
};

AdaptiveLevel adaptive_control_level(const TriangleMesh& mesh, BoundaryRule boundary);

/// One step.  All decisions are about the level as it is:
///
///   1. an edge is split where all its faces are subdividable (`edges_to_split`);
///   2. faces are replaced by `split_pattern`;
///   3. a vertex keeps its place, and its sharpness, where a face around it is not subdividable; all else
///      is refined by the rules of uniform refinement: vertices over their whole old ring, the points of
///      split edges also where an end stays.  An edge that is not split keeps its sharpness.
///
/// `is_subdividable` has a flag a face.
///
/// Source  the lab report's adaptive scheme.
///
/// Errors  TooLarge; OutOfMemory, before it is made, where the child would have more than `most_faces`.
///
/// Laws    1. F' = 4 c0 + 3 c1 + 2 c2 + c3, V' = V + split edges, and on a closed mesh twice as many edges
///         are split as 3 c0 + 2 c1 + c2;
///         2. watertight and manifold as the level was;
///         3. with all flags set it is `next_level`, bit for bit, with none nothing changes.
Result<AdaptiveStep> adaptive_step(const AdaptiveLevel& level,
                                   const std::vector<std::uint8_t>& is_subdividable,
                                   const SchemeOptions& options,
                                   double most_faces = std::numeric_limits<double>::infinity());

/// One level of the result, beside the refined mesh itself.
struct AdaptiveRecord {
    AdaptiveCounts counts;            ///< of the step that led here; zero at level 0
    std::size_t subdividable = 0;     ///< faces of the level before that were
    std::vector<Index> control_face;  ///< per face
    std::vector<VertexClass> classes;
    std::vector<std::int64_t> uniform_vertex;  ///< per vertex its number in uniform refinement, or kNone
    std::vector<std::uint8_t> same_position;   ///< per vertex 1 where uniform refinement has the same bits
};

struct AdaptiveRefinement {
    Refinement refinement;
    std::vector<AdaptiveRecord> records;  ///< one a level
    AdaptiveLevel last;                   ///< the last level, with positions in double
};

/// `levels` steps, the criterion asked anew at each.
///
/// Real    float or double; decisions are made from positions in double, so both give the same mesh.
///
/// Errors  TooLarge; OutOfMemory, before a level is made, where all together would have more than
///         `most_faces`; NotFinite, see `check_fits`; IndexOutOfRange where the criterion has not one flag a
///         face.
///
/// Law     a vertex with `same_position` has the position of `refine`, bit for bit.
template <class Real>
Result<AdaptiveRefinement> refine_adaptively(const TriangleMesh& mesh, const SchemeOptions& options,
                                             const Criterion& criterion, int levels, double most_faces);

extern template Result<AdaptiveRefinement> refine_adaptively<float>(const TriangleMesh&, const SchemeOptions&,
                                                                    const Criterion&, int, double);
extern template Result<AdaptiveRefinement> refine_adaptively<double>(const TriangleMesh&,
                                                                     const SchemeOptions&, const Criterion&,
                                                                     int, double);

}  // namespace loopcheck::core
