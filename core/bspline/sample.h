// Evenly spaced points of a uniform cubic curve: by a table of weights, and by forward differences.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bspline/curve.h"

namespace loopcheck::core {

/// Most samples in an interval of knots: 6 s^3 is still a 64-bit integer.
inline constexpr int kMaxSamplesPerInterval = 1 << 20;

/// Where sample j of a curve with s samples in an interval of knots belongs: first() + j/s, rounded once.
template <CurvePoint P>
ScalarOf<P> sample_parameter(const Curve<P>& curve, int per_interval, std::int64_t j) {
    using Scalar = ScalarOf<P>;
    return (Scalar(per_interval) * curve.first() + Scalar(j)) / Scalar(per_interval);
}

namespace detail {

template <CurvePoint P>
P weighted_sum(const std::array<ScalarOf<P>, 4>& w, const std::array<P, 4>& c) {
    return w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + w[3] * c[3];
}

/// Has `fill` write the samples of every interval but its right end, given the four points that reach it, by
/// value: as copies they are known not to be written to.  The end of the domain comes after them.
template <CurvePoint P, class Fill>
std::vector<P> sample_intervals(const Curve<P>& curve, int per_interval, Fill fill) {
    const std::vector<P> c = extended_points(curve);
    const std::size_t intervals = c.size() - 3, s = static_cast<std::size_t>(per_interval);
    const auto around = [&](std::size_t i) { return std::array<P, 4>{c[i], c[i + 1], c[i + 2], c[i + 3]}; };
    // Made interval by interval, so that what is written is still in the cache.
    std::vector<P> out;
    out.reserve(intervals * s + 1);
    for (std::size_t i = 0; i < intervals; ++i) {
        out.resize(out.size() + s);
        fill(around(i), std::span<P>(out).last(s));
    }
    out.push_back(weighted_sum(cubic_weights(ScalarOf<P>(1)), around(intervals - 1)));
    return out;
}

/// Rows of weights for the point at the left end of an interval and for its differences with step h = 1/s:
/// where P = p + a u + b u^2 + c u^3 they are
///
///     d_1 = a h + b h^2 + c h^3,   d_2 = 2 b h^2 + 6 c h^3,   d_3 = 6 c h^3
template <class Scalar>
std::array<std::array<Scalar, 4>, 4> difference_rows(std::int64_t s) {
    const auto row = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d, std::int64_t over) {
        return std::array<Scalar, 4>{Scalar(a) / Scalar(over), Scalar(b) / Scalar(over),
                                     Scalar(c) / Scalar(over), Scalar(d) / Scalar(over)};
    };
    const std::int64_t square = s * s, cube = s * s * s;
    return {row(1, 4, 1, 0, 6), row(-3 * square + 3 * s - 1, 3 - 6 * s, 3 * square + 3 * s - 3, 1, 6 * cube),
            row(s - 1, 3 - 2 * s, s - 3, 1, cube), row(-1, 3, -3, 1, cube)};
}

}  // namespace detail

/// Points of the curve at first() + j/s, j = 0, ..., m s, in that order; it has m intervals of knots.
///
///     P(i + k/s) = sum_l w_l(k/s) c_(i-1+l),   w = `cubic_weights`, once for every k
///
/// Range   degree 3, not Clamped; 1 <= s <= kMaxSamplesPerInterval.
///
/// Error   at most kTableSampleRoundings roundings of the largest |coordinate| of points and phantoms.
///
/// Laws    1. every s-th sample is a limit position; 2. the last of a closed curve has the bits of the first.
template <CurvePoint P>
std::vector<P> sample_by_table(const Curve<P>& curve, int per_interval) {
    using Scalar = ScalarOf<P>;
    std::vector<std::array<Scalar, 4>> weights;
    weights.reserve(static_cast<std::size_t>(per_interval));
    for (int k = 0; k < per_interval; ++k)
        weights.push_back(cubic_weights(Scalar(Scalar(k) / Scalar(per_interval))));
    return detail::sample_intervals(curve, per_interval, [&](const std::array<P, 4> c, std::span<P> samples) {
        for (std::size_t k = 0; k < samples.size(); ++k) samples[k] = detail::weighted_sum(weights[k], c);
    });
}
/// kCubicBasisRoundings of the weights, 4 of products and sums, 3/2 of k/s (the slopes of the weights sum to
/// no more than that) and 1 of a phantom.
inline constexpr int kTableSampleRoundings = kCubicBasisRoundings + 7;

/// The same points by forward differences, three additions a sample:
///
///     p <- p + d_1,   d_1 <- d_1 + d_2,   d_2 <- d_2 + d_3
///
/// started anew in every interval, with d_r the difference of order r and step 1/s there.  Only the end of
/// the domain is a weighted sum.
///
/// Range   that of `sample_by_table`.
///
/// Error   at most difference_sample_roundings(s) roundings of the largest |coordinate| of points and
///         phantoms.
///
/// Laws    1. in exact arithmetic the result is that of `sample_by_table`; 2. every s-th sample has the bits
///         of that result.
template <CurvePoint P>
std::vector<P> sample_by_differences(const Curve<P>& curve, int per_interval) {
    const auto rows = detail::difference_rows<ScalarOf<P>>(per_interval);
    return detail::sample_intervals(curve, per_interval, [&](const std::array<P, 4> c, std::span<P> samples) {
        std::array<P, 4> d;  // of order 0, which is the point itself, to 3
        for (std::size_t r = 0; r < 4; ++r) d[r] = detail::weighted_sum(rows[r], c);
        for (P& sample : samples) {
            sample = d[0];
            for (std::size_t r = 0; r < 3; ++r) d[r] = d[r] + d[r + 1];
        }
    });
}

/// Proof   Let M be the largest |coordinate|, h = 1/s, and count roundings u.  As |P| <= M, |P'| <= 3/2 M and
///         |P''| <= 4 M, and |P'''| <= 8 M, the d_r are at most 3/2 M h, 4 M h^2 and 8 M h^3, and those are
///         also the sums of their |weights|.  A weight takes at most 3 roundings (numerator, denominator,
///         quotient), product and sums 4: the starts are off by at most 7 of those amounts.  After k <= s
///         steps a d_r in error counts k, k(k-1)/2 or k(k-1)(k-2)/6 times:
///
///             7 (1 + 3/2 + 4/2 + 8/6) < 41
///
///         Every addition to p adds 1, which stays; to d_1, 3/2 h, which counts at most k; to d_2, 4 h^2:
///
///             s (1 + (3/2)/2 + 4/6) < 5/2 s
///
///         and a phantom is rounded once.
constexpr int difference_sample_roundings(int per_interval) {
    return 42 + (5 * per_interval + 1) / 2;
}

}  // namespace loopcheck::core
