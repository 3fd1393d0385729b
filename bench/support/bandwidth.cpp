#include "bench/support/bandwidth.h"

#include <span>
#include <thread>
#include <vector>

#include "bench/support/clock.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace loopcheck::bench {
namespace {

constexpr int kFills = 5;
constexpr std::size_t kBlock = 8;  // doubles of a cache line

void fill(std::span<double> out, double value) {
#ifdef __SSE2__
    const __m128d both = _mm_set1_pd(value);
    for (std::size_t i = 0; i < out.size(); i += 2) _mm_stream_pd(&out[i], both);
    _mm_sfence();
#else
    std::fill(out.begin(), out.end(), value);
#endif
}

}  // namespace

WriteTest::WriteTest(std::size_t bytes)
    : count_(bytes / sizeof(double)), buffer_(std::make_unique<double[]>(count_)) {}

double WriteTest::seconds_per_byte(int threads) {
    const std::size_t part = count_ / static_cast<std::size_t>(threads) / kBlock * kBlock;
    std::vector<double> times;
    times.reserve(kFills);
    for (int i = 0; i < kFills; ++i)
        times.push_back(seconds([&] {
            std::vector<std::jthread> helpers;
            for (int t = 1; t < threads; ++t)
                helpers.emplace_back([&, t] {
                    fill({&buffer_[static_cast<std::size_t>(t) * part], part}, i);
                });
            fill({buffer_.get(), part}, i);
        }));
    return median(std::move(times)) /
           static_cast<double>(part * static_cast<std::size_t>(threads) * sizeof(double));
}

}  // namespace loopcheck::bench
