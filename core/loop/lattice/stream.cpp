#include "core/loop/lattice/stream.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace loopcheck::core {

#ifdef __SSE2__

void stream_bytes(const void* from, std::size_t bytes, void* to) {
    constexpr std::size_t kWord = sizeof(__m128i), kLine = 64;
    const auto* source = static_cast<const std::byte*>(from);
    auto* target = static_cast<std::byte*>(to);
    const std::size_t ahead = -reinterpret_cast<std::uintptr_t>(target) % kLine;
    const std::size_t head = std::min(bytes, ahead);
    std::memcpy(target, source, head);
    const std::size_t end = head + (bytes - head) / kLine * kLine;
    for (std::size_t at = head; at < end; at += kWord) {
        __m128i word;
        std::memcpy(&word, source + at, kWord);
        _mm_stream_si128(reinterpret_cast<__m128i*>(target + at), word);
    }
    std::memcpy(target + end, source + end, bytes - end);
}

void end_stream() {
    _mm_sfence();
}

#else

void stream_bytes(const void* from, std::size_t bytes, void* to) {
    std::memcpy(to, from, bytes);
}

void end_stream() {}

#endif

}  // namespace loopcheck::core
