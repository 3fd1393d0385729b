#include "core/loop/rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::mesh_of;
using tests::Observed;
using tests::steps_of;
using Row = std::vector<std::pair<Index, Rational>>;

Row row_in(const Rows& rows, std::size_t i, Weights weights) {
    const auto w = weights_of<Rational>(rows.mask(i), weights);
    const auto columns = rows.columns_of(i);
    EXPECT_EQ(w.size(), columns.size());
    Row out;
    for (std::size_t j = 0; j < columns.size(); ++j) out.emplace_back(columns[j], w[j]);
    return out;
}

// The row of a vertex point of a mesh.
Row vertex_row(MeshData data, Index v, const SchemeOptions& options = tests::kEdgeOnly) {
    return row_in(steps_of(mesh_of(std::move(data)), options, 1)[0].rows, v, options.weights);
}

// The row of the edge point between two vertices.
Row edge_row(MeshData data, Index a, Index b, const SchemeOptions& options = tests::kEdgeOnly) {
    const auto mesh = mesh_of(std::move(data));
    const Topology& t = mesh.topology();
    for (const Index e : t.ring(a))
        if (t.other_end(e, a) == b)
            return row_in(steps_of(mesh, options, 1)[0].rows, t.vertex_count + e, options.weights);
    ADD_FAILURE() << "no edge " << a << " " << b;
    return {};
}

MeshData wheel_with(const std::vector<EdgeSharpness>& creases, float hub = 0) {
    MeshData data = tests::wheel(6);
    data.creases = creases;
    data.corners = {{0, hub}};
    return data;
}

Rational over(int numerator, int denominator) {
    return Rational(numerator, denominator);
}

// The row of the hub of a wheel of valence 6, all of whose ring has one weight.
Row even_ring(const Rational& ring, const Rational& hub) {
    return {{1, ring}, {2, ring}, {3, ring}, {4, ring}, {5, ring}, {6, ring}, {0, hub}};
}

TEST(Rows, SmoothVertexReadsItsRingThenItself) {
    EXPECT_EQ(vertex_row(wheel_with({}), 0), even_ring(over(1, 16), over(10, 16)));
}

TEST(Rows, SmoothEdgeReadsItsEndsThenTheOppositeVertices) {
    EXPECT_EQ(edge_row(wheel_with({}), 0, 1),
              (Row{{0, over(3, 8)}, {1, over(3, 8)}, {2, over(1, 8)}, {6, over(1, 8)}}));
}

TEST(Rows, BoundaryEdgeReadsItsEnds) {
    EXPECT_EQ(edge_row(wheel_with({}), 1, 2), (Row{{1, over(1, 2)}, {2, over(1, 2)}}));
}

TEST(Rows, BoundaryVertexReadsItsTwoNeighboursAlongTheBoundary) {
    EXPECT_EQ(vertex_row(wheel_with({}), 1), (Row{{2, over(1, 8)}, {6, over(1, 8)}, {1, over(6, 8)}}));
}

TEST(Rows, InfinitelySharpEdges) {
    EXPECT_EQ(vertex_row(wheel_with({{0, 2, 10}}), 0), even_ring(over(1, 16), over(10, 16)));
    EXPECT_EQ(vertex_row(wheel_with({{0, 2, 10}, {0, 5, 10}}), 0),
              (Row{{2, over(1, 8)}, {5, over(1, 8)}, {0, over(6, 8)}}));
    EXPECT_EQ(vertex_row(wheel_with({{0, 2, 10}, {0, 4, 10}, {0, 5, 10}}), 0), (Row{{0, 1}}));
    EXPECT_EQ(vertex_row(wheel_with({}, 10), 0), (Row{{0, 1}}));
    EXPECT_EQ(edge_row(wheel_with({{0, 2, 10}}), 0, 2), (Row{{2, over(1, 2)}, {0, over(1, 2)}}));
}

TEST(Rows, SemiSharpEdgesBlendBelowOneOnly) {
    for (const float s : {1.0F, 1.5F, 7.0F})
        EXPECT_EQ(edge_row(wheel_with({{0, 1, s}}), 0, 1), (Row{{0, over(1, 2)}, {1, over(1, 2)}})) << s;
    EXPECT_EQ(edge_row(wheel_with({{0, 1, 0.25F}}), 0, 1),
              (Row{{0, over(13, 32)}, {1, over(13, 32)}, {2, over(3, 32)}, {6, over(3, 32)}}));
    EXPECT_EQ(edge_row(wheel_with({{0, 1, 0.5F}}), 0, 1),
              (Row{{0, over(7, 16)}, {1, over(7, 16)}, {2, over(1, 16)}, {6, over(1, 16)}}));
}

