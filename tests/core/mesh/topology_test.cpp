#include "core/mesh/topology.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>

#include "tests/support/meshes.h"
#include "tests/support/results.h"
#include "tests/support/topology_faults.h"

namespace loopcheck::core {
namespace {

using tests::contains;
using tests::error_of;
using tests::faults_of;
using tests::Triangles;
using tests::value_of;
using Pairs = std::vector<std::array<Index, 2>>;
using Indices = std::vector<Index>;

Indices ring_of(const Topology& t, Index v) {
    const auto ring = t.ring(v);
    return {ring.begin(), ring.end()};
}

Error refusal(Index vertex_count, const Triangles& triangles) {
    return error_of(make_topology(vertex_count, triangles));
}

constexpr Place face(Index f) {
    return {Place::Kind::Face, f};
}
constexpr Place vertex(Index v) {
    return {Place::Kind::Vertex, v};
}

TEST(Topology, NumbersTheSquareAsWrittenByHand) {
    const auto t = value_of(make_topology(4, {{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(t.edge_ends, (Pairs{{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}}));
    EXPECT_EQ(t.edge_faces, (Pairs{{0, kNone}, {0, kNone}, {0, 1}, {1, kNone}, {1, kNone}}));
    EXPECT_EQ(t.face_edges, (Triangles{{0, 1, 2}, {2, 3, 4}}));
    EXPECT_EQ(ring_of(t, 0), (Indices{0, 2, 4}));
    EXPECT_EQ(ring_of(t, 1), (Indices{1, 0}));
    EXPECT_EQ(ring_of(t, 2), (Indices{3, 2, 1}));
    EXPECT_EQ(ring_of(t, 3), (Indices{4, 3}));
}

TEST(Topology, NumbersTheTetrahedronAsWrittenByHand) {
    const auto t = value_of(make_topology(4, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
    EXPECT_EQ(t.edge_ends, (Pairs{{0, 2}, {2, 1}, {1, 0}, {1, 3}, {3, 0}, {3, 2}}));
    EXPECT_EQ(t.edge_faces, (Pairs{{0, 2}, {0, 3}, {0, 1}, {1, 3}, {1, 2}, {2, 3}}));
    EXPECT_EQ(t.face_edges, (Triangles{{0, 1, 2}, {2, 3, 4}, {4, 5, 0}, {1, 5, 3}}));
    EXPECT_EQ(ring_of(t, 0), (Indices{0, 2, 4}));
    EXPECT_EQ(ring_of(t, 1), (Indices{2, 1, 3}));
    EXPECT_EQ(ring_of(t, 2), (Indices{1, 0, 5}));
    EXPECT_EQ(ring_of(t, 3), (Indices{4, 3, 5}));
}

TEST(Topology, AnswersAboutVerticesAndEdges) {
    const auto t = value_of(make_topology(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 4}}));
    EXPECT_FALSE(t.is_boundary_vertex(0));
    EXPECT_EQ(t.face_count_at(0), 3);
    EXPECT_TRUE(t.is_boundary_vertex(4));
    EXPECT_EQ(t.face_count_at(4), 1);
    EXPECT_TRUE(t.is_isolated(5));
    EXPECT_FALSE(t.is_boundary_vertex(5));
    EXPECT_EQ(t.face_count_at(5), 0);
    EXPECT_EQ(t.other_end(1, 1), 2);
    EXPECT_EQ(t.other_end(1, 2), 1);
    EXPECT_TRUE(t.is_boundary_edge(1));
    EXPECT_FALSE(t.is_boundary_edge(0));
    for (Index f = 0; f < t.face_count(); ++f)
        for (int i = 0; i < 3; ++i) EXPECT_EQ(t.corner_of_edge(f, t.face_edges[f][i]), i);
}

TEST(Topology, ThePillowIsClosed) {
    const auto t = value_of(make_topology(3, {{0, 1, 2}, {0, 2, 1}}));
    EXPECT_EQ(faults_of(t), "");
    EXPECT_EQ(t.edge_count(), 3);
    for (Index v = 0; v < 3; ++v) EXPECT_EQ(t.face_count_at(v), 2);
}

TEST(Topology, RefusesThreeFacesOnAnEdge) {
    const Error error = refusal(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
    EXPECT_EQ(error.code, ErrorCode::NonManifoldEdge);
    EXPECT_EQ(error.place, face(2));
    EXPECT_TRUE(contains(error.sentence, "between vertices 0 and 1 has 3 faces")) << error.sentence;
}

TEST(Topology, RefusesABowTie) {
    const Error error = refusal(5, {{0, 1, 2}, {2, 3, 4}});
    EXPECT_EQ(error.code, ErrorCode::NonManifoldVertex);
    EXPECT_EQ(error.place, vertex(2));
    EXPECT_TRUE(contains(error.sentence, "2 of its 4 edges")) << error.sentence;
}

TEST(Topology, RefusesAClosedFanBesideAnOpenOne) {
    const Error error = refusal(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}});
    EXPECT_EQ(error.code, ErrorCode::NonManifoldVertex);
    EXPECT_EQ(error.place, vertex(0));
}

TEST(Topology, RefusesTwoClosedFans) {
    Triangles faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (const auto& [a, b, c] : Triangles(faces))
        faces.push_back({a == 0 ? 0 : a + 3, b == 0 ? 0 : b + 3, c == 0 ? 0 : c + 3});
    const Error error = refusal(7, faces);
    EXPECT_EQ(error.code, ErrorCode::NonManifoldVertex);
    EXPECT_EQ(error.place, vertex(0));
    EXPECT_TRUE(contains(error.sentence, "3 of its 6 edges")) << error.sentence;
}

TEST(Topology, RefusesNeighboursThatRunInOneDirection) {
    const Error error = refusal(4, {{0, 1, 2}, {0, 1, 3}});
    EXPECT_EQ(error.code, ErrorCode::InconsistentWinding);
    EXPECT_EQ(error.place, face(1));
    EXPECT_TRUE(contains(error.sentence, "from vertex 0 to vertex 1, and so does face 0")) << error.sentence;
}

TEST(Topology, RefusesAMoebiusStrip) {
    const Error error = refusal(5, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}});
    EXPECT_EQ(error.code, ErrorCode::InconsistentWinding);
}

TEST(Topology, RefusesAFaceThatComesTwice) {
    const Triangles rotations{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
    for (const auto& again : rotations) {
        const Error error = refusal(4, {{0, 3, 1}, {0, 1, 2}, again});
        EXPECT_EQ(error.code, ErrorCode::DuplicateFace);
        EXPECT_EQ(error.place, face(2));
        EXPECT_TRUE(contains(error.sentence, "as face 1")) << error.sentence;
    }
}

TEST(Topology, NamesTheFirstOfTwoFaults) {
    EXPECT_EQ(refusal(10, {{0, 1, 2}, {0, 1, 3}, {4, 5, 6}, {4, 5, 7}}).place, face(1));
    EXPECT_EQ(refusal(10, {{0, 1, 2}, {2, 3, 4}, {5, 6, 7}, {7, 8, 9}}).place, vertex(2));
}

constexpr Index kVeryMany = 70'000;

Triangles faces_of(const MeshData& data) {
    Triangles faces;
    for (std::size_t i = 0; i < data.face_corners.size(); i += 3)
        faces.push_back({data.face_corners[i], data.face_corners[i + 1], data.face_corners[i + 2]});
    return faces;
}

TEST(Topology, TakesAVertexOfVeryManyFaces) {
    for (const auto& data : {tests::wheel(kVeryMany), tests::open_fan(kVeryMany)}) {
        const auto count = static_cast<Index>(data.positions.size());
        EXPECT_EQ(value_of(make_topology(count, faces_of(data))).face_count_at(0), kVeryMany);
    }
}

TEST(Topology, RefusesAnEdgeOfVeryManyFaces) {
    Triangles faces;
    for (Index i = 0; i < kVeryMany; ++i) faces.push_back({0, 1, 2 + i});
    const Error error = refusal(2 + kVeryMany, faces);
    EXPECT_EQ(error.code, ErrorCode::NonManifoldEdge);
    EXPECT_EQ(error.place, face(2));
    EXPECT_TRUE(contains(error.sentence, "70000 faces")) << error.sentence;
}

TEST(Topology, ADuplicateAmongVeryManyFacesOfAnEdgeIsRefused) {
    Triangles faces;
    for (Index i = 0; i < 200; ++i) faces.push_back({0, 1, 2 + i});
    faces.push_back(faces.front());
    const ErrorCode code = refusal(202, faces).code;
    EXPECT_TRUE(code == ErrorCode::NonManifoldEdge || code == ErrorCode::DuplicateFace) << code_name(code);
}

// What is wrong with a set of triangles, by the definitions and not by sorting and walking.
std::set<ErrorCode> wrong_by_definition(Index vertex_count, const Triangles& faces) {
    std::set<ErrorCode> wrong;
    std::map<std::pair<Index, Index>, int> directed, undirected;
    std::set<Triangle> turned;
    for (auto t : faces) {
        for (int i = 0; i < 3; ++i) {
            const Index a = t[i], b = t[next_corner(i)];
            if (++directed[{a, b}] > 1) wrong.insert(ErrorCode::InconsistentWinding);
            if (++undirected[std::minmax(a, b)] > 2) wrong.insert(ErrorCode::NonManifoldEdge);
        }
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        if (!turned.insert(t).second) wrong.insert(ErrorCode::DuplicateFace);
    }
    for (Index v = 0; v < vertex_count; ++v) {
        // Faces at v are joined where they share an edge at v: flood from the first one.
        std::vector<std::set<Index>> at_v;
        for (const auto& t : faces)
            if (std::count(t.begin(), t.end(), v)) at_v.emplace_back(t.begin(), t.end());
        if (at_v.empty()) continue;
        std::set<Index> reached = at_v.front();
        for (std::size_t pass = 0; pass < at_v.size(); ++pass)
            for (const auto& f : at_v)
                if (std::count_if(f.begin(), f.end(), [&](Index i) { return reached.count(i); }) >= 2)
                    reached.insert(f.begin(), f.end());
        for (const auto& f : at_v)
            if (!std::includes(reached.begin(), reached.end(), f.begin(), f.end()))
                wrong.insert(ErrorCode::NonManifoldVertex);
    }
    return wrong;
}

Triangles random_faces(std::mt19937& random, Index vertex_count, int face_count) {
    Triangles faces;
    while (static_cast<int>(faces.size()) < face_count) {
        Triangle t;
        for (Index& v : t) v = static_cast<Index>(random() % static_cast<unsigned>(vertex_count));
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) faces.push_back(t);
    }
    return faces;
}

TEST(Topology, AcceptsRandomTrianglesExactlyWhereTheDefinitionDoes) {
    std::mt19937 random(1);
    std::map<std::string, int> seen;
    for (int i = 0; i < 60'000; ++i) {
        const auto vertex_count = static_cast<Index>(3 + random() % 4);
        const Triangles faces = random_faces(random, vertex_count, static_cast<int>(1 + random() % 5));
        const auto wrong = wrong_by_definition(vertex_count, faces);
        const auto t = make_topology(vertex_count, faces);
        ASSERT_EQ(t.has_value(), wrong.empty()) << i;
        if (t)
            ASSERT_EQ(faults_of(*t), "") << i;
        else
            ASSERT_TRUE(wrong.count(t.error().code)) << i << ": " << to_string(t.error());
        ++seen[std::string(t ? "accepted" : code_name(t.error().code))];
    }
    EXPECT_EQ(seen.size(), 5U);
    for (const auto& [outcome, count] : seen) {
        fmt::print("[ OBSERVED ] {}: {}\n", outcome, count);
        EXPECT_GT(count, 100) << outcome;
    }
}

}  // namespace
}  // namespace loopcheck::core
