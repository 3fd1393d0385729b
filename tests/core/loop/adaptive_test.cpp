// The laws of the adaptive scheme, for every model and several criteria, and its rules on small meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "core/loop/adaptive/refine.h"
#include "tests/support/angles.h"
#include "tests/support/meshes.h"
#include "tests/support/models.h"
#include "tests/support/renumbered.h"
#include "tests/support/results.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::kDegree;
using tests::Observed;
using tests::value_of;

constexpr double kPi = std::numbers::pi;
constexpr double kManyFaces = 1e9;

int adaptive_levels() {
    return tests::levels_up_to(3);
}

// The same flags for the same level, whatever was asked before.
Criterion at_random(double share) {
    return [share](const AdaptiveLevel& level) {
        std::minstd_rand random(static_cast<unsigned>(level.control_face.size()));
        std::bernoulli_distribution yes(share);
        std::vector<std::uint8_t> out;
        for (std::size_t f = 0; f < level.control_face.size(); ++f) out.push_back(yes(random) ? 1 : 0);
        return out;
    };
}

std::vector<Index> first_half(Index count) {
    std::vector<Index> out;
    for (Index f = 0; 2 * f < count; ++f) out.push_back(f);
    return out;
}

std::vector<Criterion> criteria(const TriangleMesh& mesh) {
    return {where_smooth(kReportAngle, Neighbours::Edge),
            where_smooth(kReportAngle, Neighbours::Vertex),
            where_smooth(kReportAngle, Neighbours::FirstVertexRing),
            where_bent(20 * kDegree, Neighbours::Edge),
            where_listed(first_half(mesh.face_count())),
            at_random(0.9)};
}

// Calls visit(model) for every model.
template <class Visit>
void for_each_model(Visit visit) {
    for (const std::string& file : tests::model_files()) {
        const tests::LoadedModel model = tests::load_model(file);
        SCOPED_TRACE(model.name);
        visit(model);
    }
}

// Calls visit(level, flags, step) along each of the criteria.
template <class Visit>
void for_each_step(const tests::LoadedModel& model, Visit visit) {
    for (const Criterion& criterion : criteria(model.mesh)) {
        AdaptiveLevel level = adaptive_control_level(model.mesh, model.options.boundary);
        for (int l = 0; l < adaptive_levels(); ++l) {
            const auto flags = criterion(level);
            auto step = value_of(adaptive_step(level, flags, model.options));
            visit(level, flags, step);
            level = std::move(step.child);
        }
    }
}

template <class Real>
void expect_same_refinement(const tests::LoadedModel& model) {
    const auto uniform = value_of(refine<Real>(model.mesh, model.options, adaptive_levels()));
    const auto adaptive = value_of(refine_adaptively<Real>(
        model.mesh, model.options, where_smooth(kPi, Neighbours::Edge), adaptive_levels(), kManyFaces));
    ASSERT_EQ(adaptive.refinement.levels.size(), uniform.levels.size());
    for (std::size_t l = 0; l < uniform.levels.size(); ++l) {
        const RefinedLevel &a = adaptive.refinement.levels[l], &b = uniform.levels[l];
        ASSERT_EQ(a.positions, b.positions) << "level " << l;
        ASSERT_EQ(a.triangles, b.triangles) << "level " << l;
        ASSERT_EQ(a.ancestors, b.ancestors) << "level " << l;
        ASSERT_EQ(a.tags, b.tags) << "level " << l;
        for (std::size_t v = 0; v < a.positions.size(); ++v) {
            ASSERT_EQ(adaptive.records[l].uniform_vertex[v], static_cast<std::int64_t>(v)) << "level " << l;
            ASSERT_TRUE(adaptive.records[l].same_position[v]) << "level " << l << " vertex " << v;
        }
    }
}

TEST(AdaptiveLaws, AThresholdOfPiIsUniformRefinementBitForBit) {
    for_each_model([&](const tests::LoadedModel& model) {
        expect_same_refinement<double>(model);
        expect_same_refinement<float>(model);
    });
}

