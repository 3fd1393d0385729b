// The index type of everything in a mesh, and what a triangle is.
#pragma once

#include <array>
#include <cstdint>

namespace loopcheck::core {

/// Index of a vertex, edge, face or face corner, counted from 0.  No mesh has more than 2^31 - 1 of any of
/// them.
using Index = std::int32_t;

/// "There is none": the second face of a boundary edge, for instance.
inline constexpr Index kNone = -1;

/// The three vertices of a face, counter-clockwise seen from outside.
using Triangle = std::array<Index, 3>;

/// The corner after corner i of a triangle, and the one before it.
constexpr int next_corner(int i) {
    return i == 2 ? 0 : i + 1;
}
constexpr int previous_corner(int i) {
    return i == 0 ? 2 : i - 1;
}

}  // namespace loopcheck::core
