#include "reference/openmesh/last_level.h"

#include "reference/openmesh/control.h"

namespace loopcheck::reference {

template <class Real>
struct OpenmeshLastLevel<Real>::State {
    internal::OpenmeshMesh<Real> control, mesh;
};

template <class Real>
OpenmeshLastLevel<Real>::OpenmeshLastLevel(std::unique_ptr<State> state) : state_(std::move(state)) {}
template <class Real>
OpenmeshLastLevel<Real>::OpenmeshLastLevel(OpenmeshLastLevel&&) noexcept = default;
template <class Real>
OpenmeshLastLevel<Real>& OpenmeshLastLevel<Real>::operator=(OpenmeshLastLevel&&) noexcept = default;
template <class Real>
OpenmeshLastLevel<Real>::~OpenmeshLastLevel() = default;

template <class Real>
core::Result<OpenmeshLastLevel<Real>> OpenmeshLastLevel<Real>::make(const core::TriangleMesh& mesh,
                                                                    const core::SchemeOptions& options) {
    constexpr auto kPrecision =
        sizeof(Real) == sizeof(float) ? core::Precision::Float : core::Precision::Double;
    if (auto error = internal::check_openmesh(mesh, options, kPrecision)) return tl::unexpected(*error);
    return internal::openmesh_contained([&]() -> core::Result<OpenmeshLastLevel> {
        auto control = internal::openmesh_control<Real>(mesh);
        if (!control) return tl::unexpected(control.error());
        auto state = std::make_unique<State>();
        state->control = std::move(*control);
        state->mesh = state->control;
        return OpenmeshLastLevel(std::move(state));
    });
}

template <class Real>
void OpenmeshLastLevel<Real>::clear() {
    state_->mesh = state_->control;
}

template <class Real>
void OpenmeshLastLevel<Real>::refine(int levels) {
    internal::OpenmeshLoop<Real> loop;
    loop.attach(state_->mesh);
    loop(static_cast<std::size_t>(levels));
    loop.detach();
}

template <class Real>
std::vector<glm::dvec3> OpenmeshLastLevel<Real>::positions() const {
    std::vector<glm::dvec3> out;
    out.reserve(state_->mesh.n_vertices());
    for (const auto v : state_->mesh.vertices()) {
        const auto& p = state_->mesh.point(v);
        out.emplace_back(p[0], p[1], p[2]);
    }
    return out;
}

template class OpenmeshLastLevel<float>;
template class OpenmeshLastLevel<double>;

}  // namespace loopcheck::reference