TEST(AdaptiveLaws, ANegativeThresholdChangesNothing) {
    for_each_model([&](const tests::LoadedModel& model) {
        for (const auto neighbours : {Neighbours::Edge, Neighbours::Vertex, Neighbours::FirstVertexRing}) {
            const auto result = value_of(refine_adaptively<double>(
                model.mesh, model.options, where_smooth(-1, neighbours), 2, kManyFaces));
            const auto& levels = result.refinement.levels;
            EXPECT_EQ(levels.back().positions, levels.front().positions);
            EXPECT_EQ(levels.back().triangles, levels.front().triangles);
            EXPECT_EQ(levels.back().tags, levels.front().tags);
        }
    });
}

TEST(AdaptiveLaws, TheCountsObeyTheTwoIdentities) {
    for_each_model([&](const tests::LoadedModel& model) {
        const Topology& control = model.mesh.topology();
        const bool is_closed = std::none_of(control.edge_faces.begin(), control.edge_faces.end(),
                                            [](const auto& faces) { return faces[1] == kNone; });
        for_each_step(model, [&](const AdaptiveLevel& level, const auto&, const AdaptiveStep& step) {
            const auto& [c, split] = step.counts;
            const Topology &parent = level.scheme.topology, &child = step.child.scheme.topology;
            EXPECT_EQ(c[0] + c[1] + c[2] + c[3], parent.triangles.size());
            EXPECT_EQ(child.triangles.size(), 4 * c[0] + 3 * c[1] + 2 * c[2] + c[3]);
            EXPECT_EQ(static_cast<std::size_t>(child.vertex_count), parent.vertex_count + split);
            if (is_closed) {
                EXPECT_EQ(2 * split, 3 * c[0] + 2 * c[1] + c[2]);
            }
        });
    });
}

// What a mesh is made of, from its faces alone.
struct Sides {
    std::map<Index, std::vector<std::array<Index, 2>>> by_edge;  // as the faces run along it
    std::int64_t euler = 0;
    std::size_t boundary_edges = 0;

    explicit Sides(const Topology& t) {
        std::set<Index> used;
        for (Index f = 0; f < t.face_count(); ++f)
            for (int i = 0; i < 3; ++i) {
                const Index a = t.triangles[f][i], b = t.triangles[f][next_corner(i)];
                by_edge[t.face_edges[f][i]].push_back({a, b});
                used.insert(a);
            }
        euler = static_cast<std::int64_t>(used.size()) - static_cast<std::int64_t>(by_edge.size()) +
                t.face_count();
        for (const auto& [e, runs] : by_edge) boundary_edges += runs.size() == 1 ? 1 : 0;
    }
};

// Counter-clockwise, each edge once, and as many faces as there are in one fan.
void expect_ring(const Topology& t, Index v, std::size_t faces_at_v) {
    const auto ring = t.ring(v);
    const std::set<Index> edges(ring.begin(), ring.end());
    EXPECT_EQ(edges.size(), ring.size()) << "vertex " << v;
    const bool is_open = t.is_boundary_vertex(v);
    EXPECT_EQ(ring.size(), faces_at_v + (is_open ? 1 : 0)) << "vertex " << v;
    for (std::size_t i = 0; i + (is_open ? 1 : 0) < ring.size(); ++i) {
        const Index e = ring[i], next = ring[(i + 1) % ring.size()];
        const auto is_between = [&](Index f) {
            if (f == kNone) return false;
            const int corner = t.corner_of_edge(f, e);
            return t.triangles[f][corner] == v && t.face_edges[f][previous_corner(corner)] == next;
        };
        EXPECT_TRUE(is_between(t.edge_faces[e][0]) || is_between(t.edge_faces[e][1])) << "vertex " << v;
    }
}

