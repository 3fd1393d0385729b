#include "compare/explain.h"

#include <gtest/gtest.h>

#include "tests/compare/support.h"

namespace loopcheck::compare {
namespace {

using test::model_mesh;

std::string explain_vertex(const std::string& model, core::Index vertex, core::SchemeOptions options = {},
                           int level = 1, CountFrom from = CountFrom::Zero) {
    const auto text = explain(model_mesh(model), options, level, vertex, built_in_subjects(), from);
    return text ? *text : core::to_string(text.error());
}

#define EXPECT_SAYS(text, what) EXPECT_NE((text).find(what), std::string::npos) << (text)

TEST(Explain, SaysWhyATwoFaceBoundaryVertexIsNotKept) {
    const auto text = explain_vertex("square-diagonal-a", 0);
    EXPECT_SAYS(text, "It is a boundary vertex of 2 faces; boundary edges are infinitely sharp.");
    EXPECT_SAYS(text, "edge-and-corner keeps only boundary vertices of exactly one face");
    EXPECT_SAYS(text, "3/4");
    EXPECT_SAYS(text, "1/8");
}

TEST(Explain, SaysWhyAOneFaceBoundaryVertexIsKept) {
    EXPECT_SAYS(explain_vertex("single-triangle", 0),
                "keeps boundary vertices of exactly one face: the corner rule.");
    core::SchemeOptions edge_only;
    edge_only.boundary = core::BoundaryRule::EdgeOnly;
    EXPECT_SAYS(explain_vertex("single-triangle", 0, edge_only), "those of the boundary: the crease rule.");
}

TEST(Explain, GivesTheFormulaOfAnIrrationalWeight) {
    const auto text = explain_vertex("icosahedron", 3);
    EXPECT_SAYS(text, "It is an interior vertex of valence 5.");
    EXPECT_SAYS(text, "b(5) = (5/8 - (3/8 + cos(2 pi/5)/4)^2)/5 = 0.084093218925");
    EXPECT_SAYS(text, "(irrational)");
}

TEST(Explain, GivesWarrensWeightAsAFraction) {
    core::SchemeOptions options;
    options.weights = core::Weights::Warren;
    EXPECT_SAYS(explain_vertex("icosahedron", 3, options), "3/(8*5) = 3/40");
}

TEST(Explain, ShowsTheBlendOfASemiSharpEdge) {
    // The first crease of the model has the sharpness 1/4; find its edge point by the text.
    const auto mesh = model_mesh("semi-sharp-edge-0.25");
    core::Index edge = 0;
    while (mesh.edge_sharpness()[edge] == 0) ++edge;
    const auto text = explain_vertex("semi-sharp-edge-0.25", mesh.vertex_count() + edge);
    EXPECT_SAYS(text, "rule: edge point, 0.25 crease + 0.75 smooth");
    EXPECT_SAYS(text, "13/32");  // 1/4 * 1/2 + 3/4 * 3/8
    EXPECT_SAYS(text, "3/32");   // 3/4 * 1/8
}

TEST(Explain, CountsFromOneWhenAsked) {
    const auto from_zero = explain_vertex("cow", 17);
    const auto from_one = explain_vertex("cow", 17, {}, 1, CountFrom::One);
    EXPECT_SAYS(from_zero, "vertex 17 of level 1 (vertices counted from 0)");
    EXPECT_SAYS(from_one, "vertex 18 of level 1 (vertices counted from 1)");
    EXPECT_SAYS(from_one, "the vertex point of vertex 18 of level 0");
}

TEST(Explain, ListsEverySubject) {
    const auto text = explain_vertex("crease-straight", 0);
    for (const Subject& subject : built_in_subjects()) EXPECT_SAYS(text, "\n  " + subject.name);
    EXPECT_SAYS(text, "\n  exact");
}

TEST(Explain, RefusesAVertexThatDoesNotExist) {
    EXPECT_SAYS(explain_vertex("tetrahedron", 10), "Level 1 has the vertices 0 to 9. [index-out-of-range]");
    EXPECT_SAYS(explain_vertex("tetrahedron", -1), "[index-out-of-range]");
    EXPECT_SAYS(explain_vertex("tetrahedron", 10, {}, 1, CountFrom::One), "1 to 10");
}

TEST(Explain, KnowsIsolatedVertices) {
    const auto mesh = model_mesh("isolated-vertex-last");
    EXPECT_SAYS(explain_vertex("isolated-vertex-last", mesh.vertex_count() - 1), "so it stays where it is");
}

std::string explain_limit_of(const std::string& model, core::Index vertex, int level = 0,
                             CountFrom from = CountFrom::Zero) {
    const auto text = explain_limit(model_mesh(model), {}, level, vertex, from);
    return text ? *text : core::to_string(text.error());
}

TEST(ExplainLimit, ShowsTheFractionsOfADart) {
    const auto text = explain_limit_of("dart-valence-06", 6);
    EXPECT_SAYS(text, "class: dart");
    EXPECT_SAYS(text, "7/71");
    EXPECT_SAYS(text, "110/213");
    EXPECT_SAYS(text, "two directions that span the tangent plane");
}

TEST(ExplainLimit, SaysWhatTheCurvatureIs) {
    EXPECT_SAYS(explain_limit_of("tetrahedron", 0), "The curvature of the surface around it is unbounded.");
    EXPECT_SAYS(explain_limit_of("icosahedron", 0), "The curvature of the surface around it is bounded.");
    EXPECT_SAYS(explain_limit_of("torus", 0), "The curvature of the surface around it is continuous.");
}

TEST(ExplainLimit, ShowsBothSidesOfACrease) {
    const auto text = explain_limit_of("crease-loop-irregular", 2);
    EXPECT_SAYS(text, "class: crease");
    EXPECT_SAYS(text, "sector 1, ");
    EXPECT_SAYS(text, "sector 2, ");
}

TEST(ExplainLimit, SaysWhyThereIsNoNormal) {
    EXPECT_SAYS(explain_limit_of("boundary-vertex-20-faces", 0), "limit normal: undefined.");
    EXPECT_SAYS(explain_limit_of("isolated-vertex-last", 12), "It is in no face");
}

TEST(ExplainLimit, RefinesASemiSharpVertexFirst) {
    const auto text = explain_limit_of("semi-sharp-vertex-1.5", 8);
    EXPECT_SAYS(text, "class: semi-sharp");
    EXPECT_SAYS(text, "its ring was refined until that was gone");
}

TEST(ExplainLimit, NamesTheVerticesOfTheLevelWhereThereIsNone) {
    EXPECT_SAYS(explain_limit_of("tetrahedron", 4), "Level 0 has the vertices 0 to 3.");
    EXPECT_SAYS(explain_limit_of("tetrahedron", -1, 0, CountFrom::One), "Level 0 has the vertices 1 to 4.");
}

}  // namespace
}  // namespace loopcheck::compare
