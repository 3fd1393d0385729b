// A point in one register: the passes over the lattice move x, y and z together.
#pragma once

#include <cstring>

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

/// Three coordinates and one that means nothing.
template <class Real>
using Quad = typename QuadOf<Real>::Type;

/// Reals of a packed point.
inline constexpr int kPacked = 3;

template <class Real>
inline Quad<Real> quad_of(const Point<Real>& p) {
    return Quad<Real>{p.x, p.y, p.z, Real(0)};
}

/// Four reals from `at`: a packed point and the real that follows it.
template <class Real>
inline Quad<Real> load_quad(const Real* at) {
    Quad<Real> q;
    std::memcpy(&q, at, sizeof q);
    return q;
}

/// Four reals to `at`: the real after a packed point is overwritten.
template <class Real>
inline void store_quad(const Quad<Real>& q, Real* at) {
    std::memcpy(at, &q, sizeof q);
}

/// Three reals to `at`.
template <class Real>
inline void store_packed(const Quad<Real>& q, Real* at) {
    std::memcpy(at, &q, kPacked * sizeof(Real));
}

}  // namespace loopcheck::core
