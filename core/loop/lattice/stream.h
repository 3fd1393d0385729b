// Writing results that are larger than the caches.
#pragma once

#include <cstddef>

namespace loopcheck::core {

/// Copies bytes past the caches, where the machine can: a line that is written whole need not be read before.
/// Other threads see them after `end_stream`, called by the thread that wrote.
void stream_bytes(const void* from, std::size_t bytes, void* to);
void end_stream();

}  // namespace loopcheck::core
