// Points that must agree to the last bit, and where they do not.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>

#include "core/loop/lattice/address.h"
#include "core/mesh/point.h"

namespace loopcheck::tests {

/// Whether `a` has the bits of `b`, which is in double whatever it was computed in.
template <class Real>
bool same_bits(const core::Point<Real>& a, const glm::dvec3& b) {
    for (int c = 0; c < 3; ++c)
        if (std::bit_cast<std::uint64_t>(static_cast<double>(a[c])) != std::bit_cast<std::uint64_t>(b[c]))
            return false;
    return true;
}

inline std::string name_of(const core::LatticeAddress& address) {
    using Kind = core::LatticeAddress::Kind;
    const char* kind = address.kind == Kind::Vertex ? "vertex" : address.kind == Kind::Edge ? "edge" : "face";
    return fmt::format("{} {} ({}, {})", kind, address.index, address.i, address.j);
}

}  // namespace loopcheck::tests
