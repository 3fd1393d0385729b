#include "core/loop/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/results.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::load_model;
using tests::mesh_of;
using tests::Observed;
using tests::Positions;
using tests::positions_of;
using tests::steps_of;
using tests::value_of;

constexpr SchemeOptions kEdgeAndCorner{.boundary = BoundaryRule::EdgeAndCorner};
constexpr SchemeOptions kNoRule{.boundary = BoundaryRule::None};

// The positions of level 1 in exact fractions; every one is a whole number or half of one.
Positions exact_level_1(MeshData data, const SchemeOptions& options) {
    const auto mesh = mesh_of(std::move(data));
    const auto levels = positions_of<Rational>(steps_of(mesh, options, 1), options.weights, mesh);
    Positions out;
    for (const auto& p : levels[1]) {
        EXPECT_TRUE(denominator(p.x) <= 2 && denominator(p.y) <= 2 && denominator(p.z) <= 2);
        out.push_back({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
    return out;
}

Positions level_1(MeshData data, const SchemeOptions& options) {
    return value_of(refine<double>(mesh_of(std::move(data)), options, 1)).levels.at(1).positions;
}

// Vertex points 7/16 and 3/16, edge points 3/8 and 1/8; edges 02 21 10 13 30 32.
TEST(Refine, TheTetrahedronAsWrittenByHand) {
    EXPECT_EQ(exact_level_1(tests::tetrahedron(), {}), (Positions{{3, 3, 3},
                                                                  {7, 3, 3},
                                                                  {3, 7, 3},
                                                                  {3, 3, 7},
                                                                  {2, 6, 2},
                                                                  {6, 6, 2},
                                                                  {6, 2, 2},
                                                                  {6, 2, 6},
                                                                  {2, 2, 6},
                                                                  {2, 6, 6}}));
}

// All weights are fractions over a power of two: double is exact.
TEST(Refine, TheSquareAsWrittenByHand) {
    const Positions edge_points{{4, 0, 0}, {8, 4, 0}, {4, 4, 0}, {4, 8, 0}, {0, 4, 0}};
    Positions kept{{1, 1, 0}, {8, 0, 0}, {7, 7, 0}, {0, 8, 0}};
    Positions rounded{{1, 1, 0}, {7, 1, 0}, {7, 7, 0}, {1, 7, 0}};
    for (auto* points : {&kept, &rounded})
        points->insert(points->end(), edge_points.begin(), edge_points.end());
    EXPECT_EQ(level_1(tests::square(), kEdgeAndCorner), kept);
    EXPECT_EQ(level_1(tests::square(), tests::kEdgeOnly), rounded);
    EXPECT_EQ(level_1(tests::square(), kNoRule), rounded);
}

TEST(Refine, TheTriangleAsWrittenByHand) {
    const Positions kept{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    const Positions rounded{{1, 1, 0}, {6, 1, 0}, {1, 6, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    EXPECT_EQ(level_1(tests::triangle(), kEdgeAndCorner), kept);
    EXPECT_EQ(level_1(tests::triangle(), tests::kEdgeOnly), rounded);
    EXPECT_EQ(level_1(tests::triangle(), kNoRule), rounded);
}

// The cubic B-spline of the square's boundary, two levels deep: the corner (8, 0) goes to (7, 1), and then to
// 3/4 (7, 1) + 1/8 ((4, 0) + (8, 4)) = (6.75, 1.25).
TEST(Refine, TheBoundaryTwoLevelsDeepAsWrittenByHand) {
    const auto levels = value_of(refine<double>(mesh_of(tests::square()), tests::kEdgeOnly, 2)).levels;
    EXPECT_EQ(levels.at(2).positions.at(1), glm::dvec3(6.75, 1.25, 0));
    EXPECT_EQ(levels.at(2).positions.at(0), glm::dvec3(1.25, 1.25, 0));
}

TEST(Refine, ASemiSharpEdgeAsWrittenByHand) {
    MeshData data = tests::tetrahedron();
    data.creases = {{0, 1, 0.5F}};
    // Half of (6, 2, 2) and half of the midpoint (8, 0, 0).  The other edge points are not touched.
    const auto points = exact_level_1(data, {});
    EXPECT_EQ(points[6], glm::dvec3(7, 1, 1));
    EXPECT_EQ(points[4], glm::dvec3(2, 6, 2));
}

TEST(Refine, LevelZeroIsTheControlMesh) {
    MeshData data = tests::square();
    data.positions.push_back({0.1, 0.2, 0.3});
    const auto levels = value_of(refine<double>(mesh_of(data), {}, 0)).levels;
    ASSERT_EQ(levels.size(), 1U);
    EXPECT_EQ(levels[0].positions, data.positions);
    EXPECT_EQ(levels[0].triangles, (tests::Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(levels[0].ancestors.empty());
    EXPECT_EQ(levels[0].tags, (std::vector<VertexTag>{{VertexRule::Crease, true},
                                                      {VertexRule::Corner, true},
                                                      {VertexRule::Crease, true},
                                                      {VertexRule::Corner, true},
                                                      {VertexRule::Corner, false}}));
}

TEST(Refine, FloatRefusesWhatDoesNotFit) {
    MeshData data = tests::square();
    data.positions[2].z = 1e300;
    const auto mesh = mesh_of(std::move(data));
    const Error error = tests::error_of(refine<float>(mesh, {}, 1));
    EXPECT_EQ(error.code, ErrorCode::NotFinite);
    EXPECT_EQ(error.place, (Place{Place::Kind::Vertex, 2}));
    EXPECT_TRUE(refine<double>(mesh, {}, 1));
}

class RefinementOf : public testing::TestWithParam<std::string> {
  protected:
    static constexpr int kLevels = 3;
    const tests::LoadedModel model_ = load_model(GetParam());
    const std::vector<Step> steps_ = steps_of(model_.mesh, model_.options, kLevels);

    template <class Real>
    Refinement refined() const {
        return value_of(refine<Real>(model_.mesh, model_.options, kLevels));
    }
    const Topology& topology(std::size_t l) const {
        return l == 0 ? model_.mesh.topology() : steps_[l - 1].child.topology;
    }

    // Whatever way `refine` takes, its bits are those of the rows.
    template <class Real>
    void expect_the_bits_of_the_rows(Precision precision) const {
        const auto refinement = refined<Real>();
        const auto expected = positions_of<Real>(steps_, model_.options.weights, model_.mesh);
        EXPECT_EQ(refinement.precision, precision);
        ASSERT_EQ(refinement.levels.size(), expected.size());
        for (std::size_t l = 0; l < expected.size(); ++l) {
            const auto& got = refinement.levels[l].positions;
            ASSERT_EQ(got.size(), expected[l].size());
            for (std::size_t v = 0; v < got.size(); ++v)
                for (int i = 0; i < 3; ++i)
                    ASSERT_EQ(std::bit_cast<std::uint64_t>(got[v][i]),
                              std::bit_cast<std::uint64_t>(static_cast<double>(expected[l][v][i])))
                        << l << " " << v;
        }
    }
};

TEST_P(RefinementOf, HasTheBitsOfTheRowsInDouble) {
    expect_the_bits_of_the_rows<double>(Precision::Double);
}

TEST_P(RefinementOf, HasTheBitsOfTheRowsInFloat) {
    expect_the_bits_of_the_rows<float>(Precision::Float);
}

TEST_P(RefinementOf, SaysWhereEveryVertexComesFromAndWhatItIs) {
    const auto levels = refined<double>().levels;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const auto& sharpness =
            l == 0 ? control_sharpness(model_.mesh, model_.options.boundary) : steps_[l - 1].child.sharpness;
        const auto rules = vertex_rules(topology(l), sharpness);
        EXPECT_EQ(levels[l].triangles, topology(l).triangles);
        EXPECT_EQ(levels[l].ancestors, l > 0 ? ancestors_of_split(topology(l - 1)) : std::vector<Ancestor>{});
        ASSERT_EQ(levels[l].tags.size(), rules.size());
        for (Index v = 0; v < topology(l).vertex_count; ++v)
            ASSERT_EQ(levels[l].tags[v], (VertexTag{rules[v], topology(l).is_boundary_vertex(v)})) << v;
    }
}

// Vertices that are infinitely sharp, or where three infinitely sharp edges meet, and isolated ones.
TEST_P(RefinementOf, CornersAndIsolatedVerticesStayWhereTheyAre) {
    const Topology& t = model_.mesh.topology();
    const auto sharpness = control_sharpness(model_.mesh, model_.options.boundary);
    const auto in_double = refined<double>(), in_float = refined<float>();
    for (Index v = 0; v < t.vertex_count; ++v) {
        const auto ring = t.ring(v);
        const auto edges =
            std::count_if(ring.begin(), ring.end(), [&](Index e) { return is_infinite(sharpness.edge[e]); });
        if (!is_infinite(sharpness.vertex[v]) && edges < 3) continue;
        for (const auto* refinement : {&in_double, &in_float})
            for (const auto& level : refinement->levels)
                EXPECT_EQ(level.positions[v], refinement->levels[0].positions[v]) << v;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, RefinementOf, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
