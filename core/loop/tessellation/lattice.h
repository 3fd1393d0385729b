// Points of the levels of a face as integers, and what they are called from every face that has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/mesh/topology.h"

namespace loopcheck::core {

/// A vertex of some level in a control face, its parameters in units of 1/kLatticeUnit.
struct LatticePoint {
    std::int64_t u = 0, v = 0;
};

/// Every vertex of the levels up to kMostLevels + 2 is whole.
inline constexpr int kMostLevels = 30;
inline constexpr std::int64_t kLatticeUnit = std::int64_t{1} << (kMostLevels + 2);

/// The corners of a control face.
inline constexpr std::array<LatticePoint, 3> kFaceCorners{{{0, 0}, {kLatticeUnit, 0}, {0, kLatticeUnit}}};

/// The point midway.  Requires a level below kMostLevels + 2.
constexpr LatticePoint midpoint(const LatticePoint& a, const LatticePoint& b) {
    return {(a.u + b.u) / 2, (a.v + b.v) / 2};
}

/// The same for every face that has the point: a control vertex, a place on a control edge counted from its
/// first end, or a place in a face.  No neighbour is searched for, and edges with the same ends differ.
struct VertexKey {
    enum class Kind : std::uint8_t { Vertex, Edge, Face };
    Kind kind = Kind::Vertex;
    Index id = 0;
    std::int64_t s = 0, t = 0;

    bool operator==(const VertexKey&) const = default;
};

VertexKey key_of(const Topology& control, Index face, const LatticePoint& point);

struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const;
};

}  // namespace loopcheck::core
