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
        SemiSharp,  ///< a finite sharpness has a say in it: it carries one, or its row was blended by one
        Isolated,   ///< in no face
    };
    Kind kind = Kind::Interior;
    int valence = 6;  ///< number of faces around an interior vertex; 0 for every other class

    auto operator<=>(const VertexClass&) const = default;
};

/// "interior 6", "boundary", "semi-sharp".
std::string to_string(VertexClass c);

/// The class of every vertex of a level.  `blended` has 1 for the vertices whose row mixes two rules by a
/// finite sharpness; it is empty at level 0.
std::vector<VertexClass> classify(const Topology& topology, const Sharpness& sharpness,
                                  const std::vector<std::uint8_t>& blended);

}  // namespace loopcheck::core
