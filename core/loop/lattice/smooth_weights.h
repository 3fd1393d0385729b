// The smooth masks of a mesh's vertices, by valence.
#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/options.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// Of smooth vertices: the weight of a neighbour and that of the vertex, by valence.
template <class Real>
class SmoothWeights {
  public:
    SmoothWeights(const Topology& topology, Weights weights);

    struct Pair {
        Real side = 0, centre = 0;
    };
    const Pair& operator[](std::size_t valence) const { return by_valence_[valence]; }

  private:
    std::vector<Pair> by_valence_;
};

}  // namespace loopcheck::core
