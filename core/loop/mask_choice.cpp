#include "core/loop/mask_choice.h"

#include <algorithm>
#include <vector>

#include "core/loop/rules.h"
#include "core/loop/sharpness.h"

namespace loopcheck::core {
namespace {

// Ring positions of the sharp edges.
std::vector<int> sharp_of(std::span<const float> ring) {
    std::vector<int> out;
    for (std::size_t i = 0; i < ring.size(); ++i)
        if (is_sharp(ring[i])) out.push_back(static_cast<int>(i));
    return out;
}

// The mean of the sharpnesses that come to their end at the vertex in this step, at most 1.
float share_of_parent(float sharpness, float child_sharpness, std::span<const float> ring,
                      std::span<const float> child_ring) {
    float sum = 0;
    int count = 0;
    const auto add = [&](float parent, float child) {
        if (!is_sharp(parent) || is_sharp(child)) return;
        sum += parent;
        ++count;
    };
    add(sharpness, child_sharpness);
    for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], child_ring[i]);
    return std::min(1.0F, sum / static_cast<float>(count));
}

}  // namespace

Mask vertex_point_mask(float sharpness, std::span<const float> ring, std::span<const float> child_ring) {
    const std::vector<int> parent = sharp_of(ring);
    const VertexRule rule = rule_of(sharpness, static_cast<int>(parent.size()));
    Mask mask{.parent = rule, .child = rule, .ring = static_cast<int>(ring.size())};
    if (rule != VertexRule::Crease && rule != VertexRule::Corner) return mask;
    const std::vector<int> child = sharp_of(child_ring);
    const float child_sharpness = uniform_decay(sharpness);
    if (mask.parent == VertexRule::Crease) mask.parent_crease = {parent[0], parent[1]};
    mask.child = rule_of(child_sharpness, static_cast<int>(child.size()));
    if (mask.child == mask.parent) return mask;
    mask.share = share_of_parent(sharpness, child_sharpness, ring, child_ring);
    if (mask.share == 1)
        mask.child = mask.parent;
    else if (mask.child == VertexRule::Crease)
        mask.child_crease = {child[0], child[1]};
    return mask;
}

Mask edge_point_mask(float sharpness, const std::array<float, 2>& halves, CreaseShare crease_share) {
    Mask mask{.point = Mask::Point::Edge};
    if (!is_sharp(sharpness)) return mask;
    mask.parent = mask.child = VertexRule::Crease;
    const bool child_is_crease = is_sharp(halves[0]) && is_sharp(halves[1]);
    const float share = crease_share == CreaseShare::Clamped ? std::min(1.0F, sharpness) : sharpness;
    if (!child_is_crease && share != 1) {
        mask.child = VertexRule::Smooth;
        mask.share = share;
    }
    return mask;
}

}  // namespace loopcheck::core
