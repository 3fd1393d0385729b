#include "core/loop/lattice/kernels.h"

#include <atomic>
#include <cmath>

#include "core/loop/lattice/sums.h"

// Where the compiler can make a function for instructions that the build does not rely on.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX2__)
#define LOOPCHECK_PICKS_AVX2
#endif

namespace loopcheck::core {
namespace {

#ifdef LOOPCHECK_PICKS_AVX2

std::atomic<bool> avx2_is_allowed = true;

bool has_avx2() {
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has && avx2_is_allowed.load(std::memory_order_relaxed);
}

template <auto kKernel, class... Arguments>
[[gnu::target("avx2")]] auto run_with_avx2(Arguments... arguments) {
    return kKernel(arguments...);
}

#else

constexpr bool has_avx2() {
    return false;
}

template <auto kKernel, class... Arguments>
auto run_with_avx2(Arguments... arguments) {
    return kKernel(arguments...);
}

#endif

// Kernels are inlined into what is made for one set of instructions.
template <auto kKernel, class... Arguments>
auto run(Arguments... arguments) {
    return has_avx2() ? run_with_avx2<kKernel>(arguments...) : kKernel(arguments...);
}

// The edge point of a and b, between *up opposite in an upright face and *down in an inverted one.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> inner_edge_point(const Quad<Real>& a, const Quad<Real>& b,
                                                          bool upright, const PaddedPoint<Real>* up,
                                                          const PaddedPoint<Real>* down) {
    return smooth_edge_point<Real>(a, b, upright ? *up : *down, upright ? *down : *up);
}

// Row 2j of the next level without its ends: edge points and vertex points in turn.
template <int kStride, class Real>
[[gnu::always_inline]] inline void even_row(const QuadLattice<Real>& lattice, Index j,
                                            const std::uint8_t* pattern, Real* out) {
    const PaddedPoint<Real>* row = lattice.row(j);
    const std::ptrdiff_t pitch = lattice.pitch();
    const Index length = lattice.segments() - j;
    Quad<Real> a = row[0];
    for (Index i = 0; i < length; ++i, ++row, ++pattern, out += 2 * kStride) {
        if (i > 0) {
            const std::ptrdiff_t* ring = lattice.ring(*pattern & LatticePattern::kRing);
            const auto neighbour = [&](int k) __attribute__((always_inline))->const PaddedPoint<Real>& {
                return row[ring[k]];
            };
            store_quad<Real>(regular_vertex_point<Real>(a, neighbour), out - kStride);
        }
        const Quad<Real> b = row[1];
        const bool upright = (*pattern & LatticePattern::kAlong) != 0;
        store_quad<Real>(inner_edge_point<Real>(a, b, upright, row + pitch, row + 1 - pitch), out);
        a = b;
    }
}

// Row 2j + 1: the edge points across the faces between rows j and j + 1 and those up from row j, in turn.
template <int kStride, class Real>
[[gnu::always_inline]] inline void odd_row(const QuadLattice<Real>& lattice, Index j,
                                           const std::uint8_t* pattern, Real* out) {
    const PaddedPoint<Real>* row = lattice.row(j);
    const std::ptrdiff_t pitch = lattice.pitch();
    const Index length = lattice.segments() - j;
    Quad<Real> above = row[pitch];
    for (Index i = 0; i + 1 < length; ++i, ++row, ++pattern, out += 2 * kStride) {
        const Quad<Real> next = row[1], next_above = row[1 + pitch];
        const bool across = (pattern[0] & LatticePattern::kAcross) != 0;
        const bool up = (pattern[1] & LatticePattern::kUp) != 0;
        store_quad<Real>(inner_edge_point<Real>(next, above, across, row, row + 1 + pitch), out);
        store_quad<Real>(inner_edge_point<Real>(next, next_above, up, row + 2, row + pitch), out + kStride);
        above = next_above;
    }
}

template <class Real>
[[gnu::always_inline]] inline void vertex_kernel(const PaddedPoint<Real>* centre,
                                                 const PaddedPoint<Real>* ring, std::size_t valence,
                                                 Real side, Real middle, PaddedPoint<Real>* point) {
    Quad<Real> sum{};
    for (std::size_t i = 0; i < valence; ++i) sum += side * Quad<Real>(ring[i]);
    sum += middle * Quad<Real>(*centre);
    *point = sum;
}

// The first face of an edge is to its left as seen from its end 0.
template <class Real>
[[gnu::always_inline]] inline void ring_kernel(const PaddedPoint<Real>* centre, const PaddedPoint<Real>* ring,
                                               const int* ends, std::size_t valence,
                                               PaddedPoint<Real>* next) {
    for (std::size_t i = 1; i <= valence; ++i) {
        const bool outward = ends[i - 1] == 0;
        next[i] = smooth_edge_point<Real>(*centre, ring[i], outward ? ring[i + 1] : ring[i - 1],
                                          outward ? ring[i - 1] : ring[i + 1]);
    }
}

template <class Real>
[[gnu::always_inline]] inline void edge_kernel(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* left,
                                               const PaddedPoint<Real>* right, Index n,
                                               PaddedPoint<Real>* next) {
    for (Index i = 0; i < n; ++i) {
        if (i > 0) {
            const std::array<const PaddedPoint<Real>*, 6> ring{edge + i + 1, left + i,      left + i - 1,
                                                               edge + i - 1, right + i - 1, right + i};
            const auto neighbour = [&](int k) __attribute__((always_inline))->const PaddedPoint<Real>& {
                return *ring[k];
            };
            next[2 * i] = regular_vertex_point<Real>(edge[i], neighbour);
        }
        next[2 * i + 1] = smooth_edge_point<Real>(edge[i], edge[i + 1], left[i], right[i]);
    }
}

// Segments from the edge to the row are the first of a line, so the upright face, which stands on the edge,
// comes first.
template <class Real>
[[gnu::always_inline]] inline void row_kernel(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* row,
                                              Index n, PaddedPoint<Real>* next) {
    for (Index m = 1; m < n; ++m) {
        next[2 * m - 1] = smooth_edge_point<Real>(edge[m], row[m - 1], edge[m - 1], row[m]);
        next[2 * m] = smooth_edge_point<Real>(edge[m], row[m], edge[m + 1], row[m - 1]);
    }
}

template <class Real>
[[gnu::always_inline]] inline void inside_kernel(const QuadLattice<Real>* lattice,
                                                 const LatticePattern* pattern, QuadLattice<Real>* next) {
    for (Index j = 0; j < lattice->segments(); ++j) {
        const auto inside = [&](Index row) __attribute__((always_inline)) {
            return reinterpret_cast<Real*>(next->row(row) + 1);
        };
        if (j > 0) even_row<kPadded, Real>(*lattice, j, pattern->row(j), inside(2 * j));
        odd_row<kPadded, Real>(*lattice, j, pattern->row(j), inside(2 * j + 1));
    }
}

template <class Real>
[[gnu::always_inline]] inline Real* rows_kernel(const QuadLattice<Real>* lattice,
                                                const LatticePattern* pattern, Index first, Index last,
                                                Real* packed) {
    for (Index j = first; j < last; ++j) {
        const std::ptrdiff_t length = lattice->segments() - j;
        if (j > 0) {
            even_row<kPacked, Real>(*lattice, j, pattern->row(j), packed);
            packed += kPacked * (2 * length - 1);
        }
        odd_row<kPacked, Real>(*lattice, j, pattern->row(j), packed);
        packed += kPacked * 2 * (length - 1);
    }
    return packed;
}

// a x b times the inverse of its length, or 0 where that is 0.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> unit_normal(const Quad<Real>& a, const Quad<Real>& b) {
    const Quad<Real> n =
        __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
        __builtin_shufflevector(b, b, 1, 2, 0, 3) * __builtin_shufflevector(a, a, 2, 0, 1, 3);
    const Quad<Real> squares = n * n;
    const Real length = std::sqrt(squares[0] + squares[1] + squares[2]);
    return n * (length > 0 ? 1 / length : Real(0));
}

