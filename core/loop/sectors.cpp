#include "core/loop/sectors.h"

#include "core/loop/rules.h"

namespace loopcheck::core {

VertexRule Star::rule() const {
    return rule_of(pinned ? kInfiniteSharpness : 0, static_cast<int>(sharp.size()));
}

std::vector<Sector> Star::sectors() const {
    if (ring == 0) return {};
    if (sharp.empty()) return {{0, ring}};
    std::vector<Sector> out;
    for (std::size_t i = 0; i + 1 < sharp.size(); ++i) out.push_back({sharp[i], sharp[i + 1] - sharp[i]});
    if (!open) out.push_back({sharp.back(), sharp.front() + ring - sharp.back()});
    return out;
}

Star star_of(const Topology& topology, const Sharpness& sharpness, Index v) {
    const auto ring = topology.ring(v);
    Star star{
        static_cast<int>(ring.size()), topology.is_boundary_vertex(v), is_sharp(sharpness.vertex[v]), {}};
    for (int i = 0; i < star.ring; ++i)
        if (is_sharp(sharpness.edge[ring[i]])) star.sharp.push_back(i);
    return star;
}

std::string_view name(NoNormal reason) {
    switch (reason) {
        case NoNormal::None:
            return "none";
        case NoNormal::Isolated:
            return "isolated";
        case NoNormal::ValenceTwo:
            return "valence-two";
        case NoNormal::Cone:
            return "cone";
        case NoNormal::SlowCrease:
            return "slow-crease";
        case NoNormal::FoldedCrease:
            return "folded-crease";
        case NoNormal::SlowCorner:
            return "slow-corner";
        case NoNormal::FoldedCorner:
            return "folded-corner";
    }
    return {};
}

std::string sentence(NoNormal reason) {
    switch (reason) {
        case NoNormal::None:
            return {};
        case NoNormal::Isolated:
            return "The vertex is in no face.";
        case NoNormal::ValenceTwo:
            return "Of an interior vertex of valence 2 the ring gives one tangent only.";
        case NoNormal::Cone:
            return "The vertex is infinitely sharp and does not have two sharp edges: it is the tip of a "
                   "cone.";
        case NoNormal::SlowCrease:
            return "In a crease sector of 6 faces the normal converges only logarithmically.";
        case NoNormal::FoldedCrease:
            return "In a crease sector of 7 or more faces the normals of the faces tend to different limits.";
        case NoNormal::SlowCorner:
            return "In a corner sector of 3 faces the normal converges only logarithmically.";
        case NoNormal::FoldedCorner:
            return "In a corner sector of 4 or more faces the normals of the faces tend to different limits.";
    }
    return {};
}

NoNormal no_normal(const Star& star, const Sector& sector) {
    switch (star.rule()) {
        case VertexRule::Smooth:
        case VertexRule::Dart:
            return star.ring == 2 ? NoNormal::ValenceTwo : NoNormal::None;
        case VertexRule::Crease:
            if (sector.faces == 6) return NoNormal::SlowCrease;
            return sector.faces > 6 ? NoNormal::FoldedCrease : NoNormal::None;
        case VertexRule::Corner:
            if (star.ring == 0) return NoNormal::Isolated;
            if (star.sharp.size() < 2) return NoNormal::Cone;
            if (sector.faces == 3) return NoNormal::SlowCorner;
            return sector.faces > 3 ? NoNormal::FoldedCorner : NoNormal::None;
    }
    return NoNormal::None;
}

}  // namespace loopcheck::core
