#include "core/loop/lattice/address.h"

#include <algorithm>
#include <cmath>

namespace loopcheck::core {
namespace {

// Points in the rows 1 to j - 1 inside a face: row r has N - 1 - r.
std::int64_t before_row(std::int64_t segments, std::int64_t j) {
    return (j - 1) * (segments - 1) - (j - 1) * j / 2;
}

// The last row that begins at or before `at`, by the root of `before` and a step to either side of its
// rounding.
template <class Before>
std::int64_t row_of(std::int64_t at, double estimate, std::int64_t first, Before before) {
    auto row = std::max(first, static_cast<std::int64_t>(estimate));
    while (row > first && before(row) > at) --row;
    while (before(row + 1) <= at) ++row;
    return row;
}

}  // namespace

LatticeOrder::LatticeOrder(const Topology& topology, int level)
    : level_(level),
      segments_(Index{1} << level),
      vertices_(topology.vertex_count),
      edges_(topology.edge_count()),
      faces_(topology.face_count()),
      inside_((segments_ - std::int64_t{1}) * (segments_ - 2) / 2) {}

std::int64_t LatticeOrder::vertex_count() const {
    return vertices_ + edges_ * (segments_ - 1) + faces_ * inside_;
}

std::int64_t LatticeOrder::first_of_face(Index f) const {
    return vertices_ + edges_ * (segments_ - 1) + f * inside_;
}

std::int64_t LatticeOrder::index_of(const LatticeAddress& a) const {
    switch (a.kind) {
        case LatticeAddress::Kind::Vertex:
            return a.index;
        case LatticeAddress::Kind::Edge:
            return first_of_edge(a.index) + a.i - 1;
        default:
            return first_of_face(a.index) + before_row(segments_, a.j) + a.i - 1;
    }
}

LatticeAddress LatticeOrder::address_of(std::int64_t vertex) const {
    using Kind = LatticeAddress::Kind;
    if (vertex < vertices_) return {Kind::Vertex, static_cast<Index>(vertex), 0, 0};
    const std::int64_t on_edges = vertex - vertices_, per_edge = segments_ - 1;
    if (on_edges < edges_ * per_edge)
        return {Kind::Edge, static_cast<Index>(on_edges / per_edge),
                static_cast<Index>(on_edges % per_edge + 1), 0};
    const std::int64_t in_faces = on_edges - edges_ * per_edge, at = in_faces % inside_;
    const double n = segments_ - 1.5;
    const auto row = row_of(at, n + 1 - std::sqrt(std::max(0.0, n * n - 2 * static_cast<double>(at))), 1,
                            [&](std::int64_t j) { return before_row(segments_, j); });
    return {Kind::Face, static_cast<Index>(in_faces / inside_),
            static_cast<Index>(at - before_row(segments_, row) + 1), static_cast<Index>(row)};
}

std::int64_t LatticeOrder::vertex_at(const Topology& topology, Index f, Index i, Index j) const {
    const Index n = segments_, k = n - i - j;
    const Triangle& v = topology.triangles[f];
    if (k == n) return v[0];
    if (i == n) return v[1];
    if (j == n) return v[2];
    // Along edge c of the face, `at` of N from corner c.
    const auto on_edge = [&](int c, Index at) {
        const Index e = topology.face_edges[f][c];
        return first_of_edge(e) + (topology.edge_faces[e][0] == f ? at : n - at) - 1;
    };
    if (j == 0) return on_edge(0, i);
    if (k == 0) return on_edge(1, j);
    if (i == 0) return on_edge(2, k);
    return index_of({LatticeAddress::Kind::Face, f, i, j});
}

LatticeTriangle triangle_at(Index segments, std::int64_t t) {
    // Triangles in the rows before j: N^2 - (N - j)^2.
    const std::int64_t n = segments;
    const auto before = [&](std::int64_t j) { return n * n - (n - j) * (n - j); };
    const auto row = row_of(t, static_cast<double>(n) - std::sqrt(static_cast<double>(n * n - t)), 0, before);
    const std::int64_t at = t - before(row);
    return {at % 2 == 0, static_cast<Index>(at / 2), static_cast<Index>(row)};
}

std::array<std::array<Index, 2>, 3> corners_of(const LatticeTriangle& t) {
    if (t.upright) return {{{t.i, t.j}, {t.i + 1, t.j}, {t.i, t.j + 1}}};
    return {{{t.i + 1, t.j + 1}, {t.i, t.j + 1}, {t.i + 1, t.j}}};
}

}  // namespace loopcheck::core
