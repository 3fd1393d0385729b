// Shapes are made at a plain place first; `off_centre` then shears, moves and roughens them.
#include "models/generate/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace loopcheck::models {
namespace {

constexpr double kPi = std::numbers::pi;

/// Largest displacement of a coordinate; the edges of the plain shapes are about 1 long.
constexpr double kRoughness = 0.08;

/// A number in [-1, 1], the same on every machine.
double signed_unit(std::minstd_rand& random) {
    return 2.0 * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 1.0;
}

/// Rounds, too: what a library function made of the last bits ends here.
Mesh off_centre(Mesh mesh) {
    std::minstd_rand random(2027);
    for (Point& point : mesh.points) {
        const auto [x, y, z] = point;
        point = {0.95 * x + 0.13 * y - 0.07 * z + 0.71, -0.11 * x + 1.05 * y + 0.17 * z - 0.43,
                 0.06 * x - 0.15 * y + 0.9 * z + 1.13};
        for (double& coordinate : point) {
            coordinate = rounded(coordinate + kRoughness * signed_unit(random), kDecimals);
        }
    }
    return mesh;
}

Point on_circle(double radius, double angle, double z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Height of an open surface above (x, y): a saddle, so that nothing is planar.
double saddle(double x, double y) {
    return 0.15 * x * x - 0.1 * y * y + 0.08 * x * y;
}

/// Two faces for a quad, split from its first to its third corner. The corners come as a braced list, which
/// is evaluated in order even where a corner is a new vertex.
void add_quad(Mesh& mesh, const std::array<int, 4>& corners) {
    const auto [a, b, c, d] = corners;
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
}

Mesh plain_icosahedron() {
    Mesh mesh = {{{0, 0, 1.7}}, {}};
    for (int i = 0; i < 5; ++i) mesh.points.push_back(on_circle(1.52, 2 * kPi * i / 5, 0.76));
    for (int i = 0; i < 5; ++i) mesh.points.push_back(on_circle(1.52, 2 * kPi * (i + 0.5) / 5, -0.76));
    mesh.points.push_back({0, 0, -1.7});
    for (int i = 0; i < 5; ++i) {
        const int next = (i + 1) % 5;
        mesh.faces.push_back({0, 1 + i, 1 + next});
        mesh.faces.push_back({1 + i, 6 + i, 1 + next});
        mesh.faces.push_back({1 + next, 6 + i, 6 + next});
        mesh.faces.push_back({6 + next, 6 + i, 11});
    }
    return mesh;
}

/// Each face split in four, the new vertices pushed out to `radius`.
Mesh split(const Mesh& parent, double radius) {
    Mesh mesh = {parent.points, {}};
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int a, int b) {
        const auto [entry, is_new] =
            middle.try_emplace(std::minmax(a, b), static_cast<int>(mesh.points.size()));
        if (is_new) {
            Point sum = parent.points[static_cast<std::size_t>(a)];
            for (std::size_t i = 0; i < 3; ++i) sum[i] += parent.points[static_cast<std::size_t>(b)][i];
            const double length = std::hypot(sum[0], sum[1], sum[2]);
            for (double& coordinate : sum) coordinate *= radius / length;
            mesh.points.push_back(sum);
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : parent.faces) {
        const int ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
        mesh.faces.insert(mesh.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return mesh;
}

/// The faces of a sector or a disc: `wedges` triangles at vertex 0, each a triangular lattice.
/// `ring_vertex(j, t)` is place t of ring j.
template <class RingVertex>
void add_wedges(Mesh& mesh, int wedges, int rings, RingVertex ring_vertex) {
    for (int wedge = 0; wedge < wedges; ++wedge) {
        for (int j = 0; j < rings; ++j) {
            const int inner = wedge * j, outer = wedge * (j + 1);
            for (int i = 0; i <= j; ++i) {
                mesh.faces.push_back({ring_vertex(j, inner + i), ring_vertex(j + 1, outer + i),
                                      ring_vertex(j + 1, outer + i + 1)});
                if (i == j) continue;
                mesh.faces.push_back({ring_vertex(j, inner + i), ring_vertex(j + 1, outer + i + 1),
                                      ring_vertex(j, inner + i + 1)});
            }
        }
    }
}

void add_ring(Mesh& mesh, int count, double radius, double angle_step) {
    for (int t = 0; t < count; ++t) {
        Point point = on_circle(radius, angle_step * t, 0);
        point[2] = saddle(point[0], point[1]);
        mesh.points.push_back(point);
    }
}

}  // namespace

Mesh tetrahedron() {
    return off_centre(
        {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
}

Mesh octahedron() {
    return off_centre(
        {{{1.5, 0, 0}, {0, 1.5, 0}, {0, 0, 1.5}, {-1.5, 0, 0}, {0, -1.5, 0}, {0, 0, -1.5}},
         {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}}});
}

Mesh icosahedron() {
    return off_centre(plain_icosahedron());
}

Mesh bipyramid(int n) {
    // Wide enough to keep the edges of the ring longer than the roughness.
    const double radius = std::max(1.5, n / 25.0);
    Mesh mesh;
    for (int i = 0; i < n; ++i) mesh.points.push_back(on_circle(radius, 2 * kPi * i / n, 0));
    mesh.points.push_back({0, 0, 1.4});
    mesh.points.push_back({0, 0, -1.1});
    for (int i = 0; i < n; ++i) {
        const int next = (i + 1) % n;
        mesh.faces.push_back({i, next, n});
        mesh.faces.push_back({next, i, n + 1});
    }
    return off_centre(std::move(mesh));
}

Mesh pillow() {
    return off_centre({{{1.3, 0, 0.2}, {-0.4, 1.1, 0}, {-0.7, -0.9, 0.4}}, {{0, 1, 2}, {0, 2, 1}}});
}

int globe_vertex(int columns, int ring, int column) {
    return 1 + ring * columns + column % columns;
}

Mesh globe(int columns, int rings) {
    constexpr double kRadius = 2;
    Mesh mesh = {{{0, 0, kRadius}}, {}};
    for (int ring = 0; ring < rings; ++ring) {
        const double polar = kPi * (ring + 1) / (rings + 1);
        for (int column = 0; column < columns; ++column) {
            mesh.points.push_back(
                on_circle(kRadius * std::sin(polar), 2 * kPi * column / columns, kRadius * std::cos(polar)));
        }
    }
    const int last = static_cast<int>(mesh.points.size());
    mesh.points.push_back({0, 0, -kRadius});
    const auto at = [&](int ring, int column) { return globe_vertex(columns, ring, column); };
    for (int column = 0; column < columns; ++column) {
        mesh.faces.push_back({0, at(0, column), at(0, column + 1)});
        for (int ring = 0; ring + 1 < rings; ++ring) {
            add_quad(mesh, {at(ring, column), at(ring + 1, column), at(ring + 1, column + 1),
                            at(ring, column + 1)});
        }
        mesh.faces.push_back({last, at(rings - 1, column + 1), at(rings - 1, column)});
    }
    return off_centre(std::move(mesh));
}

Mesh split_icosahedron() {
    return off_centre(split(plain_icosahedron(), 1.7));
}

Mesh torus(int columns, int rows) {
    Mesh mesh;
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            const double angle = 2 * kPi * row / rows;
            mesh.points.push_back(
                on_circle(2 + 0.8 * std::cos(angle), 2 * kPi * column / columns, 0.8 * std::sin(angle)));
        }
    }
    const auto at = [&](int column, int row) { return column % columns * rows + row % rows; };
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            add_quad(mesh,
                     {at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)});
        }
    }
    return off_centre(std::move(mesh));
}

