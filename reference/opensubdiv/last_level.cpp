#include "reference/opensubdiv/last_level.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <cmath>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {

using internal::Buffer;
using internal::Value;

template <class Real>
struct OpensubdivLastLevel<Real>::State {
    internal::RefinerPtr base, refined;
    std::vector<Value<Real>> control;
    std::vector<Buffer<Real>> levels;  // from level 1
    Buffer<Real> limit, tangent1, tangent2, normals;

    int last() const { return refined->GetMaxLevel(); }
    std::size_t last_size() const {
        return static_cast<std::size_t>(refined->GetLevel(last()).GetNumVertices());
    }
    const Value<Real>* last_values() const {
        return last() == 0 ? control.data() : levels[static_cast<std::size_t>(last()) - 1].data();
    }
};

template <class Real>
OpensubdivLastLevel<Real>::OpensubdivLastLevel(std::unique_ptr<State> state) : state_(std::move(state)) {}
template <class Real>
OpensubdivLastLevel<Real>::OpensubdivLastLevel(OpensubdivLastLevel&&) noexcept = default;
template <class Real>
OpensubdivLastLevel<Real>& OpensubdivLastLevel<Real>::operator=(OpensubdivLastLevel&&) noexcept = default;
template <class Real>
OpensubdivLastLevel<Real>::~OpensubdivLastLevel() = default;

template <class Real>
core::Result<OpensubdivLastLevel<Real>> OpensubdivLastLevel<Real>::make(const core::TriangleMesh& mesh,
                                                                        const core::SchemeOptions& options) {
    if (auto error = internal::check_supported(mesh, options, 0)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<OpensubdivLastLevel> {
        auto base = internal::make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        auto state = std::make_unique<State>();
        state->base = std::move(*base);
        state->control = internal::control_values<Real>(mesh.positions());
        return OpensubdivLastLevel(std::move(state));
    });
}

template <class Real>
std::optional<core::Error> OpensubdivLastLevel<Real>::refine(int level) {
    const auto done = internal::contained([&]() -> core::Result<int> {
        refine_topology(level, LastTopology::Least);
        interpolate();
        if (state_->last() != level || !internal::caught_messages().empty())
            return internal::failed(internal::caught_messages());
        return level;
    });
    if (!done) return done.error();
    return std::nullopt;
}

template <class Real>
void OpensubdivLastLevel<Real>::clear() {
    state_->refined.reset();
}

template <class Real>
void OpensubdivLastLevel<Real>::refine_topology(int level, LastTopology last) {
    state_->refined.reset(internal::Factory::Create(*state_->base));
    internal::Far::TopologyRefiner::UniformOptions uniform(static_cast<unsigned>(level));
    uniform.fullTopologyInLastLevel = last == LastTopology::Full;
    state_->refined->RefineUniform(uniform);
}

template <class Real>
void OpensubdivLastLevel<Real>::interpolate() {
    const auto& refiner = *state_->refined;
    const internal::Far::PrimvarRefinerReal<Real> primvars(refiner);
    state_->levels.resize(static_cast<std::size_t>(state_->last()));
    const Value<Real>* parent = state_->control.data();
    for (int l = 1; l <= state_->last(); ++l) {
        Value<Real>* child = state_->levels[static_cast<std::size_t>(l) - 1].room_for(
            static_cast<std::size_t>(refiner.GetLevel(l).GetNumVertices()));
        primvars.Interpolate(l, parent, child);
        parent = child;
    }
}

template <class Real>
void OpensubdivLastLevel<Real>::limit() {
    const std::size_t size = state_->last_size();
    const internal::Far::PrimvarRefinerReal<Real> primvars(*state_->refined);
    Value<Real>* position = state_->limit.room_for(size);
    Value<Real>* tangent1 = state_->tangent1.room_for(size);
    Value<Real>* tangent2 = state_->tangent2.room_for(size);
    Value<Real>* normal = state_->normals.room_for(size);
    primvars.Limit(state_->last_values(), position, tangent1, tangent2);
    for (std::size_t v = 0; v < size; ++v) {
        const auto &a = tangent1[v], &b = tangent2[v];
        const Value<Real> n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
        const Real scale = 1 / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        normal[v] = {scale * n.x, scale * n.y, scale * n.z};
    }
}

template <class Real>
std::vector<glm::dvec3> OpensubdivLastLevel<Real>::positions() const {
    return internal::to_positions(values());
}

template <class Real>
std::span<const Value<Real>> OpensubdivLastLevel<Real>::values() const {
    return {state_->last_values(), state_->last_size()};
}

template <class Real>
std::vector<core::Triangle> OpensubdivLastLevel<Real>::faces() const {
    const auto& level = state_->refined->GetLevel(state_->last());
    std::vector<core::Triangle> out;
    out.reserve(static_cast<std::size_t>(level.GetNumFaces()));
    for (core::Index f = 0; f < level.GetNumFaces(); ++f) {
        const auto v = level.GetFaceVertices(f);
        out.push_back({v[0], v[1], v[2]});
    }
    return out;
}

template <class Real>
std::vector<glm::dvec3> OpensubdivLastLevel<Real>::limit_positions() const {
    return internal::to_positions(std::span(state_->limit.data(), state_->last_size()));
}

template <class Real>
std::vector<glm::dvec3> OpensubdivLastLevel<Real>::limit_normals() const {
    return internal::to_positions(std::span(state_->normals.data(), state_->last_size()));
}

template class OpensubdivLastLevel<float>;
template class OpensubdivLastLevel<double>;

}  // namespace loopcheck::reference
