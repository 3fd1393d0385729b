// What a bounded test saw: printed also where it passes, so that a bound that is too wide shows.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "core/mesh/high_precision.h"
#include "core/mesh/io/number.h"

namespace loopcheck::tests {

/// The roundoff u of a precision.
template <class Real>
inline constexpr double kRoundoff = std::is_same_v<Real, float> ? 0x1p-24 : 0x1p-53;

/// error / bound; 0 where both are 0, infinite where only the bound is.
inline double share_of(double error, double bound) {
    if (error == 0 && bound >= 0) return 0;
    return bound > 0 ? error / bound : std::numeric_limits<double>::infinity();
}

/// |got - exact|, the difference taken in high precision.
template <class Scalar>
double error_of_value(const Scalar& got, const core::HighPrecision& exact) {
    return static_cast<double>(abs(core::HighPrecision(got) - exact));
}

/// The largest of many magnitudes, where it was and their root mean square.  NaN is larger than all else.
class Observed {
  public:
    Observed(std::string what, std::string place, double allowed)
        : what_(std::move(what)), place_(std::move(place)), allowed_(allowed) {}

    /// `got` and `wanted` are kept for the message.
    void add(double value, std::int64_t place, double got = 0, double wanted = 0) {
        ++count_;
        squares_ += value * value;
        if (!std::isnan(largest_) && !(value <= largest_)) {
            largest_ = value;
            at_ = place;
            got_ = got;
            wanted_ = wanted;
        }
    }

    double largest() const { return largest_; }
    bool holds() const { return count_ > 0 && largest_ <= allowed_; }

    std::string text() const {
        return fmt::format("{}: largest {:.4g} at {} {}, RMS {:.2g} of {}; allowed {:.4g}", what_, largest_,
                           place_, at_, std::sqrt(squares_ / static_cast<double>(count_)), count_, allowed_);
    }
    std::string values() const {
        return fmt::format("got {:.17g} ({}), expected {:.17g} ({})", got_, core::hexfloat(got_), wanted_,
                           core::hexfloat(wanted_));
    }

    /// Prints what was seen; fails where that was nothing, or more than allowed.
    void check() const {
        fmt::print("[ OBSERVED ] {}\n", text());
        EXPECT_TRUE(holds()) << text() << "\n" << values();
    }

  private:
    std::string what_, place_;
    double allowed_;
    std::int64_t count_ = 0;
    double squares_ = 0;
    double largest_ = -1;
    std::int64_t at_ = -1;
    double got_ = 0, wanted_ = 0;
};

}  // namespace loopcheck::tests
