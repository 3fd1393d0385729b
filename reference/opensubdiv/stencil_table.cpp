#include "reference/opensubdiv/stencil_table.h"

#include <opensubdiv/far/stencilTableFactory.h>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {

using internal::Value;

template <class Real>
struct OpensubdivStencilTable<Real>::State {
    std::unique_ptr<const internal::Far::StencilTableReal<Real>> table;
    std::vector<Value<Real>> control;
    internal::Buffer<Real> refined;

    std::size_t size() const { return static_cast<std::size_t>(table->GetNumStencils()); }
};

template <class Real>
OpensubdivStencilTable<Real>::OpensubdivStencilTable(std::unique_ptr<State> state)
    : state_(std::move(state)) {}
template <class Real>
OpensubdivStencilTable<Real>::OpensubdivStencilTable(OpensubdivStencilTable&&) noexcept = default;
template <class Real>
OpensubdivStencilTable<Real>& OpensubdivStencilTable<Real>::operator=(OpensubdivStencilTable&&) noexcept =
    default;
template <class Real>
OpensubdivStencilTable<Real>::~OpensubdivStencilTable() = default;

template <class Real>
core::Result<OpensubdivStencilTable<Real>> OpensubdivStencilTable<Real>::make(
    const core::TriangleMesh& mesh, const core::SchemeOptions& options, int level) {
    if (auto error = internal::check_supported(mesh, options, level)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<OpensubdivStencilTable> {
        const auto refiner = internal::make_refiner(mesh, options);
        if (!refiner) return tl::unexpected(refiner.error());
        (*refiner)->RefineUniform(
            internal::Far::TopologyRefiner::UniformOptions(static_cast<unsigned>(level)));
        using Stencils = internal::Far::StencilTableFactoryReal<Real>;
        typename Stencils::Options stencil_options;
        stencil_options.generateIntermediateLevels = false;
        stencil_options.maxLevel = static_cast<unsigned>(level);
        auto state = std::make_unique<State>();
        state->table.reset(Stencils::Create(**refiner, stencil_options));
        if (!state->table) return internal::failed(internal::caught_messages());
        state->control = internal::control_values<Real>(mesh.positions());
        return OpensubdivStencilTable(std::move(state));
    });
}

template <class Real>
void OpensubdivStencilTable<Real>::update() {
    state_->table->UpdateValues(state_->control.data(), state_->refined.room_for(state_->size()));
}

template <class Real>
std::vector<glm::dvec3> OpensubdivStencilTable<Real>::positions() const {
    return internal::to_positions(std::span(state_->refined.data(), state_->size()));
}

template class OpensubdivStencilTable<float>;
template class OpensubdivStencilTable<double>;

}  // namespace loopcheck::reference
