// Refinement of a mesh that moves: everything but the positions is prepared once.
#pragma once

#include <span>
#include <vector>

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/refiner.h"

namespace loopcheck::core {

/// Level L of a mesh whose positions change, with the bits of `refine`, on any number of threads.
///
/// Up to level 3 most vertices lie on vertices and edges of the control mesh, and finding what is around them
/// takes longer than the sums: it is written down in lists.  From level 4 on `LatticeRefiner` needs none.
template <class Real>
class LatticeEvaluator {
  public:
    /// Refers to the mesh, which must live as long.
    /// Errors   TooLarge, as `LatticeRefiner::make`.
    static Result<LatticeEvaluator> make(const TriangleMesh& mesh, const SchemeOptions& options, int level);
    static Result<LatticeEvaluator> make(TriangleMesh&&, const SchemeOptions&, int) = delete;

    const LatticeOrder& order() const { return refiner_.order(); }

    /// As `LatticeRefiner::refine`.
    void refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined, int threads = 1) const;

  private:
    static constexpr int kListLevels = 3;

    explicit LatticeEvaluator(LatticeRefiner refiner) : refiner_(std::move(refiner)) {}

    LatticeRefiner refiner_;
    std::vector<GatherList<Real>> lists_;  // one a level, or none
};

extern template class LatticeEvaluator<float>;
extern template class LatticeEvaluator<double>;

}  // namespace loopcheck::core
