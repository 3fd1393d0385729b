// Memory that is about to be written.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace loopcheck::bench {

/// Grows without touching what it gets, and is used again: a page that is new costs more than the work on it.
template <class T>
class Buffer {
  public:
    std::span<T> room_for(std::size_t size) {
        if (size > size_) values_ = std::make_unique_for_overwrite<T[]>(size_ = size);
        return {values_.get(), size};
    }

  private:
    std::unique_ptr<T[]> values_;
    std::size_t size_ = 0;
};

}  // namespace loopcheck::bench
