#include "core/loop/tessellation/tessellate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <set>

#include "core/loop/child_parameter.h"
#include "core/loop/evaluate.h"
#include "core/loop/limit.h"
#include "core/loop/tessellation/measure.h"
#include "tests/support/models.h"
#include "tests/support/observed.h"
#include "tests/support/surface_errors.h"

namespace loopcheck::core {
namespace {

using tests::Observed;
using tests::vertex_error;

// The model's own rules; where its boundary has none and so no surface, the same rules with a surface.
tests::LoadedModel with_a_surface(const std::string& file) {
    tests::LoadedModel model = tests::load_model(file);
    if (model.options.boundary == BoundaryRule::None) model.options.boundary = BoundaryRule::EdgeOnly;
    return model;
}

Tessellation tessellated(const TriangleMesh& mesh, const SchemeOptions& options, double tolerance,
                         Splitting splitting = Splitting::WhereNeeded) {
    auto out = tessellate(mesh, options, tolerance, {}, splitting);
    if (!out) throw std::runtime_error(to_string(out.error()));
    return std::move(*out);
}

std::vector<Triangle> triangles_of(const Tessellation& tessellation) {
    std::vector<Triangle> out;
    for (const TessellationTriangle& t : tessellation.triangles) out.push_back(t.vertices);
    return out;
}

// What the header promises of a bound.  There is room in it for the error of the surface point that is
// measured.
double bound_error(const TriangleMesh& mesh, int level) {
    return 16 * vertex_error(mesh, level + 3);
}

struct SurfaceType {
    int euler_characteristic = 0;
    int boundary_loops = 0;

