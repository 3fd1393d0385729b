// Which rule a vertex follows, and the class it is counted under.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/loop/sharpness.h"
#include "core/mesh/refinement.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The rule of a vertex from its own sharpness and the number of sharp edges around it.
///
/// Own sharpness, or more than two sharp edges: Corner.  Two: Crease.  One: Dart.  None: Smooth.
/// Source  [DeRose98], section 3.
VertexRule rule_of(float vertex_sharpness, int sharp_edges);

/// The rule of every vertex of a level.
std::vector<VertexRule> vertex_rules(const Topology& topology, const Sharpness& sharpness);

/// What a vertex is, for statistics: errors of one class have one cause.
struct VertexClass {
    enum class Kind : std::uint8_t {
        Interior,   ///< smooth; `valence` tells regular (6) from extraordinary
        Boundary,   ///< on the boundary, crease rule
        Crease,     ///< inside, two infinitely sharp edges
        Dart,       ///< inside, one infinitely sharp edge
        Corner,     ///< kept: infinitely sharp itself, or more than two infinitely sharp edges
        SemiSharp,  ///< a finite sharpness has a say in it: it carries one, or what it comes from did
        Isolated,   ///< in no face
    };
    Kind kind = Kind::Interior;
    int valence = 6;  ///< number of faces around an interior vertex; 0 for every other class

    auto operator<=>(const VertexClass&) const = default;
};

/// "interior 6", "boundary", "semi-sharp".
std::string to_string(VertexClass c);

/// True where v or an edge at it has a finite sharpness.
bool has_finite_sharpness(const Topology& topology, const Sharpness& sharpness, Index v);

/// The class of every vertex of a level.  `from_finite` has 1 for the vertices that come from a vertex or an
/// edge with a finite sharpness at it; it is empty at level 0.
std::vector<VertexClass> classify(const Topology& topology, const Sharpness& sharpness,
                                  const std::vector<std::uint8_t>& from_finite);

}  // namespace loopcheck::core
