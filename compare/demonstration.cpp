#include "compare/demonstration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "compare/demonstration_meshes.h"
#include "compare/limit/opensubdiv_masks.h"
#include "compare/surface/atlas.h"
#include "core/loop/stencils.h"
#include "reference/opensubdiv/face_varying.h"
#include "reference/opensubdiv/limit.h"
#include "reference/opensubdiv/opensubdiv.h"
#include "reference/opensubdiv/surface.h"

namespace loopcheck::compare {
namespace {

using core::Derivative;
using core::HighPrecision;
using core::Index;
using core::MeshData;
using core::Result;
using core::SchemeOptions;
using reference::SurfaceMethod;
using Weights = std::vector<double>;

constexpr double kRoundoff = 0x1p-53;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

core::TriangleMesh mesh_of(MeshData data) {
    return core::TriangleMesh::make(std::move(data)).value();  // the meshes here are well formed
}

double distance(const Weights& a, const Weights& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}
double size_of_row(const Weights& a) {
    return distance(a, Weights(a.size(), 0));
}

// A direction has no length: sum |w| = 1 and the sign of `like`.
Weights as_direction(Weights w, const Weights& like) {
    const double size = size_of_row(w);
    double along = 0;
    for (std::size_t i = 0; i < w.size(); ++i) along += w[i] * like[i];
    for (double& x : w) x /= along < 0 ? -size : size;
    return w;
}

Weights dense(const core::SurfaceRows& rows, Derivative d, std::size_t vertices) {
    Weights out(vertices, 0);
    const auto& weights = rows.weights[static_cast<int>(d)];
    for (std::size_t j = 0; j < rows.columns.size(); ++j) out[rows.columns[j]] += weights[j];
    return out;
}

Weights dense(const core::SparseMatrix& matrix, Index row) {
    Weights out(matrix.column_count, 0);
    for (std::size_t k = matrix.offsets[row]; k < matrix.offsets[row + 1]; ++k)
        out[matrix.columns[k]] = matrix.weights[k];
    return out;
}

// The weights of a linear result, found by unit control points, three at a time.
using Linear = std::function<Result<glm::dvec3>(const core::TriangleMesh&)>;
Result<Weights> weights_by_units(MeshData data, const Linear& linear) {
    Weights out;
    const std::size_t count = data.positions.size();
    for (std::size_t first = 0; first < count; first += 3) {
        data.positions.assign(count, glm::dvec3(0));
        for (std::size_t i = first; i < std::min(first + 3, count); ++i)
            data.positions[i][static_cast<int>(i - first)] = 1;
        const auto result = linear(mesh_of(data));
        if (!result) return tl::unexpected(result.error());
        for (std::size_t i = first; i < std::min(first + 3, count); ++i)
            out.push_back((*result)[static_cast<int>(i - first)]);
    }
    return out;
}

enum class Part { Position, Tangent2 };

Result<Weights> observed_limit(const MeshData& data, const SchemeOptions& options, Part part) {
    return weights_by_units(data, [&](const core::TriangleMesh& mesh) -> Result<glm::dvec3> {
        const auto limits = reference::opensubdiv_limit(mesh, options, 0, core::Precision::Double);
        if (!limits) return tl::unexpected(limits.error());
        const core::LimitLevel& level = limits->levels.front();
        return part == Part::Position ? level.positions[0] : level.tangent2[0];
    });
}

Result<Weights> observed_refined(const MeshData& data, const SchemeOptions& options, Index vertex) {
    return weights_by_units(data, [&](const core::TriangleMesh& mesh) -> Result<glm::dvec3> {
        const auto refined = reference::opensubdiv_refine(mesh, options, 1, core::Precision::Double);
        if (!refined) return tl::unexpected(refined.error());
        return refined->levels.back().positions[vertex];
    });
}

Result<Weights> observed_surface(const core::TriangleMesh& mesh, const SchemeOptions& options,
                                 const reference::SurfaceSettings& settings, core::SurfaceLocation at,
                                 Derivative d) {
    const auto rows = reference::opensubdiv_surface(mesh, options, settings, std::span(&at, 1));
    if (!rows) return tl::unexpected(rows.error());
    return dense(rows->front().value(), d, static_cast<std::size_t>(mesh.vertex_count()));
}

Weights exact_surface(const core::TriangleMesh& mesh, const SchemeOptions& options, core::SurfaceLocation at,
                      Derivative d) {
    core::LimitSurface<HighPrecision> surface(mesh, options);
    const auto stencil = surface.stencil(at.face, HighPrecision(at.u), HighPrecision(at.v)).value();
    return dense(core::as_rows(stencil), d, static_cast<std::size_t>(mesh.vertex_count()));
}

// Masks over the ring of vertex 0 as weights over all vertices.
Weights over_vertices(const core::Topology& t, const std::vector<HighPrecision>& mask) {
    Weights out(t.vertex_count, 0);
    const auto ring = t.ring(0);
    for (std::size_t i = 0; i < mask.size(); ++i)
        out[i < ring.size() ? t.other_end(ring[i], 0) : 0] += static_cast<double>(mask[i]);
    return out;
}

// Vertex 0 after `level` exact levels, then by the mask of a smooth vertex.
Weights smoothed_at_level(const core::TriangleMesh& mesh, const SchemeOptions& options, int level) {
    const auto rows = core::stencils(mesh, options, level, core::StencilOf::Vertex, kNoLimit).value();
    core::Topology t = mesh.topology();
    for (int l = 0; l < level; ++l) t = core::split(t).value();
    const int n = t.face_count_at(0);
    const auto mask = core::limit_masks<HighPrecision>({n, false, false, {}}, options.weights).position;
    const Weights local = over_vertices(t, mask);
    Weights out(mesh.vertex_count(), 0);
    for (Index v = 0; v < t.vertex_count; ++v)
        if (local[v] != 0) {
            const Weights row = dense(rows, v);
            for (std::size_t c = 0; c < out.size(); ++c) out[c] += local[v] * row[c];
        }
    return out;
}

// What all demonstrations of weights begin with.  A sum of a few dozen weights, each the outcome of some ten
// sums of products of them, is right to some hundred roundings.
Demonstration shown_on(MeshData mesh, std::string mesh_in_words, std::string quantity) {
    Demonstration out;
    out.mesh = std::move(mesh);
    out.mesh_in_words = std::move(mesh_in_words);
    out.quantity = std::move(quantity);
    out.allowed = 256 * kRoundoff;
    return out;
}

// A vertex limit: position, or second tangent, of vertex 0.
Result<Demonstration> limit_of_vertex_0(Demonstration d, Part part) {
    const SchemeOptions options;
    const auto mesh = mesh_of(d.mesh);
    const core::SchemeLevel level = core::control_level(mesh, options.boundary);
    core::LimitTable<HighPrecision> table(level, options);
    const auto& right = table.masks(0);
    const auto wrong = opensubdiv_limit_masks(limit_vertex(level, 0).star);
    const auto rows = [&](const core::LimitMasks<HighPrecision>& masks) {
        return over_vertices(level.topology,
                             part == Part::Position ? masks.position : masks.sectors.front().tangent2);
    };
    auto observed = observed_limit(d.mesh, options, part);
    if (!observed) return tl::unexpected(observed.error());
    d.exact = rows(right);
    d.predicted = rows(wrong);
    d.observed = std::move(*observed);
    if (part == Part::Tangent2) {
        d.exact = as_direction(d.exact, d.exact);
        d.predicted = as_direction(d.predicted, d.exact);
        d.observed = as_direction(d.observed, d.exact);
    }
    return d;
}

Result<Demonstration> limit_dart() {
    MeshData mesh = flat_wheel(6);
    mesh.creases.push_back({0, 1, core::kInfiniteSharpness});
    return limit_of_vertex_0(
        shown_on(std::move(mesh), "6 faces around vertex 0, its edge to vertex 1 infinitely sharp",
                 "limit position of vertex 0"),
        Part::Position);
}

Result<Demonstration> limit_semi_sharp() {
    MeshData mesh = flat_wheel(6);
    mesh.corners.push_back({0, 0.5F});
    return limit_of_vertex_0(shown_on(std::move(mesh), "6 faces around vertex 0, which has the sharpness 0.5",
                                      "limit position of vertex 0"),
                             Part::Position);
}

Result<Demonstration> limit_crease_tangent() {
    return limit_of_vertex_0(shown_on(flat_fan(4), "4 faces at vertex 0 of a boundary",
                                      "limit tangent of vertex 0 across the boundary, scaled to sum |w| = 1"),
                             Part::Tangent2);
}

Result<Demonstration> limit_corner_tangent() {
    MeshData mesh = flat_fan(2);
    mesh.corners.push_back({0, core::kInfiniteSharpness});
    return limit_of_vertex_0(shown_on(std::move(mesh), "2 faces at vertex 0, an infinitely sharp corner",
                                      "second limit tangent of vertex 0, scaled to sum |w| = 1"),
                             Part::Tangent2);
}

Result<Demonstration> limit_valence_2() {
    Demonstration d =
        shown_on(flat_pillow(), "two triangles glued along all edges", "second limit tangent of vertex 0");
    auto observed = observed_limit(d.mesh, {}, Part::Tangent2);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    d.exact.assign(3, 0);
    d.allowed = 0;                       // sum_i sin(2 pi i/2) e_i is 0, without any rounding
    d.predicted_amount = 2 * kRoundoff;  // sin of the double next to pi, and of twice it
    return d;
}

Result<Demonstration> chaikin_overweight() {
    MeshData mesh = flat_octahedron();
    mesh.creases = {{0, 1, 1.2F}, {0, 3, 0.05F}, {1, 4, 0.05F}};
    Demonstration d = shown_on(
        std::move(mesh), "an octahedron, edge 0-1 of sharpness 1.2 between two of 0.05; creasing chaikin",
        "edge point of edge 0-1");
    SchemeOptions options;
    options.creasing = core::Creasing::Chaikin;
    const auto control = mesh_of(d.mesh);
    const core::Topology& t = control.topology();
    const auto ring = t.ring(0);
    const Index edge =
        *std::find_if(ring.begin(), ring.end(), [&](Index e) { return t.other_end(e, 0) == 1; });
    const Index point = t.vertex_count + edge;
    const auto row = [&](const SchemeOptions& rules) {
        return dense(core::stencils(control, rules, 1, core::StencilOf::Vertex, kNoLimit).value(), point);
    };
    d.exact = row(options);
    options.crease_share = core::CreaseShare::Unclamped;
    d.predicted = row(options);
    auto observed = observed_refined(d.mesh, options, point);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    return d;
}

Result<Demonstration> uniform_jump() {
    const auto with_sharpness = [](float s) {
        MeshData mesh = flat_wheel(6);
        mesh.creases = {{0, 1, 0.5F}, {0, 4, s}};
        return mesh;
    };
    const float above = std::nextafter(1.0F, 2.0F);
    Demonstration d =
        shown_on(with_sharpness(1), "6 faces around vertex 0, its edges to 1 and 4 of sharpness 0.5 and 1",
                 "vertex point of vertex 0: at sharpness 1, and at the next float above");
    d.columns[0] = "at 1";
    d.columns[1] = "above 1";
    for (auto [row, s] : {std::pair{&d.exact, 1.0F}, std::pair{&d.observed, above}}) {
        auto weights = observed_refined(with_sharpness(s), {}, 0);
        if (!weights) return tl::unexpected(weights.error());
        *row = std::move(*weights);
    }
    const auto ours =
        core::stencils(mesh_of(with_sharpness(above)), {}, 1, core::StencilOf::Vertex, kNoLimit).value();
    d.predicted = dense(ours, 0);
    return d;
}

Result<Demonstration> second_derivative_sign() {
    Demonstration d = shown_on(flat_octahedron(), "an octahedron",
                               "duu of face 6 at (0.375, 0.3125), in the centre triangle of level 1, by Bfr");
    const auto mesh = mesh_of(d.mesh);
    const core::SurfaceLocation at{6, 0.375, 0.3125};
    d.exact = exact_surface(mesh, {}, at, Derivative::Duu);
    auto observed = observed_surface(mesh, {}, {SurfaceMethod::Bfr, 2, 6}, at, Derivative::Duu);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    for (const double w : d.exact) d.predicted.push_back(-w);
    d.allowed *= 4 * size_of_row(d.exact);  // two doublings of the parameter; weights of this size
    return d;
}

Result<Demonstration> bfr_approximation() {
    const CornerClass valence_5{CornerClass::Kind::Interior, 5};
    const SurfaceWay& way = *find_way("bfr");
    const reference::SurfaceSettings settings{way.method, 2, 6, way.sharpness};
    Demonstration d =
        shown_on(flat_disc(5, 3), "three rings around a vertex of valence 5",
                 "position of face 0 at (0.0625, 0.0625), by Bfr at its default levels 2 and 6");
    SchemeOptions options;
    options.boundary = core::BoundaryRule::EdgeOnly;
    const auto control = mesh_of(d.mesh);
    const core::SurfaceLocation at{0, 0.0625, 0.0625};
    d.exact = exact_surface(control, options, at, Derivative::Position);
    auto observed = observed_surface(control, options, settings, at, Derivative::Position);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    const auto bound = atlas_error(valence_5, settings, reference::opensubdiv_surface);
    if (!bound) return tl::unexpected(bound.error());
    d.predicted_amount = bound->largest[0];
    return d;
}

Result<Demonstration> bspline_endcap() {
    Demonstration d =
        shown_on(flat_octahedron(), "an octahedron",
                 "sum of the position weights of face 6 near its first vertex, by PatchTable with the "
                 "box-spline end cap at levels 2 and 2");
    const auto mesh = mesh_of(d.mesh);
    double sum = 0;
    for (const double u : {0.03125, 0.0625, 0.09375}) {
        const auto row =
            observed_surface(mesh, {}, {SurfaceMethod::PatchBox, 2, 2, reference::PatchSharpness::Exact},
                             {6, u, 0.0625}, Derivative::Position);
        if (!row) return tl::unexpected(row.error());
        double of_row = 0;
        for (const double w : *row) of_row += w;
        if (std::abs(of_row - 1) >= std::abs(sum - 1) || sum == 0) sum = of_row;
    }
    d.exact = {1};
    d.observed = {sum};
    // Of 12 points, each the sum of as many with six-digit constants: at most 12 half units of the sixth
    // digit.
    d.predicted_amount = 12 * 0.5e-6;
    return d;
}

// A straight crease of some sharpness through the middle of a hexagon, at vertex 0, by a patch that takes it
// for smooth at the last level.
Result<Demonstration> crease_taken_for_smooth(float sharpness, std::string in_words,
                                              const reference::SurfaceSettings& settings, std::string by) {
    constexpr int kRings = 3;
    MeshData mesh = flat_disc(6, kRings);
    for (int step = -kRings; step < kRings; ++step)
        mesh.creases.push_back({on_line(step), on_line(step + 1), sharpness});
    Demonstration d =
        shown_on(std::move(mesh), fmt::format("a hexagon of the triangular lattice, {}", in_words),
                 fmt::format("limit position of vertex 0, by {}", by));
    SchemeOptions options;
    options.boundary = core::BoundaryRule::EdgeOnly;
    const auto control = mesh_of(d.mesh);
    const core::Topology& t = control.topology();
    Index face = 0;
    while (t.triangles[face][0] != 0) ++face;
    d.exact = exact_surface(control, options, {face, 0, 0}, Derivative::Position);
    d.predicted = smoothed_at_level(control, options, settings.sharp_level);
    auto observed = observed_surface(control, options, settings, {face, 0, 0}, Derivative::Position);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    return d;
}

Result<Demonstration> patchtable_defaults() {
    return crease_taken_for_smooth(core::kInfiniteSharpness,
                                   "a straight line through vertex 0 infinitely sharp",
                                   {SurfaceMethod::PatchGregory, 2, 2, reference::PatchSharpness::Default},
                                   "PatchTable as it comes, at level 2");
}

Result<Demonstration> sharpness_cut_off() {
    return crease_taken_for_smooth(3, "a straight line through vertex 0 of sharpness 3",
                                   {SurfaceMethod::Bfr, 2, 2}, "Bfr at levels 2 and 2");
}

Result<Demonstration> bfr_chaikin() {
    constexpr int kRings = 3;
    MeshData mesh = flat_disc(6, kRings);
    const std::array<float, 4> sharpness{0.4F, 0.9F, 2.2F, 3.1F};
    for (int i = 0; i < 4; ++i) mesh.creases.push_back({on_line(i - 2), on_line(i - 1), sharpness[i]});
    Demonstration d =
        shown_on(std::move(mesh),
                 "a hexagon of the triangular lattice, edges of sharpness 0.4, 0.9, 2.2 and 3.1 in a "
                 "straight line, the middle of it vertex 0; creasing chaikin",
                 "limit position of vertex 0, by Bfr at levels 10 and 10");
    SchemeOptions options;
    options.boundary = core::BoundaryRule::EdgeOnly;
    options.creasing = core::Creasing::Chaikin;
    const auto control = mesh_of(d.mesh);
    const core::Topology& t = control.topology();
    const Index far = on_line(-1);
    Index face = 0;  // at vertex 0, and not at the far end of the edge in question
    while (t.triangles[face][0] != 0 || t.triangles[face][1] == far || t.triangles[face][2] == far) ++face;
    d.exact = exact_surface(control, options, {face, 0, 0}, Derivative::Position);

    // The first step with the crease rule for the edge point of that edge, then the limit of level 1.
    const core::SchemeLevel level = core::control_level(control, options.boundary);
    const auto step = core::next_level(level, options).value();
    core::LimitTable<HighPrecision> table(step.child, options);
    const Weights local = over_vertices(step.child.topology, table.masks(0).position);
    const auto rows = core::stencils(control, options, 1, core::StencilOf::Vertex, kNoLimit).value();
    const auto ring = t.ring(0);
    const Index edge =
        *std::find_if(ring.begin(), ring.end(), [&](Index e) { return t.other_end(e, 0) == far; });
    d.predicted.assign(control.vertex_count(), 0);
    for (Index v = 0; v < step.child.topology.vertex_count; ++v) {
        if (local[v] == 0) continue;
        Weights row = dense(rows, v);
        if (v == t.vertex_count + edge) {
            row.assign(row.size(), 0);
            row[0] = row[far] = 0.5;
        }
        for (std::size_t c = 0; c < row.size(); ++c) d.predicted[c] += local[v] * row[c];
    }
    auto observed =
        observed_surface(control, options, {SurfaceMethod::Bfr, 10, 10}, {face, 0, 0}, Derivative::Position);
    if (!observed) return tl::unexpected(observed.error());
    d.observed = std::move(*observed);
    return d;
}

Result<Demonstration> fvar_limit_level_0() {
    // The wheel is cut along 1-0-4: the values of vertices 0, 1 and 4 on its far side are others.
    const std::array<core::Triangle, 6> values{
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {7, 8, 5}, {7, 5, 6}, {7, 6, 9}}};
    Demonstration d = shown_on(
        flat_wheel(6), "6 faces around vertex 0, with values of its own on each side of the seam 1-0-4",
        "values that LimitFaceVarying leaves unwritten: of level 0, and of level 1");
    d.columns[0] = "level 1";
    d.columns[1] = "level 0";
    const auto mesh = mesh_of(d.mesh);
    for (auto [row, level] : {std::pair{&d.exact, 1}, std::pair{&d.observed, 0}}) {
        const auto unwritten = reference::opensubdiv_unwritten_limit_values(mesh, {}, values, 10, level);
        if (!unwritten) return tl::unexpected(unwritten.error());
        *row = {static_cast<double>(unwritten->unwritten.size())};
    }
    d.predicted = {1};
    d.allowed = 0;
    return d;
}

struct Builder {
    std::string_view name;
    Result<Demonstration> (*build)();
};
constexpr std::array kBuilders{Builder{"chaikin-overweight", chaikin_overweight},
                               Builder{"limit-semi-sharp", limit_semi_sharp},
                               Builder{"limit-dart", limit_dart},
                               Builder{"limit-crease-tangent", limit_crease_tangent},
                               Builder{"limit-corner-tangent", limit_corner_tangent},
                               Builder{"limit-valence-2", limit_valence_2},
                               Builder{"bfr-approximation", bfr_approximation},
                               Builder{"second-derivative-sign", second_derivative_sign},
                               Builder{"bspline-endcap", bspline_endcap},
                               Builder{"patchtable-defaults", patchtable_defaults},
                               Builder{"sharpness-cut-off", sharpness_cut_off},
                               Builder{"bfr-chaikin", bfr_chaikin},
                               Builder{"uniform-jump", uniform_jump},
                               Builder{"fvar-limit-level-0", fvar_limit_level_0}};

}  // namespace

