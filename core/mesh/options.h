// Every variant of the rules, one line each.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace loopcheck::core {

/// What happens at the boundary of an open mesh.  Boundary edges are infinitely sharp in every case.
enum class BoundaryRule : std::uint8_t {
    None,           ///< refines like EdgeOnly; only which faces have a limit surface differs
    EdgeOnly,       ///< boundary vertices follow the crease rule
    EdgeAndCorner,  ///< and boundary vertices of exactly one face are kept: corners
};

/// How the sharpness of a semi-sharp crease decays from level to level.
enum class Creasing : std::uint8_t {
    Uniform,  ///< every edge loses 1
    Chaikin,  ///< every edge first moves towards the mean of its neighbours on the crease, then loses 1
};

/// The weight of a neighbour in the rule for smooth interior vertices.
enum class Weights : std::uint8_t {
    Loop,    ///< Loop's own, [Loop87]
    Warren,  ///< Warren's simplification, 3/(8n); equal to Loop's only at n = 3 and n = 6
};

/// The share of the crease rule where a Chaikin crease of sharpness above 1 becomes smooth in one step.
enum class CreaseShare : std::uint8_t {
    Clamped,    ///< min(1, sharpness): a weight
    Unclamped,  ///< the sharpness itself, so the smooth rule gets a negative weight: what OpenSubdiv 3.5 does
};

/// A complete choice of rules.
struct SchemeOptions {
    BoundaryRule boundary = BoundaryRule::EdgeAndCorner;
    Creasing creasing = Creasing::Uniform;
    Weights weights = Weights::Loop;
    CreaseShare crease_share = CreaseShare::Clamped;

    bool operator==(const SchemeOptions&) const = default;
};

/// The names used on the command line and in reports: "edge-and-corner", "chaikin", "warren".
std::string_view name(BoundaryRule rule);
std::string_view name(Creasing creasing);
std::string_view name(Weights weights);

/// The option of that name, or nothing.
std::optional<BoundaryRule> parse_boundary_rule(std::string_view text);
std::optional<Creasing> parse_creasing(std::string_view text);
std::optional<Weights> parse_weights(std::string_view text);

}  // namespace loopcheck::core
