// What OpenSubdiv interpolates.
#pragma once

namespace loopcheck::reference::internal {

/// The interface PrimvarRefinerReal asks of a value.
template <class Real>
struct Value {
    Real x, y, z;

    void Clear() { x = y = z = 0; }
    void AddWithWeight(const Value& other, Real weight) {
        x += weight * other.x;
        y += weight * other.y;
        z += weight * other.z;
    }
};

}  // namespace loopcheck::reference::internal
