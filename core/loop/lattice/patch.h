// The inside of a control face: a regular lattice, on which one mask of each kind applies.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string_view>

#include "core/loop/lattice/pattern.h"
#include "core/loop/lattice/quad.h"
#include "core/mesh/ids.h"

namespace loopcheck::core {

/// A closed lattice of n segments, row by row: (i, j) is number j (n + 1) + i.
template <class Real>
class QuadLattice {
  public:
    /// The points are not initialized.
    explicit QuadLattice(Index segments);

    Index segments() const { return segments_; }
    std::ptrdiff_t pitch() const { return segments_ + std::ptrdiff_t{1}; }
    Quad<Real>* row(Index j) { return quads_.get() + j * pitch(); }
    const Quad<Real>* row(Index j) const { return quads_.get() + j * pitch(); }
    /// From a point to the six around it, in the order that begins in direction `start`.
    const std::ptrdiff_t* ring(unsigned start) const { return rings_[start].data(); }

  private:
    Index segments_;
    std::unique_ptr<Quad<Real>[]> quads_;
    std::array<std::array<std::ptrdiff_t, 8>, 6> rings_;
};

/// Makes the inside of the next level: rows 1 to 2n - 2 of `next`, without their ends.
template <class Real>
void refine_inside(const QuadLattice<Real>& lattice, const LatticePattern& pattern, QuadLattice<Real>& next);

/// The same into packed points, one after the other, for the rows that come from rows `first` to `last` - 1:
/// of row j these are 2j, except for j = 0, and 2j + 1.  One real after them is overwritten.  Returns the
/// end.
template <class Real>
Real* refine_rows(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index first, Index last,
                  Real* packed);

/// The instructions that these use on this machine: "AVX2", or those that the build was made for.
std::string_view lattice_instructions();

}  // namespace loopcheck::core
