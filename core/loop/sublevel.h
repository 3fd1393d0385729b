// A part of a level that refines like the whole.
#pragma once

#include <span>
#include <vector>

#include "core/loop/refine.h"

namespace loopcheck::core {

/// Some faces of a level, with vertices, edges and faces numbered anew.
///
/// The kept vertices have all their faces here, and so their whole rings in the same order: their own rows,
/// those of the edges at them and the sharpness of both are those of the whole level.  All other vertices
/// have an empty ring and are pinned, and edges with only one of their two faces here are infinitely sharp:
/// what is computed for them, or for edges between such vertices, is meaningless.
struct SubLevel {
    SchemeLevel level;
    std::vector<Index> vertices;  ///< per vertex of `level`, its number in the whole; ascending
    std::vector<Index> faces;     ///< per face of `level`, its number in the whole; ascending
    std::vector<Index> kept;      ///< the kept vertices, as numbers of `level`, in the order asked for
};

/// The faces around the given vertices.
SubLevel sublevel_around(const Topology& topology, const Sharpness& sharpness, std::span<const Index> kept);

/// The given vertices, then those at the other ends of their edges, each once.
std::vector<Index> with_neighbours(const Topology& topology, std::span<const Index> vertices);

/// What must be kept so that the masks of the given vertices, and of the edges at them, are right for ever:
/// under Chaikin's rule an edge decays by its neighbours at both ends.
std::vector<Index> vertices_to_keep(const Topology& topology, std::span<const Index> vertices,
                                    Creasing creasing);

}  // namespace loopcheck::core
