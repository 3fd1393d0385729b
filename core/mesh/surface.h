// What an implementation of subdivision says of the limit: at the vertices of a level, and at any parameter.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "core/mesh/ids.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// The limit of every vertex of one level.
///
/// The tangents span the tangent plane and tangent1 x tangent2 points outward; their lengths mean nothing.
/// Where a subject has no tangent plane they are zero.
struct LimitLevel {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> tangent1, tangent2;
};

/// Levels 0 (the control mesh) to L, in the order of the refinement.
struct Limits {
    Precision precision = Precision::Double;
    std::vector<LimitLevel> levels;
};

/// A parameter of a face (v0, v1, v2): v0 is (0, 0), v1 is (1, 0), v2 is (0, 1); u, v >= 0 and u + v <= 1.
struct SurfaceLocation {
    Index face = 0;
    double u = 0, v = 0;
};

/// What is evaluated at a parameter, in this order everywhere.
enum class Derivative : std::uint8_t { Position, Du, Dv, Duu, Duv, Dvv };
inline constexpr int kDerivatives = 6;

/// "position", "du", ..., "dvv".
std::string_view name(Derivative derivative);

/// A point of the limit surface and its derivatives as rows over the control vertices: derivative d is
/// sum_j weights[d][j] position(columns[j]).  Ascending columns, each once.
struct SurfaceRows {
    std::vector<Index> columns;
    std::array<std::vector<double>, kDerivatives> weights;
};

}  // namespace loopcheck::core
