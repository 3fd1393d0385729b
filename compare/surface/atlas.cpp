#include "compare/surface/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace loopcheck::compare {
namespace {

using core::Derivative;
using Weights = std::vector<double>;
using AllWeights = std::array<Weights, core::kDerivatives>;

// a x + b y + c z, with weights over the same columns
Weights combined(double a, const Weights& x, double b, const Weights& y, double c = 0,
                 const Weights& z = {}) {
    Weights out(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) out[j] = a * x[j] + b * y[j] + (c == 0 ? 0 : c * z[j]);
    return out;
}

// The derivatives of an order with respect to (u, v) of the face, be the vertex its corner 0, 1 or 2.  At
// corner 0, u = x and v = y; at corner 1, x = v and y = 1 - u - v, so d/du = -d/dy, d/dv = d/dx - d/dy; at
// corner 2, y = u and x = 1 - u - v, so d/du = d/dy - d/dx, d/dv = -d/dx.  Signs do not matter here.
std::vector<Weights> turned(const AllWeights& w, int order) {
    if (order == 0) return {w[0]};
    if (order == 1) return {w[1], w[2], combined(1, w[1], -1, w[2])};
    return {w[3],
            w[4],
            w[5],
            combined(1, w[3], -2, w[4], 1, w[5]),
            combined(1, w[5], -1, w[4]),
            combined(1, w[3], -1, w[4])};
}

// The longest exact row of an order at a parameter.
double exact_size(const core::SurfaceStencil<double>& exact, int order) {
    double out = 0;
    for (const Weights& w : turned(exact.weights, order)) out = std::max(out, size_of(w));
    return out;
}

// Where a parameter is in the patch of the last level around the vertex.
enum class PlaceInPatch { Outside, NearHalf, FarHalf };

PlaceInPatch place_in_patch(double distance, double size) {
    if (!(distance > 0 && distance < size)) return PlaceInPatch::Outside;
    return distance < size / 2 ? PlaceInPatch::NearHalf : PlaceInPatch::FarHalf;
}

void add(AtlasError& error, const core::SurfaceRows& tested, const core::SurfaceStencil<double>& exact,
         PlaceInPatch place) {
    const int orders = place == PlaceInPatch::Outside ? 1 : kOrders;
    const AllWeights off = difference(tested, exact).weights;
    for (int order = 0; order < orders; ++order) {
        double size = 0;
        for (const Weights& w : turned(off, order)) {
            size = larger(size, size_of(w));
            error.unbalance[order] = larger(error.unbalance[order], unbalance_of(w));
        }
        error.largest[order] = larger(error.largest[order], size);
        if (place == PlaceInPatch::FarHalf)
            error.relative[order] = larger(error.relative[order], size / exact_size(exact, order));
    }
    for (int d = 0; d < core::kDerivatives; ++d) {
        const int order = order_of(static_cast<Derivative>(d));
        if (order < orders)
            error.rounding[order] =
                std::max(error.rounding[order], allowed_rounding(exact, static_cast<Derivative>(d)));
    }
}

core::Error no_mesh(CornerClass c) {
    return {core::ErrorCode::Unsupported,
            fmt::format("There is no mesh with only one irregular vertex of the class {}.", to_string(c)),
            {}};
}

std::optional<double> rate_of(const Atlas& atlas, const AtlasRow& row) {
    const std::size_t n = row.levels.size();
    if (n < 2 || !row.levels[n - 2] || !row.levels[n - 1]) return std::nullopt;
    const AtlasError &before = *row.levels[n - 2], &last = *row.levels[n - 1];
    if (before.is_rounding() || last.is_rounding()) return std::nullopt;
    return std::pow(last.largest[0] / before.largest[0], 1. / (atlas.levels[n - 1] - atlas.levels[n - 2]));
}

}  // namespace

core::Result<AtlasError> atlas_error(CornerClass c, const reference::SurfaceSettings& settings,
                                     const SurfaceEvaluator& evaluate) {
    const auto mesh = local_mesh(c);
    if (!mesh) return tl::unexpected(no_mesh(c));
    core::SchemeOptions options;
    options.boundary = core::BoundaryRule::EdgeOnly;
    auto parameters = crowded_parameters(settings.sharp_level + kAtlasOctaves);
    parameters.push_back({0, 0});
    std::vector<core::SurfaceLocation> locations;
    for (core::Index f = 0; f < mesh->topology().face_count_at(0); ++f)
        for (const CornerParameter& p : parameters) locations.push_back(location_at(f, 0, p));
    const auto rows = evaluate(*mesh, options, settings, locations);
    if (!rows) return tl::unexpected(rows.error());

    core::LimitSurface<double> surface(*mesh, options);
    AtlasError out;
    const double last_patch = std::ldexp(1, -settings.sharp_level);
    for (std::size_t i = 0; i < locations.size(); ++i) {
        const auto& [face, u, v] = locations[i];
        const auto exact = surface.stencil(face, u, v);
        if (!exact) return tl::unexpected(exact.error());
        if (!(*rows)[i])
            return core::fail(core::ErrorCode::SubjectFailed, "There is no surface where there must be one.",
                              {core::Place::Kind::Face, face});
        add(out, *(*rows)[i], *exact, place_in_patch(u + v, last_patch));
    }
    return out;
}

const AtlasError* LocalErrors::of(CornerClass c) {
    auto found = known_.find(c);
    if (found == known_.end())
        found = known_.emplace(c, atlas_error(c, {way_.method, 1, 1, way_.sharpness}, evaluate_)).first;
    return found->second ? &*found->second : nullptr;
}

std::vector<CornerClass> atlas_classes() {
    using Kind = CornerClass::Kind;
    std::vector<CornerClass> out;
    const auto add = [&](Kind kind, int first, int last) {
        for (int n = first; n <= last; ++n) out.push_back({kind, n});
    };
    add(Kind::Interior, 3, 20);
    add(Kind::Boundary, 1, 8);
    add(Kind::Corner, 1, 5);
    add(Kind::Dart, 3, 10);
    return out;
}

Atlas make_atlas(std::span<const SurfaceWay> ways, std::span<const CornerClass> classes,
                 std::span<const int> levels, const SurfaceEvaluator& evaluate,
                 const AtlasProgress& progress) {
    Atlas out{{levels.begin(), levels.end()}, {}};
    for (const SurfaceWay& way : ways)
        for (const CornerClass& c : classes) {
            if (progress)
                progress(out.rows.size(), ways.size() * classes.size(),
                         fmt::format("{} {}", way.name, to_string(c)));
            AtlasRow row{std::string(way.name), c, {}, {}, eigenvalue(c)};
            for (const int level : levels)
                row.levels.push_back(atlas_error(c, {way.method, level, level, way.sharpness}, evaluate));
            row.rate = rate_of(out, row);
            out.rows.push_back(std::move(row));
        }
    return out;
}

}  // namespace loopcheck::compare
