#include "core/loop/lattice/refiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "core/loop/lattice/kernels.h"
#include "core/loop/lattice/parallel.h"
#include "core/loop/lattice/skeleton.h"
#include "core/loop/lattice/stream.h"

namespace loopcheck::core {
namespace {

// Work on fewer vertices of level L is not worth another thread.
constexpr std::int64_t kVerticesPerTask = 1024;
// Larger results are written past the caches, in blocks that stay in the nearest of them.
constexpr std::size_t kCacheBytes = std::size_t{1} << 21;
constexpr std::size_t kBlockBytes = std::size_t{1} << 14;

Index grain(std::int64_t vertices_each) {
    return static_cast<Index>(kVerticesPerTask /
                              std::clamp<std::int64_t>(vertices_each, 1, kVerticesPerTask));
}

// Gathers values that belong one after the other in a result, and takes them there block by block.
template <class T>
class Outbox {
  public:
    // At most so many values are written at `end()` at once.
    Outbox(std::size_t result_size, std::size_t most)
        : is_large_(result_size * sizeof(T) > kCacheBytes),
          values_(std::make_unique_for_overwrite<T[]>(kBlockBytes / sizeof(T) + most)) {}
    ~Outbox() {
        if (is_large_) end_stream();
    }
    Outbox(const Outbox&) = delete;
    Outbox& operator=(const Outbox&) = delete;

    void begin(T* to) {
        to_ = to;
        end_ = values_.get();
    }
    T* end() { return end_; }
    void advance(T* end) {
        end_ = end;
        if (static_cast<std::size_t>(end_ - values_.get()) >= kBlockBytes / sizeof(T)) flush();
    }
    void flush() {
        const auto count = static_cast<std::size_t>(end_ - values_.get());
        if (is_large_)
            stream_bytes(values_.get(), count * sizeof(T), to_);
        else
            std::copy_n(values_.get(), count, to_);
        begin(to_ + count);
    }

