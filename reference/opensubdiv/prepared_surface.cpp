#include "reference/opensubdiv/prepared_surface.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include <algorithm>
#include <vector>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
using core::Index;

const Bfr::Surface<double>::PointDescriptor kPoints(3);

std::optional<core::Error> check_surface(const core::TriangleMesh& mesh, const core::SchemeOptions& options) {
    const auto is_set = [](auto x) { return x > 0; };
    if (std::any_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_set) ||
        std::any_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_set) ||
        std::any_of(mesh.holes().begin(), mesh.holes().end(), is_set) ||
        options.boundary == core::BoundaryRule::None)
        return core::Error{core::ErrorCode::Unsupported,
                           "Bfr is timed on meshes without sharpness, holes and faces without a surface."};
    return internal::check_supported(mesh, options, 0);
}

}  // namespace

struct OpensubdivPreparedSurface::State {
    std::vector<Bfr::Surface<double>> surfaces;
    std::vector<std::size_t> first_point;  // of each surface, in doubles
    std::vector<double> points;
};

OpensubdivPreparedSurface::OpensubdivPreparedSurface(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
OpensubdivPreparedSurface::OpensubdivPreparedSurface(OpensubdivPreparedSurface&&) noexcept = default;
OpensubdivPreparedSurface& OpensubdivPreparedSurface::operator=(OpensubdivPreparedSurface&&) noexcept =
    default;
OpensubdivPreparedSurface::~OpensubdivPreparedSurface() = default;

core::Result<OpensubdivPreparedSurface> OpensubdivPreparedSurface::make(const core::TriangleMesh& mesh,
                                                                        const core::SchemeOptions& options) {
    if (auto error = check_surface(mesh, options)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<OpensubdivPreparedSurface> {
        const auto base = internal::make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        const Bfr::RefinerSurfaceFactory<> factory(**base);
        const auto control = internal::control_values<double>(mesh.positions());
        auto state = std::make_unique<State>();
        state->surfaces.resize(static_cast<std::size_t>(mesh.face_count()));
        for (Index f = 0; f < mesh.face_count(); ++f) {
            auto& surface = state->surfaces[f];
            if (!factory.InitVertexSurface(f, &surface))
                return internal::failed(fmt::format("Bfr has no surface of face {}", f));
            const std::size_t first = state->points.size();
            state->first_point.push_back(first);
            state->points.resize(first + 3 * static_cast<std::size_t>(surface.GetNumPatchPoints()));
            surface.PreparePatchPoints(&control.front().x, kPoints, &state->points[first], kPoints);
        }
        return OpensubdivPreparedSurface(std::move(state));
    });
}

bool OpensubdivPreparedSurface::is_regular(core::Index face) const {
    return state_->surfaces[face].IsRegular();
}

void OpensubdivPreparedSurface::evaluate(core::Index face, std::span<const glm::dvec2> parameters,
                                         std::span<SurfaceSample> samples) const {
    const auto& surface = state_->surfaces[face];
    const double* points = &state_->points[state_->first_point[face]];
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        SurfaceSample& sample = samples[i];
        surface.Evaluate(&parameters[i].x, points, kPoints, &sample.position.x, &sample.du.x, &sample.dv.x);
    }
}

}  // namespace loopcheck::reference
