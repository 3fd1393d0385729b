#include "reference/boost_math/cardinal.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/cardinal_b_spline.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace loopcheck::reference {
namespace {

using core::ErrorCode;

// The result of call.operator()<degree>(), for a degree that is known when the program runs only.
template <unsigned lowest = 1, class Call>
auto with_degree(unsigned degree, Call call) {
    if constexpr (lowest < kBoostMaxDegree) {
        if (degree > lowest) return with_degree<lowest + 1>(degree, call);
    }
    return call.template operator()<lowest>();
}

std::optional<core::Error> check_degree(int degree) {
    if (degree >= 1 && degree <= kBoostMaxDegree) return std::nullopt;
    return core::Error{ErrorCode::Unsupported, fmt::format("The degree is {}; this is compiled for 1 to {}.",
                                                           degree, kBoostMaxDegree)};
}

template <unsigned d>
core::Result<double> cardinal(double x, int order) {
    if (order == 0) return boost::math::cardinal_b_spline<d>(x);
    if (order == 1) return boost::math::cardinal_b_spline_prime<d>(x);
    if constexpr (d >= 3) {
        if (order == 2) return boost::math::cardinal_b_spline_double_prime<d>(x);
    }
    return core::fail(ErrorCode::Unsupported,
                      fmt::format("Boost has no derivative of order {} at degree {}.", order, d));
}

template <unsigned d, class P>
P curve_point(std::span<const P> points, std::int64_t first, double t) {
    // At the end of the domain the last basis function that is looked for is 0 and may have no point.
    const auto low = static_cast<std::int64_t>(std::floor(t - (d - 1) / 2.0)) - first;
    const auto end = std::min(low + d + 1, static_cast<std::int64_t>(points.size()));
    P sum{};
    for (std::int64_t k = low; k < end; ++k)
        sum += boost::math::cardinal_b_spline<d>(t - static_cast<double>(first + k)) *
               points[static_cast<std::size_t>(k)];
    return sum;
}

}  // namespace

std::string boost_version() {
    return fmt::format("{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
}

core::Result<double> boost_cardinal(int degree, double x, int derivative_order) {
    if (auto error = check_degree(degree)) return tl::unexpected(std::move(*error));
    return with_degree(static_cast<unsigned>(degree),
                       [&]<unsigned d>() { return cardinal<d>(x, derivative_order); });
}

template <class P>
core::Result<std::vector<P>> boost_curve_points(int degree, std::span<const P> points, std::int64_t first,
                                                std::span<const double> parameters) {
    if (auto error = check_degree(degree)) return tl::unexpected(std::move(*error));
    const double margin = (degree - 1) / 2.0, begin = static_cast<double>(first) + margin;
    const double end = static_cast<double>(first + static_cast<std::int64_t>(points.size()) - 1) - margin;
    const auto outside = std::find_if(parameters.begin(), parameters.end(),
                                      [&](double t) { return !(t >= begin && t <= end); });
    if (outside != parameters.end())
        return core::fail(ErrorCode::OutsideDomain,
                          fmt::format("The parameter {} is not in [{}, {}].", *outside, begin, end));
    std::vector<P> out;
    out.reserve(parameters.size());
    with_degree(static_cast<unsigned>(degree), [&]<unsigned d>() {
        for (const double t : parameters) out.push_back(curve_point<d>(points, first, t));
    });
    return out;
}

template core::Result<std::vector<double>> boost_curve_points(int, std::span<const double>, std::int64_t,
                                                              std::span<const double>);
template core::Result<std::vector<glm::dvec2>> boost_curve_points(int, std::span<const glm::dvec2>,
                                                                  std::int64_t, std::span<const double>);
template core::Result<std::vector<glm::dvec3>> boost_curve_points(int, std::span<const glm::dvec3>,
                                                                  std::int64_t, std::span<const double>);

}  // namespace loopcheck::reference
