#include "core/loop/lattice/split_numbers.h"

#include <gtest/gtest.h>

#include "core/loop/lattice/split_order.h"
#include "tests/support/models.h"

namespace loopcheck::core {
namespace {

// Meshes whose sizes, and so the numbers of whose points, have nothing in common.
TEST(SplitNumbers, AreThoseOfSplitOrder) {
    for (const char* name : {"cow", "fan-3", "pillow", "annulus", "single-triangle", "genus-2"}) {
        const Topology topology = tests::load_model(tests::model_path(name)).mesh.topology();
        for (int level = 0; level <= tests::levels_up_to(5); ++level) {
            const NumberPattern pattern(level);
            const SplitNumbers numbers(pattern, topology);
            const SplitOrder split(topology, level);
            const LatticeOrder order(topology, level);
            const Index n = order.segments();
            std::vector<Index> of_face(static_cast<std::size_t>(lattice_place(n, 0, n)) + 1);
            for (Index f = 0; f < topology.face_count(); ++f) {
                numbers.of_face(f, of_face);
                std::size_t place = 0;
                for (Index j = 0; j <= n; ++j)
                    for (Index i = 0; i + j <= n; ++i)
                        ASSERT_EQ(of_face[place++],
                                  split.vertex(order.address_of(order.vertex_at(topology, f, i, j))))
                            << name << ", level " << level << ", face " << f << " (" << i << ", " << j << ")";
            }
        }
    }
}

TEST(SplitNumbers, KnowEveryClassOfPointsAtTheDeepestLevels) {
    const Topology topology = tests::mesh_of(tests::bipyramid(3)).topology();
    constexpr int kLevel = 9;
    const NumberPattern pattern(kLevel);
    const SplitNumbers numbers(pattern, topology);
    const SplitOrder split(topology, kLevel);
    constexpr Index n = Index{1} << kLevel;
    std::vector<Index> of_face(static_cast<std::size_t>(lattice_place(n, 0, n)) + 1);
    constexpr Index kFace = 4;
    numbers.of_face(kFace, of_face);
    for (Index j = 1; j < n; ++j)
        for (Index i = 1; i + j < n; ++i)
            ASSERT_EQ(of_face[static_cast<std::size_t>(lattice_place(n, i, j))],
                      split.vertex({LatticeAddress::Kind::Face, kFace, i, j}));
}

}  // namespace
}  // namespace loopcheck::core