void expect_well_formed(const Topology& t) {
    const Sides of(t);
    ASSERT_EQ(of.by_edge.size(), t.edge_ends.size());
    for (const auto& [e, runs] : of.by_edge) {
        ASSERT_LE(runs.size(), 2U) << "edge " << e;
        const auto& [a, b] = t.edge_ends[e];
        for (const auto& run : runs)
            EXPECT_TRUE(run == (std::array{a, b}) || run == (std::array{b, a})) << "edge " << e;
        if (runs.size() == 2) {
            EXPECT_NE(runs[0], runs[1]) << "edge " << e;
        }
        EXPECT_EQ(t.edge_faces[e][1] == kNone, runs.size() == 1) << "edge " << e;
        if (runs.size() == 2) {
            EXPECT_LT(t.edge_faces[e][0], t.edge_faces[e][1]) << "edge " << e;
        }
    }
    std::vector<std::size_t> faces_at(t.vertex_count, 0);
    for (const Triangle& triangle : t.triangles)
        for (const Index v : triangle) ++faces_at[v];
    for (Index v = 0; v < t.vertex_count; ++v) expect_ring(t, v, faces_at[v]);
}

TEST(AdaptiveLaws, TheResultIsWatertightAndManifold) {
    for_each_model([&](const tests::LoadedModel& model) {
        for_each_step(model, [&](const AdaptiveLevel& level, const auto& flags, const AdaptiveStep& step) {
            const Topology &parent = level.scheme.topology, &child = step.child.scheme.topology;
            ASSERT_NO_FATAL_FAILURE(expect_well_formed(child));
            const Sides before(parent), after(child);
            EXPECT_EQ(after.euler, before.euler);
            std::size_t split_boundary = 0;
            for (const auto& [f, g] : parent.edge_faces) split_boundary += g == kNone && flags[f] ? 1 : 0;
            EXPECT_EQ(after.boundary_edges, before.boundary_edges + split_boundary);
        });
    });
}

// Where every new vertex is put in the middle of its edge, the pieces of a face of the control mesh cover it
// exactly: each has the direction of its face, and their areas add up.  With edges that are shared by whole
// length, which the law above says, no vertex can lie inside an edge.
TEST(AdaptiveLaws, NoVertexLiesInsideAnEdge) {
    for_each_model([&](const tests::LoadedModel& model) {
        const auto area_of = [](const Triangle& t, const std::vector<glm::dvec3>& p) {
            return glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
        };
        const auto control_positions =
            std::vector<glm::dvec3>(model.mesh.positions().begin(), model.mesh.positions().end());
        for (const Criterion& criterion : criteria(model.mesh)) {
            AdaptiveLevel level = adaptive_control_level(model.mesh, model.options.boundary);
            std::vector<glm::dvec3> flat = control_positions;
            for (int l = 0; l < adaptive_levels(); ++l) {
                auto step = value_of(adaptive_step(level, criterion(level), model.options));
                const Topology& parent = level.scheme.topology;
                for (std::size_t v = flat.size(); v < step.ancestors.size(); ++v) {
                    const Index side = step.ancestors[v].index, f = side / 3;
                    flat.push_back((flat[parent.triangles[f][side % 3]] +
                                    flat[parent.triangles[f][next_corner(side % 3)]]) /
                                   2.0);
                }
                level = std::move(step.child);
            }
            std::vector<glm::dvec3> sum(model.mesh.face_count(), glm::dvec3(0));
            const Topology& t = level.scheme.topology;
            const double size = model.mesh.largest_coordinate();
            for (Index f = 0; f < t.face_count(); ++f) {
                const Index whole = level.control_face[f];
                const auto area = area_of(t.triangles[f], flat);
                EXPECT_GE(glm::dot(area, area_of(model.mesh.topology().triangles[whole], control_positions)),
                          0);
                sum[whole] += area;
            }
            // Halving rounds a coordinate by u M at each of 3 levels, a side by twice that, and an area of
            // two sides of at most 4 M by 8 M times it; up to 64 pieces: 64 * 3 * 2 * 2 * 8 u M^2, and as
            // much for the products.
            Observed difference("area of the pieces less that of the face, over its bound", "face", 1);
            for (Index f = 0; f < model.mesh.face_count(); ++f) {
                const auto off = sum[f] - area_of(model.mesh.topology().triangles[f], control_positions);
                difference.add(glm::length(off) / (2 * 64 * 3 * 2 * 2 * 8 * 0x1p-53 * size * size), f);
            }
            EXPECT_TRUE(difference.holds()) << difference.text();
        }
    });
}

