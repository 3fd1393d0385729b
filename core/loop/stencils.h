// Stencils: the vertices of a level, or their limits, as rows over the control vertices.
#pragma once

#include "core/loop/evaluate.h"
#include "core/mesh/sparse_matrix.h"

namespace loopcheck::core {

/// What the rows stand for.
enum class StencilOf : std::uint8_t { Vertex, VertexLimit };

/// A row for every vertex of level `level`, in the order of `refine`: its position, or the limit of it, over
/// the control vertices.
///
/// Error    the rows of all levels are multiplied in 38 digits and rounded once.  Weights below 10^-33 of the
///          largest in their row are zero in truth and left out.
///
/// Errors   TooLarge; OutOfMemory, before it is allocated, where a step could have more than `most_weights`.
///
/// Laws     1. every row sums to 1; 2. applied to the control positions they give what `refine` and `limits`
///          give, up to rounding.
Result<SparseMatrix> stencils(const TriangleMesh& mesh, const SchemeOptions& options, int level, StencilOf of,
                              double most_weights);

/// Peak memory of `stencils` per weight, in bytes: two levels of them in 38 digits, with their columns.
inline constexpr double kStencilBytesPerWeight = 140;

/// The six rows of a point of the limit surface, by `Derivative`.
SparseMatrix as_matrix(const SurfaceStencil<HighPrecision>& stencil, Index control_vertices);

}  // namespace loopcheck::core
