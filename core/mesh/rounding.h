// The constants of floating-point arithmetic that the error bounds are made of.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::core {

/// Unit roundoff u: 2^-53 for double, 2^-24 for float.
constexpr double unit_roundoff(Precision precision) {
    return precision == Precision::Float ? 0x1p-24 : 0x1p-53;
}

/// Smallest positive number t: 2^-1074 for double, 2^-149 for float.
constexpr double smallest_subnormal(Precision precision) {
    return precision == Precision::Float ? 0x1p-149 : 0x1p-1074;
}

/// k u / (1 - k u): the relative error of k roundings in a row.
///
/// Source  the standard model of floating-point arithmetic; [Higham02], section 3.1.
constexpr double rounding_of(double k, Precision precision) {
    const double ku = k * unit_roundoff(precision);
    return ku / (1 - ku);
}

}  // namespace loopcheck::core
