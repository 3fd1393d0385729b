// Some faces of a mesh with all that their refinement depends on.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// Faces first, first + 1, ..., last - 1 of the control mesh.
struct FaceBlock {
    core::Index first = 0, last = 0;

    core::Index size() const { return last - first; }
    bool has(core::Index f) const { return first <= f && f < last; }
    bool operator==(const FaceBlock&) const = default;
};

/// A block as a mesh of its own, with the faces around it.
///
/// Every vertex of every level on the faces of the block is refined here as in the whole mesh, with the same
/// sums.  For this holds:
///
///   * The faces are all that touch a *kept* vertex: one of the block and, under Chaikin's rule, one at the
///     other end of a semi-sharp edge of those.  So a kept vertex has all of its faces and edges.
///   * Faces, their corners and vertices keep their order; so of the edges of a kept vertex the order, the
///     ends, which face comes first, and where the ring begins are the same.
///   * Sharpness is carried over.
///
/// Why that is enough.  The points of level 1 on a closed face of the block, and those of its neighbours that
/// share a point with it, are vertex points of its corners, which depend on the ring of the corner, and edge
/// points of edges that end at a corner, which depend on the two faces there.  The children of the faces at a
/// corner are again all faces at the points of level 1, so the argument repeats with level 1 for the mesh.
/// Sharpness of an edge decays at each end by itself, by what is sharp around that end.  The mask of a
/// semi-sharp edge point asks for both of its halves, under Chaikin's rule so for the edges around both ends:
/// one end is of the block, the other is kept for this.  What that other end decays to matters no further:
/// the next time the two ends are the corner and the edge point.
///
/// What is not right outside: edges that have lost a face become a boundary, and so infinitely sharp; no such
/// edge ends at a kept vertex.  Where the faces left around another vertex form several fans, each fan gets a
/// copy of it, or the mesh would not be manifold.  So only vertices that are not kept change their rule, and
/// their vertex points are not among those points of level 1.
struct Neighbourhood {
    core::TriangleMesh mesh;
    core::Index first = 0;  ///< the face of `mesh` that is the first of the block; the others follow
};
Neighbourhood neighbourhood_of(const core::TriangleMesh& mesh, core::Creasing creasing, FaceBlock block);

/// Counts, each once, the faces and edges of the neighbourhood of a growing block.
class GrowingBlock {
  public:
    GrowingBlock(const core::TriangleMesh& mesh, core::Creasing creasing);

    /// Begins a block without faces.
    void restart();
    void add(core::Index f);

    core::Index size() const { return size_; }
    std::int64_t faces() const { return faces_; }
    std::int64_t edges() const { return edges_; }

  private:
    const core::TriangleMesh& mesh_;
    core::Creasing creasing_;
    // The number of the block that counted it last.
    std::vector<core::Index> own_, kept_, edge_, face_;
    core::Index block_ = 0, size_ = 0;
    std::int64_t faces_ = 0, edges_ = 0;
};

}  // namespace loopcheck::compare
