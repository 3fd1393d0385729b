#include "bench/support/meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <utility>

#include "core/loop/refine.h"
#include "core/mesh/io/model.h"

namespace loopcheck::bench {
namespace {

using core::Index;

constexpr int kLeastValence = 3, kMostValence = 14;

// Turns edges at random, as long as no valence leaves its range and no edge is there twice.
void turn_edges(core::MeshData& data, int turns) {
    auto& corners = data.face_corners;
    std::map<std::pair<Index, Index>, Index> side_of;  // from a to b: corner a of a face
    std::vector<int> valence(data.positions.size(), 0);
    const auto next = [](Index corner) { return corner - corner % 3 + (corner + 1) % 3; };
    const auto add = [&](Index face) {
        for (Index c = 3 * face; c < 3 * face + 3; ++c) side_of[{corners[c], corners[next(c)]}] = c;
    };
    const auto remove = [&](Index face) {
        for (Index c = 3 * face; c < 3 * face + 3; ++c) side_of.erase({corners[c], corners[next(c)]});
    };
    for (Index f = 0; f < static_cast<Index>(data.face_sizes.size()); ++f) add(f);
    for (const auto& [ends, corner] : side_of) ++valence[ends.first];
    std::mt19937 random(1);
    for (int turn = 0; turn < turns; ++turn) {
        const auto c = static_cast<Index>(random() % corners.size());
        const Index a = corners[c], b = corners[next(c)], left = corners[next(next(c))];
        const Index other = side_of.at({b, a}), right = corners[next(next(other))];
        if (valence[a] <= kLeastValence || valence[b] <= kLeastValence || valence[left] >= kMostValence ||
            valence[right] >= kMostValence || side_of.contains({left, right}) ||
            side_of.contains({right, left}))
            continue;
        const Index f = c / 3, g = other / 3;
        remove(f);
        remove(g);
        std::copy_n(std::array{a, right, left}.begin(), 3, &corners[3 * f]);
        std::copy_n(std::array{b, left, right}.begin(), 3, &corners[3 * g]);
        add(f);
        add(g);
        --valence[a], --valence[b], ++valence[left], ++valence[right];
    }
}

core::MeshData sphere(int size) {
    auto model = core::read_model(LOOPCHECK_MODELS_DIR "/icosahedron.obj").value();
    const auto mesh = core::TriangleMesh::make(std::move(model.data)).value();
    const auto refined = core::refine<double>(mesh, {}, size).value().levels.back();
    core::MeshData data;
    data.positions = refined.positions;
    for (const core::Triangle& t : refined.triangles) data.add_face(t);
    return data;
}

}  // namespace

const core::TriangleMesh& plain_sphere(int size) {
    static std::map<int, core::TriangleMesh> made;
    const auto found = made.find(size);
    if (found != made.end()) return found->second;
    return made.emplace(size, core::TriangleMesh::make(sphere(size)).value()).first->second;
}

const core::TriangleMesh& varied_sphere(int size) {
    static std::map<int, core::TriangleMesh> made;
    const auto found = made.find(size);
    if (found != made.end()) return found->second;
    core::MeshData data = sphere(size);
    turn_edges(data, 2 * static_cast<int>(data.face_corners.size()));
    return made.emplace(size, core::TriangleMesh::make(std::move(data)).value()).first->second;
}

}  // namespace loopcheck::bench
