// Which vertex of a subject's result is which vertex of ours: by ancestry, and proven.
#pragma once

#include <vector>

#include "compare/witness.h"

namespace loopcheck::compare {

/// Per level, `vertex_of[v]` is the subject's index of our vertex v.
struct Match {
    std::vector<std::vector<core::Index>> vertex_of;
};

/// Pairs every vertex of a subject's refinement with one of ours and proves the pairing.
///
/// Level 0 is paired by index.  A vertex point is paired with the vertex point of the vertex that its parent
/// is paired with; an edge point, whose parent edge is named by one of its faces, with the edge point of the
/// same side of the face that its face is paired with.  Proven for every level: the counts agree; every
/// vertex of ours gets exactly one of the subject's; the faces of the two are the same, as cyclic triples,
/// one to one.
///
/// Errors  SubjectFailed, with a sentence that says at which level and vertex or face the proof breaks.
core::Result<Match> match(const Witness& witness, const core::Refinement& refinement);

}  // namespace loopcheck::compare