  private:
    bool is_large_;
    std::unique_ptr<T[]> values_;
    T* end_ = nullptr;
    T* to_ = nullptr;
};

void keep_once(std::vector<Index>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::size_t closed_size(Index segments) {
    return (static_cast<std::size_t>(segments) + 1) * (static_cast<std::size_t>(segments) + 2) / 2;
}

// The lattices of a face at levels 0 to `levels`.
template <class Real>
class Patch {
  public:
    Patch(const Topology& topology, const LatticePattern& pattern, int levels)
        : topology_(topology), pattern_(pattern) {
        for (int l = 0; l <= levels; ++l) lattices_.emplace_back(Index{1} << l);
    }

    void run(std::span<const Point<Real>> control, Index f, const EdgePoints<Real>& points) {
        const Triangle& corners = topology_.triangles[f];
        lattices_[0].row(0)[0] = load_point<Real>(control, corners[0]);
        lattices_[0].row(0)[1] = load_point<Real>(control, corners[1]);
        lattices_[0].row(1)[0] = load_point<Real>(control, corners[2]);
        for (std::size_t l = 1; l < lattices_.size(); ++l) {
            take_edges(f, static_cast<int>(l), points);
            if (l > 1) refine_inside<Real>(lattices_[l - 1], pattern_, lattices_[l]);
        }
    }

    const QuadLattice<Real>& last() const { return lattices_.back(); }

  private:
    void take_edges(Index f, int level, const EdgePoints<Real>& points) {
        QuadLattice<Real>& lattice = lattices_[static_cast<std::size_t>(level)];
        const Index n = lattice.segments();
        const std::ptrdiff_t pitch = lattice.pitch();
        const std::array<std::ptrdiff_t, 3> first{0, n, n * pitch}, step{1, pitch - 1, -pitch};
        for (int c = 0; c < 3; ++c) {
            const Index e = topology_.face_edges[f][c];
            const bool along = topology_.edge_faces[e][0] == f;
            const Real* from = points.at(e, level, along ? 0 : n);
            PaddedPoint<Real>* to = lattice.row(0) + first[c];
            for (Index k = 0; k < n; ++k, from += along ? kPacked : -kPacked, to += step[c])
                *to = load_quad<Real>(from);
        }
    }

    const Topology& topology_;
    const LatticePattern& pattern_;
    std::vector<QuadLattice<Real>> lattices_;
};

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

LatticeRefiner::LatticeRefiner(const TriangleMesh& mesh, const SchemeOptions& options, int level)
    : mesh_(&mesh),
      options_(options),
      order_(mesh.topology(), level),
      sharpness_(mesh, options, level),
      smooth_({mesh.topology(), options.weights}, {mesh.topology(), options.weights}),
      pattern_(Index{1} << std::max(0, level - 1)) {}

Result<LatticeRefiner> LatticeRefiner::make(const TriangleMesh& mesh, const SchemeOptions& options,
                                            int level) {
    constexpr std::int64_t kMost = std::numeric_limits<Index>::max();
    constexpr int kMostLevels = 15;  // one face has more corners than can be numbered at the next
    if (level <= kMostLevels) {
        const LatticeOrder order(mesh.topology(), level);
        if (order.vertex_count() <= kMost && 3 * order.face_count() <= kMost)
            return LatticeRefiner(mesh, options, level);
    }
    return fail(ErrorCode::TooLarge,
                fmt::format("Level {} has more vertices or corners of faces than 2^31 - 1.", level));
}

template <class Real>
void LatticeRefiner::refine(std::span<const Point<Real>> control, std::span<Point<Real>> refined,
                            int threads) const {
    const Topology& t = topology();
    const int level = order_.level();
    if (level == 0) {
        std::copy(control.begin(), control.end(), refined.begin());
        return;
    }
    const LatticeSource<Real> from{t, options_, sharpness_, std::get<SmoothWeights<Real>>(smooth_), control};
    const Index n = order_.segments();
    EdgePoints<Real> points(level - 1);
    points.hold_all(t.edge_count());

    for_ranges(t.vertex_count, grain(1), threads, [&](Index first, Index last) {
        Fan<Real> fan(from);
        for (Index v = first; v < last; ++v) {
            fan.run(v, level, points);
            refined[static_cast<std::size_t>(v)] = fan.centre();
        }
    });
    for_ranges(t.edge_count(), grain(n), threads, [&](Index first, Index last) {
        Strip<Real> strip(from);
        for (Index e = first; e < last; ++e) {
            strip.run(e, level, points);
            auto out = refined.begin() + order_.first_of_edge(e);
            for (const PaddedPoint<Real>& q : strip.edge().subspan(1, static_cast<std::size_t>(n) - 1))
                *out++ = q;
        }
    });
    if (order_.inside_of_face() == 0) return;
    for_ranges(t.face_count(), grain(order_.inside_of_face()), threads, [&](Index first, Index last) {
        Patch<Real> patch(t, pattern_, level - 1);
        const auto rows_at_once =
            std::max<Index>(1, static_cast<Index>(kBlockBytes / sizeof(Point<Real>)) / (2 * n));
        Outbox<Real> out(
            kPacked * refined.size(),
            kPacked * 2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(rows_at_once) + 1);
        for (Index f = first; f < last; ++f) {
            patch.run(control, f, points);
            out.begin(&refined[static_cast<std::size_t>(order_.first_of_face(f))].x);
            for (Index j = 0; j < n / 2; j += rows_at_once)
                out.advance(refine_rows<Real>(patch.last(), pattern_, j, std::min(n / 2, j + rows_at_once),
                                              out.end()));
            out.flush();
        }
    });
}

template <class Real>
void LatticeRefiner::refine_by_face(std::span<const Point<Real>> control, FaceRange faces,
                                    const FaceVisitor<Real>& visit) const {
    const Topology& t = topology();
    const int level = order_.level();
    const Index n = order_.segments();
    const LatticeSource<Real> from{t, options_, sharpness_, std::get<SmoothWeights<Real>>(smooth_), control};
    EdgePoints<Real> points(level);
    Fan<Real> fan(from);
    Strip<Real> strip(from);
    Patch<Real> patch(t, pattern_, level);
    Points<Real> packed(closed_size(n));
    std::vector<Index> corners, edges, around;
    const Index block = grain(std::int64_t{n} * n);
    for (Index begin = faces.first; begin < faces.last; begin += block) {
        const Index end = std::min(faces.last, begin + block);
        corners.clear(), edges.clear(), around.clear();
        for (Index f = begin; f < end; ++f) {
            corners.insert(corners.end(), t.triangles[f].begin(), t.triangles[f].end());
            edges.insert(edges.end(), t.face_edges[f].begin(), t.face_edges[f].end());
        }
        keep_once(corners);
        keep_once(edges);
        for (const Index v : corners) around.insert(around.end(), t.ring(v).begin(), t.ring(v).end());
        keep_once(around);
        points.hold(around, t.edge_count());
        for (const Index v : corners) fan.run(v, level, points);
        for (const Index e : edges) strip.run(e, level, points);
        for (Index f = begin; f < end; ++f) {
            patch.run(control, f, points);
            auto out = packed.begin();
            for (Index j = 0; j <= n; ++j)
                for (Index i = 0; i + j <= n; ++i) *out++ = patch.last().row(j)[i];
            visit(f, packed);
        }
    }
}

void LatticeRefiner::triangles(std::span<Triangle> faces, int threads) const {
    const Index n = order_.segments();
    const std::int64_t per_face = std::int64_t{n} * n;
    for_ranges(topology().face_count(), grain(per_face / 2), threads, [&](Index first, Index last) {
        Outbox<Triangle> out(faces.size(), 2 * static_cast<std::size_t>(n));
        for (Index f = first; f < last; ++f) {
            out.begin(&faces[static_cast<std::size_t>(f * per_face)]);
            FaceNumbers numbers(topology(), order_, f);
            for (RowNumbers row = numbers.first_row(); row.length > 0;) {
                const RowNumbers above = numbers.next_row(row);
                out.advance(triangles_between(row, above, out.end()));
                row = above;
            }
            out.flush();
        }
    });
}

#define LOOPCHECK_INSTANCES(Real)                                                                         \
    template void LatticeRefiner::refine<Real>(std::span<const Point<Real>>, std::span<Point<Real>>, int) \
        const;                                                                                            \
    template void LatticeRefiner::refine_by_face<Real>(std::span<const Point<Real>>, FaceRange,           \
                                                       const FaceVisitor<Real>&) const;
LOOPCHECK_INSTANCES(float)
LOOPCHECK_INSTANCES(double)
#undef LOOPCHECK_INSTANCES

}  // namespace loopcheck::core
