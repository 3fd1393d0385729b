#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "reference/opensubdiv/catmull_clark.h"
#include "reference/opensubdiv/opensubdiv.h"
#include "tests/support/results.h"

namespace loopcheck::reference {
namespace {

using core::BoundaryRule;
using core::ErrorCode;
using core::Index;
using core::MeshData;
using core::Precision;
using namespace tests;

// A quad 0 1 2 3, and a second one, 1 4 5 2, at its right.
MeshData quads(int count) {
    MeshData data;
    data.positions = {{0, 0, 0}, {8, 0, 1}, {9, 7, 0}, {0, 8, 5}};
    data.add_face(Quad{0, 1, 2, 3});
    if (count == 2) {
        data.positions.insert(data.positions.end(), {{16, 0, 3}, {15, 9, 2}});
        data.add_face(Quad{1, 4, 5, 2});
    }
    return data;
}

MeshData cube() {
    MeshData data;
    for (int k = 0; k < 8; ++k) data.positions.emplace_back(k % 2, k / 2 % 2, k / 4);
    for (const Quad& face : {Quad{0, 2, 3, 1}, Quad{4, 5, 7, 6}, Quad{0, 1, 5, 4}, Quad{2, 6, 7, 3},
                             Quad{0, 4, 6, 2}, Quad{1, 3, 7, 5}})
        data.add_face(face);
    return data;
}

core::Result<CatmullClark> refine(const MeshData& data, int levels,
                                  BoundaryRule boundary = BoundaryRule::EdgeAndCorner,
                                  Precision precision = Precision::Double) {
    return opensubdiv_catmull_clark(data, boundary, levels, precision);
}

TEST(OpensubdivCatmullClark, SplitsEveryQuadInFourAtEveryLevel) {
    const auto made = value_of(refine(cube(), 3));
    ASSERT_EQ(made.levels.size(), 4U);
    EXPECT_TRUE(made.levels[0].ancestors.empty());
    EXPECT_EQ(made.levels[0].positions, cube().positions);
    for (std::size_t l = 1; l < 4; ++l) {
        const auto &parent = made.levels[l - 1], &level = made.levels[l];
        EXPECT_EQ(level.faces.size(), 4 * parent.faces.size());
        // V + E + F, and on a closed mesh of quads E = 2 F.
        EXPECT_EQ(level.positions.size(), parent.positions.size() + 3 * parent.faces.size());
        EXPECT_EQ(level.ancestors.size(), level.positions.size());
        EXPECT_EQ(level.limit.positions.size(), level.positions.size());
        EXPECT_EQ(level.limit.tangent1.size(), level.positions.size());
        EXPECT_EQ(level.limit.tangent2.size(), level.positions.size());
    }
}

TEST(OpensubdivCatmullClark, AncestorsAreVerticesEdgesAndFacesEachOnce) {
    const auto made = value_of(refine(cube(), 2));
    for (std::size_t l = 1; l < made.levels.size(); ++l) {
        const auto& parent = made.levels[l - 1];
        std::set<std::vector<Index>> seen;
        std::size_t with[5] = {};
        for (const QuadAncestor& ancestor : made.levels[l].ancestors) {
            std::vector<Index> vertices(ancestor.vertices.begin(),
                                        ancestor.vertices.begin() + ancestor.count);
            ++with[ancestor.count];
            if (ancestor.count == 4) {
                EXPECT_NE(std::find(parent.faces.begin(), parent.faces.end(), ancestor.vertices),
                          parent.faces.end());
            }
            std::sort(vertices.begin(), vertices.end());
            EXPECT_TRUE(seen.insert(vertices).second);
        }
        EXPECT_EQ(with[1], parent.positions.size());
        EXPECT_EQ(with[2], 2 * parent.faces.size());
        EXPECT_EQ(with[4], parent.faces.size());
    }
}

// A face point is the mean of its ancestor, also an edge point of the boundary; an edge point inside is the
// mean of its two and of two face points.
TEST(OpensubdivCatmullClark, PositionsAreThoseOfTheAncestors) {
    const auto made = value_of(refine(quads(2), 1));
    const auto& parent = made.levels[0].positions;
    int inner = 0;
    for (std::size_t k = 0; k < made.levels[1].positions.size(); ++k) {
        const QuadAncestor& ancestor = made.levels[1].ancestors[k];
        if (ancestor.count == 1) continue;
        glm::dvec3 mean(0);
        for (int c = 0; c < ancestor.count; ++c)
            mean += parent[ancestor.vertices[c]] / static_cast<double>(ancestor.count);
        const bool is_inner = ancestor.count == 2 &&
                              std::min(ancestor.vertices[0], ancestor.vertices[1]) == 1 &&
                              std::max(ancestor.vertices[0], ancestor.vertices[1]) == 2;
        if (is_inner) {
            ++inner;
            const auto centre = [&](Quad f) {
                return (parent[f[0]] + parent[f[1]] + parent[f[2]] + parent[f[3]]) / 4.0;
            };
            mean = (2.0 * mean + centre({0, 1, 2, 3}) + centre({1, 4, 5, 2})) / 4.0;
        }
        EXPECT_EQ(made.levels[1].positions[k], mean) << k;
    }
    EXPECT_EQ(inner, 1);
}

TEST(OpensubdivCatmullClark, KeepsCornersOnlyWhereAsked) {
    const auto kept = value_of(refine(quads(1), 1));
    const auto moved = value_of(refine(quads(1), 1, BoundaryRule::EdgeOnly));
    const auto p = quads(1).positions;
    for (std::size_t k = 0; k < kept.levels[1].positions.size(); ++k) {
        const QuadAncestor& ancestor = kept.levels[1].ancestors[k];
        if (ancestor.count != 1) continue;
        const auto v = static_cast<std::size_t>(ancestor.vertices[0]);
        EXPECT_EQ(kept.levels[1].positions[k], p[v]);
        EXPECT_EQ(moved.levels[1].positions[k], (6.0 * p[v] + p[(v + 1) % 4] + p[(v + 3) % 4]) / 8.0);
    }
}

TEST(OpensubdivCatmullClark, LimitOfARegularVertexIsThirtySixths) {
    // The middle of 3 x 3 points: with z = 36 there and 0 elsewhere the limit is 16.
    MeshData data;
    for (int k = 0; k < 9; ++k) data.positions.emplace_back(k % 3, k / 3, k == 4 ? 36 : 0);
    for (const Index a : {0, 1, 3, 4}) data.add_face(Quad{a, a + 1, a + 4, a + 3});
    const auto made = value_of(refine(data, 0));
    EXPECT_NEAR(made.levels[0].limit.positions[4].z, 16, 11 * 16 * 0x1p-53);
    EXPECT_EQ(made.levels[0].limit.positions[0], data.positions[0]);
}

TEST(OpensubdivCatmullClark, LevelsDoNotDependOnHowManyFollow) {
    const auto two = value_of(refine(cube(), 2)), three = value_of(refine(cube(), 3));
    for (std::size_t l = 0; l < 3; ++l) {
        EXPECT_EQ(two.levels[l].positions, three.levels[l].positions);
        EXPECT_EQ(two.levels[l].limit.positions, three.levels[l].limit.positions);
        EXPECT_EQ(two.levels[l].ancestors, three.levels[l].ancestors);
    }
}

TEST(OpensubdivCatmullClark, FloatIsFloat) {
    MeshData data = quads(1);
    for (auto& p : data.positions) p += glm::dvec3(1.0 / 3);
    const auto doubles = value_of(refine(data, 1));
    const auto floats = value_of(refine(data, 1, BoundaryRule::EdgeAndCorner, Precision::Float));
    EXPECT_EQ(floats.precision, Precision::Float);
    for (std::size_t k = 0; k < doubles.levels[1].positions.size(); ++k) {
        const double x = floats.levels[1].positions[k].x;
        EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
        EXPECT_NE(x, doubles.levels[1].positions[k].x);
    }
}

TEST(OpensubdivCatmullClark, RefusesWhatItCannotTake) {
    const auto code = [](MeshData data, int levels = 1) { return error_of(refine(data, levels)).code; };
    EXPECT_EQ(code({}), ErrorCode::EmptyMesh);
    EXPECT_EQ(code(quads(2), -1), ErrorCode::Unsupported);
    EXPECT_EQ(code(quads(1), kOpensubdivMaxLevels + 1), ErrorCode::Unsupported);

    MeshData data = quads(2);
    data.face_corners[5] = 6;
    EXPECT_EQ(code(data), ErrorCode::IndexOutOfRange);
    EXPECT_EQ(error_of(refine(data, 1)).place, (core::Place{core::Place::Kind::Face, 1}));
    data.face_corners[5] = -1;
    EXPECT_EQ(code(data), ErrorCode::IndexOutOfRange);
    data.face_corners[5] = 5;
    EXPECT_EQ(code(data), ErrorCode::RepeatedVertex);
    data.face_sizes[1] = 5;
    EXPECT_EQ(code(data), ErrorCode::IndexOutOfRange);

    data = quads(1);
    data.add_face(std::vector<Index>{0, 2, 1});
    EXPECT_EQ(code(data), ErrorCode::Unsupported);
    data = quads(1);
    data.creases = {{0, 1, 2}};
    EXPECT_EQ(code(data), ErrorCode::Unsupported);
    data = quads(1);
    data.positions[2].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(code(data), ErrorCode::NotFinite);
    data.positions[2].y = 1e39;
    EXPECT_TRUE(refine(data, 1));
    EXPECT_EQ(error_of(refine(data, 1, BoundaryRule::EdgeAndCorner, Precision::Float)).code,
              ErrorCode::NotFinite);
}

// Faces that OpenSubdiv may or may not want: whatever it says comes back as a value.
TEST(OpensubdivCatmullClark, SurvivesTopologyThatIsNoSurface) {
    MeshData twice = quads(1);
    twice.add_face(Quad{0, 1, 2, 3});
    MeshData reversed = quads(2);
    std::swap(reversed.face_corners[5], reversed.face_corners[7]);
    MeshData fin = quads(2);
    fin.positions.insert(fin.positions.end(), {{8, 0, 9}, {9, 7, 9}});
    fin.add_face(Quad{1, 6, 7, 2});
    MeshData bow = quads(1);
    bow.positions.insert(bow.positions.end(), {{-8, 0, 1}, {-9, -7, 0}, {0, -8, 5}});
    bow.add_face(Quad{0, 4, 5, 6});
    MeshData isolated = quads(1);
    isolated.positions.emplace_back(1, 2, 3);
    for (const MeshData& data : {twice, reversed, fin, bow, isolated}) {
        const auto made = refine(data, 2);
        if (!made) {
            EXPECT_EQ(made.error().code, ErrorCode::SubjectFailed);
            EXPECT_FALSE(made.error().sentence.empty());
        } else {
            EXPECT_EQ(made->levels.size(), 3U);
        }
    }
    EXPECT_EQ(value_of(refine(isolated, 1)).levels[1].positions.size(), 10U);
}

}  // namespace
}  // namespace loopcheck::reference
