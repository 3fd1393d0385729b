// Which of the known deviations are seen in OpenSubdiv's surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "compare/deviations.h"

namespace loopcheck::compare {

/// A deviation of the list that `compare_surface` looks for.
enum class SurfaceDeviationId : std::uint8_t {
    Approximation,
    SecondDerivativeSign,
    BoxEndCap,
    PatchDefaults,
    SharpnessCutOff,
    BfrChaikin,
};
inline constexpr int kSurfaceDeviations = 6;

/// Its name in the list of known deviations: "bfr-approximation", ...
std::string_view name(SurfaceDeviationId id);

}  // namespace loopcheck::compare