Mesh slab_with_tunnels(int tunnels) {
    const int length = 2 * tunnels + 1;
    const auto solid = [&](int x, int y) {
        const bool is_inside = x >= 0 && x < length && y >= 0 && y < 3;
        const bool is_tunnel = y == 1 && x % 2 == 1;
        return is_inside && !is_tunnel;
    };
    Mesh mesh;
    std::map<std::array<int, 3>, int> vertices;
    const auto at = [&](int x, int y, int z) {
        const auto [entry, is_new] = vertices.try_emplace({x, y, z}, static_cast<int>(mesh.points.size()));
        if (is_new) mesh.points.push_back({double(x), double(y), double(z)});
        return entry->second;
    };
    const auto add_wall = [&](int x0, int y0, int x1, int y1) {
        add_quad(mesh, {at(x0, y0, 0), at(x1, y1, 0), at(x1, y1, 1), at(x0, y0, 1)});
    };
    for (int x = 0; x < length; ++x) {
        for (int y = 0; y < 3; ++y) {
            if (!solid(x, y)) continue;
            add_quad(mesh, {at(x, y, 1), at(x + 1, y, 1), at(x + 1, y + 1, 1), at(x, y + 1, 1)});
            add_quad(mesh, {at(x, y, 0), at(x, y + 1, 0), at(x + 1, y + 1, 0), at(x + 1, y, 0)});
            if (!solid(x, y - 1)) add_wall(x, y, x + 1, y);
            if (!solid(x + 1, y)) add_wall(x + 1, y, x + 1, y + 1);
            if (!solid(x, y + 1)) add_wall(x + 1, y + 1, x, y + 1);
            if (!solid(x - 1, y)) add_wall(x, y + 1, x, y);
        }
    }
    return off_centre(std::move(mesh));
}

