// Sums of products in twice the precision of double.
#pragma once

#include <array>
#include <cmath>

#include "core/mesh/high_precision.h"

namespace loopcheck::compare {

/// The unevaluated sum high + low, with |low| at most half an ulp of high.
struct DoubleDouble {
    double high = 0, low = 0;
};

/// x rounded to a double and the rest to another: right to 2^-106 of x.
inline DoubleDouble to_double_double(const core::HighPrecision& x) {
    const auto high = static_cast<double>(x);
    return {high, static_cast<double>(core::HighPrecision(x - high))};
}

/// sum += w x.
///
/// Error  after m of these, at most m 2^-102 sum |w| |x|, where nothing underflows: 2^-49 of the part of any
///        `row_bound` that is due to its m roundings.
/// Source [Knuth97], section 4.2.2, theorem B, for the sum without error; fma for the product without error.
inline void add_product(DoubleDouble& sum, const DoubleDouble& w, const DoubleDouble& x) {
    const double p = w.high * x.high;
    const double rest = std::fma(w.high, x.high, -p) + (w.high * x.low + w.low * x.high);
    const double s = sum.high + p;
    const double t = s - sum.high;
    const double low = ((sum.high - (s - t)) + (p - t)) + (sum.low + rest);
    sum.high = s + low;
    sum.low = low - (sum.high - s);
}

/// A vector of such.
using DoubleDouble3 = std::array<DoubleDouble, 3>;

}  // namespace loopcheck::compare
