// The limit masks that OpenSubdiv applies where they are not those of the limit.
#pragma once

#include "core/loop/limit.h"

namespace loopcheck::compare {

/// Position and tangent masks of Far::PrimvarRefinerReal::Limit at a vertex, by the rule that it refines by.
///
///     smooth, dart   position and tangents of a smooth vertex; a dart's sharp edge is not looked at
///     crease         position 1/6, 2/3, 1/6 and tangent e_0 - e_k along it;
///                    across it, k >= 4: 2 (1 - cos(theta)) sum_i sin(i theta) e_i - sin(theta) (e_0 + e_k),
///                    theta = pi/k, which belongs to the edge rule 3/8, 5/8; k <= 3 as ours
///     corner         position v;  tangents r_0 - v and r_1 - v, r_0 and r_1 being the first two edges of the
///     ring
///
/// e_0, ..., e_k are the edges between the first and the second sharp edge.
///
/// Shapes  as `core::limit_masks`, with one sector.  It has tangents also where a crease or corner has no
/// limit
///         normal, but not at an interior vertex of valence 2, where OpenSubdiv's second one is the rounding
///         of sin(pi).
/// Source  OpenSubdiv's documentation of its limit masks and its results, 3.5.0; the tests hold every model's
///         results against these masks.
core::LimitMasks<core::HighPrecision> opensubdiv_limit_masks(const core::Star& star);

}  // namespace loopcheck::compare
