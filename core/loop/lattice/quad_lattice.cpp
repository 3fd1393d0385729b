#include "core/loop/lattice/quad_lattice.h"

namespace loopcheck::core {

template <class Real>
QuadLattice<Real>::QuadLattice(Index segments)
    : segments_(segments), points_(static_cast<std::size_t>(pitch() * pitch())) {
    const std::array<std::ptrdiff_t, 6> around{1, pitch(), pitch() - 1, -1, -pitch(), 1 - pitch()};
    for (std::size_t start = 0; start < 6; ++start)
        for (std::size_t k = 0; k < 6; ++k) rings_[start][k] = around[(start + k) % 6];
}

template class QuadLattice<float>;
template class QuadLattice<double>;

}  // namespace loopcheck::core