template <class Real>
[[gnu::always_inline]] inline void ring_limit_kernel(const PaddedPoint<Real>* ring,
                                                     const LimitWeights<Real>* weights,
                                                     PaddedPoint<Real>* position, PaddedPoint<Real>* normal) {
    const auto sum_over = [&](const std::vector<Real>& w) __attribute__((always_inline)) {
        Quad<Real> sum{};
        for (std::size_t k = 0; k < w.size(); ++k) sum += w[k] * Quad<Real>(ring[k]);
        return sum;
    };
    *position = sum_over(weights->position);
    *normal = unit_normal<Real>(sum_over(weights->tangent1), sum_over(weights->tangent2));
}

template <class Real>
[[gnu::always_inline]] inline void limit_kernel(const QuadLattice<Real>* lattice,
                                                const LatticePattern* pattern, Index j,
                                                const RegularLimit<Real>* weights, Real* positions,
                                                Real* normals) {
    const PaddedPoint<Real>* row = lattice->row(j) + 1;
    const std::uint8_t* starts = pattern->row(j) + 1;
    const auto [side, centre, sine] = *weights;
    constexpr Real half = Real(1) / 2;
    for (Index i = 1; i + j < lattice->segments(); ++i, ++row, positions += kPacked, normals += kPacked) {
        const std::ptrdiff_t* ring = lattice->ring(*starts++ & LatticePattern::kRing);
        const Quad<Real> p0 = row[ring[0]], p1 = row[ring[1]], p2 = row[ring[2]], p3 = row[ring[3]],
                         p4 = row[ring[4]], p5 = row[ring[5]], vertex = row[0];
        const Quad<Real> zero{};
        store_quad<Real>(
            zero + side * p0 + side * p1 + side * p2 + side * p3 + side * p4 + side * p5 + centre * vertex,
            positions);
        // Terms of weight 0 would not change a sum that begins with +0.
        const Quad<Real> tangent1 = zero + p0 + half * p1 - half * p2 - p3 - half * p4 + half * p5;
        const Quad<Real> tangent2 = zero + sine * p1 + sine * p2 - sine * p4 - sine * p5;
        store_quad<Real>(unit_normal<Real>(tangent1, tangent2), normals);
    }
}

