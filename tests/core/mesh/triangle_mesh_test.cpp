#include "core/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/meshes.h"
#include "tests/support/results.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::kNoPlace;
using tests::mesh_of;
using Indices = std::vector<Index>;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr Place face(Index f) {
    return {Place::Kind::Face, f};
}
constexpr Place vertex(Index v) {
    return {Place::Kind::Vertex, v};
}

// Expects that the data is refused with this code, at this place, by a sentence that says this.
void expect_refusal(MeshData data, ErrorCode code, Place place, const std::string& says) {
    const Error error = error_of(TriangleMesh::make(std::move(data)));
    EXPECT_EQ(error.code, code) << to_string(error);
    EXPECT_EQ(error.place, place) << to_string(error);
    EXPECT_TRUE(contains(error.sentence, says)) << to_string(error);
    EXPECT_EQ(error.sentence.back(), '.') << to_string(error);
}

MeshData with_face(MeshData data, const Indices& vertices) {
    data.add_face(vertices);
    return data;
}

Index edge_between(const TriangleMesh& mesh, Index a, Index b) {
    for (const Index e : mesh.topology().ring(a))
        if (mesh.topology().other_end(e, a) == b) return e;
    return kNone;
}

TEST(TriangleMesh, KeepsWhatItIsGiven) {
    MeshData data = tests::square();
    data.creases = {{2, 0, 1.5F}};
    data.corners = {{3, 2.5F}};
    data.holes = {1};
    const auto positions = data.positions;
    const auto mesh = mesh_of(std::move(data));
    EXPECT_TRUE(std::equal(positions.begin(), positions.end(), mesh.positions().begin()));
    EXPECT_EQ(mesh.vertex_count(), 4);
    EXPECT_EQ(mesh.face_count(), 2);
    EXPECT_EQ(mesh.topology().triangles, (tests::Triangles{{0, 1, 2}, {0, 2, 3}}));
    for (Index e = 0; e < 5; ++e)
        EXPECT_EQ(mesh.edge_sharpness()[e], e == edge_between(mesh, 0, 2) ? 1.5F : 0.0F);
    for (Index v = 0; v < 4; ++v) EXPECT_EQ(mesh.vertex_sharpness()[v], v == 3 ? 2.5F : 0.0F);
    EXPECT_EQ(mesh.holes()[0], 0);
    EXPECT_EQ(mesh.holes()[1], 1);
}

TEST(TriangleMesh, AcceptsIsolatedVertices) {
    MeshData data = tests::triangle();
    data.positions.insert(data.positions.end(), 2, {1, 2, 3});
    const auto mesh = mesh_of(std::move(data));
    EXPECT_EQ(mesh.vertex_count(), 5);
    EXPECT_TRUE(mesh.topology().is_isolated(3));
}

TEST(TriangleMesh, RefusesAnEmptyMesh) {
    expect_refusal({}, ErrorCode::EmptyMesh, kNoPlace, "no vertices");
    expect_refusal(tests::data_of({{0, 0, 0}}, {}), ErrorCode::EmptyMesh, kNoPlace, "no faces");
}

TEST(TriangleMesh, RefusesCoordinatesThatAreNotFinite) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
        for (int i = 0; i < 3; ++i) {
            MeshData data = tests::square();
            data.positions[2][i] = bad;
            data.positions[3][0] = bad;
            const std::string says = std::string("Coordinate ") + "xyz"[i];
            expect_refusal(data, ErrorCode::NotFinite, vertex(2), says);
        }
}

TEST(TriangleMesh, RefusesFacesOfOtherThanThreeCorners) {
    const auto square = tests::square();
    expect_refusal(with_face(square, {0, 1, 2, 3}), ErrorCode::NotATriangle, face(2), "4 corners");
    expect_refusal(with_face(square, {0, 1}), ErrorCode::NotATriangle, face(2), "2 corners");
    expect_refusal(with_face(square, {}), ErrorCode::NotATriangle, face(2), "0 corners");
    MeshData negative = square;
    negative.face_sizes[0] = -3;
    expect_refusal(negative, ErrorCode::NotATriangle, face(0), "-3 corners");
    MeshData same_sum = tests::data_of(square.positions, {});
    same_sum.face_sizes = {2, 4};
    same_sum.face_corners = {0, 1, 2, 0, 2, 3};
    expect_refusal(same_sum, ErrorCode::NotATriangle, face(0), "2 corners");
}

TEST(TriangleMesh, RefusesMissingCorners) {
    MeshData data = tests::square();
    data.face_corners.pop_back();
    expect_refusal(data, ErrorCode::IndexOutOfRange, face(1), "missing");
    data.face_corners.clear();
    expect_refusal(data, ErrorCode::IndexOutOfRange, face(0), "missing");
}

TEST(TriangleMesh, RefusesCornersThatBelongToNoFace) {
    MeshData data = tests::square();
    data.face_corners.push_back(1);
    expect_refusal(data, ErrorCode::IndexOutOfRange, {}, "There are 7 corners, but the faces have 6");
}

TEST(TriangleMesh, RefusesIndicesOutOfRange) {
    constexpr Index kMost = std::numeric_limits<Index>::max(), kLeast = std::numeric_limits<Index>::min();
    for (const Index bad : {-1, 4, kMost, kLeast})
        for (int i = 0; i < 3; ++i) {
            Indices corners{0, 1, 2};
            corners[i] = bad;
            expect_refusal(with_face(tests::square(), corners), ErrorCode::IndexOutOfRange, face(2),
                           "vertex " + std::to_string(bad) + ", but the vertices are 0 to 3");
        }
}