TEST(Rows, SemiSharpVerticesBlendFromCornerToCrease) {
    const Row half{{2, over(1, 16)}, {5, over(1, 16)}, {0, over(14, 16)}};
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.5F}, {0, 2, 10}, {0, 5, 10}}), 0), half);
    // Only what ends in this step has a share: 1.5 does not.
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.5F}, {0, 2, 1.5F}, {0, 5, 10}}), 0), half);
    // A crease through a vertex whose own sharpness ends.
    EXPECT_EQ(vertex_row(wheel_with({{0, 2, 10}, {0, 5, 10}}, 0.5F), 0), half);
}

TEST(Rows, SemiSharpVerticesBlendFromCreaseToDartAndSmooth) {
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.25F}, {0, 3, 10}}), 0), (Row{{1, over(5, 64)},
                                                                           {2, over(3, 64)},
                                                                           {3, over(5, 64)},
                                                                           {4, over(3, 64)},
                                                                           {5, over(3, 64)},
                                                                           {6, over(3, 64)},
                                                                           {0, over(42, 64)}}));
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.5F}, {0, 4, 0.5F}}), 0), (Row{{1, over(3, 32)},
                                                                            {2, over(1, 32)},
                                                                            {3, over(1, 32)},
                                                                            {4, over(3, 32)},
                                                                            {5, over(1, 32)},
                                                                            {6, over(1, 32)},
                                                                            {0, over(22, 32)}}));
}

TEST(Rows, SemiSharpVerticesBlendFromCornerToSmooth) {
    EXPECT_EQ(vertex_row(wheel_with({}, 0.5F), 0), even_ring(over(1, 32), over(26, 32)));
    EXPECT_EQ(vertex_row(wheel_with({}, 1.5F), 0), (Row{{0, 1}}));
    EXPECT_EQ(vertex_row(wheel_with({}, 1), 0), (Row{{0, 1}}));
}

TEST(Rows, SharpnessesThatEndTogetherCountByTheirMean) {
    const Row half = even_ring(over(1, 32), over(26, 32));
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.25F}, {0, 2, 0.5F}, {0, 4, 0.75F}}), 0), half);
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.75F}}, 0.25F), 0), half);
}

TEST(Rows, ADartThatEndsBlendsNothing) {
    EXPECT_EQ(vertex_row(wheel_with({{0, 1, 0.5F}}), 0), even_ring(over(1, 16), over(10, 16)));
}

// 1.2 and 0.05 at the hub: 3/4 1.2 + 1/4 0.05 - 1 < 0, so the half at the hub is smooth.
TEST(Rows, AnOverweightChaikinCreaseIsClampedUnlessAsked) {
    const auto data = wheel_with({{0, 1, 1.2F}, {0, 4, 0.05F}});
    SchemeOptions options{.boundary = BoundaryRule::EdgeOnly, .creasing = Creasing::Chaikin};
    EXPECT_EQ(edge_row(data, 0, 1, options), (Row{{0, over(1, 2)}, {1, over(1, 2)}}));
    options.crease_share = CreaseShare::Unclamped;
    const Rational s(1.2F), end = over(3, 8) + s / 8, opposite = (1 - s) / 8;
    EXPECT_EQ(edge_row(data, 0, 1, options), (Row{{0, end}, {1, end}, {2, opposite}, {6, opposite}}));
    EXPECT_LT(opposite, 0);
    // The same where the hub is the second end of the edge.
    EXPECT_EQ(edge_row(wheel_with({{0, 2, 1.2F}, {0, 4, 0.05F}}), 0, 2, options),
              (Row{{2, end}, {0, end}, {1, opposite}, {3, opposite}}));
}

TEST(Rows, UnclampedSharesAreOfNoConsequenceElsewhere) {
    SchemeOptions options{.creasing = Creasing::Uniform, .crease_share = CreaseShare::Unclamped};
    EXPECT_EQ(edge_row(wheel_with({{0, 1, 1.2F}}), 0, 1, options), (Row{{0, over(1, 2)}, {1, over(1, 2)}}));
}