std::string_view name(DeviationStatus status) {
    switch (status) {
        case DeviationStatus::AsPredicted:
            return "as predicted";
        case DeviationStatus::Fixed:
            return "fixed";
        case DeviationStatus::New:
            return "new";
    }
    return {};
}

DeviationStatus status_of(const Demonstration& d) {
    const double off = distance(d.observed, d.exact);
    if (off <= d.allowed) return DeviationStatus::Fixed;
    const bool as_predicted =
        d.predicted.empty() ? off <= d.predicted_amount : distance(d.observed, d.predicted) <= d.allowed;
    return as_predicted ? DeviationStatus::AsPredicted : DeviationStatus::New;  // also where a weight is NaN
}

Result<Demonstration> demonstrate(const KnownDeviation& deviation) {
    const auto builder = std::find_if(kBuilders.begin(), kBuilders.end(),
                                      [&](const Builder& b) { return b.name == deviation.name; });
    if (builder == kBuilders.end())
        return core::fail(core::ErrorCode::Unsupported, fmt::format("Nothing shows {}.", deviation.name));
    auto out = builder->build();
    if (!out) return out;
    out->deviation = &deviation;
    out->observed_amount = distance(out->observed, out->exact);
    if (!out->predicted.empty()) out->predicted_amount = distance(out->predicted, out->exact);
    out->status = status_of(*out);
    return out;
}

}  // namespace loopcheck::compare
