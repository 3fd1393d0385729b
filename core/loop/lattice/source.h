// What the passes over the lattice start from.
#pragma once

#include <span>

#include "core/loop/lattice/edge_sharpness.h"
#include "core/loop/lattice/smooth_weights.h"
#include "core/mesh/options.h"
#include "core/mesh/point.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// What a mesh is refined by, and from.
template <class Real>
struct LatticeSource {
    const Topology& topology;
    const SchemeOptions& options;
    const SharpnessLevels& sharpness;
    const SmoothWeights<Real>& smooth;
    std::span<const Point<Real>> control;
};

}  // namespace loopcheck::core