template <class Real>
void expect_uniform_positions(const tests::LoadedModel& model, std::size_t& same, std::size_t& all) {
    const auto uniform = value_of(refine<Real>(model.mesh, model.options, adaptive_levels()));
    for (const Criterion& criterion : criteria(model.mesh)) {
        const auto result = value_of(
            refine_adaptively<Real>(model.mesh, model.options, criterion, adaptive_levels(), kManyFaces));
        for (std::size_t l = 0; l < result.records.size(); ++l) {
            const AdaptiveRecord& record = result.records[l];
            const auto& positions = result.refinement.levels[l].positions;
            for (std::size_t v = 0; v < positions.size(); ++v) {
                ++all;
                if (!record.same_position[v]) continue;
                ++same;
                ASSERT_NE(record.uniform_vertex[v], kNone);
                ASSERT_EQ(positions[v],
                          uniform.levels[l].positions[static_cast<std::size_t>(record.uniform_vertex[v])])
                    << "level " << l << " vertex " << v;
            }
        }
    }
}

TEST(AdaptiveLaws, AVertexThatDependsOnSubdividableFacesOnlyHasItsUniformPositionBitForBit) {
    for_each_model([&](const tests::LoadedModel& model) {
        std::size_t same = 0, all = 0;
        expect_uniform_positions<double>(model, same, all);
        expect_uniform_positions<float>(model, same, all);
        EXPECT_GT(same, 0U);
        fmt::print("[ OBSERVED ] {} of {} vertices have to have their uniform position\n", same, all);
    });
}

// The two-ring of the lab report's law: all faces at the vertex and at its neighbours.
std::vector<std::uint8_t> two_ring_is_set(const Topology& t, const std::vector<std::uint8_t>& flags) {
    std::vector<std::uint8_t> one(t.vertex_count, 1), two(t.vertex_count, 1);
    for (Index f = 0; f < t.face_count(); ++f)
        for (const Index v : t.triangles[f]) one[v] = one[v] && flags[f] ? 1 : 0;
    for (Index v = 0; v < t.vertex_count; ++v) {
        two[v] = one[v];
        for (const Index e : t.ring(v)) two[v] = two[v] && one[t.other_end(e, v)] ? 1 : 0;
    }
    return two;
}

TEST(AdaptiveLaws, EveryVertexWhoseTwoRingIsSubdividableIsAmongThem) {
    std::size_t checked = 0;
    for_each_model([&](const tests::LoadedModel& model) {
        for_each_step(model, [&](const AdaptiveLevel& level, const auto& flags, const AdaptiveStep& step) {
            if (level.control_face.size() != static_cast<std::size_t>(model.mesh.face_count()))
                return;  // level 0 only
            const auto two_ring = two_ring_is_set(level.scheme.topology, flags);
            for (Index v = 0; v < level.scheme.topology.vertex_count; ++v) {
                if (!two_ring[v]) continue;
                ++checked;
                EXPECT_TRUE(step.child.uniform.same_position[v]) << "vertex " << v;
            }
        });
    });
    EXPECT_GT(checked, 1000U);
}

