// Fractions for numbers that are known to many digits.
#pragma once

#include <optional>
#include <string>

#include "core/loop/high_precision.h"

namespace loopcheck::compare {

/// The fraction that a 38-digit number stands for, "7/71": the first convergent of its continued fraction
/// that is within 10^-30 of it (relative, absolute below 1), if its denominator is below 10^6; else nothing.
///
/// A number that is no fraction agrees with one of these by chance with a probability below 10^-17.
std::optional<std::string> as_fraction(const core::HighPrecision& value);

}  // namespace loopcheck::compare
