// Work on several threads, where the results do not depend on their number.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// How many items to take at once, of so many vertices each: less is not worth another thread.
inline Index grain(std::int64_t vertices_each) {
    constexpr std::int64_t kVerticesPerTask = 1024;
    return static_cast<Index>(kVerticesPerTask /
                              std::clamp<std::int64_t>(vertices_each, 1, kVerticesPerTask));
}

/// Calls `work(first, last)` for ranges that together are 0 to `count` - 1, of about `grain` each or more, on
/// at most `threads` threads, nor on more than the machine has.
template <class Work>
void for_ranges(Index count, Index grain, int threads, const Work& work) {
    if (threads <= 1 || count <= grain) {
        if (count > 0) work(Index{0}, count);
        return;
    }
    tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<Index>(0, count, static_cast<std::size_t>(grain)),
                          [&](const tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
    });
}

}  // namespace loopcheck::core
