// From the order by address to the order of `split`, which is OpenSubdiv's.
#pragma once

#include <cstdint>
#include <vector>

#include "core/loop/lattice/address.h"

namespace loopcheck::core {

/// The numbers that `split`, applied L times, gives to the vertices and faces of level L.
///
/// A vertex keeps its number when its level is refined; the edge point of edge e of a level with V vertices
/// is V + e.  Edges are numbered so too: of a level with F faces, the three edges inside face g become 3 g to
/// 3 g + 2, the halves of edge e become 3 F + 2 e and 3 F + 2 e + 1.  Followed down to the control mesh, this
/// gives every number in at most L steps, without the levels.
class SplitOrder {
  public:
    /// Refers to the topology.  Requires 0 <= level <= 30 and vertices that 62 bits can count.
    SplitOrder(const Topology& topology, int level);

    std::int64_t vertex(const LatticeAddress& address) const;
    /// Number of segment q of edge e, counted from its end 0.
    std::int64_t edge(Index e, Index q) const { return edge_of_edge(e, level_, q); }
    /// Number of a triangle of control face f.
    std::int64_t face(Index f, const LatticeTriangle& triangle) const {
        return face_of_level(f, level_, triangle);
    }

  private:
    struct LevelSize {
        std::int64_t vertices, edges, faces;
    };
    // A step of the lattice inside a face, named by its direction: along edge 0, 1 or 2 of the upright
    // triangle at (i, j).
    struct Segment {
        int direction;
        Index i, j;
    };

    std::int64_t face_of_level(Index f, int level, LatticeTriangle triangle) const;
    std::int64_t edge_inside(Index f, int level, Segment s) const;
    std::int64_t edge_of_edge(Index e, int level, Index segment) const;

    const Topology& topology_;
    int level_;
    std::vector<LevelSize> sizes_;
};

}  // namespace loopcheck::core