// Where every edge of the new parent's split is that of the old one's, by the numbers of its ends; several
// edges with the same ends are taken in any order, because their points coincide.
std::vector<Index> numbers_of_children(const std::vector<Index>& vertex, const AdaptiveStep& old_step,
                                       const Topology& old_parent, const AdaptiveStep& new_step,
                                       const Topology& new_parent) {
    const auto ends_of = [](const Topology& t, Index side) {
        return std::array{t.triangles[side / 3][side % 3], t.triangles[side / 3][next_corner(side % 3)]};
    };
    const auto key = [](Index a, Index b) { return std::minmax({a, b}); };
    std::multimap<std::pair<Index, Index>, Index> points;
    for (std::size_t v = new_parent.vertex_count; v < new_step.ancestors.size(); ++v) {
        const auto [a, b] = ends_of(new_parent, new_step.ancestors[v].index);
        points.emplace(key(a, b), static_cast<Index>(v));
    }
    std::vector<Index> out = vertex;
    for (std::size_t v = old_parent.vertex_count; v < old_step.ancestors.size(); ++v) {
        const auto [a, b] = ends_of(old_parent, old_step.ancestors[v].index);
        const auto found = points.find(key(vertex[a], vertex[b]));
        if (found == points.end()) {
            ADD_FAILURE() << "the edge between " << a << " and " << b << " is split in one numbering only";
            return out;
        }
        out.push_back(found->second);
        points.erase(found);
    }
    EXPECT_TRUE(points.empty());
    return out;
}

TEST(AdaptiveLaws, NeitherNumberingNorTheFirstVertexMattersWithEdgeAndVertexNeighbours) {
    for_each_model([&](const tests::LoadedModel& model) {
        std::mt19937 random(5);
        const auto numbers = tests::renumbered(read_model(tests::model_path(model.name))->data, random);
        const auto mesh = tests::mesh_of(numbers.data);
        Observed moved("renumbered, in units of twice the bound of uniform refinement", "vertex", 1);
        for (const auto& criterion :
             {where_smooth(kReportAngle, Neighbours::Edge), where_smooth(kReportAngle, Neighbours::Vertex),
              where_bent(20 * kDegree, Neighbours::Edge)}) {
            AdaptiveLevel a = adaptive_control_level(model.mesh, model.options.boundary);
            AdaptiveLevel b = adaptive_control_level(mesh, model.options.boundary);
            std::vector<Index> vertex = numbers.vertex;
            Bounds bounds = control_bounds(a.positions, Precision::Double);
            for (int l = 0; l < adaptive_levels(); ++l) {
                auto step_a = value_of(adaptive_step(a, criterion(a), model.options));
                auto step_b = value_of(adaptive_step(b, criterion(b), model.options));
                ASSERT_EQ(step_a.counts.faces_with_unsplit, step_b.counts.faces_with_unsplit)
                    << "level " << l;
                vertex = numbers_of_children(vertex, step_a, a.scheme.topology, step_b, b.scheme.topology);
                ASSERT_FALSE(testing::Test::HasFailure());
                bounds =
                    next_bounds(step_a.rows, model.options.weights, a.positions, bounds, Precision::Double);
                a = std::move(step_a.child);
                b = std::move(step_b.child);
                for (std::size_t v = 0; v < a.positions.size(); ++v)
                    for (int i = 0; i < 3; ++i)
                        moved.add(tests::share_of(std::abs(a.positions[v][i] - b.positions[vertex[v]][i]),
                                                  2 * bounds[v][i]),
                                  static_cast<std::int64_t>(v), b.positions[vertex[v]][i], a.positions[v][i]);
            }
        }
        moved.check();
    });
}

TEST(SplitPattern, IsTheLabReportsForEverySetOfEdges) {
    const auto pieces = [](const Triangle& midpoints) {
        const SplitPattern pattern = split_pattern({0, 1, 2}, midpoints);
        const auto triangles = pattern.triangles();
        return std::vector<Triangle>(triangles.begin(), triangles.end());
    };
    using Pieces = std::vector<Triangle>;
    constexpr Index ab = 3, bc = 4, ca = 5, no = kNone;
    EXPECT_EQ(pieces({ab, bc, ca}), (Pieces{{0, ab, ca}, {ab, 1, bc}, {ca, bc, 2}, {bc, ca, ab}}));
    EXPECT_EQ(pieces({no, bc, ca}), (Pieces{{0, 1, bc}, {ca, bc, 2}, {ca, 0, bc}}));
    EXPECT_EQ(pieces({ab, no, ca}), (Pieces{{1, 2, ca}, {0, ab, ca}, {ab, 1, ca}}));
    EXPECT_EQ(pieces({ab, bc, no}), (Pieces{{2, 0, ab}, {ab, 1, bc}, {bc, 2, ab}}));
    EXPECT_EQ(pieces({ab, no, no}), (Pieces{{0, ab, 2}, {ab, 1, 2}}));
    EXPECT_EQ(pieces({no, bc, no}), (Pieces{{1, bc, 0}, {bc, 2, 0}}));
    EXPECT_EQ(pieces({no, no, ca}), (Pieces{{2, ca, 1}, {ca, 0, 1}}));
    EXPECT_EQ(pieces({no, no, no}), (Pieces{{0, 1, 2}}));
}

