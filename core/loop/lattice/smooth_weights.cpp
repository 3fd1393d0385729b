#include "core/loop/lattice/smooth_weights.h"

#include "core/loop/masks.h"

namespace loopcheck::core {

template <class Real>
SmoothWeights<Real>::SmoothWeights(const Topology& topology, Weights weights) {
    for (Index v = 0; v < topology.vertex_count; ++v) {
        const std::size_t n = topology.ring(v).size();
        if (n < 2) continue;
        if (n >= by_valence_.size()) by_valence_.resize(n + 1);
        if (by_valence_[n].centre != 0) continue;
        const auto all = weights_of<Real>(Mask{.ring = static_cast<int>(n)}, weights);
        by_valence_[n] = {all.front(), all.back()};
    }
}

template class SmoothWeights<float>;
template class SmoothWeights<double>;

}  // namespace loopcheck::core
