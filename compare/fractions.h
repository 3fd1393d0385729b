// Fractions for numbers that are known to many digits.
#pragma once

#include <optional>
#include <string>

#include "core/mesh/high_precision.h"

namespace loopcheck::compare {

/// How sure a fraction must be.
struct FractionSearch {
    double tolerance;            ///< relative, absolute below 1
    double largest_denominator;  ///< a number that is none agrees by chance with about the square of it times
                                 ///< that
};
inline constexpr FractionSearch kOf38Digits{1e-30, 1e6};
inline constexpr FractionSearch kOfDouble{4e-16, 1e3};

/// The fraction that a number stands for, "7/71": the first convergent of its continued fraction that is
/// within the tolerance; nothing where its denominator would be too large.
std::optional<std::string> as_fraction(const core::HighPrecision& value,
                                       const FractionSearch& search = kOf38Digits);

}  // namespace loopcheck::compare