    bool operator==(const SurfaceType&) const = default;
};

// Isolated vertices do not count.
SurfaceType type_of(const Topology& t) {
    SurfaceType type{t.face_count() - t.edge_count(), 0};
    std::vector<std::uint8_t> seen(t.vertex_count, 0);
    for (Index v = 0; v < t.vertex_count; ++v) {
        if (t.is_isolated(v)) continue;
        ++type.euler_characteristic;
        if (seen[v] || !t.is_boundary_vertex(v)) continue;
        ++type.boundary_loops;
        for (Index w = v; !seen[w]; w = t.other_end(t.ring(w).front(), w)) seen[w] = 1;
    }
    return type;
}

void expect_same_shape(const TriangleMesh& mesh, const SchemeOptions& options,
                       const Tessellation& tessellation) {
    std::vector<Triangle> faces;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (!no_limit_surface(mesh, options.boundary, f)) faces.push_back(mesh.topology().triangles[f]);
    const auto wanted = make_topology(mesh.vertex_count(), std::move(faces));
    ASSERT_TRUE(wanted) << to_string(wanted.error());
    auto data = tests::data_of(tessellation.positions, triangles_of(tessellation));
    const auto got = TriangleMesh::make(std::move(data));
    ASSERT_TRUE(got) << to_string(got.error());
    EXPECT_EQ(type_of(got->topology()), type_of(*wanted));
    for (Index v = 0; v < got->vertex_count(); ++v) EXPECT_FALSE(got->topology().is_isolated(v));
}

// Every corner of every triangle is the surface at its parameters.
void expect_on_surface(const TriangleMesh& mesh, const SchemeOptions& options,
                       const Tessellation& tessellation, const std::string& place) {
    LimitSurface<double> surface(mesh, options);
    Observed observed("error of a vertex over its bound", place, 1);
    const double M = mesh.largest_coordinate();
    for (const TessellationTriangle& t : tessellation.triangles)
        for (int i = 0; i < 3; ++i) {
            const auto [u, v] = t.parameters[i];
            const auto stencil = surface.stencil(t.face, u, v).value();
            const double allowed =
                vertex_error(mesh, tessellation.deepest_level()) + tests::evaluated_error(stencil, M);
            const glm::dvec3 off = apply<double>(stencil, mesh.positions()).at(Derivative::Position) -
                                   tessellation.positions[t.vertices[i]];
            for (int axis = 0; axis < 3; ++axis) observed.add(std::abs(off[axis]) / allowed, t.vertices[i]);
        }
    observed.check();
}

void expect_within(const TriangleMesh& mesh, const SchemeOptions& options, const Tessellation& tessellation,
                   double tolerance, int samples, const std::string& place) {
    EXPECT_LE(tessellation.bound, tolerance);
    const MeasuredDistance measured = measure(mesh, options, tessellation, samples);
    const double rounding = bound_error(mesh, tessellation.deepest_level());
    Observed share("measured distance over the bound", place, 1);
    share.add(measured.largest / (tessellation.bound + rounding), measured.at.face, measured.largest,
              tessellation.bound);
    share.check();
    EXPECT_LE(measured.excess, rounding) << "a triangle of face " << measured.at.face;
}

class TessellateEveryModel : public testing::TestWithParam<std::string> {};

TEST_P(TessellateEveryModel, IsManifoldOnTheSurfaceAndWithinItsBound) {
    const auto [name, mesh, options] = with_a_surface(GetParam());
    // Where there are more faces, larger ones of them will do; and in a short run.
    const double least = tests::is_short_run() ? 5e-2 : 2e-2;
    const double tolerance = std::max(least, mesh.face_count() / 2400.0) * mesh.diagonal();
    const Tessellation tessellation = tessellated(mesh, options, tolerance);
    expect_same_shape(mesh, options, tessellation);
    expect_on_surface(mesh, options, tessellation, name);
    expect_within(mesh, options, tessellation, tolerance, 3, name);
}

INSTANTIATE_TEST_SUITE_P(Models, TessellateEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(Tessellate, HoldsSmallTolerances) {
    for (const char* name : {"torus", "bipyramid-03", "crease-bent", "fan-5"}) {
        const auto [stem, mesh, options] = with_a_surface(tests::model_path(name));
        const double tolerance = 1e-3 * mesh.diagonal();
        const Tessellation tessellation = tessellated(mesh, options, tolerance);
        expect_same_shape(mesh, options, tessellation);
        expect_within(mesh, options, tessellation, tolerance, 2, stem);
    }
}

// In this model a triangle that is good enough meets neighbours two levels deeper: left alone, it would have
// their vertices inside its edge.
TEST(Tessellate, SplitsWhatANeighbourSplitTwice) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("crease-from-boundary"));
    expect_same_shape(mesh, options, tessellated(mesh, options, 5e-3 * mesh.diagonal()));
}

// Any positions and any sharpness: what no model was made to show.
TEST(Tessellate, HoldsItsBoundOnRandomMeshes) {
    std::mt19937_64 random(20);
    for (int round = 0; round < 14; ++round) {
        MeshData data = round % 2 == 0 ? tests::bipyramid(3 + round / 2) : tests::open_fan(1 + round / 2);
        for (glm::dvec3& p : data.positions)
            for (int axis = 0; axis < 3; ++axis)
                p[axis] =
                    std::ldexp(static_cast<double>(random() >> 11), -53) * (random() % 4 == 0 ? 0.01 : 1);
        const Topology t = tests::mesh_of(data).topology();
        for (const auto& ends : t.edge_ends)
            if (random() % 4 == 0)
                data.creases.push_back({ends[0], ends[1], static_cast<float>(random() % 25) / 2});
        const TriangleMesh mesh = tests::mesh_of(std::move(data));
        SchemeOptions options;
        options.creasing = round % 3 == 0 ? Creasing::Chaikin : Creasing::Uniform;
        options.weights = round % 5 == 0 ? Weights::Warren : Weights::Loop;
        const double tolerance = 3e-2 * mesh.diagonal();
        const Tessellation tessellation = tessellated(mesh, options, tolerance);
        expect_same_shape(mesh, options, tessellation);
        expect_within(mesh, options, tessellation, tolerance, 4, fmt::format("random mesh {}", round));
    }
}

TEST(Tessellate, EverywhereIsTheLimitOfUniformRefinement) {
    for (const char* name : {"octahedron", "crease-one-edge", "grid-irregular-4"}) {
        const auto [stem, mesh, options] = with_a_surface(tests::model_path(name));
        const Tessellation tessellation =
            tessellated(mesh, options, 5e-3 * mesh.diagonal(), Splitting::Everywhere);
        const int level = tessellation.deepest_level();
        ASSERT_GE(level, 2) << name;
        ASSERT_EQ(tessellation.triangles.size(), static_cast<std::size_t>(mesh.face_count()) << (2 * level));
        const auto limit = limits<double>(mesh, options, level).value().levels[level].positions;
        const auto refined = refine<double>(mesh, options, level).value().levels[level].triangles;
        Observed observed("difference of a limit over its bound", stem, 1);
        for (const TessellationTriangle& t : tessellation.triangles) {
            const auto& [a, b, c] = t.parameters;
            double u = (a[0] + b[0] + c[0]) / 3, v = (a[1] + b[1] + c[1]) / 3;
            Index face = t.face;
            for (int l = 0; l < level; ++l) face = 4 * face + descend(u, v);
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 off = limit[refined[face][i]] - tessellation.positions[t.vertices[i]];
                for (int axis = 0; axis < 3; ++axis)
                    observed.add(std::abs(off[axis]) / (2 * vertex_error(mesh, level)), face);
            }
        }
        observed.check();
    }
}