// The last row is not followed by one that would mend the real after it.
template <int kStride, class Real>
[[gnu::always_inline]] inline void gather_kernel(const GatherList<Real>* list,
                                                 const PaddedPoint<Real>* points, Index first, Index last,
                                                 Real* out) {
    const std::uint32_t* offsets = list->offsets.data();
    for (Index row = first; row < last; ++row, out += kStride) {
        const Index* columns = list->columns.data() + offsets[row];
        const Real* weights = list->weights.data() + list->first_weight[row];
        const std::uint32_t count = offsets[row + 1] - offsets[row];
        Quad<Real> sum{};
        if (count == 4)
            for (std::uint32_t k = 0; k < 4; ++k) sum += weights[k] * Quad<Real>(points[columns[k]]);
        else
            for (std::uint32_t k = 0; k < count; ++k) sum += weights[k] * Quad<Real>(points[columns[k]]);
        if (kStride > kPacked || row + 1 < last)
            store_quad<Real>(sum, out);
        else
            store_packed<Real>(sum, out);
    }
}

}  // namespace

template <class Real>
PaddedPoint<Real> smooth_vertex_point(const PaddedPoint<Real>& centre,
                                      std::span<const PaddedPoint<Real>> ring,
                                      const typename SmoothWeights<Real>::Pair& weights) {
    PaddedPoint<Real> point;
    run<vertex_kernel<Real>>(&centre, ring.data(), ring.size(), weights.side, weights.centre, &point);
    return point;
}

template <class Real>
void refine_smooth_ring(const PaddedPoint<Real>& centre, const PaddedPoint<Real>* ring,
                        std::span<const int> ends, PaddedPoint<Real>* next) {
    run<ring_kernel<Real>>(&centre, ring, ends.data(), ends.size(), next);
}

