// Refinement straight to level L (core/loop/lattice) beside OpenSubdiv's Far, in double on one thread.
//
//     build/release/bench/loopcheck_lattice_bench            levels 1 to 6, two minutes
//     build/release/bench/loopcheck_lattice_bench --smoke    one small run; checks the bits, its times mean
//     nothing
//
// The mesh is closed, with 20 480 triangles (5120 at level 6) and valences from 3 to 14. Both sides start
// from a mesh that they have taken over, and end with the positions and the faces of the last level:
//
//     ours         `LatticeRefiner::make`, `refine` into a buffer that is used again, `triangles` likewise
//     opensubdiv   RefineUniform with the least topology in the last level, Interpolate of every level into
//     buffers
//                  that are used again; the faces are those of the last level
//
// The runs of the two alternate on a warm heap.  Read the ratio of the medians: how many times as long
// OpenSubdiv takes here and now.  Before that every position is compared bit for bit.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <map>
#include <random>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_order.h"
#include "core/loop/refine.h"
#include "core/mesh/io/model.h"
#include "reference/opensubdiv/last_level.h"

namespace {

using namespace loopcheck;
using core::Index;
using Peer = reference::OpensubdivLastLevel;

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
        const Index c = static_cast<Index>(random() % corners.size());
        const Index a = corners[c], b = corners[next(c)], left = corners[next(next(c))];
        const Index other = side_of.at({b, a}), right = corners[next(next(other))];
        if (valence[a] <= kLeastValence || valence[b] <= kLeastValence || valence[left] >= kMostValence ||
            valence[right] >= kMostValence || side_of.contains({left, right}) ||
            side_of.contains({right, left}))
            continue;
        const Index f = c / 3, g = other / 3;
        remove(f);
        remove(g);
        std::copy_n(std::array{a, right, left}.begin(), 3, corners.begin() + 3 * f);
        std::copy_n(std::array{b, left, right}.begin(), 3, corners.begin() + 3 * g);
        add(f);
        add(g);
        --valence[a], --valence[b], ++valence[left], ++valence[right];
    }
}

// A sphere of 20 4^levels triangles.
core::TriangleMesh varied_sphere(int levels) {
    auto model = core::read_model(LOOPCHECK_MODELS_DIR "/icosahedron.obj").value();
    const auto mesh = core::TriangleMesh::make(std::move(model.data)).value();
    const auto refined = core::refine<double>(mesh, {}, levels).value().levels.back();
    core::MeshData data;
    data.positions = refined.positions;
    for (const core::Triangle& t : refined.triangles) data.add_face(t);
    turn_edges(data, 2 * static_cast<int>(data.face_corners.size()));
    return core::TriangleMesh::make(std::move(data)).value();
}

class Ours {
  public:
    explicit Ours(const core::TriangleMesh& mesh) : mesh_(mesh) {}

    void refine(int level) {
        const auto refiner = core::LatticeRefiner::make(mesh_, {}, level).value();
        positions_.resize(static_cast<std::size_t>(refiner.order().vertex_count()));
        faces_.resize(static_cast<std::size_t>(refiner.order().face_count()));
        refiner.refine<double>(mesh_.positions(), positions_);
        refiner.triangles(faces_);
    }

    const std::vector<glm::dvec3>& positions() const { return positions_; }

  private:
    const core::TriangleMesh& mesh_;
    std::vector<glm::dvec3> positions_;
    std::vector<core::Triangle> faces_;
};

bool same_bits(const core::TriangleMesh& mesh, int level, const Ours& ours, const Peer& peer) {
    const core::LatticeOrder order(mesh.topology(), level);
    const core::SplitOrder split(mesh.topology(), level);
    const auto theirs = peer.positions();
    if (ours.positions().size() != theirs.size()) return false;
    for (std::size_t v = 0; v < theirs.size(); ++v) {
        const auto number = split.vertex(order.address_of(static_cast<std::int64_t>(v)));
        const glm::dvec3& b = theirs[static_cast<std::size_t>(number)];
        const glm::dvec3& a = ours.positions()[v];
        if (std::bit_cast<std::uint64_t>(a.x) != std::bit_cast<std::uint64_t>(b.x) ||
            std::bit_cast<std::uint64_t>(a.y) != std::bit_cast<std::uint64_t>(b.y) ||
            std::bit_cast<std::uint64_t>(a.z) != std::bit_cast<std::uint64_t>(b.z))
            return false;
    }
    return true;
}

double seconds(auto&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

// False where a bit differs.
bool run(const core::TriangleMesh& mesh, int level, int repetitions) {
    Ours ours(mesh);
    Peer peer = Peer::make(mesh, {}).value();
    ours.refine(level);
    peer.refine(level);
    if (!same_bits(mesh, level, ours, peer)) {
        fmt::print(stderr, "level {}: the positions differ\n", level);
        return false;
    }
    std::vector<double> our_times, peer_times;
    for (int i = 0; i < repetitions; ++i) {
        our_times.push_back(seconds([&] { ours.refine(level); }));
        peer_times.push_back(seconds([&] { peer.refine(level); }));
    }
    const double vertices = static_cast<double>(ours.positions().size());
    fmt::print("{:>5} {:>12} {:>11.3g} {:>11.3g} {:>7.2f}\n", level, ours.positions().size(),
               1e9 * median(our_times) / vertices, 1e9 * median(peer_times) / vertices,
               median(peer_times) / median(our_times));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    const bool smoke = argc == 2 && std::string_view(argv[1]) == "--smoke";
    if (argc > 1 && !smoke) {
        fmt::print(stderr, "usage: loopcheck_lattice_bench [--smoke]\n");
        return EXIT_FAILURE;
    }
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);  // keep what was freed: new pages cost more than the work
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
    fmt::print("{:>5} {:>12} {:>11} {:>11} {:>7}\n", "level", "vertices", "ours, ns", "Far, ns", "ratio");
    if (smoke) return run(varied_sphere(2), 3, 1) ? EXIT_SUCCESS : EXIT_FAILURE;
    const core::TriangleMesh large = varied_sphere(5);
    bool same = true;
    for (int level = 1; level <= 5; ++level) same &= run(large, level, level < 5 ? 9 : 5);
    same &= run(varied_sphere(4), 6, 5);
    return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
