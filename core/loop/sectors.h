// The sectors of a vertex: what the sharp edges around it leave together.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/loop/sharpness.h"
#include "core/mesh/refinement.h"
#include "core/mesh/topology.h"

namespace loopcheck::core {

/// The faces between two neighbouring sharp edges around a vertex, counter-clockwise; all of them where there
/// are fewer than two such edges.  In a sector of k faces the edges e_0, ..., e_k are the ring positions
/// first, first + 1, ... (cyclic); e_k is e_0 again where the sector goes all around.
struct Sector {
    int first = 0;
    int faces = 0;

    bool operator==(const Sector&) const = default;
};

/// The edges around a vertex at which nothing is semi-sharp: all that its limit depends on.
struct Star {
    int ring = 0;            ///< number of edges
    bool open = false;       ///< on the boundary
    bool pinned = false;     ///< infinitely sharp itself
    std::vector<int> sharp;  ///< ring positions of the infinitely sharp edges, ascending

    auto operator<=>(const Star&) const = default;

    /// Smooth, dart, crease or corner, as in refinement.
    VertexRule rule() const;
    /// In the order of their first edges.  None around an isolated vertex.
    std::vector<Sector> sectors() const;
};

/// The star of v.  A finite sharpness counts as infinite: that is the star of the rule v refines by, which is
/// that of its limit only where !has_finite_sharpness(topology, sharpness, v).
Star star_of(const Topology& topology, const Sharpness& sharpness, Index v);

/// Why a sector of a vertex has no limit normal.
enum class NoNormal : std::uint8_t {
    None,          ///< it has one
    Isolated,      ///< the vertex is in no face
    ValenceTwo,    ///< two faces glued on all edges at it: the second tangent needs more than the ring
    Cone,          ///< an infinitely sharp vertex without two sharp edges: the tip of a cone
    SlowCrease,    ///< a crease sector of 6 faces: the normal converges only logarithmically
    FoldedCrease,  ///< a crease sector of 7 or more faces: normals of the faces tend to different limits
    SlowCorner,    ///< a corner sector of 3 faces: the normal converges only logarithmically
    FoldedCorner,  ///< a corner sector of 4 or more faces: normals of the faces tend to different limits
};

/// The reason as a stable name: "valence-two", "folded-crease".
std::string_view name(NoNormal reason);

/// The reason as a sentence; empty for `None`.
std::string sentence(NoNormal reason);

/// Whether the limit surface has a tangent plane at a vertex, within one sector.
///
/// Crease sector of k faces: the eigenvalues 3/8 + cos(pi j/k)/4 of j = 1, 2 and the 1/2 of the crease itself
/// compete; from k = 7 on those of j = 1 and 2 win, and both their eigenvectors vanish on the two sharp
/// edges. Corner sector: 1/2 twice, against j = 1 from k = 4 on.  Equal eigenvalues (k = 6, k = 3) make a
/// Jordan block.
NoNormal no_normal(const Star& star, const Sector& sector);

}  // namespace loopcheck::core