template <class Real>
void refine_smooth_edge(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* left,
                        const PaddedPoint<Real>* right, Index n, PaddedPoint<Real>* next) {
    run<edge_kernel<Real>>(edge, left, right, n, next);
}

template <class Real>
void refine_row_beside(const PaddedPoint<Real>* edge, const PaddedPoint<Real>* row, Index n,
                       PaddedPoint<Real>* next) {
    run<row_kernel<Real>>(edge, row, n, next);
}

template <class Real>
void refine_inside(const QuadLattice<Real>& lattice, const LatticePattern& pattern, QuadLattice<Real>& next) {
    run<inside_kernel<Real>>(&lattice, &pattern, &next);
}

template <class Real>
Real* refine_rows(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index first, Index last,
                  Real* packed) {
    return run<rows_kernel<Real>>(&lattice, &pattern, first, last, packed);
}

template <class Real>
void limits_of_row(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index j,
                   const RegularLimit<Real>& weights, Real* positions, Real* normals) {
    run<limit_kernel<Real>>(&lattice, &pattern, j, &weights, positions, normals);
}

template <class Real>
void limit_of_ring(const PaddedPoint<Real>* ring, const LimitWeights<Real>& weights,
                   PaddedPoint<Real>& position, PaddedPoint<Real>& normal) {
    run<ring_limit_kernel<Real>>(ring, &weights, &position, &normal);
}

template <class Real>
void gather(const GatherList<Real>& list, const PaddedPoint<Real>* points, Index first, Index last,
            PaddedPoint<Real>* out) {
    run<gather_kernel<kPadded, Real>>(&list, points, first, last, reinterpret_cast<Real*>(out));
}

template <class Real>
void gather(const GatherList<Real>& list, const PaddedPoint<Real>* points, Index first, Index last,
            Real* out) {
    run<gather_kernel<kPacked, Real>>(&list, points, first, last, out);
}

std::string_view lattice_instructions() {
    return has_avx2() ? "AVX2" : "those of the build";
}

#ifdef LOOPCHECK_PICKS_AVX2
void allow_avx2(bool allowed) {
    avx2_is_allowed = allowed;
}
#else
void allow_avx2(bool) {}
#endif

#define LOOPCHECK_INSTANCES(Real)                                                                           \
    template PaddedPoint<Real> smooth_vertex_point<Real>(                                                   \
        const PaddedPoint<Real>&, std::span<const PaddedPoint<Real>>, const SmoothWeights<Real>::Pair&);    \
    template void refine_smooth_ring<Real>(const PaddedPoint<Real>&, const PaddedPoint<Real>*,              \
                                           std::span<const int>, PaddedPoint<Real>*);                       \
    template void refine_smooth_edge<Real>(const PaddedPoint<Real>*, const PaddedPoint<Real>*,              \
                                           const PaddedPoint<Real>*, Index, PaddedPoint<Real>*);            \
    template void refine_row_beside<Real>(const PaddedPoint<Real>*, const PaddedPoint<Real>*, Index,        \
                                          PaddedPoint<Real>*);                                              \
    template void refine_inside<Real>(const QuadLattice<Real>&, const LatticePattern&, QuadLattice<Real>&); \
    template Real* refine_rows<Real>(const QuadLattice<Real>&, const LatticePattern&, Index, Index, Real*); \
    template void limits_of_row<Real>(const QuadLattice<Real>&, const LatticePattern&, Index,               \
                                      const RegularLimit<Real>&, Real*, Real*);                             \
    template void gather<Real>(const GatherList<Real>&, const PaddedPoint<Real>*, Index, Index,             \
                               PaddedPoint<Real>*);                                                         \
    template void gather<Real>(const GatherList<Real>&, const PaddedPoint<Real>*, Index, Index, Real*);     \
    template void limit_of_ring<Real>(const PaddedPoint<Real>*, const LimitWeights<Real>&,                  \
                                      PaddedPoint<Real>&, PaddedPoint<Real>&);
LOOPCHECK_INSTANCES(float)
LOOPCHECK_INSTANCES(double)
#undef LOOPCHECK_INSTANCES

}  // namespace loopcheck::core
