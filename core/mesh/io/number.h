// Numbers in text files: read correctly rounded, written so that they read back to the same bits.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace loopcheck::core {

/// The double (float) nearest to the decimal number in `text`, ties to even, whatever the locale.
///
/// Accepts an optional sign, digits with an optional point, an optional exponent, and "inf", "infinity",
/// "nan" and "nan(...)" in any case; nothing before or after.
/// Result   infinity on overflow, the nearest subnormal or zero on underflow, nothing where `text` is not a
///          number.
std::optional<double> parse_double(std::string_view text);
std::optional<float> parse_float(std::string_view text);

/// A decimal integer with an optional sign, or nothing where `text` is none or does not fit.
std::optional<long long> parse_integer(std::string_view text);

/// The shortest decimal that reads back to the same bits.
std::string shortest(double value);
std::string shortest(float value);

/// The value as a hexadecimal fraction, "0x1.8p+1": every bit, readable.
std::string hexfloat(double value);

}  // namespace loopcheck::core
