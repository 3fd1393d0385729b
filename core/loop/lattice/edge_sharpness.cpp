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

LatticeSharpness::LatticeSharpness(const Sharpness& control) : edge_(control.edge), vertex_(control.vertex) {
    look_through();
}

void LatticeSharpness::look_through() {
    has_semi_sharp_ = !uneven_.empty();
    has_sharp_ = has_semi_sharp_;
    for (const auto* values : {&edge_, &vertex_})
        for (const float s : *values) {
            has_sharp_ |= is_sharp(s);
            has_semi_sharp_ |= is_semi_sharp(s);
        }
}

LatticeSharpness LatticeSharpness::next(const Topology& topology, Creasing creasing) const {
    LatticeSharpness out;
    out.level_ = level_ + 1;
    out.vertex_.reserve(vertex_.size());
    for (const float s : vertex_) out.vertex_.push_back(uniform_decay(s));
    out.edge_.reserve(edge_.size());
    for (Index e = 0; e < topology.edge_count(); ++e) {
        if (creasing == Creasing::Uniform || (is_even(e) && !is_semi_sharp(edge_[e]))) {
            out.edge_.push_back(uniform_decay(edge_[e]));
            continue;
        }
        std::vector<float> halves = halves_of(topology, e);
        const bool alike = std::all_of(halves.begin(), halves.end(), [&](float s) { return s == halves[0]; });
        out.edge_.push_back(alike ? halves[0] : kUneven);
        if (!alike) out.uneven_.emplace(e, std::move(halves));
    }
    out.look_through();
    return out;
}

// Chaikin's rule.  At the ends every edge of the control vertex counts, in ring order; in between the two
// segments.
std::vector<float> LatticeSharpness::halves_of(const Topology& topology, Index e) const {
    const Index segments = Index{1} << level_;
    std::vector<float> halves;
    halves.reserve(2 * static_cast<std::size_t>(segments));
    for (Index point = 0; point <= segments; ++point) {
        SemiSharp around;
        if (point == 0 || point == segments) {
            const Index v = topology.edge_ends[e][point == 0 ? 0 : 1];
            for (const Index other : topology.ring(v))
                around.add(at_end(other, topology.edge_ends[other][0] == v ? 0 : 1));
        } else {
            for (const Index q : {point, point - 1}) around.add(of_segment(e, q));
        }
        if (point > 0) halves.push_back(around.decay(of_segment(e, point - 1)));
        if (point < segments) halves.push_back(around.decay(of_segment(e, point)));
    }
    return halves;
}

SharpnessLevels::SharpnessLevels(const TriangleMesh& mesh, const SchemeOptions& options, int levels) {
    levels_.emplace_back(control_sharpness(mesh, options.boundary));
    for (int l = 0; l < levels && levels_.back().has_semi_sharp(); ++l)
        levels_.push_back(levels_.back().next(mesh.topology(), options.creasing));
}

}  // namespace loopcheck::core
