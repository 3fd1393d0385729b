// The split of some edges of a level: the topology and order of the mesh that comes of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/loop/adaptive/pattern.h"
#include "core/mesh/refinement.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// Where an edge of the finer mesh comes from.
struct EdgeOrigin {
    enum class Kind : std::uint8_t {
        Kept,    ///< an edge that was not split
        Half,    ///< the half of a split edge towards its end `part`
        Cut,     ///< cuts corner `part` off a face, as in `split`
        Inside,  ///< joins a corner of a face with a midpoint
    };
    Kind kind = Kind::Kept;
    Index parent = 0;  ///< the edge, or the face
    int part = 0;
};

/// Where a face of the finer mesh comes from.
struct FaceOrigin {
    Index parent = 0;
    int child = kNone;  ///< its number among the children of `split`, where it is one of them
};

/// A mesh with some edges split.
struct PartialSplit {
    /// c0 to c3: faces of the parent with 0 to 3 edges that are not split.
    std::array<std::size_t, 4> faces_with_unsplit{};
    Topology topology;
    std::vector<Ancestor> ancestors;
    std::vector<Index> split_edges;  ///< ascending; the point of the i-th is vertex V + i
    std::vector<EdgeOrigin> edges;
    std::vector<FaceOrigin> faces;
};

/// An edge is split where all its faces are subdividable, so both its faces agree: 1 or 0 an edge.
std::vector<std::uint8_t> edges_to_split(const Topology& topology,
                                         const std::vector<std::uint8_t>& is_subdividable);

/// Replaces every face by its `split_pattern`.  In the order of `split`, with what is not there left out:
/// vertices, then the points of the split edges; faces by parent; the edges inside faces, then by parent edge
/// its two halves or itself.  Rings start at what became of the edge that the parent's ring starts with; the
/// ring of a new point at the half along which the lower-numbered face of the edge runs.
///
/// Errors  before anything is allocated: TooLarge; OutOfMemory where there would be more than `most_faces`.
///
/// Laws    1. there are 4 c0 + 3 c1 + 2 c2 + c3 faces;
///         2. where all edges are split it is `split`, also in every order;
///         3. any two faces that are both children of `split` keep their order, so what only depends on such
///         faces is summed in the order of uniform refinement.
Result<PartialSplit> split_where(const Topology& parent, const std::vector<std::uint8_t>& is_split,
                                 double most_faces = std::numeric_limits<double>::infinity());

}  // namespace loopcheck::core
