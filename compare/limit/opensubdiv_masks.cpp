#include "compare/limit/opensubdiv_masks.h"

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using core::Star;
using Masks = core::LimitMasks<HighPrecision>;

std::vector<HighPrecision> no_weights(const Star& star) {
    return std::vector<HighPrecision>(star.ring + std::size_t{1}, HighPrecision(0));
}

// A smooth vertex with as many edges.
Masks smooth(const Star& star) {
    return core::limit_masks<HighPrecision>({star.ring, false, false, {}}, core::Weights::Loop);
}

std::vector<HighPrecision> across_crease(const Star& star, int first, int faces) {
    const HighPrecision theta = acos(HighPrecision(-1)) / faces;
    const HighPrecision inside = 2 * (1 - cos(theta));
    auto out = no_weights(star);
    for (int i = 1; i < faces; ++i) out[first + i] = inside * sin(i * theta);
    out[first] = out[first + faces] = -sin(theta);
    return out;
}

Masks crease(const Star& star) {
    const core::Sector sector{star.sharp[0], star.sharp[1] - star.sharp[0]};
    Masks out = core::limit_masks<HighPrecision>(star, core::Weights::Loop);
    auto& masks = out.sectors.front();
    if (sector.faces < 4) return out;
    masks.no_normal = core::NoNormal::None;
    masks.tangent1 = no_weights(star);
    masks.tangent1[sector.first] = 1;
    masks.tangent1[sector.first + sector.faces] = -1;
    masks.tangent2 = across_crease(star, sector.first, sector.faces);
    return out;
}

Masks corner(const Star& star) {
    Masks out{no_weights(star), {}};
    out.position[star.ring] = 1;
    if (star.ring < 2) return out;
    auto& masks = out.sectors.emplace_back();
    masks.sector = {0, 1};
    masks.tangent1 = masks.tangent2 = no_weights(star);
    masks.tangent1[0] = masks.tangent2[1] = 1;
    masks.tangent1[star.ring] = masks.tangent2[star.ring] = -1;
    return out;
}

}  // namespace

Masks opensubdiv_limit_masks(const Star& star) {
    switch (star.rule()) {
        case core::VertexRule::Smooth:
        case core::VertexRule::Dart:
            return smooth(star);
        case core::VertexRule::Crease:
            return crease(star);
        case core::VertexRule::Corner:
            break;
    }
    return corner(star);
}

}  // namespace loopcheck::compare
