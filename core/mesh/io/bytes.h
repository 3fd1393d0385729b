// Numbers in binary files, in either byte order.  Internal.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace loopcheck::core {

/// The number in the first bytes.  Requires at least sizeof(Number) bytes.
template <class Number>
Number load(std::string_view bytes, std::endian order) {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes.data(), raw.size());
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
}

/// Appends the bytes of the number.
template <class Number>
void append(std::string& bytes, Number number, std::endian order) {
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

}  // namespace loopcheck::core
