#include "core/loop/lattice/pattern.h"

#include "core/loop/lattice/sums.h"

namespace loopcheck::core {

LatticePattern::LatticePattern(Index segments)
    : pitch_(static_cast<std::size_t>(segments) + 1), bytes_(pitch_ * pitch_) {
    for (Index j = 0; j <= segments; ++j)
        for (Index i = 0; i + j <= segments; ++i) {
            unsigned byte = upright_first(i + j + 1, j) ? kAcross : 0;
            if (i > 0 && upright_first(i, j)) byte |= kUp;
            if (j > 0 && upright_first(j, i)) byte |= kAlong;
            if (i > 0 && j > 0) byte |= static_cast<unsigned>(ring_start(i, j));
            bytes_[static_cast<std::size_t>(j) * pitch_ + static_cast<std::size_t>(i)] =
                static_cast<std::uint8_t>(byte);
        }
}

}  // namespace loopcheck::core
