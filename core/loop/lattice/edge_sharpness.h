// The sharpness along the edges of the control mesh at every level: all that there is, since what refinement
// makes inside faces is smooth.
#pragma once

#include <vector>

#include "core/loop/sharpness.h"
#include "core/mesh/options.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The sharpness of one level.
class LatticeSharpness {
  public:
    /// That of the control mesh.
    explicit LatticeSharpness(const Sharpness& control);

    /// That of the next level, as `half_edge_sharpness` has it.  Requires the control mesh's topology.
    LatticeSharpness next(const Topology& topology, Creasing creasing) const;

    float of_vertex(Index v) const { return vertex_[v]; }
    /// Of segment q of edge e, counted from its end 0.
    float of_segment(Index e, Index q) const { return edge_[e].size() == 1 ? edge_[e][0] : edge_[e][q]; }
    /// The segment of e that is next to its end 0 or 1.
    float at_end(Index e, int end) const { return end == 0 ? edge_[e].front() : edge_[e].back(); }
    /// True where all segments of e are alike.
    bool is_even(Index e) const { return edge_[e].size() == 1; }

  private:
    LatticeSharpness() = default;

    int level_ = 0;
    std::vector<std::vector<float>> edge_;  // one value where all are alike, else one a segment
    std::vector<float> vertex_;
};

}  // namespace loopcheck::core
