// The scalar of the third witness.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

namespace loopcheck::core {

/// 38 decimal digits: twice those of double and more, so that its own rounding is below any difference we
/// report.
using HighPrecision =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<38>, boost::multiprecision::et_off>;

/// Exact fractions, for masks as text and for the scheme where its weights are rational.
using Rational = boost::multiprecision::cpp_rational;

}  // namespace loopcheck::core