AdaptiveCounts first_counts(const TriangleMesh& mesh, const Criterion& criterion) {
    const AdaptiveLevel level = adaptive_control_level(mesh, BoundaryRule::EdgeAndCorner);
    return value_of(adaptive_step(level, criterion(level), {})).counts;
}

// The normals of the cube's triangles are equal or at a right angle.
TEST(WhereSmooth, SplitsNothingOfACubeAt60DegreesAndAllOfItAt90) {
    const auto mesh = tests::mesh_of(tests::cube());
    EXPECT_EQ(first_counts(mesh, where_smooth(kReportAngle, Neighbours::Edge)).split_edges, 0U);
    EXPECT_EQ(first_counts(mesh, where_smooth(90 * kDegree, Neighbours::Edge)).split_edges, 18U);
}

TEST(WhereBent, IsTheOpposite) {
    const auto mesh = tests::mesh_of(tests::cube());
    EXPECT_EQ(first_counts(mesh, where_bent(kReportAngle, Neighbours::Edge)).split_edges, 18U);
    EXPECT_EQ(first_counts(mesh, where_bent(90 * kDegree, Neighbours::Edge)).split_edges, 0U);
}

TEST(Neighbours, OfTheFirstVertexDependOnWhichVertexIsFirst) {
    // A roof over vertices 0, 1 with a flat part beyond: only the faces at the ridge are bent.
    const tests::Positions points{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 1, 0}, {-1, 0, -3}};
    tests::Triangles faces{{0, 2, 1}, {2, 3, 1}, {0, 1, 4}};
    const auto split_edges = [&](Neighbours neighbours) {
        return first_counts(tests::mesh_of(tests::data_of(points, faces)),
                            where_smooth(kReportAngle, neighbours))
            .split_edges;
    };
    const std::array before{split_edges(Neighbours::FirstVertexRing), split_edges(Neighbours::Edge),
                            split_edges(Neighbours::Vertex)};
    faces[1] = {1, 2, 3};
    EXPECT_NE(split_edges(Neighbours::FirstVertexRing), before[0]);
    EXPECT_EQ(split_edges(Neighbours::Edge), before[1]);
    EXPECT_EQ(split_edges(Neighbours::Vertex), before[2]);
}

TEST(LargestNormalAngles, AreZeroWhereThereIsNoneToCompare) {
    const auto alone = tests::mesh_of(tests::triangle());
    EXPECT_EQ(largest_normal_angles(alone.topology(), alone.positions(), Neighbours::Vertex),
              std::vector<double>{0});
    // The second face is degenerate.
    const auto sliver =
        tests::mesh_of(tests::data_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 0, 3}}));
    EXPECT_EQ(largest_normal_angles(sliver.topology(), sliver.positions(), Neighbours::Edge),
              (std::vector<double>{0, 0}));
}

