// A point in one register: the passes over the lattice move x, y and z together.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "core/mesh/ids.h"
#include "core/mesh/point.h"

namespace loopcheck::core {

template <class Real>
struct QuadOf;
template <>
struct QuadOf<float> {
    using Type [[gnu::vector_size(16)]] = float;
};
template <>
struct QuadOf<double> {
    using Type [[gnu::vector_size(32)]] = double;
};

/// Three coordinates, and one that means nothing, in a register.  Whatever has one as a result, or as an
/// argument by value, must be inlined where kernels use it: with AVX and without, it is passed in different
/// ways.
template <class Real>
using Quad = typename QuadOf<Real>::Type;

/// From a point in memory to the next, in reals.
inline constexpr int kPacked = 3, kPadded = 4;

/// Four reals from `at`: a packed point and the real that follows it.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> load_quad(const Real* at) {
    Quad<Real> q;
    std::memcpy(&q, at, sizeof q);
    return q;
}

/// Four reals to `at`: the real after a packed point is overwritten.
template <class Real>
[[gnu::always_inline]] inline void store_quad(const Quad<Real>& q, Real* at) {
    std::memcpy(at, &q, sizeof q);
}

/// Three reals to `at`.
template <class Real>
[[gnu::always_inline]] inline void store_packed(const Quad<Real>& q, Real* at) {
    std::memcpy(at, &q, kPacked * sizeof(Real));
}

/// A quad in memory.  Nothing is taken for granted of its alignment, which GCC 12 gets wrong for objects on
/// the stack in files that are not compiled for AVX.
template <class Real>
class PaddedPoint {
  public:
    PaddedPoint() = default;
    [[gnu::always_inline]] PaddedPoint(const Quad<Real>& q) { *this = q; }
    [[gnu::always_inline]] PaddedPoint& operator=(const Quad<Real>& q) {
        store_quad<Real>(q, reals_.data());
        return *this;
    }
    [[gnu::always_inline]] operator Quad<Real>() const { return load_quad<Real>(reals_.data()); }

    operator Point<Real>() const { return {reals_[0], reals_[1], reals_[2]}; }

  private:
    std::array<Real, 4> reals_;
};

/// Padded points, aligned to cache lines and not initialized.
template <class Real>
class PaddedPoints {
  public:
    PaddedPoints() = default;
    explicit PaddedPoints(std::size_t size) { resize(size); }

    /// What was there is lost.
    void resize(std::size_t size) {
        if (size > room_) {
            points_.reset(
                static_cast<PaddedPoint<Real>*>(::operator new(size * sizeof(PaddedPoint<Real>), kLine)));
            room_ = size;
        }
        size_ = size;
    }
    std::size_t size() const { return size_; }
    PaddedPoint<Real>* data() { return points_.get(); }
    const PaddedPoint<Real>* data() const { return points_.get(); }
    PaddedPoint<Real>& operator[](std::size_t i) { return points_[i]; }
    const PaddedPoint<Real>& operator[](std::size_t i) const { return points_[i]; }

  private:
    static constexpr std::align_val_t kLine{64};
    struct Free {
        void operator()(PaddedPoint<Real>* points) const { ::operator delete(points, kLine); }
    };

    std::size_t size_ = 0, room_ = 0;
    std::unique_ptr<PaddedPoint<Real>[], Free> points_;
};

/// Point i of `points`.
template <class Real>
[[gnu::always_inline]] inline Quad<Real> load_point(std::span<const Point<Real>> points, Index i) {
    const Point<Real>* p = points.data() + i;
    if (p != &points.back()) return load_quad<Real>(&p->x);
    return Quad<Real>{p->x, p->y, p->z, Real(0)};
}

}  // namespace loopcheck::core
