// OpenSubdiv's limit surface at any parameter, as rows over the control vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// OpenSubdiv's ways to the surface, and what each puts where the last level is still irregular.
/// ENDCAP_LEGACY_GREGORY is not among them: for triangles its basis is zero.
enum class SurfaceMethod : std::uint8_t {
    Bfr,           ///< Bfr::Surface: quartic Gregory triangles
    PatchGregory,  ///< Far::PatchTable, ENDCAP_GREGORY_BASIS: quartic Gregory triangles
    PatchBox,      ///< Far::PatchTable, ENDCAP_BSPLINE_BASIS: quartic box splines, as on regular faces
    PatchLinear,   ///< Far::PatchTable, ENDCAP_BILINEAR_BASIS: flat triangles
};
std::string_view name(SurfaceMethod method);

/// How Far::PatchTable treats infinitely sharp features.
enum class PatchSharpness : std::uint8_t {
    Default,  ///< as it comes: useInfSharpPatch false, generateLegacySharpCornerPatches true
    Exact,    ///< useInfSharpPatch true, generateLegacySharpCornerPatches false, which Bfr has always
};

/// Levels of refinement below which a face that is still irregular is approximated.
///
///     Bfr           SetApproxLevelSmooth(smooth_level), SetApproxLevelSharp(sharp_level)
///     PatchTable    AdaptiveOptions: isolationLevel = sharp_level, secondaryLevel = smooth_level,
///                   useInfSharpPatch; PatchTableFactory::Options: maxIsolationLevel = sharp_level,
///                   useInfSharpPatch, generateLegacySharpCornerPatches, in double
///
/// Range   1 <= smooth_level <= sharp_level <= kOpensubdivMaxSurfaceLevel.  At 0, OpenSubdiv's Gregory
///         patches next to sharpness are made of uninitialised memory; where smooth is above sharp it takes
///         sharp for both; of a level it keeps the last four bits, and at 15 it crashes.
struct SurfaceSettings {
    SurfaceMethod method = SurfaceMethod::Bfr;
    /// For irregular vertices without semi-sharpness; unless `sharpness` is Default in a PatchTable, also
    /// those on infinitely sharp creases.
    int smooth_level = 2;
    /// For the rest.
    int sharp_level = 6;
    PatchSharpness sharpness = PatchSharpness::Default;  ///< PatchTable only
};
inline constexpr int kOpensubdivMaxSurfaceLevel = 10;

/// Position and derivatives at the locations, in their order, in double.  Derivatives are with respect to the
/// (u, v) of the control face.
///
/// Range    every location inside its face: u, v >= 0, u + v <= 1 but for rounding, 0 <= face < face_count.
/// Result   nothing where OpenSubdiv has no surface: in holes, and under BoundaryRule::None in faces with a
///          boundary vertex.
/// Errors   Unsupported (Warren's weights, settings out of range, a valence above 65 535; for Bfr, out of
///          caution, an interior vertex of valence 2 with sharpness on its two faces: Bfr is known to crash
///          at such vertices, though no mesh that TriangleMesh accepts was seen to do it), SubjectFailed.
/// Cost     memory and time grow at least with the square of the valence: Bfr takes 1.5 GB at 10 000.
/// Laws     (1) position rows sum to 1 and derivative rows to 0, PatchBox excepted: its conversion has six
///          digits.  (2) On regular faces every method gives the same rows.
core::Result<std::vector<std::optional<core::SurfaceRows>>> opensubdiv_surface(
    const core::TriangleMesh& mesh, const core::SchemeOptions& options, const SurfaceSettings& settings,
    std::span<const core::SurfaceLocation> locations);

}  // namespace loopcheck::reference
