#include "core/loop/evaluate.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::Observed;
using High = HighPrecision;

const double kHighRoundoff = static_cast<double>(std::numeric_limits<High>::epsilon()) / 2;

// Parameters of all kinds: corners, edges, the inside, and near every corner and edge.  Multiples of 2^-52.
const std::vector<std::array<double, 2>>& parameters() {
    static const std::vector<std::array<double, 2>> all = [] {
        std::vector<std::array<double, 2>> out;
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; i + j <= 4; ++j) out.push_back({i / 4.0, j / 4.0});
        for (const double near : {0x1p-3, 0x1p-7, 0x1p-20})
            for (const double along : {0.0, 0.3125, 0.6875, 1.0}) {
                const double u = near * along, v = near - u;
                out.push_back({u, v});         // near corner 0
                out.push_back({1 - near, v});  // corner 1
                out.push_back({u, 1 - near});  // corner 2
            }
        out.push_back({0.296875, 0.4140625});
        out.push_back({std::floor(0x1p52 / 3) * 0x1p-52, 0.25});
        return out;
    }();
    return all;
}

// A dense row over the control vertices, so that stencils of different columns can be compared.
std::vector<High> dense(const SurfaceStencil<High>& stencil, Derivative d, Index vertices) {
    std::vector<High> out(vertices, High(0));
    for (std::size_t j = 0; j < stencil.columns.size(); ++j)
        out[stencil.columns[j]] = stencil.weights[static_cast<int>(d)][j];
    return out;
}
double distance(const std::vector<High>& a, const std::vector<High>& b) {
    High sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += abs(High(a[i] - b[i]));
    return static_cast<double>(sum);
}

// The model's own rules; where its boundary has none and so no surface, the same rules with a surface.
tests::LoadedModel with_a_surface(tests::LoadedModel model) {
    if (model.options.boundary == BoundaryRule::None) model.options.boundary = BoundaryRule::EdgeOnly;
    return model;
}

// The sector of corner i of face f that holds the face.
const SectorMasks<High>& sector_with(const LimitMasks<High>& masks, const Topology& t, Index f, int i) {
    const auto ring = t.ring(t.triangles[f][i]);
    const auto n = static_cast<int>(ring.size());
    const auto position =
        static_cast<int>(std::find(ring.begin(), ring.end(), t.face_edges[f][i]) - ring.begin());
    return *std::find_if(masks.sectors.begin(), masks.sectors.end(), [&](const SectorMasks<High>& s) {
        return (position - s.sector.first + n) % n < s.sector.faces;
    });
}

