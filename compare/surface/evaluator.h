// A way to a limit surface that is under test, and where it is looked at.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"
#include "reference/opensubdiv/surface.h"

namespace loopcheck::compare {

/// What is asked: position and derivatives as rows over the control vertices, at every location, in order.
/// The built-in one is `reference::opensubdiv_surface`; tests pass one that cheats.
using SurfaceEvaluator = std::function<core::Result<std::vector<std::optional<core::SurfaceRows>>>(
    const core::TriangleMesh&, const core::SchemeOptions&, const reference::SurfaceSettings&,
    std::span<const core::SurfaceLocation>)>;

/// One of OpenSubdiv's ways to the surface, as named on the command line.
struct SurfaceWay {
    std::string_view name;
    reference::SurfaceMethod method;
    reference::PatchSharpness sharpness;
};

/// bfr, patch-gregory, patch-box, patch-linear (with exact sharpness), patch-default (Gregory, as it comes).
std::span<const SurfaceWay> surface_ways();

/// The way of that name, or null.
const SurfaceWay* find_way(std::string_view name);

/// A parameter of a face as steps from one corner: x towards the next one, y towards the one before.
struct CornerParameter {
    double x = 0, y = 0;
};

/// Parameters that crowd around a corner geometrically: kRadii times kDirections of them an octave, at the
/// distances r 2^-j, 1/2 < r < 1, j = 0, ..., octaves - 1 (distance: x + y), nearest last.  Both edges are
/// among the directions.
///
/// Twice a parameter is again one, so those inside the patch of level L around the corner are, as parameters
/// of that patch, the same for every L.  All are fractions with few bits, exact in every computation, and
/// none is on an edge of a refined triangle of the first seven octaves below its own, except on the edges of
/// the face itself: every implementation finds it in the same triangle.
std::vector<CornerParameter> crowded_parameters(int octaves);
inline constexpr int kRadii = 5;
inline constexpr int kDirections = 9;

/// The location of a parameter seen from corner 0, 1 or 2 of a face.
core::SurfaceLocation location_at(core::Index face, int corner, CornerParameter p);

}  // namespace loopcheck::compare
