#include "core/mesh/io/number.h"

#include <locale.h>
#include <stdlib.h>

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>
#include <type_traits>

namespace loopcheck::core {
namespace {

/// The text without a leading '+', which std::from_chars does not take.  "+-1" is left as it is: no number.
std::string_view without_plus(std::string_view text) {
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    return plus ? text.substr(1) : text;
}

/// The number in `text`, known to be one, by strtod in the C locale.
///
/// std::from_chars says only "out of range" for both overflow and underflow and gives no value.  strtod of
/// glibc gives the correctly rounded one in both cases, infinity included; the tests check it exactly.
template <class Float>
Float round_out_of_range(std::string_view text) {
    static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
    const std::string terminated(text);
    if constexpr (std::is_same_v<Float, float>)
        return strtof_l(terminated.c_str(), nullptr, c_locale);
    else
        return strtod_l(terminated.c_str(), nullptr, c_locale);
}

template <class Number>
std::optional<Number> parse(std::string_view text) {
    text = without_plus(text);
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
    if (error == std::errc{}) return value;
    if constexpr (std::is_floating_point_v<Number>)
        return round_out_of_range<Number>(text);
    else
        return std::nullopt;
}

template <class Float, class... Format>
std::string print(Float value, Format... format) {
    std::array<char, 64> text;
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value, format...);
    return {text.data(), end};
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
    return parse<double>(text);
}
std::optional<float> parse_float(std::string_view text) {
    return parse<float>(text);
}
std::optional<long long> parse_integer(std::string_view text) {
    return parse<long long>(text);
}

std::string shortest(double value) {
    return print(value);
}
std::string shortest(float value) {
    return print(value);
}

std::string hexfloat(double value) {
    std::string text = print(value, std::chars_format::hex);
    if (std::isfinite(value)) text.insert(text[0] == '-' ? 1 : 0, "0x");
    return text;
}

}  // namespace loopcheck::core
