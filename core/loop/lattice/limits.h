// Limit positions and normals of every vertex of level L, without the levels in between.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/refiner.h"
#include "core/loop/limit.h"

namespace loopcheck::core {

/// The limits of level L, with the bits of `limits`, on any number of threads.  Masks are prepared once;
/// positions are pushed through again and again.
template <class Real>
class LatticeLimits {
  public:
    /// Refers to the mesh, which must live as long.
    /// Errors   TooLarge, as `LatticeRefiner::make`.
    static Result<LatticeLimits> make(const TriangleMesh& mesh, const SchemeOptions& options, int level);
    static Result<LatticeLimits> make(TriangleMesh&&, const SchemeOptions&, int) = delete;

    const LatticeOrder& order() const { return refiner_.order(); }

    /// Of every vertex of level L by `order()`: the limit position, and the unit normal in its first sector,
    /// 0 where there is none.
    ///
    /// Requires `control` with a point a control vertex, and room for `order().vertex_count()` in both
    /// results. Memory  beside the results: 2^L E points, and 4^L a thread.
    void evaluate(std::span<const Point<Real>> control, std::span<Point<Real>> positions,
                  std::span<Point<Real>> normals, int threads = 1) const;

  private:
    using Masks = LimitWeights<Real>;

    explicit LatticeLimits(LatticeRefiner refiner);

    static Masks first_sector(const LimitMasks<Real>& masks);
    const Masks* masks_of_star(const Star& star);
    void find_vertex_masks(const SchemeLevel& control, Index v);
    void find_edge_masks(const SchemeLevel& control, Index e);
    std::vector<Masks> semi_sharp_masks(const SchemeLevel& control, std::vector<Index> points) const;

    LatticeRefiner refiner_;
    LatticePattern pattern_;
    RegularLimit<Real> regular_;
    std::map<Star, std::unique_ptr<const Masks>> by_star_;
    std::vector<const Masks*> of_vertex_;
    std::vector<const Masks*> of_edge_;                        // of all points on it, or null
    std::map<Index, std::vector<Masks>> semi_sharp_vertices_;  // one each
    std::map<Index, std::vector<Masks>> semi_sharp_edges_;     // of its points, ends included
};

extern template class LatticeLimits<float>;
extern template class LatticeLimits<double>;

}  // namespace loopcheck::core
