#include "reference/opensubdiv/last_level.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <variant>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

template <class Real>
using Levels = std::vector<std::vector<internal::Value<Real>>>;

template <class Real>
void interpolate(const internal::Far::TopologyRefiner& refiner, Levels<Real>& values) {
    const internal::Far::PrimvarRefinerReal<Real> primvars(refiner);
    const int level = refiner.GetMaxLevel();
    values.resize(static_cast<std::size_t>(level) + 1);
    for (int l = 1; l <= level; ++l) {
        values[l].resize(static_cast<std::size_t>(refiner.GetLevel(l).GetNumVertices()));
        primvars.Interpolate(l, values[l - 1], values[l]);
    }
}

}  // namespace

struct OpensubdivLastLevel::State {
    internal::RefinerPtr base, refined;
    std::variant<Levels<double>, Levels<float>> values;
};

OpensubdivLastLevel::OpensubdivLastLevel(std::unique_ptr<State> state) : state_(std::move(state)) {}
OpensubdivLastLevel::OpensubdivLastLevel(OpensubdivLastLevel&&) noexcept = default;
OpensubdivLastLevel& OpensubdivLastLevel::operator=(OpensubdivLastLevel&&) noexcept = default;
OpensubdivLastLevel::~OpensubdivLastLevel() = default;

core::Result<OpensubdivLastLevel> OpensubdivLastLevel::make(const core::TriangleMesh& mesh,
                                                            const core::SchemeOptions& options,
                                                            core::Precision precision) {
    if (auto error = internal::check_supported(mesh, options, 0)) return tl::unexpected(*error);
    return internal::contained([&]() -> core::Result<OpensubdivLastLevel> {
        auto base = internal::make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        auto state = std::make_unique<State>();
        state->base = std::move(*base);
        if (precision == core::Precision::Float)
            state->values = Levels<float>{internal::control_values<float>(mesh.positions())};
        else
            state->values = Levels<double>{internal::control_values<double>(mesh.positions())};
        return OpensubdivLastLevel(std::move(state));
    });
}

std::optional<core::Error> OpensubdivLastLevel::refine(int level) {
    auto& [base, refined, values] = *state_;
    const auto done = internal::contained([&]() -> core::Result<int> {
        refined.reset(internal::Factory::Create(*base));
        internal::Far::TopologyRefiner::UniformOptions uniform(static_cast<unsigned>(level));
        uniform.fullTopologyInLastLevel = false;
        refined->RefineUniform(uniform);
        std::visit([&](auto& levels) { interpolate(*refined, levels); }, values);
        if (refined->GetMaxLevel() != level || !internal::caught_messages().empty())
            return internal::failed(internal::caught_messages());
        return level;
    });
    if (!done) return done.error();
    return std::nullopt;
}

std::vector<glm::dvec3> OpensubdivLastLevel::positions() const {
    return std::visit([](const auto& levels) { return internal::to_positions(levels.back()); },
                      state_->values);
}

template <class Real>
std::span<const internal::Value<Real>> OpensubdivLastLevel::values() const {
    return std::get<Levels<Real>>(state_->values).back();
}

template std::span<const internal::Value<float>> OpensubdivLastLevel::values<float>() const;
template std::span<const internal::Value<double>> OpensubdivLastLevel::values<double>() const;

}  // namespace loopcheck::reference
