#include "core/loop/lattice/edge_sharpness.h"

#include <algorithm>

namespace loopcheck::core {
namespace {

// The semi-sharp edges around a vertex, summed in the order in which they are met.
struct SemiSharp {
    float sum = 0;
    int count = 0;

    void add(float s) {
        if (!is_semi_sharp(s)) return;
        sum += s;
        ++count;
    }
    float decay(float s) const { return chaikin_decay(s, sum, count); }
};

}  // namespace

LatticeSharpness::LatticeSharpness(const Sharpness& control) : vertex_(control.vertex) {
    edge_.reserve(control.edge.size());
    for (const float s : control.edge) edge_.push_back({s});
}

LatticeSharpness LatticeSharpness::next(const Topology& topology, Creasing creasing) const {
    LatticeSharpness out;
    out.level_ = level_ + 1;
    for (const float s : vertex_) out.vertex_.push_back(uniform_decay(s));
    out.edge_.resize(edge_.size());
    for (Index e = 0; e < topology.edge_count(); ++e) {
        if (creasing == Creasing::Uniform || (is_even(e) && !is_semi_sharp(edge_[e][0]))) {
            out.edge_[e] = {uniform_decay(edge_[e][0])};
            continue;
        }
        // At the ends every edge of the control vertex counts, in ring order; in between the two segments.
        const auto at_vertex = [&](Index v) {
            SemiSharp around;
            for (const Index other : topology.ring(v))
                around.add(at_end(other, topology.edge_ends[other][0] == v ? 0 : 1));
            return around;
        };
        const Index segments = Index{1} << level_;
        std::vector<float>& halves = out.edge_[e];
        halves.reserve(2 * static_cast<std::size_t>(segments));
        for (Index point = 0; point <= segments; ++point) {
            SemiSharp around;
            if (point == 0 || point == segments)
                around = at_vertex(topology.edge_ends[e][point == 0 ? 0 : 1]);
            else
                for (const Index q : {point, point - 1}) around.add(of_segment(e, q));
            if (point > 0) halves.push_back(around.decay(of_segment(e, point - 1)));
            if (point < segments) halves.push_back(around.decay(of_segment(e, point)));
        }
        const bool alike = std::all_of(halves.begin(), halves.end(), [&](float s) { return s == halves[0]; });
        if (alike) halves.resize(1);
    }
    return out;
}

}  // namespace loopcheck::core
