#include "core/loop/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/topology_faults.h"

namespace loopcheck::core {
namespace {

using tests::error_of;
using tests::faults_of;
using tests::Triangles;
using tests::value_of;
using Pairs = std::vector<std::array<Index, 2>>;
using Indices = std::vector<Index>;

Topology split_of(const Topology& parent) {
    return value_of(split(parent));
}

// From the rules in the header, on paper.
TEST(Split, NumbersTheSquareAsWrittenByHand) {
    const auto t = split_of(tests::mesh_of(tests::square()).topology());
    EXPECT_EQ(t.vertex_count, 9);
    EXPECT_EQ(
        t.triangles,
        (Triangles{{0, 4, 6}, {4, 1, 5}, {6, 5, 2}, {5, 6, 4}, {0, 6, 8}, {6, 2, 7}, {8, 7, 3}, {7, 8, 6}}));
    EXPECT_EQ(t.edge_ends, (Pairs{{4, 6},
                                  {5, 4},
                                  {6, 5},
                                  {6, 8},
                                  {7, 6},
                                  {8, 7},  // across corners
                                  {4, 0},
                                  {4, 1},
                                  {5, 1},
                                  {5, 2},
                                  {6, 2},
                                  {6, 0},  // halves of edges 0 1 2
                                  {7, 2},
                                  {7, 3},
                                  {8, 3},
                                  {8, 0}}));  // halves of edges 3 4
    EXPECT_EQ(t.edge_faces, (Pairs{{0, 3},
                                   {1, 3},
                                   {2, 3},
                                   {4, 7},
                                   {5, 7},
                                   {6, 7},
                                   {0, kNone},
                                   {1, kNone},
                                   {1, kNone},
                                   {2, kNone},
                                   {2, 5},
                                   {0, 4},
                                   {5, kNone},
                                   {6, kNone},
                                   {6, kNone},
                                   {4, kNone}}));
    const Indices rings[] = {{6, 11, 15},    {8, 7},        {12, 10, 9},          {14, 13},  // vertex points
                             {7, 1, 0, 6},   {9, 2, 1, 8},  {11, 0, 2, 10, 4, 3},            // edge points
                             {13, 5, 4, 12}, {15, 3, 5, 14}};
    for (Index v = 0; v < t.vertex_count; ++v)
        EXPECT_EQ(Indices(t.ring(v).begin(), t.ring(v).end()), rings[v]) << v;
}

TEST(Split, NamesTheAncestorsOfTheSquare) {
    using From = Ancestor::Kind;
    EXPECT_EQ(ancestors_of_split(tests::mesh_of(tests::square()).topology()),
              (std::vector<Ancestor>{{From::Vertex, 0},
                                     {From::Vertex, 1},
                                     {From::Vertex, 2},
                                     {From::Vertex, 3},
                                     {From::Edge, 0},
                                     {From::Edge, 1},
                                     {From::Edge, 2},
                                     {From::Edge, 4},
                                     {From::Edge, 5}}));
}

// An edge by what it joins: its ends and its faces.
using EdgeKey = std::tuple<Index, Index, Index, Index>;

std::vector<EdgeKey> edges_of(const Topology& t) {
    std::vector<EdgeKey> out;
    for (Index e = 0; e < t.edge_count(); ++e) {
        const auto [low, high] = std::minmax(t.edge_ends[e][0], t.edge_ends[e][1]);
        out.emplace_back(low, high, t.edge_faces[e][0], t.edge_faces[e][1]);
    }
    std::sort(out.begin(), out.end());
    return out;
}

bool has_double_edges(const Topology& t) {
    const auto edges = edges_of(t);
    return std::adjacent_find(edges.begin(), edges.end(), [](const EdgeKey& a, const EdgeKey& b) {
               return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b);
           }) != edges.end();
}

TEST(Split, ThePillowHasDoubleEdgesAtEveryLevelAndStaysRight) {
    Topology t = tests::mesh_of(tests::wheel(2)).topology();
    for (int level = 1; level <= 5; ++level) {
        t = split_of(t);
        ASSERT_EQ(faults_of(t), "") << level;
        EXPECT_TRUE(has_double_edges(t)) << level;
        EXPECT_EQ(t.vertex_count - t.edge_count() + t.face_count(), 2) << level;
        for (Index v = 0; v < t.vertex_count; ++v) EXPECT_EQ(t.face_count_at(v), v < 3 ? 2 : 6) << v;
    }
}

// Isolated vertices cost nothing, so that the vertices alone can be too many: nothing is allocated.  Faces
// and edges cannot: 2^31 corners take 2 GB.
TEST(Split, RefusesWhatCannotBeNumbered) {
    Topology t = tests::mesh_of(tests::square()).topology();
    t.vertex_count = std::numeric_limits<Index>::max() - 4;
    EXPECT_EQ(error_of(split(t)).code, ErrorCode::TooLarge);
    t.vertex_count = std::numeric_limits<Index>::max();
    EXPECT_EQ(error_of(split(t)).code, ErrorCode::TooLarge);
}

class SplitOf : public testing::TestWithParam<std::string> {
  protected:
    // Calls check(parent, child) for three levels.
    template <class Check>
    void for_three_levels(Check check) {
        Topology parent = tests::load_model(GetParam()).mesh.topology();
        for (int level = 0; level < 3; ++level) {
            Topology child = split_of(parent);
            ASSERT_NO_FATAL_FAILURE(check(parent, child)) << level;
            parent = std::move(child);
        }
    }
};

TEST_P(SplitOf, CountsVerticesEdgesAndFaces) {
    for_three_levels([](const Topology& parent, const Topology& child) {
        const Index V = parent.vertex_count, E = parent.edge_count(), F = parent.face_count();
        EXPECT_EQ(child.vertex_count, V + E);
        EXPECT_EQ(child.edge_count(), 2 * E + 3 * F);
        EXPECT_EQ(child.face_count(), 4 * F);
    });
}

TEST_P(SplitOf, IsConsistent) {
    for_three_levels([](const Topology&, const Topology& child) { EXPECT_EQ(faults_of(child), ""); });
}

// An independent way to the same edges: from the triangles alone.  It cannot tell double edges apart.
TEST_P(SplitOf, HasTheEdgesOfItsTriangles) {
    for_three_levels([](const Topology&, const Topology& child) {
        const auto rebuilt = make_topology(child.vertex_count, child.triangles);
        if (has_double_edges(child)) {
            EXPECT_EQ(error_of(rebuilt).code, ErrorCode::NonManifoldEdge);
        } else {
            ASSERT_TRUE(rebuilt) << to_string(rebuilt.error());
            EXPECT_EQ(edges_of(child), edges_of(*rebuilt));
        }
    });
}

// The four triangles of a face, and the ends and rings of vertex points, as the header has them.
TEST_P(SplitOf, NumbersFacesAndHalvesAsDocumented) {
    for_three_levels([](const Topology& parent, const Topology& child) {
        const Index V = parent.vertex_count, F = parent.face_count();
        for (Index f = 0; f < F; ++f) {
            const auto [v0, v1, v2] = parent.triangles[f];
            const auto [e0, e1, e2] = parent.face_edges[f];
            const Index E0 = V + e0, E1 = V + e1, E2 = V + e2;
            const Triangle expected[] = {{v0, E0, E2}, {E0, v1, E1}, {E2, E1, v2}, {E1, E2, E0}};
            for (int i = 0; i < 4; ++i) ASSERT_EQ(child.triangles[4 * f + i], expected[i]) << f;
            const std::array<Index, 2> cuts[] = {{E0, E2}, {E1, E0}, {E2, E1}};
            for (int i = 0; i < 3; ++i) ASSERT_EQ(child.edge_ends[3 * f + i], cuts[i]) << f;
        }
        for (Index e = 0; e < parent.edge_count(); ++e)
            for (int i = 0; i < 2; ++i) {
                ASSERT_EQ(half_edge(parent, e, i), 3 * F + 2 * e + i);
                ASSERT_EQ(child.edge_ends[3 * F + 2 * e + i], (std::array{V + e, parent.edge_ends[e][i]}));
            }
        for (Index v = 0; v < V; ++v) {
            ASSERT_EQ(child.ring(v).size(), parent.ring(v).size());
            for (std::size_t i = 0; i < parent.ring(v).size(); ++i)
                ASSERT_EQ(child.other_end(child.ring(v)[i], v), V + parent.ring(v)[i]) << v;
        }
    });
}

TEST_P(SplitOf, NamesAncestorsByTheFacesThatHaveThem) {
    for_three_levels([](const Topology& parent, const Topology& child) {
        const auto ancestors = ancestors_of_split(parent);
        ASSERT_EQ(ancestors.size(), static_cast<std::size_t>(child.vertex_count));
        for (Index i = 0; i < child.vertex_count; ++i) {
            const auto [kind, index] = ancestors[i];
            const bool is_vertex = i < parent.vertex_count;
            ASSERT_EQ(kind, is_vertex ? Ancestor::Kind::Vertex : Ancestor::Kind::Edge);
            ASSERT_EQ(is_vertex ? index : parent.vertex_count + parent.face_edges[index / 3][index % 3], i);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Models, SplitOf, testing::ValuesIn(tests::model_files()), tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
