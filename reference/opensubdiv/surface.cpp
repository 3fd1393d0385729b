#include "reference/opensubdiv/surface.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <algorithm>
#include <numeric>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

using namespace internal;
namespace Bfr = OpenSubdiv::Bfr;
using core::Index;
using core::SurfaceRows;

using Surfaces = std::vector<std::optional<SurfaceRows>>;
using StencilTable = Far::StencilTableReal<double>;

// Some rows over the control vertices, with the same columns.
template <int kRows>
using Weights = std::array<double, kRows>;
template <int kRows>
struct Rows {
    std::vector<Index> columns;
    std::vector<Weights<kRows>> weights;  // one a column
};

// Adds up such rows.  What it keeps between sums is as long as the mesh, what it does for a sum only as long
// as the sum.
template <int kRows>
class RowSum {
  public:
    explicit RowSum(Index vertex_count) : sums_(vertex_count), seen_(vertex_count, 0) {}

    void add(Index column, const Weights<kRows>& weights, double scale = 1) {
        if (!seen_[column]) columns_.push_back(column);
        seen_[column] = 1;
        for (int d = 0; d < kRows; ++d) sums_[column][d] += scale * weights[d];
    }

    // The sum so far, with ascending columns; the next one starts from zero.
    Rows<kRows> take() {
        std::sort(columns_.begin(), columns_.end());
        Rows<kRows> out{std::move(columns_), {}};
        columns_.clear();
        out.weights.reserve(out.columns.size());
        for (const Index column : out.columns) {
            out.weights.push_back(sums_[column]);
            sums_[column] = {};
            seen_[column] = 0;
        }
        return out;
    }

  private:
    std::vector<Weights<kRows>> sums_;
    std::vector<std::uint8_t> seen_;
    std::vector<Index> columns_;
};

SurfaceRows to_surface_rows(Rows<core::kDerivatives> rows) {
    SurfaceRows out{std::move(rows.columns), {}};
    for (int d = 0; d < core::kDerivatives; ++d) {
        out.weights[d].reserve(rows.weights.size());
        for (const auto& weights : rows.weights) out.weights[d].push_back(weights[d]);
    }
    return out;
}

// Room for the weights of the points of a patch, a row a derivative.
struct PointWeights {
    std::array<std::vector<double>, core::kDerivatives> rows;

    explicit PointWeights(int count) {
        for (auto& row : rows) row.resize(count);
    }
    Weights<core::kDerivatives> at(int i) const {
        Weights<core::kDerivatives> out;
        for (int d = 0; d < core::kDerivatives; ++d) out[d] = rows[d][i];
        return out;
    }
};

// The locations by face, so that each face is set up once.
std::vector<std::size_t> by_face(std::span<const core::SurfaceLocation> locations) {
    std::vector<std::size_t> order(locations.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return locations[a].face < locations[b].face; });
    return order;
}

std::optional<core::Error> check_settings(const SurfaceSettings& settings) {
    if (settings.smooth_level >= 1 && settings.smooth_level <= settings.sharp_level &&
        settings.sharp_level <= kOpensubdivMaxSurfaceLevel)
        return std::nullopt;
    return core::Error{core::ErrorCode::Unsupported,
                       fmt::format("The levels of OpenSubdiv's surface are 1 <= smooth <= sharp <= {}; "
                                   "asked for were smooth {} and sharp {}.",
                                   kOpensubdivMaxSurfaceLevel, settings.smooth_level, settings.sharp_level)};
}

// An interior vertex of valence 2 has the same two faces as its neighbours: is any of it sharp?
bool is_sharp_pillow(const core::TriangleMesh& mesh, Index v) {
    const core::Topology& t = mesh.topology();
    if (t.ring(v).size() != 2 || t.is_boundary_vertex(v)) return false;
    const Index face = t.edge_faces[t.ring(v)[0]][0];
    for (int i = 0; i < 3; ++i)
        if (mesh.edge_sharpness()[t.face_edges[face][i]] > 0 ||
            mesh.vertex_sharpness()[t.triangles[face][i]] > 0)
            return true;
    return false;
}

