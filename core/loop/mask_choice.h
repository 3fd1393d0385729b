// Which mask a refined vertex has, from the sharpness around what it comes from.  No mesh here either.
#pragma once

#include <array>
#include <span>

#include "core/loop/masks.h"
#include "core/mesh/options.h"

namespace loopcheck::core {

/// The mask of a vertex point.
///
/// `sharpness` is that of the vertex, `ring` that of the edges around it, `child_ring` that of their halves
/// next to it in the next level; both in ring order.
Mask vertex_point_mask(float sharpness, std::span<const float> ring, std::span<const float> child_ring);

/// The mask of an edge point.  `halves` is the sharpness of the two halves of the edge in the next level.
Mask edge_point_mask(float sharpness, const std::array<float, 2>& halves, CreaseShare share);

}  // namespace loopcheck::core