int grid_vertex(int columns, int row, int column) {
    return row * (columns + 1) + column;
}

Mesh grid(int columns, int rows) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const double x = column - 0.5 * columns, y = row - 0.5 * rows;
            mesh.points.push_back({x, y, saddle(x, y)});
        }
    }
    const auto at = [&](int row, int column) { return grid_vertex(columns, row, column); };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            add_quad(mesh,
                     {at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)});
        }
    }
    return off_centre(std::move(mesh));
}

Mesh square(Diagonal diagonal) {
    Mesh mesh = {{{-1, -1, 0.3}, {1, -1, -0.2}, {1, 1, 0.5}, {-1, 1, -0.4}}, {}};
    if (diagonal == Diagonal::From0To2) {
        add_quad(mesh, {0, 1, 2, 3});
    } else {
        add_quad(mesh, {1, 2, 3, 0});
    }
    return off_centre(std::move(mesh));
}

Mesh sector(int k, int rings) {
    const double angle = std::min(kPi / 3 * k, 1.7 * kPi);
    Mesh mesh = {{{0, 0, 0}}, {}};
    for (int j = 1; j <= rings; ++j) add_ring(mesh, k * j + 1, j, angle / (k * j));
    // Ring j starts after vertex 0 and the rings 1 .. j-1.
    const auto ring_vertex = [&](int j, int t) { return j == 0 ? 0 : k * j * (j - 1) / 2 + j + t; };
    add_wedges(mesh, k, rings, ring_vertex);
    return off_centre(std::move(mesh));
}

Mesh disc(int n, int rings) {
    Mesh mesh = {{{0, 0, 0}}, {}};
    for (int j = 1; j <= rings; ++j) add_ring(mesh, n * j, j, 2 * kPi / (n * j));
    const auto ring_vertex = [&](int j, int t) { return j == 0 ? 0 : 1 + n * j * (j - 1) / 2 + t % (n * j); };
    add_wedges(mesh, n, rings, ring_vertex);
    return off_centre(std::move(mesh));
}

Mesh annulus(int n) {
    Mesh mesh;
    add_ring(mesh, n, 1, 2 * kPi / n);
    add_ring(mesh, n, 2, 2 * kPi / n);
    for (int i = 0; i < n; ++i) add_quad(mesh, {i, n + i, n + (i + 1) % n, (i + 1) % n});
    return off_centre(std::move(mesh));
}

}  // namespace loopcheck::models
