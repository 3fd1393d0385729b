// Which triangles of a triangulation share a vertex.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/ids.h"

namespace loopcheck::core {

/// The triangles at each vertex.  Unlike `Topology` it is made of any triangles.
class Fans {
  public:
    Fans(std::size_t vertices, std::span<const Triangle> triangles);

    /// The triangles at v, ascending.
    std::span<const Index> at(Index v) const {
        return {members_.data() + offsets_[v], offsets_[v + std::size_t{1}] - offsets_[v]};
    }
    /// The triangles that share a vertex with triangle t, itself among them, ascending.
    std::vector<Index> star(Index t) const;
    /// Whether the triangles at v surround it: each neighbour is in two of them.
    bool is_closed(Index v) const;

  private:
    std::span<const Triangle> triangles_;
    std::vector<std::size_t> offsets_;
    std::vector<Index> members_;
};

}  // namespace loopcheck::core
