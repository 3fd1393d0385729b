#include "core/bspline/curve.h"

#include <fmt/format.h>

#include <array>

namespace loopcheck::core {
namespace {

constexpr std::array kAllEnds{Ends::Natural, Ends::Closed, Ends::Open, Ends::Clamped};

std::size_t least_points(const CurveShape& shape) {
    switch (shape.ends) {
        case Ends::Natural:
            return 2;
        case Ends::Closed:
            return 3;
        case Ends::Open:
        case Ends::Clamped:
            break;
    }
    return static_cast<std::size_t>(shape.degree) + 1;
}

}  // namespace

std::string_view name(Ends ends) {
    switch (ends) {
        case Ends::Natural:
            return "natural";
        case Ends::Closed:
            return "closed";
        case Ends::Open:
            return "open";
        case Ends::Clamped:
            return "clamped";
    }
    return "unknown";
}

std::optional<Ends> parse_ends(std::string_view text) {
    for (const Ends ends : kAllEnds)
        if (name(ends) == text) return ends;
    return std::nullopt;
}

std::optional<Error> check_shape(const CurveShape& shape, std::size_t count) {
    if (shape.degree < 1 || shape.degree > kMaxDegree)
        return Error{ErrorCode::Unsupported,
                     fmt::format("The degree is {}; it must be 1 to {}.", shape.degree, kMaxDegree)};
    if (shape.ends == Ends::Natural && shape.degree % 2 == 0)
        return Error{
            ErrorCode::Unsupported,
            fmt::format("Natural ends are for odd degrees; at degree {} the curve may be closed, open or "
                        "clamped.",
                        shape.degree)};
    if (count < least_points(shape))
        return Error{ErrorCode::TooFewPoints,
                     fmt::format("A curve of degree {} with {} ends needs {} points; there are {}.",
                                 shape.degree, name(shape.ends), least_points(shape), count)};
    return std::nullopt;
}

}  // namespace loopcheck::core
