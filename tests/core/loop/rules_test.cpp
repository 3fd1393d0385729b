#include "core/loop/rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/loop/refine.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::mesh_of;
using Kind = VertexClass::Kind;

TEST(RuleOf, CountsSharpEdges) {
    EXPECT_EQ(rule_of(0, 0), VertexRule::Smooth);
    EXPECT_EQ(rule_of(0, 1), VertexRule::Dart);
    EXPECT_EQ(rule_of(0, 2), VertexRule::Crease);
    for (const int edges : {3, 4, 5, 100}) EXPECT_EQ(rule_of(0, edges), VertexRule::Corner) << edges;
}

TEST(RuleOf, ASharpVertexIsACorner) {
    for (const float s : {1e-6F, 0.5F, 3.0F, 10.0F})
        for (int edges = 0; edges < 5; ++edges) EXPECT_EQ(rule_of(s, edges), VertexRule::Corner) << s;
}

TEST(VertexRules, CountSharpAndSemiSharpEdgesAlike) {
    for (const float s : {0.25F, 10.0F})
        for (int edges = 0; edges <= 5; ++edges) {
            MeshData data = tests::wheel(5);
            for (Index i = 1; i <= edges; ++i) data.creases.push_back({0, i, s});
            const auto mesh = mesh_of(std::move(data));
            const auto rules = vertex_rules(mesh.topology(), control_sharpness(mesh, BoundaryRule::EdgeOnly));
            EXPECT_EQ(rules[0], rule_of(0, edges)) << edges;
            // The boundary has two sharp edges; a spoke is a third one.
            for (Index i = 1; i <= 5; ++i)
                EXPECT_EQ(rules[i], i <= edges ? VertexRule::Corner : VertexRule::Crease) << i;
        }
}

TEST(VertexClass, NamesAreStable) {
    EXPECT_EQ(to_string(VertexClass{Kind::Interior, 6}), "interior 6");
    EXPECT_EQ(to_string(VertexClass{Kind::Interior, 13}), "interior 13");
    EXPECT_EQ(to_string(VertexClass{Kind::Boundary, 0}), "boundary");
    EXPECT_EQ(to_string(VertexClass{Kind::Crease, 0}), "crease");
    EXPECT_EQ(to_string(VertexClass{Kind::Dart, 0}), "dart");
    EXPECT_EQ(to_string(VertexClass{Kind::Corner, 0}), "corner");
    EXPECT_EQ(to_string(VertexClass{Kind::SemiSharp, 0}), "semi-sharp");
    EXPECT_EQ(to_string(VertexClass{Kind::Isolated, 0}), "isolated");
}

// The class of vertex 0 of a wheel of valence 5 with so many spokes of a sharpness.
VertexClass hub(int spokes, float sharpness, float own = 0) {
    MeshData data = tests::wheel(5);
    for (Index i = 1; i <= spokes; ++i) data.creases.push_back({0, i, sharpness});
    data.corners = {{0, own}};
    return control_level(mesh_of(std::move(data)), BoundaryRule::EdgeOnly).classes[0];
}

TEST(Classify, TellsTheVerticesInsideApart) {
    EXPECT_EQ(hub(0, 0), (VertexClass{Kind::Interior, 5}));
    EXPECT_EQ(hub(1, 10), (VertexClass{Kind::Dart, 0}));
    EXPECT_EQ(hub(2, 10), (VertexClass{Kind::Crease, 0}));
    EXPECT_EQ(hub(3, 10), (VertexClass{Kind::Corner, 0}));
    EXPECT_EQ(hub(0, 0, 10), (VertexClass{Kind::Corner, 0}));
    EXPECT_EQ(hub(1, 0.5F), (VertexClass{Kind::SemiSharp, 0}));
    EXPECT_EQ(hub(5, 9.5F), (VertexClass{Kind::SemiSharp, 0}));
    EXPECT_EQ(hub(0, 0, 2), (VertexClass{Kind::SemiSharp, 0}));
}

TEST(Classify, TellsTheVerticesOfTheBoundaryApart) {
    MeshData data = tests::square();
    data.positions.push_back({1, 2, 3});
    const auto mesh = mesh_of(std::move(data));
    const VertexClass boundary{Kind::Boundary, 0}, corner{Kind::Corner, 0}, isolated{Kind::Isolated, 0};
    EXPECT_EQ(control_level(mesh, BoundaryRule::EdgeAndCorner).classes,
              (std::vector{boundary, corner, boundary, corner, isolated}));
    EXPECT_EQ(control_level(mesh, BoundaryRule::EdgeOnly).classes,
              (std::vector{boundary, boundary, boundary, boundary, isolated}));
}

// A sharpness of 1/2 on edge 01 decides the first step: of its two ends and of its edge point.
TEST(Classify, WhatComesFromAFiniteSharpnessIsSemiSharp) {
    MeshData data = tests::tetrahedron();
    data.creases = {{0, 1, 0.5F}};
    const auto steps = tests::steps_of(mesh_of(std::move(data)), {}, 2);
    const auto semi_sharp = [](const SchemeLevel& level) {
        std::vector<Index> out;
        for (Index v = 0; v < level.topology.vertex_count; ++v)
            if (level.classes[v].kind == Kind::SemiSharp) out.push_back(v);
        return out;
    };
    EXPECT_EQ(semi_sharp(steps[0].child), (std::vector<Index>{0, 1, 6}));
    EXPECT_EQ(semi_sharp(steps[1].child), std::vector<Index>{});
}

TEST(HasFiniteSharpness, IsAboutTheVertexAndItsEdges) {
    MeshData data = tests::wheel(5);
    data.creases = {{0, 2, 1.5F}, {0, 3, 10}};
    data.corners = {{1, 0.5F}, {4, 10}};
    const auto mesh = mesh_of(std::move(data));
    const auto sharpness = control_sharpness(mesh, BoundaryRule::EdgeOnly);
    const bool expected[] = {true, true, true, false, false, false};
    for (Index v = 0; v < 6; ++v)
        EXPECT_EQ(has_finite_sharpness(mesh.topology(), sharpness, v), expected[v]) << v;
}

class ClassesOf : public testing::TestWithParam<std::string> {};

// New vertices inside, away from every sharp edge, are regular: only control vertices are extraordinary.
TEST_P(ClassesOf, RefinementMakesNoExtraordinaryVertex) {
    const auto model = tests::load_model(GetParam());
    const auto steps = tests::steps_of(model.mesh, model.options, 3);
    for (const auto& step : steps) {
        ASSERT_EQ(step.child.classes.size(), static_cast<std::size_t>(step.child.topology.vertex_count));
        for (Index v = model.mesh.vertex_count(); v < step.child.topology.vertex_count; ++v) {
            const VertexClass c = step.child.classes[v];
            ASSERT_EQ(c.valence, c.kind == Kind::Interior ? 6 : 0) << v;
            ASSERT_NE(c.kind, Kind::Isolated) << v;
        }
    }
}

TEST_P(ClassesOf, BlendedRowsAreSemiSharp) {
    const auto model = tests::load_model(GetParam());
    for (const auto& step : tests::steps_of(model.mesh, model.options, 3))
        for (Index v = 0; v < step.child.topology.vertex_count; ++v)
            if (step.rows.mask(v).is_blended()) {
                ASSERT_EQ(step.child.classes[v].kind, Kind::SemiSharp) << v;
            }
}

INSTANTIATE_TEST_SUITE_P(Models, ClassesOf, testing::ValuesIn(tests::model_files()), tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
