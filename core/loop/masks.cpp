#include "core/loop/masks.h"

#include <fmt/format.h>

#include <bit>

namespace loopcheck::core {

std::string to_string(const Mask& mask) {
    const auto point = mask.point == Mask::Point::Vertex ? "vertex point" : "edge point";
    if (!mask.is_blended()) return fmt::format("{}, {}", point, name(mask.parent));
    return fmt::format("{}, {} {} + {} {}", point, mask.share, name(mask.parent), 1 - mask.share,
                       name(mask.child));
}

std::vector<int> places_of(const Mask& mask) {
    if (mask.point == Mask::Point::Edge) {
        if (mask.parent == VertexRule::Crease && !mask.is_blended()) return {0, 1};
        return {0, 1, 2, 3};
    }
    std::vector<int> places;
    if (detail::is_smooth(mask.parent) || detail::is_smooth(mask.child)) {
        for (int i = 0; i < mask.ring; ++i) places.push_back(i);
    } else {
        const auto add = [&](VertexRule rule, const Mask::Ends& ends) {
            if (rule == VertexRule::Crease) places.insert(places.end(), ends.begin(), ends.end());
        };
        add(mask.parent, mask.parent_crease);
        if (mask.is_blended()) add(mask.child, mask.child_crease);
    }
    places.push_back(mask.ring);
    return places;
}

int weight_ulps(const Mask& mask, Weights weights) {
    if (mask.is_blended()) return 2 * kLoopWeightUlps;
    if (mask.point == Mask::Point::Edge || !detail::is_smooth(mask.parent)) return 0;
    const auto n = static_cast<unsigned>(mask.ring);
    const bool warren_dyadic = std::has_single_bit(n % 3 == 0 ? n / 3 : n);  // 3/(8n) is a fraction over 2^k
    return (weights == Weights::Loop ? n == 6 : warren_dyadic) ? 0 : kLoopWeightUlps;
}

}  // namespace loopcheck::core
