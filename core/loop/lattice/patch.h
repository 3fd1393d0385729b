// The inside of a control face.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/skeleton.h"

namespace loopcheck::core {

/// The lattices of a face at levels 0 to `levels`.
template <class Real>
class FacePatch {
  public:
    FacePatch(const Topology& topology, const LatticePattern& pattern, int levels)
        : topology_(topology), pattern_(pattern) {
        for (int l = 0; l <= levels; ++l) lattices_.emplace_back(Index{1} << l);
    }

    /// From the control mesh and the points on its edges, which `points` has at all those levels.
    void run(std::span<const Point<Real>> control, Index f, const EdgePoints<Real>& points) {
        const Triangle& corners = topology_.triangles[f];
        lattices_[0].row(0)[0] = load_point<Real>(control, corners[0]);
        lattices_[0].row(0)[1] = load_point<Real>(control, corners[1]);
        lattices_[0].row(1)[0] = load_point<Real>(control, corners[2]);
        for (std::size_t l = 1; l < lattices_.size(); ++l) {
            take_edges(f, static_cast<int>(l), points);
            if (l > 1) refine_inside<Real>(lattices_[l - 1], pattern_, lattices_[l]);
        }
    }

    const QuadLattice<Real>& last() const { return lattices_.back(); }

  private:
    void take_edges(Index f, int level, const EdgePoints<Real>& points) {
        QuadLattice<Real>& lattice = lattices_[static_cast<std::size_t>(level)];
        const Index n = lattice.segments();
        const std::ptrdiff_t pitch = lattice.pitch();
        const std::array<std::ptrdiff_t, 3> first{0, n, n * pitch}, step{1, pitch - 1, -pitch};
        for (int c = 0; c < 3; ++c) {
            const Index e = topology_.face_edges[f][c];
            const bool along = topology_.edge_faces[e][0] == f;
            const Real* from = points.at(e, level, along ? 0 : n);
            PaddedPoint<Real>* to = lattice.row(0) + first[c];
            for (Index k = 0; k < n; ++k, from += along ? kPacked : -kPacked, to += step[c])
                *to = load_quad<Real>(from);
        }
    }

    const Topology& topology_;
    const LatticePattern& pattern_;
    std::vector<QuadLattice<Real>> lattices_;
};

}  // namespace loopcheck::core
