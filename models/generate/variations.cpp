// Variations of a mesh; see the header.
#include "models/generate/variations.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

namespace loopcheck::models {
namespace {

std::size_t index(int i) {
    return static_cast<std::size_t>(i);
}

/// The directed edge `from` -> `to` of a face, and the third vertex of that face.
struct HalfEdge {
    std::size_t face;
    int from;
    int to;
    int across;
};

std::optional<HalfEdge> find_half_edge(const Mesh& mesh, int from, int to) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Face& face = mesh.faces[f];
            if (face[i] == from && face[(i + 1) % 3] == to) return HalfEdge{f, from, to, face[(i + 2) % 3]};
        }
    }
    return std::nullopt;
}

int valence(const Mesh& mesh, int vertex) {
    return static_cast<int>(std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const Face& face) {
        return std::find(face.begin(), face.end(), vertex) != face.end();
    }));
}

/// Replaces the edge from-to of the two faces by the edge between the vertices across it.
void flip(Mesh& mesh, const HalfEdge& one, const HalfEdge& other) {
    mesh.faces[one.face] = {one.from, other.across, one.across};
    mesh.faces[other.face] = {one.to, one.across, other.across};
}

}  // namespace

Mesh with_rotated_faces(Mesh mesh, int step) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        Face& face = mesh.faces[f];
        std::rotate(face.begin(), face.begin() + static_cast<int>(f) * step % 3, face.end());
    }
    return mesh;
}

Mesh with_renumbered_vertices(const Mesh& mesh, int stride) {
    const int count = static_cast<int>(mesh.points.size());
    const auto renumber = [&](int& vertex) { vertex = (stride * vertex + 1) % count; };
    Mesh result = mesh;
    for (int v = 0; v < count; ++v) {
        int renumbered = v;
        renumber(renumbered);
        result.points[index(renumbered)] = mesh.points[index(v)];
    }
    for (Face& face : result.faces) std::for_each(face.begin(), face.end(), renumber);
    for (Corner& corner : result.corners) renumber(corner.vertex);
    for (Crease& crease : result.creases) {
        renumber(crease.from);
        renumber(crease.to);
    }
    return result;
}

Mesh with_reversed_face_order(Mesh mesh) {
    std::reverse(mesh.faces.begin(), mesh.faces.end());
    return mesh;
}

Mesh with_isolated_vertex(Mesh mesh, int place) {
    mesh.points.insert(mesh.points.begin() + place, {2.25, -1.75, 3.5});
    for (Face& face : mesh.faces) {
        for (int& vertex : face) vertex += vertex >= place ? 1 : 0;
    }
    return mesh;
}

Mesh side_by_side(Mesh first, const Mesh& second) {
    const int offset = static_cast<int>(first.points.size());
    for (const Point& point : second.points) {
        first.points.push_back({point[0] + 6.5, point[1] - 1.25, point[2] + 0.75});
    }
    for (const auto& [a, b, c] : second.faces) first.faces.push_back({a + offset, b + offset, c + offset});
    return first;
}

Mesh moved(Mesh mesh, double distance) {
    for (Point& point : mesh.points) {
        point = {point[0] + distance, point[1] - distance, point[2] + distance / 2};
    }
    return mesh;
}

Mesh scaled(Mesh mesh, double factor, int decimals) {
    for (Point& point : mesh.points) {
        for (double& coordinate : point) coordinate *= factor;
    }
    mesh.decimals = decimals;
    return mesh;
}

Mesh with_mixed_magnitudes(Mesh mesh) {
    constexpr std::array<double, 3> kFactors = {1e6, 1, 1e-6};
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        for (double& coordinate : mesh.points[v]) coordinate *= kFactors[v % 3];
    }
    // Enough for the small ones, and the large ones still fit the integers that a double holds exactly.
    mesh.decimals = 9;
    return mesh;
}

Mesh with_random_flips(Mesh mesh, int count, int lowest, int highest) {
    std::minstd_rand random(7);
    for (int done = 0; done < count;) {
        const Face face = mesh.faces[random() % mesh.faces.size()];
        const std::size_t corner = random() % 3;
        const HalfEdge one = *find_half_edge(mesh, face[corner], face[(corner + 1) % 3]);
        const HalfEdge other = *find_half_edge(mesh, one.to, one.from);
        const bool fits = valence(mesh, one.from) > lowest && valence(mesh, one.to) > lowest &&
                          valence(mesh, one.across) < highest && valence(mesh, other.across) < highest;
        if (!fits || find_half_edge(mesh, one.across, other.across)) continue;
        flip(mesh, one, other);
        ++done;
    }
    return mesh;
}

}  // namespace loopcheck::models
