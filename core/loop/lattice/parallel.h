// Work on several threads, where the results do not depend on their number.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// Calls `work(first, last)` for ranges that together are 0 to `count` - 1, of at least `grain` each but for
/// the last, on at most `threads` threads.
template <class Work>
void for_ranges(Index count, Index grain, int threads, const Work& work) {
    if (threads <= 1 || count <= grain) {
        if (count > 0) work(Index{0}, count);
        return;
    }
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<Index>(0, count, static_cast<std::size_t>(grain)),
                          [&](const tbb::blocked_range<Index>& range) { work(range.begin(), range.end()); });
    });
}

}  // namespace loopcheck::core