TEST(Tessellate, StartsWithTheControlVerticesInTheirOrder) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("isolated-vertex-middle"));
    const Tessellation tessellation = tessellated(mesh, options, 0.05 * mesh.diagonal());
    const auto limit = limits<double>(mesh, options, 0).value().levels[0].positions;
    std::size_t i = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.topology().is_isolated(v)) continue;
        EXPECT_LE(glm::distance(tessellation.positions[i++], limit[v]), 2 * vertex_error(mesh, 0)) << v;
    }
    EXPECT_LT(i, static_cast<std::size_t>(mesh.vertex_count()));
}

// Its triangles are uneven, so the surface of one reaches far over its edges, but it stays in the plane.
TEST(Tessellate, DoesNotSplitWhatIsFlatAndInside) {
    constexpr int kSide = 12;
    tests::Positions positions;
    tests::Triangles faces;
    const auto at = [](int i, int j) { return static_cast<Index>(j * (kSide + 1) + i); };
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i) {
            const bool moves = i > 0 && j > 0 && i < kSide && j < kSide;
            const double x = moves ? 0.3 * std::sin(5.0 * i + 3.0 * j) : 0;
            const double y = moves ? 0.3 * std::cos(3.0 * i + 7.0 * j) : 0;
            positions.push_back({i + x, j + y, 0});
            if (i < kSide && j < kSide) {
                faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    const TriangleMesh mesh = tests::mesh_of(tests::data_of(positions, faces));
    const Tessellation tessellation = tessellated(mesh, {}, 2e-2);
    std::vector<int> pieces(faces.size(), 0);
    for (const TessellationTriangle& t : tessellation.triangles) ++pieces[t.face];
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const int i = static_cast<int>(f / 2) % kSide, j = static_cast<int>(f / 2) / kSide;
        const bool inside = i >= 3 && j >= 3 && i < kSide - 3 && j < kSide - 3;
        EXPECT_TRUE(pieces[f] == 1 || !inside) << f;
    }
    expect_within(mesh, {}, tessellation, 2e-2, 4, "uneven grid");
}

TEST(Tessellate, NeedsFourTimesTheTrianglesForAQuarterOfTheTolerance) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("torus"));
    const auto count = [&](double relative) {
        return static_cast<double>(tessellated(mesh, options, relative * mesh.diagonal()).triangles.size());
    };
    Observed observed("growth of the triangles", name, 5);
    const double growth = count(1e-3 / 4) / count(1e-3 * 4);
    observed.add(std::sqrt(growth), 0);
    observed.check();
    EXPECT_GE(std::sqrt(growth), 3);
}