TEST(Rows, WarrensWeightsChangeTheSmoothRuleOnly) {
    SchemeOptions options = tests::kEdgeOnly;
    options.weights = Weights::Warren;
    const auto wheel = tests::wheel(5);
    const Rational ring = over(3, 40);
    EXPECT_EQ(vertex_row(wheel, 0, options),
              (Row{{1, ring}, {2, ring}, {3, ring}, {4, ring}, {5, ring}, {0, over(25, 40)}}));
    EXPECT_EQ(vertex_row(wheel, 1, options), vertex_row(wheel, 1));
    EXPECT_EQ(edge_row(wheel, 0, 1, options), edge_row(wheel, 0, 1));
}

TEST(Rows, AnEdgeOfThePillowReadsItsOppositeVertexTwice) {
    EXPECT_EQ(edge_row(tests::wheel(2), 0, 1),
              (Row{{0, over(3, 8)}, {1, over(3, 8)}, {2, over(1, 8)}, {2, over(1, 8)}}));
}

class RowsOf : public testing::TestWithParam<std::string> {
  protected:
    const tests::LoadedModel model_ = tests::load_model(GetParam());
    const std::vector<Step> steps_ = steps_of(model_.mesh, model_.options, 3);
    const Topology& parent(std::size_t l) const {
        return l == 0 ? model_.mesh.topology() : steps_[l - 1].child.topology;
    }
};

TEST_P(RowsOf, SumToOne) {
    Observed error("|sum - 1|", "mask", 1e-36);  // fewer than 1000 roundings of 2^-127
    for (const auto& step : steps_)
        for (std::size_t i = 0; i < step.rows.masks.size(); ++i) {
            const Mask& mask = step.rows.masks[i];
            const auto w = weights_of<HighPrecision>(mask, model_.options.weights);
            error.add(tests::error_of_value(1.0, std::accumulate(w.begin(), w.end(), HighPrecision(0))),
                      static_cast<std::int64_t>(i));
            if (!tests::is_fraction(mask, model_.options.weights)) continue;
            const auto exact = weights_of<Rational>(mask, model_.options.weights);
            EXPECT_EQ(std::accumulate(exact.begin(), exact.end(), Rational(0)), 1) << i;
        }
    error.check();
}

TEST_P(RowsOf, HaveAColumnForEveryWeightAndEachMaskOnce) {
    for (std::size_t l = 0; l < steps_.size(); ++l) {
        const Rows& rows = steps_[l].rows;
        ASSERT_EQ(rows.row_count(), parent(l).vertex_count + parent(l).edge_ends.size());
        ASSERT_EQ(rows.offsets.size(), rows.row_count() + 1);
        ASSERT_EQ(rows.offsets.back(), rows.columns.size());
        for (std::size_t i = 0; i < rows.row_count(); ++i)
            ASSERT_EQ(rows.columns_of(i).size(), places_of(rows.mask(i)).size()) << i;
        for (auto mask = rows.masks.begin(); mask != rows.masks.end(); ++mask)
            EXPECT_EQ(std::count(mask, rows.masks.end(), *mask), 1);
    }
}

// What a mask means by its places, looked up in the topology.
TEST_P(RowsOf, NameTheVerticesThatTheirMasksMean) {
    for (std::size_t l = 0; l < steps_.size(); ++l) {
        const Topology& t = parent(l);
        const Rows& rows = steps_[l].rows;
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const bool is_edge = i >= static_cast<std::size_t>(t.vertex_count);
            ASSERT_EQ(rows.mask(i).point, is_edge ? Mask::Point::Edge : Mask::Point::Vertex);
            std::vector<Index> around;
            if (is_edge) {
                const auto e = static_cast<Index>(i) - t.vertex_count;
                around = {t.edge_ends[e][0], t.edge_ends[e][1]};
                for (const Index f : t.edge_faces[e])
                    if (f != kNone)
                        around.push_back(std::accumulate(t.triangles[f].begin(), t.triangles[f].end(), 0) -
                                         around[0] - around[1]);
            } else {
                const auto v = static_cast<Index>(i);
                ASSERT_EQ(rows.mask(i).ring, static_cast<int>(t.ring(v).size()));
                for (const Index e : t.ring(v)) around.push_back(t.other_end(e, v));
                around.push_back(v);
            }
            const auto places = places_of(rows.mask(i));
            for (std::size_t j = 0; j < places.size(); ++j)
                ASSERT_EQ(rows.columns_of(i)[j], around.at(places[j])) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, RowsOf, testing::ValuesIn(tests::model_files()), tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
