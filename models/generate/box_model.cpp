// Box modelling; see the header.
#include "models/generate/box_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace loopcheck::models {
namespace {

std::size_t index(int i) {
    return static_cast<std::size_t>(i);
}

Point sum(const Point& a, const Point& b, double factor) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point with_length(const Point& a, double length) {
    return sum({0, 0, 0}, a, length / std::hypot(a[0], a[1], a[2]));
}

double squared_distance(const Point& a, const Point& b) {
    const Point d = sum(a, b, -1);
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

Point at(const Section& section, double left, double up) {
    return sum(sum(section.centre, section.left, left), section.up, up);
}

/// The outline of a lofted section in units of its half width and half height, counter-clockwise.
constexpr std::array<std::array<double, 2>, kRingSize> kOutline = {
    {{0.42, 1}, {-0.42, 1}, {-1, 0.42}, {-1, -0.45}, {-0.45, -1}, {0.45, -1}, {1, -0.45}, {1, 0.42}}};

/// The three quads that close a ring, counter-clockwise seen from ahead.
constexpr std::array<Quad, 3> kCap = {{{7, 0, 1, 2}, {7, 2, 3, 6}, {6, 3, 4, 5}}};

/// The corners of the section, starting with the one that twists the tube from `base` least.
std::array<Point, 4> corners(const Section& to, const std::array<Point, 4>& base) {
    std::array<Point, 4> best = {at(to, 1, 1), at(to, -1, 1), at(to, -1, -1), at(to, 1, -1)};
    const auto twist = [&](const std::array<Point, 4>& candidate) {
        double total = 0;
        for (std::size_t i = 0; i < 4; ++i) total += squared_distance(base[i], candidate[i]);
        return total;
    };
    std::array<Point, 4> candidate = best;
    for (int turn = 1; turn < 4; ++turn) {
        std::rotate(candidate.begin(), candidate.begin() + 1, candidate.end());
        if (twist(candidate) < twist(best)) best = candidate;
    }
    return best;
}

}  // namespace

Section section(const Point& centre, const Point& ahead, const Point& top, double half_width,
                double half_height) {
    const Point left = cross(top, ahead);
    return {centre, with_length(left, half_width), with_length(cross(ahead, left), half_height)};
}

QuadMesh loft(std::span<const Section> sections) {
    QuadMesh mesh;
    for (const Section& section : sections) {
        for (const auto& [left, up] : kOutline) mesh.points.push_back(at(section, left, up));
    }
    const int last = static_cast<int>(sections.size()) - 1;
    const auto corner = [](int ring, int i) { return ring * kRingSize + i % kRingSize; };
    for (int ring = 0; ring < last; ++ring) {
        for (int i = 0; i < kRingSize; ++i) {
            mesh.quads.push_back(
                {corner(ring, i), corner(ring, i + 1), corner(ring + 1, i + 1), corner(ring + 1, i)});
        }
    }
    for (const auto& [a, b, c, d] : kCap) mesh.quads.push_back({d, c, b, a});
    for (const auto& [a, b, c, d] : kCap) {
        mesh.quads.push_back({corner(last, a), corner(last, b), corner(last, c), corner(last, d)});
    }
    return mesh;
}

int strip_quad(int segment, Strip strip) {
    return segment * kRingSize + static_cast<int>(strip);
}

std::vector<int> ring_path(int ring) {
    std::vector<int> path;
    for (int i = 0; i <= kRingSize; ++i) path.push_back(ring * kRingSize + i % kRingSize);
    return path;
}

int rear_top_quad(int section_count) {
    return (section_count - 1) * kRingSize;
}

std::vector<Section> sections_along(std::span<const Station> stations, const Point& top) {
    std::vector<Section> sections;
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, stations.size() - 1);
        const Point ahead = sum(stations[after].centre, stations[before].centre, -1);
        const auto& [centre, half_width, half_height] = stations[i];
        sections.push_back(section(centre, ahead, top, half_width, half_height));
    }
    return sections;
}

void extrude(QuadMesh& mesh, int quad, const Section& to) {
    const Quad base = mesh.quads[index(quad)];
    std::array<Point, 4> base_points;
    for (std::size_t i = 0; i < 4; ++i) base_points[i] = mesh.points[index(base[i])];
    Quad tip;
    for (std::size_t i = 0; const Point& corner : corners(to, base_points)) {
        tip[i++] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(corner);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        mesh.quads.push_back({base[i], base[next], tip[next], tip[i]});
    }
    mesh.quads[index(quad)] = tip;
}

void grow(QuadMesh& mesh, int quad, std::span<const Section> sections) {
    for (const Section& section : sections) extrude(mesh, quad, section);
}

Mesh triangulated(const QuadMesh& mesh) {
    Mesh result = {mesh.points, {}};
    for (Point& point : result.points) {
        for (double& coordinate : point) coordinate = rounded(coordinate, kDecimals);
    }
    for (const auto& [a, b, c, d] : mesh.quads) {
        const auto diagonal = [&](int from, int to) {
            return squared_distance(result.points[index(from)], result.points[index(to)]);
        };
        if (diagonal(a, c) <= diagonal(b, d)) {
            result.faces.insert(result.faces.end(), {{a, b, c}, {a, c, d}});
        } else {
            result.faces.insert(result.faces.end(), {{a, b, d}, {b, c, d}});
        }
    }
    return result;
}

}  // namespace loopcheck::models
