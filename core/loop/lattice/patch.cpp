#include "core/loop/lattice/patch.h"

#include "core/loop/lattice/sums.h"

// Where the compiler can make a function for instructions that the build does not rely on.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX2__)
#define LOOPCHECK_PICKS_AVX2
#endif

namespace loopcheck::core {
namespace {

// The edge point of a and b, between *up opposite in an upright face and *down in an inverted one.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> inner_edge_point(const Quad<Real>& a, const Quad<Real>& b,
                                                          bool upright, const Quad<Real>* up,
                                                          const Quad<Real>* down) {
    return smooth_edge_point<Real>(a, b, upright ? *up : *down, upright ? *down : *up);
}

// Row 2j of the next level without its ends: edge points and vertex points in turn.
template <int kStride, class Real>
[[gnu::always_inline]] inline void even_row(const QuadLattice<Real>& lattice, Index j,
                                            const std::uint8_t* pattern, Real* out) {
    const Quad<Real>* row = lattice.row(j);
    const std::ptrdiff_t pitch = lattice.pitch();
    const Index length = lattice.segments() - j;
    Quad<Real> a = row[0];
    for (Index i = 0; i < length; ++i, ++row, ++pattern, out += 2 * kStride) {
        if (i > 0) {
            const std::ptrdiff_t* ring = lattice.ring(*pattern & LatticePattern::kRing);
            const auto neighbour = [&](int k) __attribute__((always_inline)) {
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
    const Quad<Real>* row = lattice.row(j);
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

// The two kernels, to be made for several instruction sets.
template <class Real>
[[gnu::always_inline]] inline void inside_kernel(const QuadLattice<Real>& lattice,
                                                 const LatticePattern& pattern, QuadLattice<Real>& next) {
    constexpr int kStride = sizeof(Quad<Real>) / sizeof(Real);
    for (Index j = 0; j < lattice.segments(); ++j) {
        if (j > 0)
            even_row<kStride, Real>(lattice, j, pattern.row(j), reinterpret_cast<Real*>(next.row(2 * j) + 1));
        odd_row<kStride, Real>(lattice, j, pattern.row(j), reinterpret_cast<Real*>(next.row(2 * j + 1) + 1));
    }
}

template <class Real>
[[gnu::always_inline]] inline Real* rows_kernel(const QuadLattice<Real>& lattice,
                                                const LatticePattern& pattern, Index first, Index last,
                                                Real* packed) {
    for (Index j = first; j < last; ++j) {
        const std::ptrdiff_t length = lattice.segments() - j;
        if (j > 0) {
            even_row<kPacked, Real>(lattice, j, pattern.row(j), packed);
            packed += kPacked * (2 * length - 1);
        }
        odd_row<kPacked, Real>(lattice, j, pattern.row(j), packed);
        packed += kPacked * 2 * (length - 1);
    }
    return packed;
}

#ifdef LOOPCHECK_PICKS_AVX2

template <class Real>
[[gnu::target("avx2")]] void inside_avx2(const QuadLattice<Real>& lattice, const LatticePattern& pattern,
                                         QuadLattice<Real>& next) {
    inside_kernel<Real>(lattice, pattern, next);
}

template <class Real>
[[gnu::target("avx2")]] Real* rows_avx2(const QuadLattice<Real>& lattice, const LatticePattern& pattern,
                                        Index first, Index last, Real* packed) {
    return rows_kernel<Real>(lattice, pattern, first, last, packed);
}

bool has_avx2() {
    static const bool has = __builtin_cpu_supports("avx2") != 0;
    return has;
}

#endif

}  // namespace

template <class Real>
QuadLattice<Real>::QuadLattice(Index segments)
    : segments_(segments),
      quads_(std::make_unique_for_overwrite<Quad<Real>[]>(static_cast<std::size_t>(pitch()) *
                                                          static_cast<std::size_t>(pitch()))) {
    const std::array<std::ptrdiff_t, 6> around{1, pitch(), pitch() - 1, -1, -pitch(), 1 - pitch()};
    for (std::size_t start = 0; start < 6; ++start)
        for (std::size_t k = 0; k < 6; ++k) rings_[start][k] = around[(start + k) % 6];
}

template <class Real>
void refine_inside(const QuadLattice<Real>& lattice, const LatticePattern& pattern, QuadLattice<Real>& next) {
#ifdef LOOPCHECK_PICKS_AVX2
    if (has_avx2()) return inside_avx2<Real>(lattice, pattern, next);
#endif
    inside_kernel<Real>(lattice, pattern, next);
}

template <class Real>
Real* refine_rows(const QuadLattice<Real>& lattice, const LatticePattern& pattern, Index first, Index last,
                  Real* packed) {
#ifdef LOOPCHECK_PICKS_AVX2
    if (has_avx2()) return rows_avx2<Real>(lattice, pattern, first, last, packed);
#endif
    return rows_kernel<Real>(lattice, pattern, first, last, packed);
}

std::string_view lattice_instructions() {
#ifdef LOOPCHECK_PICKS_AVX2
    if (has_avx2()) return "AVX2";
#endif
    return "those of the build";
}

template class QuadLattice<float>;
template class QuadLattice<double>;
template void refine_inside<float>(const QuadLattice<float>&, const LatticePattern&, QuadLattice<float>&);
template void refine_inside<double>(const QuadLattice<double>&, const LatticePattern&, QuadLattice<double>&);
template float* refine_rows<float>(const QuadLattice<float>&, const LatticePattern&, Index, Index, float*);
template double* refine_rows<double>(const QuadLattice<double>&, const LatticePattern&, Index, Index,
                                     double*);

}  // namespace loopcheck::core
