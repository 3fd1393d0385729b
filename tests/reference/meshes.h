// Small meshes for the adapters, made without a file.
#pragma once

#include <cmath>
#include <cstdlib>

#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference::test {

inline core::TriangleMesh make(core::MeshData data) {
    auto mesh = core::TriangleMesh::make(std::move(data));
    if (!mesh) std::abort();
    return std::move(*mesh);
}

/// n faces around vertex 0: closed (an interior vertex of valence n) or open (a boundary vertex of n faces).
inline core::MeshData fan(int n, bool closed) {
    core::MeshData data;
    data.positions.emplace_back(0.1, 0.2, 1);
    const int rim = closed ? n : n + 1;
    for (int i = 0; i < rim; ++i)
        data.positions.emplace_back(std::cos(6.0 * i / rim), std::sin(6.0 * i / rim), 0.01 * i);
    for (core::Index i = 0; i < n; ++i)
        data.add_face(std::array<core::Index, 3>{0, 1 + i, 1 + (i + 1) % rim});
    return data;
}

}  // namespace loopcheck::reference::test
