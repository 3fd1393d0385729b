// Small meshes for tests, made in one line.
#pragma once

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::tests {

using Positions = std::vector<glm::dvec3>;
using Triangles = std::vector<core::Triangle>;

inline constexpr core::SchemeOptions kEdgeOnly{.boundary = core::BoundaryRule::EdgeOnly};

/// Positions without any symmetry or special value, for tests to which they do not matter.
inline Positions scattered(int count) {
    Positions out;
    for (int i = 0; i < count; ++i)
        out.push_back({std::cos(1.7 * i), std::sin(2.3 * i + 1), std::cos(1.0 * i * i)});
    return out;
}

inline core::MeshData data_of(Positions positions, const Triangles& triangles) {
    core::MeshData data;
    data.positions = std::move(positions);
    for (const auto& t : triangles) data.add_face(t);
    return data;
}

/// The mesh of data that is right.  Throws where it is not, which fails the test.
inline core::TriangleMesh mesh_of(core::MeshData data) {
    auto mesh = core::TriangleMesh::make(std::move(data));
    if (!mesh) throw std::runtime_error(core::to_string(mesh.error()));
    return std::move(*mesh);
}

/// n faces around vertex 0, which is inside; its ring is 1, ..., n.  n = 2 is the pillow.
inline core::MeshData wheel(int n) {
    Triangles faces;
    for (int i = 1; i <= n; ++i) faces.push_back({0, i, i % n + 1});
    return data_of(scattered(n + 1), faces);
}

/// n faces around vertex 0, which is on the boundary; its ring is 1, ..., n + 1.
inline core::MeshData open_fan(int n) {
    Triangles faces;
    for (int i = 1; i <= n; ++i) faces.push_back({0, i, i + 1});
    return data_of(scattered(n + 2), faces);
}

/// A closed mesh: the apexes 0 and 1 have valence n, the others 4.
inline core::MeshData bipyramid(int n) {
    Triangles faces;
    for (int i = 0; i < n; ++i) {
        const core::Index a = 2 + i, b = 2 + (i + 1) % n;
        faces.push_back({0, a, b});
        faces.push_back({1, b, a});
    }
    return data_of(scattered(n + 2), faces);
}

/// The corner of a cube of side 16: refined once, all its coordinates are whole.
inline core::MeshData tetrahedron() {
    return data_of({{0, 0, 0}, {16, 0, 0}, {0, 16, 0}, {0, 0, 16}},
                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// The unit cube as 12 triangles.  Vertices are numbered in binary: bit 0 is x, bit 1 is y, bit 2 is z.
inline core::MeshData cube() {
    Positions positions;
    for (int v = 0; v < 8; ++v) positions.push_back({v & 1, v >> 1 & 1, v >> 2 & 1});
    return data_of(positions, {{0, 2, 3},
                               {0, 3, 1},
                               {4, 5, 7},
                               {4, 7, 6},
                               {0, 1, 5},
                               {0, 5, 4},
                               {2, 6, 7},
                               {2, 7, 3},
                               {0, 4, 6},
                               {0, 6, 2},
                               {1, 3, 7},
                               {1, 7, 5}});
}

/// A square of side 8, split from vertex 0 to vertex 2.
inline core::MeshData square() {
    return data_of({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

/// Half of that square.
inline core::MeshData triangle() {
    return data_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}});
}

}  // namespace loopcheck::tests
