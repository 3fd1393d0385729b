// Meshes that are in no file: random triangulations with random sharpness.
#pragma once

#include <algorithm>
#include <array>
#include <random>

#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::tests {

/// The engine's output is fixed by the standard; the distributions are not, so none is used.
using Random = std::mt19937;

inline double coordinate(Random& random) {
    return static_cast<double>(random()) / 0x1p31 - 1;
}

inline void add_points(core::MeshData& data, int count, Random& random) {
    for (int i = 0; i < count; ++i) {
        const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
        data.positions.emplace_back(x, y, z);
    }
}

inline void add_triangle(core::MeshData& data, core::Index a, core::Index b, core::Index c, Random& random) {
    std::array<core::Index, 3> triangle{a, b, c};
    std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
    data.add_face(triangle);
}

/// With two poles of valence n.
inline core::MeshData bipyramid(int n, Random& random) {
    core::MeshData data;
    add_points(data, n + 2, random);
    for (core::Index i = 0; i < n; ++i) {
        add_triangle(data, i, (i + 1) % n, n, random);
        add_triangle(data, (i + 1) % n, i, n + 1, random);
    }
    return data;
}

/// A closed bipyramid, an open grid with random diagonals, or a torus with random diagonals.
inline core::MeshData random_shape(Random& random) {
    const int kind = static_cast<int>(random() % 3);
    if (kind == 0) return bipyramid(3 + static_cast<int>(random() % 12), random);
    core::MeshData data;
    const bool wraps = kind == 2;
    const int least = wraps ? 3 : 1;
    const int columns = least + static_cast<int>(random() % 4), rows = least + static_cast<int>(random() % 4);
    const int width = wraps ? columns : columns + 1, height = wraps ? rows : rows + 1;
    add_points(data, width * height, random);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const core::Index a = y * width + x, b = y * width + (x + 1) % width;
            const core::Index c = (y + 1) % height * width + x,
                              d = (y + 1) % height * width + (x + 1) % width;
            if (random() % 2 == 0) {
                add_triangle(data, a, b, d, random);
                add_triangle(data, a, d, c, random);
            } else {
                add_triangle(data, a, b, c, random);
                add_triangle(data, b, d, c, random);
            }
        }
    return data;
}

inline void add_sharpness(core::MeshData& data, const core::Topology& topology, Random& random) {
    constexpr std::array<float, 10> kSharpness{0.05F, 0.3F, 0.5F, 1, 1.2F, 1.5F, 2.5F, 3, 7.75F, 10};
    for (const auto& [a, b] : topology.edge_ends)
        if (random() % 3 == 0) data.creases.push_back({a, b, kSharpness[random() % kSharpness.size()]});
    for (core::Index v = 0; v < topology.vertex_count; ++v)
        if (random() % 6 == 0) data.corners.push_back({v, kSharpness[random() % kSharpness.size()]});
}

/// A random shape, with random sharpness where `sharp`.
inline core::TriangleMesh random_mesh(Random& random, bool sharp) {
    core::MeshData data = random_shape(random);
    auto mesh = core::TriangleMesh::make(data).value();
    if (!sharp) return mesh;
    add_sharpness(data, mesh.topology(), random);
    return core::TriangleMesh::make(data).value();
}

inline core::SchemeOptions random_options(Random& random) {
    core::SchemeOptions options;
    options.boundary = static_cast<core::BoundaryRule>(random() % 3);
    options.creasing = static_cast<core::Creasing>(random() % 2);
    return options;
}

}  // namespace loopcheck::tests