std::optional<core::Error> check_valences(const core::TriangleMesh& mesh) {
    for (Index v = 0; v < mesh.vertex_count(); ++v)
        if (is_sharp_pillow(mesh, v))
            return core::Error{
                core::ErrorCode::Unsupported,
                fmt::format("Bfr may crash at an interior vertex of valence 2 next to sharpness, such as {}.",
                            v),
                {core::Place::Kind::Vertex, v}};
    return std::nullopt;
}

// ---- Bfr

core::Result<Surfaces> evaluate_bfr(const Far::TopologyRefiner& base, const SurfaceSettings& settings,
                                    std::span<const core::SurfaceLocation> locations) {
    Bfr::SurfaceFactory::Options options;
    options.SetApproxLevelSmooth(settings.smooth_level).SetApproxLevelSharp(settings.sharp_level);
    const Bfr::RefinerSurfaceFactory<> factory(base, options);

    Surfaces out(locations.size());
    RowSum<core::kDerivatives> sum(base.GetLevel(0).GetNumVertices());
    Bfr::Surface<double> surface;
    std::vector<Index> points;
    Index face = core::kNone;
    for (const std::size_t i : by_face(locations)) {
        if (locations[i].face != face) {
            face = locations[i].face;
            points.clear();
            if (factory.InitVertexSurface(face, &surface)) {
                points.resize(surface.GetNumControlPoints());
                surface.GetControlPointIndices(points.data());
            }
        }
        if (points.empty()) continue;
        PointWeights w(static_cast<int>(points.size()));
        const double uv[2] = {locations[i].u, locations[i].v};
        surface.EvaluateStencil(uv, w.rows[0].data(), w.rows[1].data(), w.rows[2].data(), w.rows[3].data(),
                                w.rows[4].data(), w.rows[5].data());
        for (std::size_t j = 0; j < points.size(); ++j) sum.add(points[j], w.at(static_cast<int>(j)));
        out[i] = to_surface_rows(sum.take());
    }
    return out;
}

// ---- Far::PatchTable

Far::PatchTableFactory::Options patch_options(const SurfaceSettings& settings) {
    using Options = Far::PatchTableFactory::Options;
    Options out(static_cast<unsigned>(settings.sharp_level));
    switch (settings.method) {
        case SurfaceMethod::PatchBox:
            out.SetEndCapType(Options::ENDCAP_BSPLINE_BASIS);
            break;
        case SurfaceMethod::PatchLinear:
            out.SetEndCapType(Options::ENDCAP_BILINEAR_BASIS);
            break;
        default:
            out.SetEndCapType(Options::ENDCAP_GREGORY_BASIS);
    }
    out.SetPatchPrecision<double>();
    if (settings.sharpness == PatchSharpness::Exact) {
        out.useInfSharpPatch = true;
        out.generateLegacySharpCornerPatches = false;
    }
    return out;
}

// The points that patches name, over the control vertices: first these and the refined ones, whose stencils
// are so already; then those of the end caps, whose stencils are over the former.  The latter are composed
// when they are needed: OpenSubdiv composes all, in a time that grows with the cube of the valence.
class PatchPoints {
  public:
    PatchPoints(const Far::TopologyRefiner& refiner, const Far::PatchTable& patches)
        : refined_(make_stencils(refiner)),
          local_(patches.GetLocalPointStencilTable<double>()),
          rows_(patches.GetNumLocalPoints()),
          sum_(refiner.GetLevel(0).GetNumVertices()) {}

    void add(Index point, const Weights<core::kDerivatives>& weights, RowSum<core::kDerivatives>& to) {
        if (point < refined_->GetNumStencils()) {
            const auto stencil = refined_->GetStencil(point);
            for (int i = 0; i < stencil.GetSize(); ++i)
                to.add(stencil.GetVertexIndices()[i], weights, stencil.GetWeights()[i]);
        } else {
            const Rows<1>& row = local(point - refined_->GetNumStencils());
            for (std::size_t i = 0; i < row.columns.size(); ++i)
                to.add(row.columns[i], weights, row.weights[i][0]);
        }
    }

