#include "core/loop/sharpness.h"

#include <algorithm>

namespace loopcheck::core {
namespace {

struct SemiSharp {
    float sum = 0;
    int count = 0;
};

// Per vertex, the semi-sharp edges around it, summed in ring order.
std::vector<SemiSharp> semi_sharp_around(const Topology& topology, const Sharpness& sharpness) {
    std::vector<SemiSharp> out(topology.vertex_count);
    for (Index v = 0; v < topology.vertex_count; ++v)
        for (const Index e : topology.ring(v))
            if (is_semi_sharp(sharpness.edge[e])) {
                out[v].sum += sharpness.edge[e];
                ++out[v].count;
            }
    return out;
}

}  // namespace

Sharpness control_sharpness(const TriangleMesh& mesh, BoundaryRule boundary) {
    const Topology& t = mesh.topology();
    Sharpness s{{mesh.edge_sharpness().begin(), mesh.edge_sharpness().end()},
                {mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end()}};
    for (Index e = 0; e < t.edge_count(); ++e)
        if (t.is_boundary_edge(e)) s.edge[e] = kInfiniteSharpness;
    for (Index v = 0; v < t.vertex_count; ++v) {
        const bool one_face_corner = t.is_boundary_vertex(v) && t.face_count_at(v) == 1;
        if (t.is_isolated(v) || (boundary == BoundaryRule::EdgeAndCorner && one_face_corner))
            s.vertex[v] = kInfiniteSharpness;
    }
    return s;
}

float uniform_decay(float s) {
    if (is_infinite(s)) return kInfiniteSharpness;
    return s > 1 ? s - 1 : 0;
}

float chaikin_decay(float s, float semi_sharp_sum, int semi_sharp_count) {
    if (!is_semi_sharp(s) || semi_sharp_count <= 1) return uniform_decay(s);
    const float mean_of_others = (semi_sharp_sum - s) / static_cast<float>(semi_sharp_count - 1);
    return std::max(0.0F, 0.75F * s + 0.25F * mean_of_others - 1);
}

std::vector<std::array<float, 2>> half_edge_sharpness(const Topology& topology, const Sharpness& sharpness,
                                                      Creasing creasing) {
    std::vector<std::array<float, 2>> halves;
    halves.reserve(sharpness.edge.size());
    if (creasing == Creasing::Uniform) {
        for (const float s : sharpness.edge) halves.push_back({uniform_decay(s), uniform_decay(s)});
        return halves;
    }
    const auto semi_sharp = semi_sharp_around(topology, sharpness);
    for (Index e = 0; e < topology.edge_count(); ++e) {
        std::array<float, 2>& half = halves.emplace_back();
        for (int i = 0; i < 2; ++i) {
            const auto& [sum, count] = semi_sharp[topology.edge_ends[e][i]];
            half[i] = chaikin_decay(sharpness.edge[e], sum, count);
        }
    }
    return halves;
}

}  // namespace loopcheck::core
