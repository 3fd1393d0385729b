#include "core/mesh/options.h"

#include <gtest/gtest.h>

#include "core/mesh/refinement.h"

namespace loopcheck::core {
namespace {

TEST(Options, NamesAreStable) {
    EXPECT_EQ(name(BoundaryRule::None), "none");
    EXPECT_EQ(name(BoundaryRule::EdgeOnly), "edge-only");
    EXPECT_EQ(name(BoundaryRule::EdgeAndCorner), "edge-and-corner");
    EXPECT_EQ(name(Creasing::Uniform), "uniform");
    EXPECT_EQ(name(Creasing::Chaikin), "chaikin");
    EXPECT_EQ(name(Weights::Loop), "loop");
    EXPECT_EQ(name(Weights::Warren), "warren");
    EXPECT_EQ(name(Precision::Float), "float");
    EXPECT_EQ(name(Precision::Double), "double");
}

TEST(Options, EveryNameIsReadBack) {
    for (const auto rule : {BoundaryRule::None, BoundaryRule::EdgeOnly, BoundaryRule::EdgeAndCorner})
        EXPECT_EQ(parse_boundary_rule(name(rule)), rule);
    for (const auto creasing : {Creasing::Uniform, Creasing::Chaikin})
        EXPECT_EQ(parse_creasing(name(creasing)), creasing);
    for (const auto weights : {Weights::Loop, Weights::Warren})
        EXPECT_EQ(parse_weights(name(weights)), weights);
}

TEST(Options, NothingElseIsRead) {
    for (const char* text : {"", " ", "Edge-Only", "edge-only ", "edge", "edge_only", "loops", "normal"}) {
        EXPECT_FALSE(parse_boundary_rule(text)) << text;
        EXPECT_FALSE(parse_creasing(text)) << text;
        EXPECT_FALSE(parse_weights(text)) << text;
    }
    EXPECT_FALSE(parse_boundary_rule("chaikin"));
    EXPECT_FALSE(parse_creasing("none"));
    EXPECT_FALSE(parse_weights("uniform"));
}

TEST(Options, DefaultIsLoopWithCornersKept) {
    const SchemeOptions options;
    EXPECT_EQ(options.boundary, BoundaryRule::EdgeAndCorner);
    EXPECT_EQ(options.creasing, Creasing::Uniform);
    EXPECT_EQ(options.weights, Weights::Loop);
    EXPECT_EQ(options.crease_share, CreaseShare::Clamped);
}

TEST(VertexRule, NamesAreStable) {
    EXPECT_EQ(name(VertexRule::Smooth), "smooth");
    EXPECT_EQ(name(VertexRule::Dart), "dart");
    EXPECT_EQ(name(VertexRule::Crease), "crease");
    EXPECT_EQ(name(VertexRule::Corner), "corner");
}

}  // namespace
}  // namespace loopcheck::core
