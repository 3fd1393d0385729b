#include "compare/demonstration_meshes.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace loopcheck::compare {
namespace {

using core::Index;
using core::MeshData;

glm::dvec3 on_circle(double turn) {
    const double angle = 2 * std::numbers::pi * turn;
    return {std::cos(angle), std::sin(angle), 0};
}

void add_triangle(MeshData& data, Index a, Index b, Index c) {
    const std::array corners{a, b, c};
    data.add_face(corners);
}

}  // namespace

MeshData flat_wheel(int n) {
    MeshData data;
    data.positions.emplace_back(0);
    for (int i = 0; i < n; ++i) data.positions.push_back(on_circle(static_cast<double>(i) / n));
    for (Index i = 1; i <= n; ++i) add_triangle(data, 0, i, i % n + 1);
    return data;
}

MeshData flat_fan(int k) {
    MeshData data;
    data.positions.emplace_back(0);
    for (int i = 0; i <= k; ++i) data.positions.push_back(on_circle(0.5 * i / k));
    for (Index i = 1; i <= k; ++i) add_triangle(data, 0, i, i + 1);
    return data;
}

MeshData flat_disc(int n, int rings) {
    // Ring r has n r vertices: r to a wedge, the first of each on the spoke.
    const auto vertex = [n](int r, int wedge, int k) {
        return r == 0 ? 0 : static_cast<Index>(1 + n * r * (r - 1) / 2 + (wedge * r + k) % (n * r));
    };
    MeshData data;
    data.positions.emplace_back(0);
    for (int r = 1; r <= rings; ++r)
        for (int wedge = 0; wedge < n; ++wedge)
            for (int k = 0; k < r; ++k)
                data.positions.push_back(static_cast<double>(r - k) *
                                             on_circle(static_cast<double>(wedge) / n) +
                                         static_cast<double>(k) * on_circle((wedge + 1.0) / n));
    for (int r = 1; r <= rings; ++r)
        for (int wedge = 0; wedge < n; ++wedge)
            for (int k = 0; k < r; ++k) {
                const Index inner = vertex(r - 1, wedge, k), outer = vertex(r, wedge, k + 1);
                add_triangle(data, inner, vertex(r, wedge, k), outer);
                if (k + 1 < r) add_triangle(data, inner, outer, vertex(r - 1, wedge, k + 1));
            }
    return data;
}

Index on_line(int step) {
    const int r = std::abs(step);
    return r == 0 ? 0 : static_cast<Index>(1 + 3 * r * (r - 1) + (step < 0 ? 3 * r : 0));
}

MeshData flat_octahedron() {
    MeshData data;
    for (int i = 0; i < 3; ++i) data.positions.push_back(0.4 * on_circle(i / 3.0));
    for (int i = 0; i < 3; ++i) data.positions.push_back(1.2 * on_circle((i + 0.5) / 3.0));
    for (Index i = 0; i < 3; ++i) {
        const Index next = (i + 1) % 3;
        add_triangle(data, next, i, 3 + i);         // beside the inner triangle
        add_triangle(data, next, 3 + i, 3 + next);  // at its corner
    }
    add_triangle(data, 0, 1, 2);
    add_triangle(data, 3, 5, 4);
    return data;
}

MeshData flat_pillow() {
    MeshData data;
    for (int i = 0; i < 3; ++i) data.positions.push_back(on_circle(i / 3.0));
    add_triangle(data, 0, 1, 2);
    add_triangle(data, 0, 2, 1);
    return data;
}

}  // namespace loopcheck::compare