  private:
    static std::unique_ptr<const StencilTable> make_stencils(const Far::TopologyRefiner& refiner) {
        using StencilFactory = Far::StencilTableFactoryReal<double>;
        StencilFactory::Options options;
        options.generateControlVerts = true;
        options.generateOffsets = true;
        return std::unique_ptr<const StencilTable>(StencilFactory::Create(refiner, options));
    }

    const Rows<1>& local(Index point) {
        auto& row = rows_[point];
        if (!row) {
            const auto outer = local_->GetStencil(point);
            for (int i = 0; i < outer.GetSize(); ++i) {
                const auto inner = refined_->GetStencil(outer.GetVertexIndices()[i]);
                for (int j = 0; j < inner.GetSize(); ++j)
                    sum_.add(inner.GetVertexIndices()[j], {inner.GetWeights()[j]}, outer.GetWeights()[i]);
            }
            row = sum_.take();
        }
        return *row;
    }

    std::unique_ptr<const StencilTable> refined_;
    const StencilTable* local_;
    std::vector<std::optional<Rows<1>>> rows_;
    RowSum<1> sum_;
};

core::Result<Surfaces> evaluate_patches(const Far::TopologyRefiner& base, const SurfaceSettings& settings,
                                        std::span<const core::SurfaceLocation> locations) {
    const auto options = patch_options(settings);
    const RefinerPtr refiner(Factory::Create(base));
    if (!refiner) return failed(caught_messages());
    auto adaptive = options.GetRefineAdaptiveOptions();
    adaptive.SetSecondaryLevel(settings.smooth_level);
    refiner->RefineAdaptive(adaptive);
    const std::unique_ptr<const Far::PatchTable> patches(Far::PatchTableFactory::Create(*refiner, options));
    if (!patches) return failed(caught_messages());
    if (!caught_messages().empty()) return failed(caught_messages());

    PatchPoints patch_points(*refiner, *patches);
    const Far::PatchMap map(*patches);
    Surfaces out(locations.size());
    RowSum<core::kDerivatives> sum(base.GetLevel(0).GetNumVertices());
    for (std::size_t i = 0; i < locations.size(); ++i) {
        const auto [face, u, v] = locations[i];
        const Far::PatchTable::PatchHandle* handle = map.FindPatch(face, u, v);
        if (handle == nullptr) continue;
        const auto points = patches->GetPatchVertices(*handle);
        PointWeights w(points.size());
        patches->EvaluateBasis(*handle, u, v, w.rows[0].data(), w.rows[1].data(), w.rows[2].data(),
                               w.rows[3].data(), w.rows[4].data(), w.rows[5].data());
        for (int p = 0; p < points.size(); ++p) patch_points.add(points[p], w.at(p), sum);
        out[i] = to_surface_rows(sum.take());
    }
    return out;
}

}  // namespace

std::string_view name(SurfaceMethod method) {
    switch (method) {
        case SurfaceMethod::Bfr:
            return "bfr";
        case SurfaceMethod::PatchGregory:
            return "patch-gregory";
        case SurfaceMethod::PatchBox:
            return "patch-box";
        case SurfaceMethod::PatchLinear:
            return "patch-linear";
    }
    return "";
}

core::Result<Surfaces> opensubdiv_surface(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                          const SurfaceSettings& settings,
                                          std::span<const core::SurfaceLocation> locations) {
    if (auto error = check_supported(mesh, options, 0)) return tl::unexpected(*error);
    if (auto error = check_settings(settings)) return tl::unexpected(*error);
    if (settings.method == SurfaceMethod::Bfr)
        if (auto error = check_valences(mesh)) return tl::unexpected(*error);
    return contained([&]() -> core::Result<Surfaces> {
        const auto base = make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        return settings.method == SurfaceMethod::Bfr ? evaluate_bfr(**base, settings, locations)
                                                     : evaluate_patches(**base, settings, locations);
    });
}

}  // namespace loopcheck::reference
