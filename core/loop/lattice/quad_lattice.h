// A control face at one level, a register a point.
#pragma once

#include <array>
#include <cstddef>

#include "core/loop/lattice/quad.h"

namespace loopcheck::core {

/// A closed lattice of n segments, row by row: (i, j) is number j (n + 1) + i.
template <class Real>
class QuadLattice {
  public:
    /// The points are not initialized.
    explicit QuadLattice(Index segments);

    Index segments() const { return segments_; }
    std::ptrdiff_t pitch() const { return segments_ + std::ptrdiff_t{1}; }
    PaddedPoint<Real>* row(Index j) { return points_.data() + j * pitch(); }
    const PaddedPoint<Real>* row(Index j) const { return points_.data() + j * pitch(); }
    /// From a point to the six around it, in the order that begins in direction `start`.
    const std::ptrdiff_t* ring(unsigned start) const { return rings_[start].data(); }

  private:
    Index segments_;
    PaddedPoints<Real> points_;
    std::array<std::array<std::ptrdiff_t, 8>, 6> rings_;
};

}  // namespace loopcheck::core
