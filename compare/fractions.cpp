#include "compare/fractions.h"

#include <fmt/format.h>

#include <cstdint>

namespace loopcheck::compare {

std::optional<std::string> as_fraction(const core::HighPrecision& value, const FractionSearch& search) {
    using High = core::HighPrecision;
    const High size = abs(value);
    const High tolerance = search.tolerance * (size > 1 ? size : High(1));
    High p = 1, q = 0, p_before = 0, q_before = 1;  // convergents of the continued fraction
    for (High rest = size;;) {
        const High whole = floor(High(rest + High("1e-20")));
        const High p_next = whole * p + p_before, q_next = whole * q + q_before;
        if (q_next > search.largest_denominator || p_next > High(1e15)) return std::nullopt;
        p_before = p, p = p_next, q_before = q, q = q_next;
        if (abs(High(size - p / q)) <= tolerance) break;
        rest -= whole;
        if (rest < High("1e-20")) return std::nullopt;  // the next denominator would be far too large
        rest = 1 / rest;
    }
    if (p == 0 && value != 0) return std::nullopt;
    const std::string sign = value < 0 && p != 0 ? "-" : "";
    const auto number = [](const High& x) { return fmt::format("{}", static_cast<std::int64_t>(x)); };
    return q == 1 ? sign + number(p) : fmt::format("{}{}/{}", sign, number(p), number(q));
}

}  // namespace loopcheck::compare
