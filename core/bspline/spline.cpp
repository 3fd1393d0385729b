#include "core/bspline/spline.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace loopcheck::core {

std::optional<Error> check_knots(std::span<const double> knots, int degree, std::size_t point_count) {
    const auto bad = [](std::string sentence) { return Error{ErrorCode::BadKnots, std::move(sentence)}; };
    if (degree < 1 || degree > kMaxDegree)
        return bad(fmt::format("The degree is {}; it must be 1 to {}.", degree, kMaxDegree));
    const auto d = static_cast<std::size_t>(degree);
    if (point_count <= d)
        return bad(fmt::format("{} points are too few for degree {}.", point_count, degree));
    if (knots.size() != point_count + d + 1)
        return bad(fmt::format("There are {} knots; {} points of degree {} need {}.", knots.size(),
                               point_count, degree, point_count + d + 1));
    for (std::size_t k = 0; k < knots.size(); ++k) {
        if (!(std::abs(knots[k]) <= std::numeric_limits<double>::max() * 0x1p-24))
            return bad(fmt::format("Knot {} is not finite, or too large to be summed.", k));
        if (k > 0 && knots[k] < knots[k - 1])
            return bad(fmt::format("Knot {} is smaller than the one before.", k));
    }
    if (knots[d] == knots[d + 1] || knots[point_count - 1] == knots[point_count])
        return bad("The domain begins or ends with an empty interval.");
    for (std::size_t k = d + 1; k + d < point_count; ++k)
        if (knots[k] == knots[k + d])
            return bad(
                fmt::format("Knot {} is repeated more than {} times: the curve would be torn.", k, degree));
    return std::nullopt;
}

}  // namespace loopcheck::core