TEST(Tessellate, NeedsFewerTrianglesThanUniformRefinement) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("cow"));
    const double tolerance = 1e-2 * mesh.diagonal();
    const auto count = [&](Splitting splitting) {
        return static_cast<double>(tessellated(mesh, options, tolerance, splitting).triangles.size());
    };
    expect_within(mesh, options, tessellated(mesh, options, tolerance), tolerance, 2, name);
    Observed observed("share of the triangles of uniform refinement", name, 0.5);
    observed.add(count(Splitting::WhereNeeded) / count(Splitting::Everywhere), 0);
    observed.check();
}

TEST(Tessellate, TellsItsProgressAndItsLevels) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("crease-bent"));
    std::vector<std::size_t> counts;
    const auto tessellation = tessellate(mesh, options, 1e-2 * mesh.diagonal(), {}, Splitting::WhereNeeded,
                                         [&](std::size_t triangles) { counts.push_back(triangles); });
    ASSERT_TRUE(tessellation);
    ASSERT_GE(counts.size(), 2U);
    EXPECT_EQ(counts.front(), static_cast<std::size_t>(mesh.face_count()));
    EXPECT_EQ(counts.back(), tessellation->triangles.size());
    // Of F faces each leaf of level l is a 4^l-th.
    double faces = 0;
    for (std::size_t l = 0; l < tessellation->leaves.size(); ++l)
        faces += std::ldexp(static_cast<double>(tessellation->leaves[l]), -2 * static_cast<int>(l));
    EXPECT_EQ(faces, mesh.face_count());
    double largest = 0;
    for (const TessellationTriangle& t : tessellation->triangles) largest = std::max(largest, t.bound);
    EXPECT_EQ(tessellation->bound, largest);
}

TEST(Tessellate, LeavesOutFacesWithoutALimitSurface) {
    const auto [name, mesh, options] = with_a_surface(tests::model_path("grid-4x4"));
    SchemeOptions without = options;
    without.boundary = BoundaryRule::None;
    std::set<Index> wanted, got;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (!no_limit_surface(mesh, BoundaryRule::None, f)) wanted.insert(f);
    const Tessellation tessellation = tessellated(mesh, without, 1e-2 * mesh.diagonal());
    for (const TessellationTriangle& t : tessellation.triangles) got.insert(t.face);
    EXPECT_EQ(got, wanted);
    EXPECT_LT(wanted.size(), static_cast<std::size_t>(mesh.face_count()));
    expect_same_shape(mesh, without, tessellation);
}

TEST(Tessellate, RefusesWhatItCannotDo) {
    const TriangleMesh mesh = tests::mesh_of(tests::tetrahedron());
    const auto code = [&](double tolerance, const SchemeOptions& options = {},
                          const TessellationLimits& limits = {}) {
        const auto result = tessellate(mesh, options, tolerance, limits);
        return result ? "none" : std::string(code_name(result.error().code));
    };
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double tolerance : {0.0, -1.0, infinity, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(code(tolerance), "outside-domain") << tolerance;
    EXPECT_EQ(code(1, {.crease_share = CreaseShare::Unclamped}), "unsupported");
    EXPECT_EQ(code(100, {}, {.most_levels = 0, .most_triangles = 4}), "none");
    EXPECT_EQ(code(100, {}, {.most_levels = 0, .most_triangles = 3}), "too-large") << "it has 4 faces";
    EXPECT_EQ(code(100, {}, {.most_triangles = std::numeric_limits<std::size_t>::max()}), "none");
    const auto shallow = tessellate(mesh, {}, 1e-3, {.most_levels = 2});
    ASSERT_FALSE(shallow);
    EXPECT_EQ(shallow.error().code, ErrorCode::TooLarge);
    EXPECT_EQ(shallow.error().place.kind, Place::Kind::Face);
    EXPECT_NE(shallow.error().sentence.find("more than 2 levels"), std::string::npos);
    const auto small = tessellate(mesh, {}, 1e-3, {.most_triangles = 100});
    ASSERT_FALSE(small);
    EXPECT_NE(small.error().sentence.find("more than 100 triangles"), std::string::npos);

    const TriangleMesh open = tests::mesh_of(tests::triangle());
    const auto none = tessellate(open, {.boundary = BoundaryRule::None}, 1, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::NoLimitSurface);
}

}  // namespace
}  // namespace loopcheck::core
