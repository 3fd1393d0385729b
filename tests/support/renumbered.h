// The same mesh in another order.
#pragma once

#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "core/mesh/mesh_data.h"

namespace loopcheck::tests {

/// The same surface with its vertices renumbered, its faces in another order and each of them turned.
struct Renumbered {
    core::MeshData data;
    std::vector<core::Index> vertex;  // new number of each vertex
    std::vector<core::Index> face;    // new number of each face
    std::vector<int> turn;            // corner i of a face is corner i + turn of its new face
};

inline std::vector<core::Index> shuffled(std::size_t count, std::mt19937& random) {
    std::vector<core::Index> out(count);
    std::iota(out.begin(), out.end(), 0);
    for (std::size_t i = count; i > 1; --i) std::swap(out[i - 1], out[random() % i]);
    return out;
}

inline Renumbered renumbered(const core::MeshData& data, std::mt19937& random) {
    Renumbered out{
        data, shuffled(data.positions.size(), random), shuffled(data.face_sizes.size(), random), {}};
    for (std::size_t v = 0; v < out.vertex.size(); ++v) out.data.positions[out.vertex[v]] = data.positions[v];
    for (std::size_t f = 0; f < out.face.size(); ++f) {
        out.turn.push_back(static_cast<int>(random() % 3));
        for (int i = 0; i < 3; ++i)
            out.data.face_corners[3 * out.face[f] + (i + out.turn[f]) % 3] =
                out.vertex[data.face_corners[3 * f + i]];
    }
    for (auto& crease : out.data.creases)
        crease = {out.vertex[crease.a], out.vertex[crease.b], crease.sharpness};
    for (auto& corner : out.data.corners) corner.vertex = out.vertex[corner.vertex];
    for (auto& hole : out.data.holes) hole = out.face[hole];
    return out;
}

}  // namespace loopcheck::tests
