#include "core/mesh/mesh_data.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace loopcheck::core {
namespace {

using Indices = std::vector<Index>;

/// A triangle, a square and a pentagon over nine vertices.
MeshData three_polygons() {
    MeshData data;
    for (int i = 0; i < 9; ++i) data.positions.emplace_back(i, i * i, 0);
    data.add_face(Indices{0, 1, 2});
    data.add_face(Indices{0, 2, 3, 4});
    data.add_face(Indices{4, 5, 6, 7, 8});
    return data;
}

TEST(Triangulate, FansFromTheFirstCorner) {
    const Triangulated result = triangulate(three_polygons());
    EXPECT_EQ(result.data.face_sizes, (Indices{3, 3, 3, 3, 3, 3}));
    EXPECT_EQ(result.data.face_corners, (Indices{0, 1, 2, 0, 2, 3, 0, 3, 4, 4, 5, 6, 4, 6, 7, 4, 7, 8}));
    EXPECT_EQ(result.polygon_of, (Indices{0, 1, 1, 2, 2, 2}));
    EXPECT_EQ(result.split, 2u);
}

TEST(Triangulate, KeepsPositionsAndTags) {
    MeshData data = three_polygons();
    data.creases = {{0, 2, 1.5f}};
    data.corners = {{7, 2.5f}};
    const Triangulated result = triangulate(data);
    EXPECT_EQ(result.data.positions, data.positions);
    ASSERT_EQ(result.data.creases.size(), 1u);
    EXPECT_EQ(result.data.creases[0].b, 2);
    EXPECT_EQ(result.data.creases[0].sharpness, 1.5f);
    ASSERT_EQ(result.data.corners.size(), 1u);
    EXPECT_EQ(result.data.corners[0].vertex, 7);
}

TEST(Triangulate, MakesEveryPieceOfAHoleAHole) {
    MeshData data = three_polygons();
    data.holes = {2, 0};
    EXPECT_EQ(triangulate(data).data.holes, (Indices{3, 4, 5, 0}));
}

TEST(Triangulate, LeavesAHoleThatNamesNoFaceWithoutOne) {
    constexpr Index kLast = std::numeric_limits<Index>::max();
    MeshData data = three_polygons();
    data.holes = {-1, 3, kLast};
    const Triangulated result = triangulate(data);
    EXPECT_EQ(result.data.holes, (Indices{-1, 6, kLast}));
    EXPECT_EQ(result.data.face_sizes.size(), 6u);
}

TEST(Triangulate, KeepsTrianglesAndSmallerFaces) {
    MeshData data = three_polygons();
    data.face_sizes = {3, 0, 1, 2};
    data.face_corners = {0, 1, 2, 3, 4, 5};
    const Triangulated result = triangulate(data);
    EXPECT_EQ(result.data.face_sizes, data.face_sizes);
    EXPECT_EQ(result.data.face_corners, data.face_corners);
    EXPECT_EQ(result.polygon_of, (Indices{0, 1, 2, 3}));
    EXPECT_EQ(result.split, 0u);
}

TEST(Triangulate, ChangesNothingWhereTheSizesDoNotMatch) {
    MeshData data = three_polygons();
    data.face_sizes = {3, 4, 6};
    EXPECT_FALSE(sizes_match(data));
    EXPECT_EQ(triangulate(data).data.face_sizes, data.face_sizes);
    data.face_sizes = {13, -1};
    EXPECT_FALSE(sizes_match(data));
    const Triangulated result = triangulate(data);
    EXPECT_EQ(result.data.face_sizes, data.face_sizes);
    EXPECT_EQ(result.data.face_corners, data.face_corners);
    EXPECT_EQ(result.polygon_of, (Indices{0, 1}));
}

TEST(Triangulate, TakesAnEmptyMesh) {
    const Triangulated result = triangulate({});
    EXPECT_TRUE(result.data.face_sizes.empty());
    EXPECT_TRUE(result.polygon_of.empty());
}

}  // namespace
}  // namespace loopcheck::core
