// The faces of level L: each row of a control face is a first number and a pattern that does not change.
#include <array>
#include <cstring>

#include "core/loop/lattice/parallel.h"
#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/stream.h"

namespace loopcheck::core {
namespace {

// The numbers of the vertices of level L along a row of a face: of its ends, and from its second vertex on.
struct RowNumbers {
    Index first, last, second, step = 1;
    Index length;  // the last is number `length`

    Index operator[](Index i) const { return i == 0 ? first : i == length ? last : second + step * (i - 1); }
};

class FaceNumbers {
  public:
    FaceNumbers(const Topology& topology, const LatticeOrder& order, Index f)
        : corners_(topology.triangles[f]),
          segments_(order.segments()),
          inside_(static_cast<Index>(order.first_of_face(f))) {
        for (int c = 0; c < 3; ++c) {
            const Index e = topology.face_edges[f][c];
            const auto first = static_cast<Index>(order.first_of_edge(e));
            if (topology.edge_faces[e][0] == f)
                edges_[c] = {first, 1};
            else
                edges_[c] = {first + segments_ - 2, -1};
        }
    }

    // Of row 0, and of the one after a row.
    RowNumbers first_row() const {
        return {corners_[0], corners_[1], edges_[0].first, edges_[0].step, segments_};
    }
    RowNumbers next_row(const RowNumbers& row) {
        const Index j = segments_ - row.length + 1, length = row.length - 1;
        if (length == 0) return {corners_[2], corners_[2], 0, 1, 0};
        const Index inside = inside_;
        inside_ += length - 1;
        return {edges_[2][segments_ - j], edges_[1][j], inside, 1, length};
    }

  private:
    // The points of an edge as the face runs, from its point 1 on.
    struct EdgeNumbers {
        Index first, step;
        Index operator[](Index k) const { return first + step * (k - 1); }
    };

    Triangle corners_;
    Index segments_;
    Index inside_;  // the next inside the face
    std::array<EdgeNumbers, 3> edges_;
};

// The triangles between two rows.  Returns the end.
Triangle* triangles_between(const RowNumbers& row, const RowNumbers& above, Triangle* out) {
    const auto pair = [&](Index i) {
        *out++ = {row[i], row[i + 1], above[i]};
        *out++ = {above[i + 1], above[i], row[i + 1]};
    };
    const Index pairs = row.length - 1;
    Index i = 0;
    if (pairs > 0) pair(i++);
    // Two pairs in three words, as long as all their vertices are numbered in turn.
    using Word [[gnu::vector_size(16)]] = Index;
    const Index s = row.step, r = row.second, a = above.second;
    std::array<Word, 3> words{Word{r, r + s, a, a + 1}, Word{a, r + s, r + s, r + 2 * s},
                              Word{a + 1, a + 2, a + 1, r + 2 * s}};
    const std::array<Word, 3> step{Word{2 * s, 2 * s, 2, 2}, Word{2, 2 * s, 2 * s, 2 * s},
                                   Word{2, 2, 2, 2 * s}};
    static_assert(sizeof words == 4 * sizeof(Triangle));
    for (; i + 2 < pairs; i += 2, out += 4) {
        std::memcpy(out, &words, sizeof words);
        for (std::size_t w = 0; w < 3; ++w) words[w] += step[w];
    }
    while (i < pairs) pair(i++);
    *out++ = {row[pairs], row.last, above.last};
    return out;
}

}  // namespace

void LatticeRefiner::triangles(std::span<Triangle> faces, int threads) const {
    const Index n = order_.segments();
    const std::int64_t per_face = std::int64_t{n} * n;
    for_ranges(topology().face_count(), grain(per_face / 2), threads, [&](Index first, Index last) {
        Outbox<Triangle> out(faces.size(), 2 * static_cast<std::size_t>(n));
        out.begin(&faces[static_cast<std::size_t>(first * per_face)]);
        for (Index f = first; f < last; ++f) {
            FaceNumbers numbers(topology(), order_, f);
            for (RowNumbers row = numbers.first_row(); row.length > 0;) {
                const RowNumbers above = numbers.next_row(row);
                out.advance(triangles_between(row, above, out.end()));
                row = above;
            }
        }
        out.flush();
    });
}

}  // namespace loopcheck::core
