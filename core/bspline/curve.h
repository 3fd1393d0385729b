// A curve with uniform or clamped knots, from its control points and what happens at its ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/bspline/spline.h"

namespace loopcheck::core {

/// What happens at the ends of a curve of degree d with the control points c_0, ..., c_(N-1).
enum class Ends : std::uint8_t {
    Natural,  ///< phantoms c_-k = 2 c_0 - c_k, and so at the other end: from c_0 to c_(N-1); odd degrees only
    Closed,   ///< c_(i+N) = c_i
    Open,     ///< no end rule: the curve is where all d + 1 functions are, and it is shorter than its polygon
    Clamped,  ///< knots d + 1 times at the ends: from c_0 to c_(N-1), along the polygon there
};
std::string_view name(Ends ends);
std::optional<Ends> parse_ends(std::string_view text);

/// Everything about a curve but where its points are.
struct CurveShape {
    int degree = 3;
    Ends ends = Ends::Natural;

    bool operator==(const CurveShape&) const = default;
};

/// Unsupported or TooFewPoints where no curve of this shape has `count` control points: Natural takes 2 and
/// odd degrees, Closed 3, Open and Clamped degree + 1.
std::optional<Error> check_shape(const CurveShape& shape, std::size_t count);

/// NotFinite, with the point, where a coordinate is NaN or beyond the largest number over 2^bits, so that a
/// weighted sum could overflow.  Points without a `magnitude` are exact or have range enough.
template <CurvePoint P>
std::optional<Error> check_magnitudes(const std::vector<P>& points, int bits) {
    if constexpr (requires(const P& p) { magnitude(p); }) {
        const auto most = std::ldexp(std::numeric_limits<ScalarOf<P>>::max(), -bits);
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!(magnitude(points[i]) <= most))
                return Error{ErrorCode::NotFinite,
                             "A coordinate is not finite, or too large to be summed.",
                             {Place::Kind::Point, static_cast<std::int64_t>(i)}};
    }
    return std::nullopt;
}

/// Control points and shape, known to fit together; finite.
///
/// The parameter: with uniform knots basis function i is centred at t = i, and the domain is
///
///     Natural  [0, N-1]      Closed  [0, N]      Open  [(d-1)/2, N-1 - (d-1)/2]
///
/// and with clamped knots 0 (d + 1 times), 1, 2, ..., N-d (d + 1 times) it is [0, N-d].
template <CurvePoint P>
class Curve {
  public:
    using Scalar = ScalarOf<P>;

    /// Errors   those of `check_shape`; NotFinite, with the point, where a coordinate is NaN or beyond the
    ///          largest number over 2^24, so that a weighted sum could overflow.
    static Result<Curve> make(std::vector<P> points, const CurveShape& shape) {
        if (auto error = check_shape(shape, points.size())) return tl::unexpected(std::move(*error));
        if (auto error = check_magnitudes(points, 24)) return tl::unexpected(std::move(*error));
        Curve out;
        out.points_ = std::move(points);
        out.shape_ = shape;
        return out;
    }

    const std::vector<P>& points() const { return points_; }
    const CurveShape& shape() const { return shape_; }
    std::size_t size() const { return points_.size(); }

    Scalar first() const { return shape_.ends == Ends::Open ? Scalar(shape_.degree - 1) / 2 : Scalar(0); }
    Scalar last() const {
        const auto n = static_cast<std::int64_t>(size());
        switch (shape_.ends) {
            case Ends::Closed:
                return Scalar(n);
            case Ends::Clamped:
                return Scalar(n - shape_.degree);
            default:
                return Scalar(n - 1) - first();
        }
    }

  private:
    template <CurvePoint Q>
    friend Curve<Q> subdivide(const Curve<Q>& curve);
    Curve() = default;

    std::vector<P> points_;
    CurveShape shape_;
};

/// Control point i for any i from -degree to N - 1 + degree: a phantom beyond the ends.  Natural: reflected
/// in the end, and again where there are too few points; Closed: around; else i must be inside.
template <CurvePoint P>
P control_point(const Curve<P>& curve, std::int64_t i) {
    const auto n = static_cast<std::int64_t>(curve.size());
    const auto& c = curve.points();
    if (curve.shape().ends == Ends::Closed) return c[((i % n) + n) % n];
    if (i < 0) return ScalarOf<P>(2) * c.front() - control_point(curve, -i);
    if (i >= n) return ScalarOf<P>(2) * c.back() - control_point(curve, 2 * (n - 1) - i);
    return c[i];
}

/// How many phantoms a curve needs at either end: degree / 2, rounded down; none for Open and Clamped.
inline std::int64_t phantom_count(const CurveShape& shape) {
    return shape.ends == Ends::Natural || shape.ends == Ends::Closed ? shape.degree / 2 : 0;
}

/// The control points from -phantom_count to the last, and as many phantoms after it (Closed: one more, which
/// closes the domain).
template <CurvePoint P>
std::vector<P> extended_points(const Curve<P>& curve) {
    const std::int64_t m = phantom_count(curve.shape());
    const auto n = static_cast<std::int64_t>(curve.size()) + (curve.shape().ends == Ends::Closed ? 1 : 0);
    std::vector<P> out;
    out.reserve(static_cast<std::size_t>(n + 2 * m));
    for (std::int64_t i = -m; i < n + m; ++i) out.push_back(control_point(curve, i));
    return out;
}

/// The same curve over plain knots, phantoms included.  Its domain is that of the curve, and half an interval
/// more at both ends where a closed curve has an even degree.
template <CurvePoint P>
Spline<P> spline_of(const Curve<P>& curve) {
    using Scalar = ScalarOf<P>;
    const int d = curve.shape().degree;
    Spline<P> out{d, {}, extended_points(curve), curve.shape().ends != Ends::Clamped};
    const auto count = static_cast<std::int64_t>(out.points.size()) + d + 1;
    out.knots.reserve(static_cast<std::size_t>(count));
    for (std::int64_t k = 0; k < count; ++k)
        out.knots.push_back(curve.shape().ends == Ends::Clamped
                                ? Scalar(std::clamp<std::int64_t>(k - d, 0, count - 1 - 2 * d))
                                : Scalar(2 * (k - phantom_count(curve.shape())) - (d + 1)) / 2);
    return out;
}

}  // namespace loopcheck::core
