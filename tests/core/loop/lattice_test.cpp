#include "core/loop/tessellation/lattice.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "tests/support/meshes.h"

namespace loopcheck::core {
namespace {

// The point of an edge of a face, a fraction of the way from its corner to the next.
LatticePoint on_edge(int corner, std::int64_t eighths) {
    const LatticePoint& a = kFaceCorners[corner];
    const LatticePoint& b = kFaceCorners[next_corner(corner)];
    return {a.u + (b.u - a.u) / 8 * eighths, a.v + (b.v - a.v) / 8 * eighths};
}

TEST(VertexKey, IsTheSameFromBothFacesOfAnEdge) {
    const Topology t = tests::mesh_of(tests::bipyramid(5)).topology();
    for (Index e = 0; e < t.edge_count(); ++e) {
        const auto [f, g] = t.edge_faces[e];
        const int i = t.corner_of_edge(f, e), j = t.corner_of_edge(g, e);
        for (int k = 0; k <= 8; ++k)
            EXPECT_EQ(key_of(t, f, on_edge(i, k)), key_of(t, g, on_edge(j, 8 - k))) << e << " " << k;
    }
}

// The pillow's three edges join two faces; every point of level 3 still has one name.
TEST(VertexKey, TellsAllPointsApart) {
    for (const auto& data : {tests::wheel(2), tests::bipyramid(3), tests::open_fan(3)}) {
        const Topology t = tests::mesh_of(data).topology();
        const auto order = [](const VertexKey& a, const VertexKey& b) {
            return std::tie(a.kind, a.id, a.s, a.t) < std::tie(b.kind, b.id, b.s, b.t);
        };
        std::set<VertexKey, decltype(order)> keys(order);
        std::set<std::size_t> hashes;
        for (Index f = 0; f < t.face_count(); ++f)
            for (std::int64_t i = 0; i <= 8; ++i)
                for (std::int64_t j = 0; i + j <= 8; ++j) {
                    const VertexKey key = key_of(t, f, {kLatticeUnit / 8 * i, kLatticeUnit / 8 * j});
                    keys.insert(key);
                    hashes.insert(VertexKeyHash{}(key));
                }
        const auto whole =
            static_cast<std::size_t>(t.vertex_count + 7 * t.edge_count() + 21 * t.face_count());
        EXPECT_EQ(keys.size(), whole);
        EXPECT_EQ(hashes.size(), whole);
    }
}

TEST(LatticePoint, IsWholeTwoLevelsBelowTheLast) {
    LatticePoint a = kFaceCorners[0], b = kFaceCorners[1];
    for (int level = 1; level <= kMostLevels + 2; ++level) {
        const LatticePoint m = midpoint(a, b);
        EXPECT_EQ(2 * m.u, a.u + b.u);
        EXPECT_EQ(2 * m.v, a.v + b.v);
        (level % 2 == 0 ? a : b) = m;
    }
}

}  // namespace
}  // namespace loopcheck::core
