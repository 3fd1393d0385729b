#include "core/loop/lattice/split_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/loop/lattice/split_order.h"
#include "core/loop/lattice/sums.h"

namespace loopcheck::core {
namespace {

using Kind = LatticeAddress::Kind;

// Two of i, j and i + j have the same power of two, the third a greater one: s < t < level.
int class_of(int s, int t) {
    return t * (t - 1) / 2 + s;
}
LatticeAddress example_of(int s, int t, Index f) {
    return {Kind::Face, f, Index{1} << t, Index{1} << s};
}

}  // namespace

NumberPattern::NumberPattern(int level) : level_(level) {
    const Topology nothing;  // on which `first` is 0
    const SplitOrder split(nothing, level);
    const Index n = Index{1} << level;
    for (Index i = 1; i < n; ++i) edge_.push_back(static_cast<Index>(split.vertex({Kind::Edge, 0, i, 0})));
    const std::size_t inside =
        static_cast<std::size_t>(n - 1) * static_cast<std::size_t>(std::max(n - 2, 0)) / 2;
    inside_.reserve(inside);
    inside_class_.reserve(inside);
    for (Index j = 1; j < n; ++j)
        for (Index i = 1; i + j < n; ++i) {
            inside_.push_back(static_cast<Index>(split.vertex({Kind::Face, 0, i, j})));
            const auto [s, t] = std::minmax({trailing_zeros(i), trailing_zeros(j), trailing_zeros(i + j)});
            inside_class_.push_back(static_cast<std::uint8_t>(class_of(s, t)));
        }
}

double NumberPattern::bytes(int level) {
    return std::ldexp(5, 2 * level - 1);
}

SplitNumbers::SplitNumbers(const NumberPattern& pattern, const Topology& topology)
    : pattern_(pattern), topology_(topology) {
    const Topology nothing;
    const SplitOrder split(topology, pattern.level_), bare(nothing, pattern.level_);
    for (int t = 0; t < pattern.level_; ++t) {
        const LatticeAddress on_edge{Kind::Edge, 0, Index{1} << t, 0};
        edge_.push_back(
            {split.vertex(on_edge) - bare.vertex(on_edge), std::int64_t{1} << (pattern.level_ - t - 1)});
        for (int s = 0; s < t; ++s) {
            const std::int64_t of_0 = split.vertex(example_of(s, t, 0));
            inside_.push_back(
                {of_0 - bare.vertex(example_of(s, t, 0)), split.vertex(example_of(s, t, 1)) - of_0});
        }
    }
}

void SplitNumbers::of_face(Index f, std::span<Index> numbers) const {
    const Index n = Index{1} << pattern_.level_;
    const auto at = [&](Index i, Index j) -> Index& {
        return numbers[static_cast<std::size_t>(lattice_place(n, i, j))];
    };
    constexpr std::size_t kMostClasses = 15 * 14 / 2;
    std::array<Index, kMostClasses> first;
    for (std::size_t c = 0; c < inside_.size(); ++c) first[c] = inside_[c].at(f);
    std::size_t point = 0;
    for (Index j = 1; j + 1 < n; ++j) {
        Index* row = &at(0, j);
        for (Index i = 1; i + j < n; ++i, ++point)
            row[i] = first[pattern_.inside_class_[point]] + pattern_.inside_[point];
    }
    for (int c = 0; c < 3; ++c) {
        const Index e = topology_.face_edges[f][c];
        const bool along = topology_.edge_faces[e][0] == f;
        for (Index k = 1; k < n; ++k) {
            const auto [i, j] = on_face_edge(n, c, along ? k : n - k);
            at(i, j) = edge_[trailing_zeros(k)].at(e) + pattern_.edge_[k - std::size_t{1}];
        }
    }
    const auto& corners = topology_.triangles[f];
    at(0, 0) = corners[0];
    at(n, 0) = corners[1];
    at(0, n) = corners[2];
}

}  // namespace loopcheck::core