TEST(AdaptiveStep, KeepsWhatIsNextToAFaceThatStays) {
    const auto mesh = tests::mesh_of(tests::square());
    const AdaptiveLevel level = adaptive_control_level(mesh, BoundaryRule::EdgeOnly);
    const auto step = value_of(adaptive_step(level, {1, 0}, {.boundary = BoundaryRule::EdgeOnly}));
    EXPECT_EQ(step.counts.faces_with_unsplit, (std::array<std::size_t, 4>{0, 1, 0, 1}));
    EXPECT_EQ(step.counts.split_edges, 2U);
    const auto& p = step.child.positions;
    EXPECT_EQ(p[0], (glm::dvec3{0, 0, 0}));
    EXPECT_EQ(p[1], (glm::dvec3{7, 1, 0})) << "1/8, 3/4, 1/8 of (0, 0), (8, 0), (8, 8)";
    EXPECT_EQ(p[2], (glm::dvec3{8, 8, 0}));
    EXPECT_EQ(p[3], (glm::dvec3{0, 8, 0}));
    EXPECT_EQ(p[4], (glm::dvec3{4, 0, 0}));
    EXPECT_EQ(p[5], (glm::dvec3{8, 4, 0}));
}

TEST(AdaptiveStep, LetsSharpnessDecayOnlyWhereItRefines) {
    auto data = tests::bipyramid(6);
    data.creases = {{0, 2, 2.5F}, {1, 5, 2.5F}};
    data.corners = {{1, 1.5F}, {0, 1.5F}};
    const auto mesh = tests::mesh_of(data);
    const AdaptiveLevel closed = adaptive_control_level(mesh, BoundaryRule::EdgeOnly);
    std::vector<std::uint8_t> around_0(12, 0);
    for (int f = 0; f < 12; f += 2) around_0[f] = 1;
    const auto step = value_of(adaptive_step(closed, around_0, {}));
    const Topology& t = step.child.scheme.topology;
    const Sharpness& s = step.child.scheme.sharpness;
    EXPECT_EQ(s.vertex[0], 0.5F) << "refined";
    EXPECT_EQ(s.vertex[1], 1.5F) << "stays";
    std::map<float, int> edges;
    for (Index e = 0; e < t.edge_count(); ++e) ++edges[s.edge[e]];
    EXPECT_EQ(edges[1.5F], 2) << "two halves of the edge from 0 to 2";
    EXPECT_EQ(edges[2.5F], 1) << "the edge from 1 to 5";
}

TEST(WhereListed, SplitsWhatComesFromTheListedFacesOnly) {
    const auto mesh = tests::mesh_of(tests::bipyramid(6));
    const std::vector<Index> list{0, 2, 4, 6, 8, 10, 99};
    const auto result = value_of(refine_adaptively<double>(mesh, {}, where_listed(list), 2, kManyFaces));
    const auto& record = result.records[2];
    for (std::size_t f = 0; f < record.control_face.size(); ++f)
        if (record.control_face[f] % 2 == 1) {
            const auto& triangle = result.refinement.levels[2].triangles[f];
            EXPECT_TRUE(std::all_of(triangle.begin(), triangle.end(), [](Index v) { return v < 8; }));
        }
    EXPECT_EQ(record.control_face.size(), 6U + 6U * (3 + 4 + 4))
        << "one piece of each face still has an edge that stays";
}

TEST(RefineAdaptively, RefusesWhatItCannotDo) {
    const auto mesh = tests::mesh_of(tests::tetrahedron());
    const Criterion all = where_smooth(kPi, Neighbours::Edge);
    EXPECT_EQ(tests::error_of(refine_adaptively<double>(mesh, {}, all, 3, 4 + 16 + 64)).code,
              ErrorCode::OutOfMemory);
    EXPECT_TRUE(refine_adaptively<double>(mesh, {}, all, 2, 4 + 16 + 64));
    const Criterion one_flag = [](const AdaptiveLevel&) { return std::vector<std::uint8_t>{1}; };
    EXPECT_EQ(tests::error_of(refine_adaptively<double>(mesh, {}, one_flag, 1, kManyFaces)).code,
              ErrorCode::IndexOutOfRange);
    const Criterion none = where_smooth(-1, Neighbours::Edge);
    EXPECT_EQ(tests::error_of(refine_adaptively<double>(mesh, {}, none, 40, kManyFaces)).code,
              ErrorCode::TooLarge);
}

}  // namespace
}  // namespace loopcheck::core
