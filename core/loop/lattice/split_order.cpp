#include "core/loop/lattice/split_order.h"

#include <algorithm>
#include <array>

#include "core/loop/lattice/sums.h"

namespace loopcheck::core {
namespace {

// How far along its line a segment is, and whether that counts from the end that `split` names first.
Index along(int direction, Index i, Index j) {
    return direction == 0 ? i : j;
}
Index line_of(int direction, Index i, Index j) {
    return direction == 0 ? j : direction == 1 ? i + j + 1 : i;
}

// Whether the first end of an edge is the lower along its line.  A half begins at its middle, which is the
// lower end of the upper half.  The edge inside a face near its corner c begins at the edge point of edge c;
// `upright` is that face.
bool half_begins_low(Index along) {
    return along % 2 == 1;
}
bool cut_begins_low(int direction, bool upright) {
    return (direction == 2) != upright;
}

}  // namespace

SplitOrder::SplitOrder(const Topology& topology, int level) : topology_(topology), level_(level) {
    sizes_.push_back({topology.vertex_count, topology.edge_count(), topology.face_count()});
    for (int l = 0; l < level; ++l) {
        const auto [v, e, f] = sizes_.back();
        sizes_.push_back({v + e, 2 * e + 3 * f, 4 * f});
    }
}

std::int64_t SplitOrder::face_of_level(Index f, int level, LatticeTriangle t) const {
    if (level == 0) return f;
    const bool odd_i = t.i % 2 == 1, odd_j = t.j % 2 == 1;
    // The middle child of a face points the other way.  The others lie at its corners.
    LatticeTriangle parent{t.upright, t.i / 2, t.j / 2};
    int child = 3;
    if (t.upright) {
        parent.upright = !(odd_i && odd_j);
        if (parent.upright) child = odd_i ? 1 : odd_j ? 2 : 0;
    } else {
        parent.upright = !odd_i && !odd_j;
        if (!parent.upright) child = odd_i && odd_j ? 0 : odd_j ? 1 : 2;
    }
    return 4 * face_of_level(f, level - 1, parent) + child;
}

std::int64_t SplitOrder::edge_inside(Index f, int level, Segment s) const {
    const Index at = along(s.direction, s.i, s.j);
    if (line_of(s.direction, s.i, s.j) % 2 == 1) {
        // New in this level: inside a face of the level before, upright and inverted in turn.
        constexpr std::array<int, 3> kNear{2, 0, 1};  // the corner it is near to, by direction
        const bool upright = at % 2 == 0;
        return 3 * face_of_level(f, level - 1, {upright, s.i / 2, s.j / 2}) + kNear[s.direction];
    }
    const Segment parent{s.direction, s.i / 2, s.j / 2};
    const Index parent_at = at / 2;
    const bool parent_is_new = line_of(s.direction, s.i, s.j) / 2 % 2 == 1;
    const bool parent_begins_low =
        parent_is_new ? cut_begins_low(s.direction, parent_at % 2 == 0) : half_begins_low(parent_at);
    const int half = (at % 2 == 0) == parent_begins_low ? 0 : 1;
    return 3 * sizes_[level - 1].faces + 2 * edge_inside(f, level - 1, parent) + half;
}

std::int64_t SplitOrder::edge_of_edge(Index e, int level, Index segment) const {
    if (level == 0) return e;
    const bool begins_low = level == 1 || half_begins_low(segment / 2);
    const int half = (segment % 2 == 0) == begins_low ? 0 : 1;
    return 3 * sizes_[level - 1].faces + 2 * edge_of_edge(e, level - 1, segment / 2) + half;
}

std::int64_t SplitOrder::vertex(const LatticeAddress& a) const {
    if (a.kind == LatticeAddress::Kind::Vertex) return a.index;
    if (a.kind == LatticeAddress::Kind::Edge) {
        const int born = level_ - trailing_zeros(a.i);
        return sizes_[born - 1].vertices + edge_of_edge(a.index, born - 1, (a.i >> (level_ - born)) / 2);
    }
    const int shift = std::min(trailing_zeros(a.i), trailing_zeros(a.j));
    const int born = level_ - shift;
    const Index i = a.i >> shift, j = a.j >> shift;
    const int direction = j % 2 == 0 ? 0 : i % 2 == 1 ? 1 : 2;
    return sizes_[born - 1].vertices + edge_inside(a.index, born - 1, {direction, i / 2, j / 2});
}

}  // namespace loopcheck::core
