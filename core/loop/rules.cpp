#include "core/loop/rules.h"

#include <fmt/format.h>

#include <algorithm>

namespace loopcheck::core {
namespace {

int sharp_edges_at(const Topology& topology, const Sharpness& sharpness, Index v) {
    const auto ring = topology.ring(v);
    return static_cast<int>(
        std::count_if(ring.begin(), ring.end(), [&](Index e) { return is_sharp(sharpness.edge[e]); }));
}

}  // namespace

bool has_finite_sharpness(const Topology& topology, const Sharpness& sharpness, Index v) {
    const auto ring = topology.ring(v);
    return is_semi_sharp(sharpness.vertex[v]) ||
           std::any_of(ring.begin(), ring.end(), [&](Index e) { return is_semi_sharp(sharpness.edge[e]); });
}

VertexRule rule_of(float vertex_sharpness, int sharp_edges) {
    if (is_sharp(vertex_sharpness) || sharp_edges > 2) return VertexRule::Corner;
    if (sharp_edges == 2) return VertexRule::Crease;
    return sharp_edges == 1 ? VertexRule::Dart : VertexRule::Smooth;
}

std::vector<VertexRule> vertex_rules(const Topology& topology, const Sharpness& sharpness) {
    std::vector<VertexRule> rules(topology.vertex_count);
    for (Index v = 0; v < topology.vertex_count; ++v)
        rules[v] = rule_of(sharpness.vertex[v], sharp_edges_at(topology, sharpness, v));
    return rules;
}

std::string to_string(VertexClass c) {
    switch (c.kind) {
        case VertexClass::Kind::Interior:
            return fmt::format("interior {}", c.valence);
        case VertexClass::Kind::Boundary:
            return "boundary";
        case VertexClass::Kind::Crease:
            return "crease";
        case VertexClass::Kind::Dart:
            return "dart";
        case VertexClass::Kind::Corner:
            return "corner";
        case VertexClass::Kind::SemiSharp:
            return "semi-sharp";
        case VertexClass::Kind::Isolated:
            return "isolated";
    }
    return {};
}

std::vector<VertexClass> classify(const Topology& topology, const Sharpness& sharpness,
                                  const std::vector<std::uint8_t>& from_finite) {
    using Kind = VertexClass::Kind;
    const std::vector<VertexRule> rules = vertex_rules(topology, sharpness);
    std::vector<VertexClass> classes(topology.vertex_count);
    for (Index v = 0; v < topology.vertex_count; ++v) {
        const auto kind = [&] {
            if (topology.is_isolated(v)) return Kind::Isolated;
            if ((!from_finite.empty() && from_finite[v]) || has_finite_sharpness(topology, sharpness, v))
                return Kind::SemiSharp;
            if (rules[v] == VertexRule::Corner) return Kind::Corner;
            if (topology.is_boundary_vertex(v)) return Kind::Boundary;
            if (rules[v] == VertexRule::Crease) return Kind::Crease;
            return rules[v] == VertexRule::Dart ? Kind::Dart : Kind::Interior;
        }();
        classes[v] = {kind, kind == Kind::Interior ? topology.face_count_at(v) : 0};
    }
    return classes;
}

}  // namespace loopcheck::core
