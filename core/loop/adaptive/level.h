// A level of adaptive refinement, and how it relates to uniform refinement.
#pragma once

#include <cstdint>
#include <vector>

#include "core/loop/refine.h"

namespace loopcheck::core {

/// What of an adaptive level is also in uniform refinement to the same level.  A thing has the number it has
/// there, or kNone; numbers of uniform levels need 64 bits, however few faces there are here.
struct UniformNumbers {
    std::vector<std::int64_t> vertex, edge, face;
    /// Sizes of the uniform level.
    std::int64_t vertices = 0, edges = 0, faces = 0;
    /// Per vertex 1 only where everything that its position was made of was refined as in uniform refinement,
    /// so that it has the same position there, bit for bit; per edge the same of its sharpness.
    std::vector<std::uint8_t> same_position, same_sharpness;
};

/// One level of adaptive refinement.
struct AdaptiveLevel {
    SchemeLevel scheme;
    std::vector<glm::dvec3>
        positions;  ///< in double, whatever is refined: decisions are the same in every precision
    std::vector<Index> control_face;  ///< per face, the face of the control mesh it is part of
    UniformNumbers uniform;
};

}  // namespace loopcheck::core
