// The third witness: the same rules in high precision, with a proven bound for everybody else.
#pragma once

#include <array>
#include <vector>

#include "core/loop/error_bound.h"
#include "core/loop/refine.h"

namespace loopcheck::compare {

/// What is true of one level.
struct WitnessLevel {
    core::SchemeLevel scheme;
    core::Rows rows;                        ///< the way here from the level before; empty at level 0
    std::vector<core::Ancestor> ancestors;  ///< empty at level 0
    /// The exact positions as an unevaluated sum of two doubles, to 2^-106 of themselves.
    std::vector<glm::dvec3> exact;
    std::vector<glm::dvec3> exact_rest;
    /// How far a right implementation can be from `exact`, by its precision.
    std::array<core::Bounds, 2> bounds;

    const core::Bounds& bound(core::Precision precision) const {
        return bounds[precision == core::Precision::Float];
    }
};

/// Levels 0 to L of a mesh under one choice of rules.
struct Witness {
    core::SchemeOptions options;
    std::vector<WitnessLevel> levels;
    double largest_coordinate = 0;  ///< M of the control mesh
    double diagonal = 0;            ///< of the control mesh's bounding box
};

/// Refines in high precision and bounds the rounding of float and double.  Errors: TooLarge.
core::Result<Witness> make_witness(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                   int levels);

/// |p - exact position of v|, per coordinate, right to a few units of roundoff of itself.
glm::dvec3 distance_from_exact(const WitnessLevel& level, core::Index v, const glm::dvec3& p);

/// Peak memory of a witness, and of each result that is kept with its match, in bytes per vertex of the last
/// level. A test measures them.
inline constexpr double kWitnessBytesPerVertex = 600;
inline constexpr double kResultBytesPerVertex = 80;
/// And of the limits of a result.
inline constexpr double kLimitsBytesPerVertex = 100;

}  // namespace loopcheck::compare
