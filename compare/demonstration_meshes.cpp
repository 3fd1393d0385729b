#include "compare/demonstration_meshes.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <utility>

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

MeshData flat_hexagon(int radius) {
    std::map<std::pair<int, int>, Index> number;
    MeshData data;
    const auto add = [&](int i, int j) {
        number[{i, j}] = static_cast<Index>(data.positions.size());
        data.positions.emplace_back(i + j / 2.0, j * std::sqrt(0.75), 0);
    };
    add(0, 0);
    for (int i = -radius; i <= radius; ++i)
        if (i != 0) add(i, 0);
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; j != 0 && i <= radius; ++i)
            if (std::abs(i + j) <= radius) add(i, j);
    for (const auto& [place, v] : number) {
        const auto at = [&, i = place.first, j = place.second](int di, int dj) {
            const auto found = number.find({i + di, j + dj});
            return found == number.end() ? core::kNone : found->second;
        };
        const Index right = at(1, 0), up = at(0, 1), down_right = at(1, -1);
        if (right != core::kNone && up != core::kNone) add_triangle(data, v, right, up);
        if (right != core::kNone && down_right != core::kNone) add_triangle(data, v, down_right, right);
    }
    return data;
}

Index on_line(int radius, int step) {
    if (step == 0) return 0;
    return step + radius + (step < 0 ? 1 : 0);
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
