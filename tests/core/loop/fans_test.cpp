#include "core/loop/tessellation/fans.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/mesh/topology.h"
#include "tests/support/meshes.h"

namespace loopcheck::core {
namespace {

std::vector<Index> at(const Fans& fans, Index v) {
    return {fans.at(v).begin(), fans.at(v).end()};
}

TEST(Fans, HoldTheTrianglesAtEachVertexAscending) {
    const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 4}, {0, 2, 4}};
    const Fans fans(6, triangles);
    EXPECT_EQ(at(fans, 0), (std::vector<Index>{0, 2}));
    EXPECT_EQ(at(fans, 1), (std::vector<Index>{0, 1}));
    EXPECT_EQ(at(fans, 2), (std::vector<Index>{0, 1, 2}));
    EXPECT_EQ(at(fans, 3), std::vector<Index>{}) << "isolated";
    EXPECT_EQ(at(fans, 4), (std::vector<Index>{1, 2}));
    EXPECT_EQ(at(fans, 5), std::vector<Index>{});
}

TEST(Fans, HaveAStarOfAllTrianglesThatShareAVertex) {
    // A strip: triangle i is (i, i + 1, i + 2).
    std::vector<Triangle> strip;
    for (Index i = 0; i < 8; ++i) strip.push_back({i, i + 1, i + 2});
    const Fans fans(10, strip);
    EXPECT_EQ(fans.star(0), (std::vector<Index>{0, 1, 2}));
    EXPECT_EQ(fans.star(4), (std::vector<Index>{2, 3, 4, 5, 6}));
}

// Closed where the vertex is inside the mesh: also of a pillow, whose edges have the same two faces.
TEST(Fans, AreClosedAroundInnerVertices) {
    for (const auto& data : {tests::wheel(2), tests::wheel(5), tests::open_fan(1), tests::open_fan(4),
                             tests::tetrahedron(), tests::cube()}) {
        const Topology t = tests::mesh_of(data).topology();
        const Fans fans(static_cast<std::size_t>(t.vertex_count), t.triangles);
        for (Index v = 0; v < t.vertex_count; ++v)
            EXPECT_EQ(fans.is_closed(v), !t.is_boundary_vertex(v))
                << t.face_count() << " faces, vertex " << v;
    }
}

TEST(Fans, AreNotClosedWhereANeighbourIsInMoreThanTwo) {
    // Two pillows on the edge 0-1.
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 2}, {0, 1, 3}, {1, 0, 3}};
    const Fans fans(4, triangles);
    EXPECT_FALSE(fans.is_closed(0));
    EXPECT_TRUE(fans.is_closed(2));
}

}  // namespace
}  // namespace loopcheck::core
