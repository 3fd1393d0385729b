// Doubles of every size, the same on every run.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace loopcheck::tests {

inline std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

/// The ends and the middle of the range first, then finite doubles of random bits, a tenth of them subnormal.
inline std::vector<double> doubles_of_every_size(std::size_t count, std::uint64_t seed = 1) {
    using Limits = std::numeric_limits<double>;
    std::vector<double> values{0.0,
                               -0.0,
                               Limits::min(),
                               Limits::denorm_min(),
                               Limits::max(),
                               Limits::lowest(),
                               Limits::epsilon(),
                               0.1,
                               1.0 / 3,
                               9007199254740993.0,
                               1e22,
                               1e23,
                               -5e-324,
                               2.2250738585072011e-308};
    std::mt19937_64 random(seed);
    while (values.size() < count) {
        std::uint64_t raw = random();
        if (raw % 10 == 0) raw &= 0x800FFFFFFFFFFFFF;
        if (const double value = std::bit_cast<double>(raw); std::isfinite(value)) values.push_back(value);
    }
    return values;
}

}  // namespace loopcheck::tests
