// Every file in models/ is accepted, and every file in models/reject/ is refused for the reason in its name.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>

#include "core/mesh/io/model.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/topology_faults.h"

namespace loopcheck::core {
namespace {

using tests::faults_of;
using tests::load_model;

class ModelFile : public testing::TestWithParam<std::string> {};

TEST_P(ModelFile, IsReadWithoutAWarningAndAccepted) {
    const auto model = tests::value_of(read_model(GetParam()));
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    EXPECT_FALSE(model.description.empty());
    const auto mesh = TriangleMesh::make(model.data);
    ASSERT_TRUE(mesh) << to_string(mesh.error());
    EXPECT_EQ(faults_of(mesh->topology()), "");
}

// The orders that Topology promises for level 0.
TEST_P(ModelFile, IsNumberedInTheOrderOfItsFaces) {
    const auto model = load_model(GetParam());
    const Topology& t = model.mesh.topology();
    Index met = 0;
    std::vector<Index> first_out(t.vertex_count, kNone);
    for (Index f = 0; f < t.face_count(); ++f)
        for (int i = 0; i < 3; ++i) {
            const Index e = t.face_edges[f][i], v = t.triangles[f][i];
            ASSERT_LE(e, met);
            if (first_out[v] == kNone) first_out[v] = e;
            if (e < met) continue;
            ++met;
            EXPECT_EQ(t.edge_ends[e], (std::array{v, t.triangles[f][next_corner(i)]})) << e;
        }
    EXPECT_EQ(met, t.edge_count());
    for (Index v = 0; v < t.vertex_count; ++v)
        if (!t.is_isolated(v) && !t.is_boundary_vertex(v)) {
            EXPECT_EQ(t.ring(v).front(), first_out[v]) << v;
        } else if (t.is_boundary_vertex(v)) {
            EXPECT_EQ(t.edge_ends[t.ring(v).front()][0], v) << v;
        }
}

// Roots of the sets that the pairs join.
std::vector<Index> joined(Index count, const std::vector<std::array<Index, 2>>& pairs) {
    std::vector<Index> root(count);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](Index i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    };
    for (const auto& [a, b] : pairs) root[find(a)] = find(b);
    for (Index i = 0; i < count; ++i) root[i] = find(i);
    return root;
}

struct Shape {
    int components = 0, boundaries = 0, isolated = 0, euler = 0;
};

// A boundary is a cycle of boundary edges; each of its vertices has two of them.
Shape shape_of(const Topology& t) {
    const auto is_root = [](const std::vector<Index>& root, Index v) { return root[v] == v; };
    std::vector<std::array<Index, 2>> boundary;
    for (Index e = 0; e < t.edge_count(); ++e)
        if (t.is_boundary_edge(e)) boundary.push_back(t.edge_ends[e]);
    const auto component = joined(t.vertex_count, t.edge_ends), cycle = joined(t.vertex_count, boundary);
    Shape shape;
    for (Index v = 0; v < t.vertex_count; ++v) {
        if (t.is_isolated(v))
            ++shape.isolated;
        else if (is_root(component, v))
            ++shape.components;
        if (t.is_boundary_vertex(v) && is_root(cycle, v)) ++shape.boundaries;
    }
    shape.euler = t.vertex_count - t.edge_count() + t.face_count();
    return shape;
}

// V - E + F = sum over components of (2 - 2 genus - boundaries), and 1 for an isolated vertex.
TEST_P(ModelFile, HasTheEulerCharacteristicOfAnOrientableSurface) {
    const auto shape = shape_of(load_model(GetParam()).mesh.topology());
    const int twice_genus = 2 * shape.components - shape.boundaries + shape.isolated - shape.euler;
    EXPECT_GE(twice_genus, 0);
    EXPECT_EQ(twice_genus % 2, 0);
}

INSTANTIATE_TEST_SUITE_P(Models, ModelFile, testing::ValuesIn(tests::model_files()), tests::model_test_name);

TEST(ModelFiles, HaveTheEulerCharacteristicOfTheirNames) {
    const std::map<std::string, int> expected{{"tetrahedron", 2},
                                              {"octahedron", 2},
                                              {"icosahedron", 2},
                                              {"pillow", 2},
                                              {"torus", 0},
                                              {"genus-2", -2},
                                              {"annulus", 0},
                                              {"single-triangle", 1},
                                              {"square-diagonal-a", 1},
                                              {"grid-4x4", 1},
                                              {"fan-9", 1},
                                              {"bipyramid-360", 2},
                                              {"isolated-vertex-last", 3},
                                              {"two-components", 4},
                                              {"cow", 2},
                                              {"mixed-valence", 2},
                                              {"two-components-open-closed", 3}};
    for (const auto& [name, euler] : expected)
        EXPECT_EQ(shape_of(load_model(tests::model_path(name)).mesh.topology()).euler, euler) << name;
}

class RejectedFile : public testing::TestWithParam<std::string> {
  protected:
    static std::string text() {
        std::ifstream file(GetParam(), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
};

// The code in a line "reject: CODE: why".
std::string code_in(const std::string& text) {
    const std::string mark = "reject: ";
    const auto start = text.find(mark) + mark.size();
    return text.substr(start, text.find(':', start) - start);
}

// The reason for which a file is refused, by the reader or by the mesh, at a line where one is known.
Error refusal_of(const std::string& file) {
    const auto model = read_model(file);
    if (!model) return model.error();
    Error error = tests::error_of(TriangleMesh::make(model->data));
    error.place = model->locate(error.place);
    return error;
}

bool has_a_place(ErrorCode code) {
    // What is missing has no line, and a model does not keep the lines of its creases.
    return code != ErrorCode::EmptyMesh && code != ErrorCode::NoSuchEdge;
}

TEST_P(RejectedFile, IsRefusedForTheReasonInItsName) {
    const Error error = refusal_of(GetParam());
    EXPECT_EQ(code_name(error.code), code_in(text())) << to_string(error);
    const std::string name = std::filesystem::path(GetParam()).filename().string();
    EXPECT_TRUE(name.starts_with(code_name(error.code))) << to_string(error);
    EXPECT_EQ(error.sentence.back(), '.') << to_string(error);
    fmt::print("[ OBSERVED ] {}\n", to_string(error));
}

TEST_P(RejectedFile, IsRefusedWithTheLine) {
    const Error error = refusal_of(GetParam());
    if (!has_a_place(error.code)) {
        EXPECT_EQ(error.place, Place{});
        return;
    }
    const std::string bytes = text();
    EXPECT_EQ(error.place.kind, Place::Kind::Line) << to_string(error);
    EXPECT_GE(error.place.index, 1);
    EXPECT_LE(error.place.index, std::count(bytes.begin(), bytes.end(), '\n') + 1) << to_string(error);
}

INSTANTIATE_TEST_SUITE_P(Models, RejectedFile, testing::ValuesIn(tests::rejected_files()),
                         tests::file_test_name);

}  // namespace
}  // namespace loopcheck::core
