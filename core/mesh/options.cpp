#include "core/mesh/options.h"

#include <array>

namespace loopcheck::core {
namespace {

template <class Enum>
struct Named {
    Enum value;
    std::string_view name;
};

constexpr std::array<Named<BoundaryRule>, 3> kBoundaryRules{{{BoundaryRule::EdgeAndCorner, "edge-and-corner"},
                                                             {BoundaryRule::EdgeOnly, "edge-only"},
                                                             {BoundaryRule::None, "none"}}};
constexpr std::array<Named<Creasing>, 2> kCreasings{
    {{Creasing::Uniform, "uniform"}, {Creasing::Chaikin, "chaikin"}}};
constexpr std::array<Named<Weights>, 2> kWeights{{{Weights::Loop, "loop"}, {Weights::Warren, "warren"}}};

template <class Enum, std::size_t N>
std::string_view name_in(const std::array<Named<Enum>, N>& table, Enum value) {
    for (const auto& row : table)
        if (row.value == value) return row.name;
    return {};
}

template <class Enum, std::size_t N>
std::optional<Enum> value_in(const std::array<Named<Enum>, N>& table, std::string_view text) {
    for (const auto& row : table)
        if (row.name == text) return row.value;
    return std::nullopt;
}

}  // namespace

std::string_view name(BoundaryRule rule) {
    return name_in(kBoundaryRules, rule);
}
std::string_view name(Creasing creasing) {
    return name_in(kCreasings, creasing);
}
std::string_view name(Weights weights) {
    return name_in(kWeights, weights);
}

std::optional<BoundaryRule> parse_boundary_rule(std::string_view text) {
    return value_in(kBoundaryRules, text);
}
std::optional<Creasing> parse_creasing(std::string_view text) {
    return value_in(kCreasings, text);
}
std::optional<Weights> parse_weights(std::string_view text) {
    return value_in(kWeights, text);
}

}  // namespace loopcheck::core
