// What is known to differ in OpenSubdiv's surfaces.
#pragma once

#include <span>
#include <string_view>

#include "compare/deviations.h"

namespace loopcheck::compare {

/// Entry of the list: as `KnownDeviation`, with the place and the amount predicted by `judge_surface`.
struct SurfaceDeviation {
    std::string_view name;
    std::string_view family;
    KnownDeviation::Kind kind;
    std::string_view what;  ///< one sentence
};

/// Number of a deviation in the list.
enum class SurfaceDeviationId : std::uint8_t {
    Approximation,
    SecondDerivativeSign,
    BoxEndCap,
    PatchDefaults,
    SharpnessCutOff,
    BfrChaikin,
};
inline constexpr int kSurfaceDeviations = 6;

/// The list, by `SurfaceDeviationId`.
std::span<const SurfaceDeviation> surface_deviations();

}  // namespace loopcheck::compare
