// How fast this machine writes memory, here and now: what no refinement can beat.
#pragma once

#include <cstddef>
#include <memory>

namespace loopcheck::bench {

/// A large buffer, touched once, to be filled past the caches.
class WriteTest {
  public:
    explicit WriteTest(std::size_t bytes);

    /// Seconds a byte, the median of a few fills by so many threads.
    double seconds_per_byte(int threads);

  private:
    std::size_t count_;
    std::unique_ptr<double[]> buffer_;
};

}  // namespace loopcheck::bench