High dot(const std::vector<High>& a, const std::vector<High>& b) {
    High sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// The share of a row that is not a combination of two others; nothing where these two are parallel, as on the
// rim of the pillow.
double outside_of_plane(std::vector<High> row, const std::vector<High>& a, std::vector<High> b) {
    const auto take_out = [](std::vector<High>& from, const std::vector<High>& part) {
        const High share = dot(from, part) / dot(part, part);
        for (std::size_t i = 0; i < from.size(); ++i) from[i] -= share * part[i];
    };
    const High size = dot(row, row);
    const High both = dot(b, b);
    take_out(b, a);
    if (dot(b, b) < both * 1e-60) return 0;
    take_out(row, a);
    take_out(row, b);
    return static_cast<double>(sqrt(High(dot(row, row) / size)));
}

class EvaluateEveryModel : public testing::TestWithParam<std::string> {
  protected:
    const tests::LoadedModel model = with_a_surface(tests::load_model(GetParam()));

    // Some ten faces, all of them where there are fewer; some three in a short run; no holes.
    std::vector<Index> faces() const {
        std::vector<Index> out;
        const Index most = tests::is_short_run() ? 3 : 10;
        for (Index f = 0; f < model.mesh.face_count(); f += 1 + model.mesh.face_count() / most)
            if (!model.mesh.holes()[f]) out.push_back(f);
        return out;
    }
};

// Position rows sum to 1 and derivative rows to 0, and double agrees with 38 digits, both within the bound.
TEST_P(EvaluateEveryModel, IsWithinItsBoundOfThirtyEightDigits) {
    LimitSurface<double> surface(model.mesh, model.options);
    LimitSurface<High> exact_surface(model.mesh, model.options);
    Observed use(model.name + ": sum |w - exact| / bound", "face", 1);
    Observed sums(model.name + ": |row sum - exact sum| / bound", "face", 1);
    for (const Index f : faces())
        for (const auto& [u, v] : parameters()) {
            const auto got = surface.stencil(f, u, v).value();
            const auto exact = exact_surface.stencil(f, High(u), High(v)).value();
            ASSERT_EQ(got.columns, exact.columns);
            ASSERT_EQ(got.smoothness, exact.smoothness);
            for (int d = 0; d < kDerivatives; ++d) {
                double error = 0;
                High sum = 0;
                for (std::size_t j = 0; j < got.columns.size(); ++j) {
                    error += tests::error_of_value(got.weights[d][j], exact.weights[d][j]);
                    sum += exact.weights[d][j];
                }
                use.add(tests::share_of(error, got.weight_error[d] * tests::kRoundoff<double>), f);
                const double off = static_cast<double>(abs(High(sum - (d == 0 ? 1 : 0))));
                sums.add(tests::share_of(off, exact.weight_error[d] * kHighRoundoff), f);
            }
        }
    use.check();
    sums.check();
}

// A vertex of level l sits at a parameter of a face of the control mesh.  Its limit mask over the vertices of
// that level, taken back to the control vertices, is what `evaluate` says at that parameter.  So the surface
// at a vertex is the limit mask (l = 0), and it does not change when the mesh is refined first (l > 0).
TEST_P(EvaluateEveryModel, IsTheLimitMaskOfEveryVertexOfEveryLevel) {
    const int levels = tests::levels_up_to(3);
    const Index V = model.mesh.vertex_count();
    if (V > 300) return;  // the dense rows of all levels take too long
    LimitSurface<High> surface(model.mesh, model.options);
    std::vector<std::vector<High>> rows(V, std::vector<High>(V, High(0)));
    for (Index v = 0; v < V; ++v) rows[v][v] = 1;
    std::vector<std::array<std::array<double, 2>, 3>> corners(model.mesh.face_count(),
                                                              {{{0, 0}, {1, 0}, {0, 1}}});
    SchemeLevel level = control_level(model.mesh, model.options.boundary);
    Observed off(model.name + ": sum |w - limit mask| / bound", "level", 1);
    // The tangents are rows of length about 1 over rows of length down to 2^-3; the rest is as above.
    Observed planes(model.name + ": what of a tangent is not in the plane of du and dv, over bound", "level",
                    1);
    for (int l = 0;; ++l) {
        LimitTable<High> table(level, model.options);
        // Chaikin's rule reaches farther than the others, so look everywhere.
        const bool everywhere = model.options.creasing == Creasing::Chaikin && l < 2;
        const Index step = everywhere ? 1 : 1 + level.topology.face_count() / 20;
        for (Index f = 0; f < level.topology.face_count(); f += step) {
            const Index base = f >> (2 * l);
            if (model.mesh.holes()[base]) continue;
            for (int i = 0; i < 3; ++i) {
                const Index v = level.topology.triangles[f][i];
                const auto [x, y] = corners[f][i];
                const auto stencil = surface.stencil(base, High(x), High(y)).value();
                const auto over_control = [&](const std::vector<High>& mask) {
                    std::vector<High> out(V, High(0));
                    const auto ring = level.topology.ring(v);
                    for (std::size_t k = 0; k < mask.size(); ++k) {
                        const auto& row = rows[k < ring.size() ? level.topology.other_end(ring[k], v) : v];
                        for (Index c = 0; c < V; ++c) out[c] += mask[k] * row[c];
                    }
                    return out;
                };
                const double bound = (stencil.weight_error[0] + 30.0 * (l + 1)) * kHighRoundoff;
                const LimitMasks<High>& masks = table.masks(v);
                off.add(
                    distance(dense(stencil, Derivative::Position, V), over_control(masks.position)) / bound,
                    l);
                const auto& sector = sector_with(masks, level.topology, f, i);
                EXPECT_EQ(sector.no_normal, stencil.no_normal);
                if (sector.no_normal != NoNormal::None) continue;
                const auto du = dense(stencil, Derivative::Du, V), dv = dense(stencil, Derivative::Dv, V);
                for (const auto* tangent : {&sector.tangent1, &sector.tangent2})
                    planes.add(outside_of_plane(over_control(*tangent), du, dv) / (1000 * bound), l);
            }
        }
        if (l == levels) break;
        auto next = next_level(level, model.options).value();
        const auto table_of_weights = weights_of<High>(next.rows, model.options.weights);
        std::vector<std::vector<High>> child_rows;
        for (std::size_t r = 0; r < next.rows.row_count(); ++r) {
            auto& row = child_rows.emplace_back(V, High(0));
            const auto columns = next.rows.columns_of(r);
            for (std::size_t k = 0; k < columns.size(); ++k)
                for (Index c = 0; c < V; ++c)
                    row[c] += table_of_weights[next.rows.mask_of_row[r]][k] * rows[columns[k]][c];
        }
        rows = std::move(child_rows);
        std::vector<std::array<std::array<double, 2>, 3>> child_corners;
        for (const auto& c : corners) {
            const auto middle = [&](int i, int j) -> std::array<double, 2> {
                return {(c[i][0] + c[j][0]) / 2, (c[i][1] + c[j][1]) / 2};
            };
            const auto e0 = middle(0, 1), e1 = middle(1, 2), e2 = middle(2, 0);
            child_corners.push_back({c[0], e0, e2});
            child_corners.push_back({e0, c[1], e1});
            child_corners.push_back({e2, e1, c[2]});
            child_corners.push_back({e1, e2, e0});
        }
        corners = std::move(child_corners);
        level = std::move(next.child);
    }
    off.check();
    planes.check();
}

// Central differences of the first derivatives, in 38 digits.
TEST_P(EvaluateEveryModel, SecondDerivativesAreThoseOfTheFirst) {
    LimitSurface<High> surface(model.mesh, model.options);
    const Index V = model.mesh.vertex_count();
    const double h = 0x1p-60;
    // The difference is off by h max |third derivative|, which is 400 for the basis at most, times 8 a level:
    // 3 levels for these parameters, 10 more where sharpness lasts longest.  Rounding over h is far below.
    Observed off(model.name + ": |difference quotient - second derivative|, sum over a row", "face",
                 h * std::pow(8.0, 13) * 400);
    const std::array<std::array<double, 2>, 4> inside{
        {{0.25, 0.25}, {0.3125, 0.40625}, {0.125, 0.6875}, {0.71875, 0.15625}}};
    for (const Index f : faces())
        for (const auto& [u, v] : inside) {
            const auto row = [&](const High& x, const High& y, Derivative d) {
                return dense(surface.stencil(f, x, y).value(), d, V);
            };
            const auto check = [&](Derivative first, Derivative second, double du, double dv) {
                const auto ahead = row(High(u) + du, High(v) + dv, first),
                           behind = row(High(u) - du, High(v) - dv, first);
                const auto exact = row(High(u), High(v), second);
                std::vector<High> quotient(V);
                for (Index c = 0; c < V; ++c) quotient[c] = (ahead[c] - behind[c]) / (2 * h);
                off.add(distance(quotient, exact), f);
            };
            check(Derivative::Du, Derivative::Duu, h, 0);
            check(Derivative::Du, Derivative::Duv, 0, h);
            check(Derivative::Dv, Derivative::Duv, h, 0);
            check(Derivative::Dv, Derivative::Dvv, 0, h);
            check(Derivative::Position, Derivative::Du, h, 0);
            check(Derivative::Position, Derivative::Dv, 0, h);
        }
    off.check();
}

// On an edge, both faces give the same point and the same derivative along it; where the edge is smooth, also
// the same derivative across it.
TEST_P(EvaluateEveryModel, BothFacesAgreeOnTheirEdge) {
    LimitSurface<High> surface(model.mesh, model.options);
    const Topology& t = model.mesh.topology();
    const SchemeLevel control = control_level(model.mesh, model.options.boundary);
    const Index V = t.vertex_count;
    Observed off(model.name + ": sum |w - w of the other face| / bound", "edge", 1);
    const std::array<std::array<double, 2>, 3> corner{{{0, 0}, {1, 0}, {0, 1}}};
    const Index step = 1 + t.edge_count() / 15;
    for (Index e = 0; e < t.edge_count(); e += step) {
        const auto [f0, f1] = t.edge_faces[e];
        if (f1 == kNone || model.mesh.holes()[f0] || model.mesh.holes()[f1]) continue;
        const bool smooth = !is_sharp(control.sharpness.edge[e]);
        for (const double s : {0.5, 0.1875, 0.96875}) {
            std::array<std::vector<High>, 2> point, along, across;
            double bound = 0;
            for (int side = 0; side < 2; ++side) {
                const Index f = t.edge_faces[e][side];
                const int i = t.corner_of_edge(f, e), j = next_corner(i), k = previous_corner(i);
                const double x = side == 0 ? s : 1 - s;  // the other face runs along it the other way
                const auto at = [&](int c) { return (1 - x) * corner[i][c] + x * corner[j][c]; };
                const auto stencil = surface.stencil(f, High(at(0)), High(at(1))).value();
                const auto du = dense(stencil, Derivative::Du, V), dv = dense(stencil, Derivative::Dv, V);
                // The derivative in a direction of the parameter plane; `side` 1 looks the other way.
                const auto toward = [&](double x_direction, double y_direction) {
                    std::vector<High> out(V);
                    for (Index c = 0; c < V; ++c)
                        out[c] = (side == 0 ? 1 : -1) * (x_direction * du[c] + y_direction * dv[c]);
                    return out;
                };
                point[side] = dense(stencil, Derivative::Position, V);
                along[side] = toward(corner[j][0] - corner[i][0], corner[j][1] - corner[i][1]);
                // Across a smooth edge: to the middle of it from the third corner, in both faces.
                across[side] = toward(corner[k][0] - (corner[i][0] + corner[j][0]) / 2,
                                      corner[k][1] - (corner[i][1] + corner[j][1]) / 2);
                bound += (stencil.weight_error[1] + stencil.weight_error[2] + stencil.weight_error[0]) *
                         kHighRoundoff;
            }
            off.add(distance(point[0], point[1]) / bound, e);
            off.add(distance(along[0], along[1]) / bound, e);
            // Inside an edge the surface is regular, and the parameters of both faces are those of one
            // lattice.
            if (smooth) off.add(distance(across[0], across[1]) / bound, e);
        }
    }
    if (t.face_count() > 1) off.check();  // a single triangle has no such edge
}

INSTANTIATE_TEST_SUITE_P(Models, EvaluateEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

TEST(Evaluate, RefusesWhatHasNoSurface) {
    const SchemeOptions options;
    const auto mesh = tests::mesh_of(tests::wheel(5));
    const auto code = [&](Index face, double u, double v) {
        return evaluate(mesh, options, face, u, v).error().code;
    };
    EXPECT_EQ(code(-1, 0, 0), ErrorCode::IndexOutOfRange);
    EXPECT_EQ(code(5, 0, 0), ErrorCode::IndexOutOfRange);
    EXPECT_EQ(code(0, -0x1p-60, 0), ErrorCode::OutsideDomain);
    EXPECT_EQ(code(0, 0.75, 0.5), ErrorCode::OutsideDomain);
    EXPECT_EQ(code(0, std::nan(""), 0), ErrorCode::OutsideDomain);
    EXPECT_EQ(code(0, 0, std::numeric_limits<double>::infinity()), ErrorCode::OutsideDomain);

    SchemeOptions none;
    none.boundary = BoundaryRule::None;
    EXPECT_EQ(evaluate(mesh, none, 0, 0.25, 0.25).error().code, ErrorCode::NoLimitSurface);
    auto data = tests::tetrahedron();
    data.holes = {2};
    const auto holed = tests::mesh_of(std::move(data));
    EXPECT_EQ(evaluate(holed, options, 2, 0.25, 0.25).error().code, ErrorCode::NoLimitSurface);
    EXPECT_TRUE(evaluate(holed, options, 1, 0.25, 0.25));
}

TEST(Evaluate, SaysWhatTheDerivativesAre) {
    const SchemeOptions options;
    const auto at_centre = [&](const TriangleMesh& mesh) {
        return evaluate(mesh, options, 0, 0.0, 0.0).value();
    };
    EXPECT_EQ(at_centre(tests::mesh_of(tests::wheel(6))).smoothness, Smoothness::Regular);
    EXPECT_EQ(at_centre(tests::mesh_of(tests::wheel(5))).smoothness, Smoothness::TangentPlane);
    EXPECT_EQ(at_centre(tests::mesh_of(tests::open_fan(3))).smoothness, Smoothness::Regular);
    EXPECT_EQ(at_centre(tests::mesh_of(tests::open_fan(4))).smoothness, Smoothness::TangentPlane);
    const auto folded = at_centre(tests::mesh_of(tests::open_fan(7)));
    EXPECT_EQ(folded.smoothness, Smoothness::NoPlane);
    EXPECT_EQ(folded.no_normal, NoNormal::FoldedCrease);
    EXPECT_EQ(folded.at(Derivative::Du), glm::dvec3(0));
}

// A bowl over a wheel: its second derivatives near the vertex, measured in the tangent plane, change by
// mu / lambda^2 a level.
TEST(Curvature, IsContinuousBoundedOrUnboundedByValence) {
    for (const int n : {3, 4, 5, 6, 7, 8, 12}) {
        auto data = tests::bipyramid(n);  // the apex 0 has valence n
        const auto mesh = tests::mesh_of(std::move(data));
        LimitSurface<High> surface(mesh, {});
        const auto points = convert_points<High>(mesh.positions());
        // Second fundamental form over first: the largest |d . N| / |t|^2 near the vertex.
        const auto curvature = [&](double distance) {
            const auto p =
                apply<High>(surface.stencil(0, High(distance), High(distance) / 4).value(), points);
            const auto vec = [](const Vec3<High>& x) { return std::array<High, 3>{x.x, x.y, x.z}; };
            const auto dot3 = [](const auto& a, const auto& b) {
                return High(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            };
            const auto du = vec(p.at(Derivative::Du)), dv = vec(p.at(Derivative::Dv));
            const std::array<High, 3> normal{du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                                             du[0] * dv[1] - du[1] * dv[0]};
            const High area = sqrt(dot3(normal, normal));
            const High L = dot3(vec(p.at(Derivative::Duu)), normal) / area,
                       M = dot3(vec(p.at(Derivative::Duv)), normal) / area,
                       N = dot3(vec(p.at(Derivative::Dvv)), normal) / area;
            const High E = dot3(du, du), F = dot3(du, dv), G = dot3(dv, dv);
            const High mean = (E * N - 2 * F * M + G * L) / (2 * (E * G - F * F));
            const High gauss = (L * N - M * M) / (E * G - F * F);
            return std::sqrt(static_cast<double>(abs(High(4 * mean * mean - 2 * gauss))));  // of k1^2 + k2^2
        };
        // Where the distance is small other modes have died out, but at small valences 38 digits run out,
        // too.
        const double near = n < 7 ? 0x1p-20 : 0x1p-45;
        const double growth = std::pow(curvature(near * 0x1p-10) / curvature(near), 0.1);  // a level
        fmt::print("[ OBSERVED ] valence {}: curvature changes {:.6f} times a level\n", n, growth);
        if (curvature_at(n) == Curvature::Unbounded)
            EXPECT_GT(growth, 1.01) << n;
        else
            EXPECT_NEAR(growth, 1, 0.01) << n;
        EXPECT_EQ(curvature_at(n) == Curvature::Continuous, n == 6);
    }
}

TEST(LimitSurface, AnswersArbitrarilyNearAnIrregularVertex) {
    const auto mesh = tests::mesh_of(tests::bipyramid(5));
    LimitSurface<double> surface(mesh, {});
    const auto at_vertex = surface.stencil(0, 0.0, 0.0).value();
    for (const double near : {0x1p-100, 0x1p-300, 0x1p-1074}) {
        const auto stencil = surface.stencil(0, near, 0.0).value();
        for (std::size_t j = 0; j < stencil.columns.size(); ++j) {
            EXPECT_NEAR(stencil.weights[0][j], at_vertex.weights[0][j], 1e-15);
            for (int d = 0; d < kDerivatives; ++d) EXPECT_TRUE(std::isfinite(stencil.weights[d][j])) << near;
        }
    }
}

}  // namespace
}  // namespace loopcheck::core
