// Why a vertex is where it is: the rule, the reason, the mask, and what each subject computes.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "compare/subject.h"
#include "compare/witness.h"
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

/// IndexOutOfRange, in the numbers of the user, where a level has no such vertex; else nothing.
std::optional<core::Error> no_such_vertex(const Witness& witness, int level, core::Index vertex,
                                          CountFrom from);

/// Explains the limit of vertex `vertex` (from 0) of level `level` (at least 0): the masks of its position
/// and, for every sector, of its tangent plane, as decimals and fractions, or why there is none; and the
/// exact limit. Errors  IndexOutOfRange, TooLarge.
core::Result<std::string> explain_limit(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                        int level, core::Index vertex, CountFrom from);

}  // namespace loopcheck::compare
