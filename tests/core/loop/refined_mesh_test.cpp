#include "core/loop/lattice/refined_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_order.h"
#include "core/loop/refine.h"
#include "tests/support/models.h"

namespace loopcheck::core {
namespace {

bool is_inferred(const Topology& t, Index v, BoundaryRule boundary) {
    return boundary == BoundaryRule::EdgeAndCorner && t.is_boundary_vertex(v) && t.face_count_at(v) == 1;
}

// Level by level, the slow way.
MeshData by_levels(const TriangleMesh& mesh, const RefinedLevel& level, const SchemeLevel& scheme, int l,
                   BoundaryRule boundary) {
    MeshData out;
    out.positions = level.positions;
    for (const Triangle& triangle : level.triangles) out.add_face(triangle);
    const Topology& t = scheme.topology;
    for (Index e = 0; e < t.edge_count(); ++e)
        if (!t.is_boundary_edge(e) && is_sharp(scheme.sharpness.edge[e]))
            out.creases.push_back({t.edge_ends[e][0], t.edge_ends[e][1], scheme.sharpness.edge[e]});
    for (Index v = 0; v < t.vertex_count; ++v)
        if (!t.is_isolated(v) && !is_inferred(t, v, boundary) && is_sharp(scheme.sharpness.vertex[v]))
            out.corners.push_back({v, scheme.sharpness.vertex[v]});
    for (Index f = 0; f < t.face_count(); ++f)
        if (mesh.holes()[f >> (2 * l)]) out.holes.push_back(f);
    return out;
}

void expect_equal(const MeshData& a, const MeshData& b) {
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (std::size_t v = 0; v < a.positions.size(); ++v)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(std::bit_cast<std::uint64_t>(a.positions[v][c]),
                      std::bit_cast<std::uint64_t>(b.positions[v][c]))
                << "vertex " << v;
    EXPECT_EQ(a.face_sizes, b.face_sizes);
    EXPECT_EQ(a.face_corners, b.face_corners);
    EXPECT_TRUE(std::ranges::equal(a.creases, b.creases, [](const EdgeSharpness& x, const EdgeSharpness& y) {
        return x.a == y.a && x.b == y.b && x.sharpness == y.sharpness;
    }));
    EXPECT_TRUE(
        std::ranges::equal(a.corners, b.corners, [](const VertexSharpness& x, const VertexSharpness& y) {
            return x.vertex == y.vertex && x.sharpness == y.sharpness;
        }));
    EXPECT_EQ(a.holes, b.holes);
}

// The same in the order of `split`.
MeshData renumbered(const MeshData& data, const Topology& t, int level) {
    const LatticeOrder order(t, level);
    const SplitOrder split(t, level);
    const auto vertex = [&](Index v) { return static_cast<Index>(split.vertex(order.address_of(v))); };
    MeshData out = data;
    for (std::size_t v = 0; v < data.positions.size(); ++v)
        out.positions[vertex(static_cast<Index>(v))] = data.positions[v];
    const auto per_face = static_cast<std::int64_t>(order.segments()) * order.segments();
    const auto face = [&](std::int64_t f) {
        return split.face(static_cast<Index>(f / per_face), triangle_at(order.segments(), f % per_face));
    };
    for (std::int64_t f = 0; f < order.face_count(); ++f)
        for (int c = 0; c < 3; ++c)
            out.face_corners[static_cast<std::size_t>(3 * face(f) + c)] =
                vertex(data.face_corners[static_cast<std::size_t>(3 * f + c)]);
    for (EdgeSharpness& crease : out.creases) crease = {vertex(crease.a), vertex(crease.b), crease.sharpness};
    return out;
}

auto sorted(std::vector<EdgeSharpness> creases) {
    std::ranges::sort(creases, {}, [](const EdgeSharpness& c) { return std::pair(c.a, c.b); });
    return creases;
}

class RefinedMeshOfEveryModel : public testing::TestWithParam<std::string> {};

TEST_P(RefinedMeshOfEveryModel, IsTheLastLevelOfRefine) {
    auto [name, mesh, options] = tests::load_model(GetParam());
    const int levels = tests::levels_up_to(3);
    for (const auto boundary : {BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None}) {
        options.boundary = boundary;
        const auto slow = refine<double>(mesh, options, levels).value();
        SchemeLevel scheme = control_level(mesh, boundary);
        for (int l = 0; l <= levels; ++l) {
            SCOPED_TRACE(testing::Message() << "level " << l);
            MeshData expected = by_levels(mesh, slow.levels[l], scheme, l, boundary);
            const auto made = refined_mesh(mesh, options, Precision::Double, l, LevelOrder::Split).value();
            ASSERT_NO_FATAL_FAILURE(expect_equal(made, expected));
            const auto lattice =
                refined_mesh(mesh, options, Precision::Double, l, LevelOrder::Lattice).value();
            MeshData back = renumbered(lattice, mesh.topology(), l);
            back.creases = sorted(std::move(back.creases));
            expected.creases = sorted(std::move(expected.creases));
            ASSERT_NO_FATAL_FAILURE(expect_equal(back, expected));
            if (l < levels) scheme = next_level(scheme, options).value().child;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, RefinedMeshOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(RefinedMesh, HasTheBitsOfRefineInFloat) {
    const auto mesh = tests::load_model(tests::model_path("isolated-vertex-middle")).mesh;
    const auto slow = refine<float>(mesh, {}, 2).value();
    const auto fast = refined_mesh(mesh, {}, Precision::Float, 2, LevelOrder::Split).value();
    EXPECT_EQ(fast.positions, slow.levels.back().positions);
}

TEST(RefinedMesh, NumbersTheLatticeFaceAfterFace) {
    const auto mesh = tests::load_model(tests::model_path("tetrahedron")).mesh;
    const auto made = refined_mesh(mesh, {}, Precision::Double, 2, LevelOrder::Lattice).value();
    const auto refiner = LatticeRefiner::make(mesh, {}, 2).value();
    std::vector<Triangle> faces(static_cast<std::size_t>(refiner.order().face_count()));
    refiner.triangles(faces);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(made.face_corners[3 * f + c], faces[f][c]);
}

TEST(RefinedMesh, RefusesWhatRefineRefuses) {
    const auto huge = tests::mesh_of(tests::data_of({{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    const auto error = [&](Precision precision, int level) {
        return refined_mesh(huge, {}, precision, level, LevelOrder::Split).error().code;
    };
    EXPECT_EQ(error(Precision::Float, 1), ErrorCode::NotFinite);
    EXPECT_EQ(error(Precision::Double, 16), ErrorCode::TooLarge);
}

}  // namespace
}  // namespace loopcheck::core
