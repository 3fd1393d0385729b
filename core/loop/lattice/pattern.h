// In which order the sums inside a control face run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// The order of summation at every place of a lattice, a byte each: in which direction the ring of (i, j)
/// begins, and for the segments from (i, j) along edge 0 and edge 2, and for that from (i + 1, j) to
/// (i, j + 1), whether the upright face comes first.  It does not depend on the size of the lattice.
class LatticePattern {
  public:
    static constexpr unsigned kRing = 7, kAlong = 8, kUp = 16, kAcross = 32;

    /// For closed lattices of up to `segments` segments.
    explicit LatticePattern(Index segments);

    const std::uint8_t* row(Index j) const { return bytes_.data() + static_cast<std::size_t>(j) * pitch_; }

  private:
    std::size_t pitch_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace loopcheck::core
