#include "reference/opensubdiv/last_level.h"

#include <opensubdiv/far/primvarRefiner.h>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {

struct OpensubdivLastLevel::State {
    internal::RefinerPtr base, refined;
    std::vector<std::vector<internal::Value<double>>> values;  // of every level
};

OpensubdivLastLevel::OpensubdivLastLevel(std::unique_ptr<State> state) : state_(std::move(state)) {}
OpensubdivLastLevel::OpensubdivLastLevel(OpensubdivLastLevel&&) noexcept = default;
OpensubdivLastLevel& OpensubdivLastLevel::operator=(OpensubdivLastLevel&&) noexcept = default;
OpensubdivLastLevel::~OpensubdivLastLevel() = default;

core::Result<OpensubdivLastLevel> OpensubdivLastLevel::make(const core::TriangleMesh& mesh,
                                                            const core::SchemeOptions& options) {
    if (auto error = internal::check_supported(mesh, options, 0)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<OpensubdivLastLevel> {
        auto base = internal::make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        auto state = std::make_unique<State>();
        state->base = std::move(*base);
        state->values.push_back(internal::control_values<double>(mesh.positions()));
        return OpensubdivLastLevel(std::move(state));
    });
}

void OpensubdivLastLevel::refine(int level) {
    auto& [base, refined, values] = *state_;
    refined.reset(internal::Factory::Create(*base));
    internal::Far::TopologyRefiner::UniformOptions uniform(static_cast<unsigned>(level));
    uniform.fullTopologyInLastLevel = false;
    refined->RefineUniform(uniform);
    const internal::Far::PrimvarRefinerReal<double> primvars(*refined);
    values.resize(static_cast<std::size_t>(level) + 1);
    for (int l = 1; l <= level; ++l) {
        values[l].resize(static_cast<std::size_t>(refined->GetLevel(l).GetNumVertices()));
        primvars.Interpolate(l, values[l - 1], values[l]);
    }
}

std::vector<glm::dvec3> OpensubdivLastLevel::positions() const {
    return internal::to_positions(state_->values.back());
}

}  // namespace loopcheck::reference
