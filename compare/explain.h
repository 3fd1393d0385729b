// Why a vertex is where it is: the rule, the reason, the mask, and what each subject computes.
#pragma once

#include <span>
#include <string>

#include "compare/subject.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// From which number vertices are counted, in what the user types and in what is printed.
enum class CountFrom : int { Zero = 0, One = 1 };

/// Explains vertex `vertex` (from 0) of level `level` (at least 1) in words, with the mask as fractions and
/// decimals over the vertices of the level before, and the position by the exact rules and by every subject.
/// Errors  IndexOutOfRange, TooLarge.
core::Result<std::string> explain(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                  int level, core::Index vertex, std::span<const Subject> subjects,
                                  CountFrom from);

}  // namespace loopcheck::compare
