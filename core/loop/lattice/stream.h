// Writing results that are larger than the caches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

namespace loopcheck::core {

/// Copies bytes past the caches, where the machine can: a line that is written whole need not be read before.
/// Other threads see them after `end_stream`, called by the thread that wrote.
void stream_bytes(const void* from, std::size_t bytes, void* to);
void end_stream();

/// Larger results are written past the caches, in blocks that stay in the nearest of them.
inline constexpr std::size_t kCacheBytes = std::size_t{1} << 21;
inline constexpr std::size_t kBlockBytes = std::size_t{1} << 14;

/// Gathers values that belong one after the other in a result, and takes them there block by block.
template <class T>
class Outbox {
  public:
    /// At most so many values are written at `end()` at once.
    Outbox(std::size_t result_size, std::size_t most)
        : is_large_(result_size * sizeof(T) > kCacheBytes),
          values_(std::make_unique_for_overwrite<T[]>(kBlockBytes / sizeof(T) + most)) {}
    ~Outbox() {
        if (is_large_) end_stream();
    }
    Outbox(const Outbox&) = delete;
    Outbox& operator=(const Outbox&) = delete;

    void begin(T* to) {
        to_ = to;
        end_ = values_.get();
    }
    T* end() { return end_; }
    void advance(T* end) {
        end_ = end;
        if (static_cast<std::size_t>(end_ - values_.get()) >= kBlockBytes / sizeof(T)) flush();
    }
    void flush() {
        const auto count = static_cast<std::size_t>(end_ - values_.get());
        if (is_large_)
            stream_bytes(values_.get(), count * sizeof(T), to_);
        else
            std::copy_n(values_.get(), count, to_);
        begin(to_ + count);
    }

  private:
    bool is_large_;
    std::unique_ptr<T[]> values_;
    T* end_ = nullptr;
    T* to_ = nullptr;
};

}  // namespace loopcheck::core