TEST(TriangleMesh, RefusesAVertexTwiceInAFace) {
    for (const Indices& corners : {Indices{3, 3, 0}, {0, 3, 3}, {3, 0, 3}, {3, 3, 3}})
        expect_refusal(with_face(tests::square(), corners), ErrorCode::RepeatedVertex, face(2), "Vertex 3");
}

TEST(TriangleMesh, NamesTheFirstBadFace) {
    const auto data = with_face(with_face(tests::square(), {1, 1, 2}), {0, 1, 9});
    expect_refusal(data, ErrorCode::RepeatedVertex, face(2), "Vertex 1");
}

TEST(TriangleMesh, RefusesWhatIsNotManifold) {
    expect_refusal(with_face(tests::square(), {0, 1, 2}), ErrorCode::DuplicateFace, face(2), "as face 0");
    expect_refusal(with_face(tests::square(), {1, 0, 2}), ErrorCode::NonManifoldEdge, face(2), "3 faces");
}

TEST(TriangleMesh, RefusesBadSharpness) {
    for (const float bad : {kNaN, -1.0F, -kInfinity, -1e-45F}) {
        MeshData data = tests::square();
        data.creases = {{0, 1, 1}, {0, 2, bad}};
        expect_refusal(data, ErrorCode::BadSharpness, kNoPlace, "between vertices 0 and 2");
        data = tests::square();
        data.corners = {{0, 1}, {3, bad}};
        expect_refusal(data, ErrorCode::BadSharpness, kNoPlace, "vertex 3");
    }
}

TEST(TriangleMesh, SharpnessStopsAtInfinite) {
    for (const float s : {10.0F, 10.5F, 1e30F, kInfinity}) {
        MeshData data = tests::square();
        data.creases = {{0, 2, s}};
        data.corners = {{1, s}};
        const auto mesh = mesh_of(std::move(data));
        EXPECT_EQ(mesh.edge_sharpness()[edge_between(mesh, 0, 2)], kInfiniteSharpness);
        EXPECT_EQ(mesh.vertex_sharpness()[1], kInfiniteSharpness);
    }
}

TEST(TriangleMesh, TheLastSharpnessCounts) {
    MeshData data = tests::square();
    data.creases = {{0, 2, 5}, {2, 0, 1.25F}};
    data.corners = {{1, 5}, {1, 0}};
    const auto mesh = mesh_of(std::move(data));
    EXPECT_EQ(mesh.edge_sharpness()[edge_between(mesh, 0, 2)], 1.25F);
    EXPECT_EQ(mesh.vertex_sharpness()[1], 0);
}

TEST(TriangleMesh, RefusesCreasesThatAreNotOnAnEdge) {
    for (const auto& [a, b] : {std::pair{1, 3}, {1, 1}, {0, 4}, {-1, 0}, {-1, -1}, {4, 4}}) {
        MeshData data = tests::square();
        data.creases = {{a, b, 1}};
        expect_refusal(data, ErrorCode::NoSuchEdge, kNoPlace,
                       "vertices " + std::to_string(a) + " and " + std::to_string(b));
    }
}

TEST(TriangleMesh, RefusesTagsOnWhatDoesNotExist) {
    for (const Index bad : {-1, 4}) {
        MeshData data = tests::square();
        data.corners = {{bad, 1}};
        expect_refusal(data, ErrorCode::IndexOutOfRange, kNoPlace, "vertex " + std::to_string(bad));
    }
    for (const Index bad : {-1, 2}) {
        MeshData data = tests::square();
        data.holes = {0, bad};
        expect_refusal(data, ErrorCode::HoleOutOfRange, kNoPlace, "face " + std::to_string(bad));
    }
}

TEST(TriangleMesh, FindsTheLargestCoordinateAndTheDiagonal) {
    MeshData data = tests::triangle();
    data.positions = {{1, -7, 2}, {4, -3, 2}, {1, -3, 14}};
    const auto mesh = mesh_of(std::move(data));
    EXPECT_EQ(mesh.largest_coordinate(), 14);
    EXPECT_EQ(mesh.diagonal(), 13);  // sides 3, 4, 12
}

TEST(TriangleMesh, TheLargestCoordinateIsNeverZero) {
    MeshData data = tests::triangle();
    data.positions.assign(3, {0, -0.0, 0});
    EXPECT_EQ(mesh_of(std::move(data)).largest_coordinate(), std::numeric_limits<double>::min());
}

TEST(CheckFits, NamesTheCoordinateBeyondFloat) {
    MeshData data = tests::square();
    data.positions[2].y = -1e300;
    const auto mesh = mesh_of(std::move(data));
    EXPECT_FALSE(check_fits(mesh, Precision::Double));
    const auto error = check_fits(mesh, Precision::Float);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code, ErrorCode::NotFinite);
    EXPECT_EQ(error->place, vertex(2));
    EXPECT_TRUE(contains(error->sentence, "Coordinate y")) << error->sentence;
}

TEST(CheckFits, DrawsTheLineAtHalfTheRange) {
    MeshData data = tests::square();
    data.positions[0].x = std::numeric_limits<float>::max() / 2;
    EXPECT_FALSE(check_fits(mesh_of(data), Precision::Float));
    data.positions[0].x *= 1 + 0x1p-24;
    EXPECT_TRUE(check_fits(mesh_of(data), Precision::Float));
    data.positions[0].x = std::numeric_limits<double>::max() / 2;
    EXPECT_FALSE(check_fits(mesh_of(data), Precision::Double));
    data.positions[0].x *= 1 + 0x1p-52;
    EXPECT_TRUE(check_fits(mesh_of(data), Precision::Double));
}

}  // namespace
}  // namespace loopcheck::core
