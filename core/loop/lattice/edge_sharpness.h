// The sharpness along the edges of the control mesh at every level: all that there is, since what refinement
// makes inside faces is smooth.
#pragma once

#include <algorithm>
#include <map>
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
    float of_segment(Index e, Index q) const { return is_even(e) ? edge_[e] : uneven_.find(e)->second[q]; }
    /// The segment of e that is next to its end 0 or 1.
    float at_end(Index e, int end) const {
        if (is_even(e)) return edge_[e];
        const std::vector<float>& segments = uneven_.find(e)->second;
        return end == 0 ? segments.front() : segments.back();
    }
    /// True where all segments of e are alike.
    bool is_even(Index e) const { return edge_[e] != kUneven; }
    /// Whether anything is sharp, and whether anything will change in the next level.
    bool has_sharp() const { return has_sharp_; }
    bool has_semi_sharp() const { return has_semi_sharp_; }

  private:
    static constexpr float kUneven = -1;

    LatticeSharpness() = default;
    std::vector<float> halves_of(const Topology& topology, Index e) const;
    void look_through();

    int level_ = 0;
    bool has_sharp_ = false, has_semi_sharp_ = false;
    std::vector<float> edge_;                     // of all segments, or kUneven
    std::map<Index, std::vector<float>> uneven_;  // one a segment
    std::vector<float> vertex_;
};

/// That of every level.
class SharpnessLevels {
  public:
    SharpnessLevels(const TriangleMesh& mesh, const SchemeOptions& options, int levels);

    const LatticeSharpness& operator[](int level) const {
        return levels_[std::min(static_cast<std::size_t>(level), levels_.size() - 1)];
    }

  private:
    std::vector<LatticeSharpness> levels_;  // the last stands for all that follow
};

}  // namespace loopcheck::core
