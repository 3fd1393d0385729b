#include "compare/surface/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace loopcheck::compare {
namespace {

using core::Derivative;
using reference::SurfaceSettings;
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

// How many of the faces at the vertex are to be looked at: around a smooth vertex or a cone all are alike.
int different_faces(CornerClass c) {
    using Kind = CornerClass::Kind;
    return c.kind == Kind::Interior || c.kind == Kind::Cone || c.kind == Kind::Regular ? 1 : c.faces;
}

core::Error no_mesh(CornerClass c) {
    return {core::ErrorCode::Unsupported,
            fmt::format("The class {} has no local mesh, or too large a one.", to_string(c)),
            {}};
}

std::optional<double> rate_of(const Atlas& atlas, const AtlasRow& row) {
    const std::size_t n = row.levels.size();
    if (n < 2 || !row.levels[n - 2] || !row.levels[n - 1]) return std::nullopt;
    const AtlasError &before = *row.levels[n - 2], &last = *row.levels[n - 1];
    if (before.is_rounding() || last.is_rounding()) return std::nullopt;
    return std::pow(last.largest[0] / before.largest[0], 1. / (atlas.levels[n - 1] - atlas.levels[n - 2]));
}

// The parameters of one face at the vertex, with the exact surface there.
struct FaceTruth {
    std::vector<core::SurfaceLocation> locations;
    std::vector<core::SurfaceStencil<double>> exact;
};

core::Result<FaceTruth> truth_of(core::LimitSurface<double>& surface, core::Index face,
                                 std::span<const CornerParameter> parameters) {
    FaceTruth out;
    for (const CornerParameter& p : parameters) {
        out.locations.push_back(location_at(face, 0, p));
        const auto& [f, u, v] = out.locations.back();
        auto exact = surface.stencil(f, u, v);
        if (!exact) return tl::unexpected(exact.error());
        out.exact.push_back(std::move(*exact));
    }
    return out;
}

// `last_patch` is the size of the patch of the last level.
core::Result<AtlasError> error_of(std::span<const FaceTruth> faces, double last_patch,
                                  const core::Result<std::vector<std::optional<core::SurfaceRows>>>& rows) {
    if (!rows) return tl::unexpected(rows.error());
    AtlasError out;
    auto row = rows->begin();
    for (const FaceTruth& truth : faces)
        for (std::size_t i = 0; i < truth.exact.size(); ++i, ++row) {
            const auto& [face, u, v] = truth.locations[i];
            if (!*row)
                return core::fail(core::ErrorCode::SubjectFailed,
                                  "There is no surface where there must be one.",
                                  {core::Place::Kind::Face, face});
            add(out, **row, truth.exact[i], place_in_patch(u + v, last_patch));
        }
    return out;
}

// `settings` with the same levels: the exact surface is computed once for all.
std::vector<core::Result<AtlasError>> measure(CornerClass c, std::span<const SurfaceSettings> settings,
                                              const SurfaceEvaluator& evaluate) {
    const auto all = [&](const core::Error& error) {
        return std::vector<core::Result<AtlasError>>(settings.size(), tl::unexpected(error));
    };
    const auto mesh = local_mesh(c);
    if (!mesh || different_faces(c) > kMostLocalFaces) return all(no_mesh(c));
    core::SchemeOptions options;
    options.boundary = core::BoundaryRule::EdgeOnly;
    const int level = settings.front().sharp_level;
    auto parameters = crowded_parameters(level + kAtlasOctaves);
    parameters.push_back({0, 0});

    core::LimitSurface<double> surface(*mesh, options);
    std::vector<FaceTruth> faces;
    std::vector<core::SurfaceLocation> locations;
    for (core::Index f = 0; f < different_faces(c); ++f) {
        auto truth = truth_of(surface, f, parameters);
        if (!truth) return all(truth.error());
        locations.insert(locations.end(), truth->locations.begin(), truth->locations.end());
        faces.push_back(std::move(*truth));
    }
    std::vector<core::Result<AtlasError>> out;
    for (const SurfaceSettings& s : settings)
        out.push_back(error_of(faces, std::ldexp(1, -level), evaluate(*mesh, options, s, locations)));
    return out;
}

}  // namespace

core::Result<AtlasError> atlas_error(CornerClass c, const reference::SurfaceSettings& settings,
                                     const SurfaceEvaluator& evaluate) {
    return std::move(measure(c, std::array{settings}, evaluate).front());
}

std::vector<core::Result<AtlasError>> atlas_errors(CornerClass c, std::span<const SurfaceWay> ways, int level,
                                                   const SurfaceEvaluator& evaluate) {
    std::vector<SurfaceSettings> settings;
    for (const SurfaceWay& way : ways) settings.push_back({way.method, level, level, way.sharpness});
    return measure(c, settings, evaluate);
}

const AtlasError* LocalErrors::of(const SurfaceWay& way, CornerClass c) {
    auto found = known_.find(c);
    if (found == known_.end()) found = known_.emplace(c, atlas_errors(c, ways_, 1, evaluate_)).first;
    const auto at = std::find_if(ways_.begin(), ways_.end(),
                                 [&](const SurfaceWay& known) { return known.name == way.name; });
    const auto& error = found->second.at(static_cast<std::size_t>(at - ways_.begin()));
    return error ? &*error : nullptr;
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
        for (const CornerClass& c : classes)
            out.rows.push_back({std::string(way.name), c, {}, {}, eigenvalue(c)});
    for (std::size_t k = 0; k < classes.size(); ++k) {
        if (progress) progress(k, classes.size(), to_string(classes[k]));
        for (const int level : levels) {
            auto errors = atlas_errors(classes[k], ways, level, evaluate);
            for (std::size_t i = 0; i < ways.size(); ++i)
                out.rows[i * classes.size() + k].levels.push_back(std::move(errors[i]));
        }
    }
    for (AtlasRow& row : out.rows) row.rate = rate_of(out, row);
    return out;
}

}  // namespace loopcheck::compare
