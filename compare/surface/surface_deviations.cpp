#include "compare/surface/surface_deviations.h"

#include <array>

namespace loopcheck::compare {
namespace {

using Kind = KnownDeviation::Kind;

constexpr std::array<SurfaceDeviation, kSurfaceDeviations> kDeviations{{
    {"bfr-approximation", "opensubdiv", Kind::Approximation,
     "Around an irregular vertex the triangles of the last level are approximated by one patch each."},
    {"second-derivative-sign", "opensubdiv", Kind::Error,
     "Second derivatives have the wrong sign where a patch lies in a triangle turned by half a circle."},
    {"bspline-endcap", "opensubdiv", Kind::Error,
     "The box-spline end cap is made with constants of six digits, also in double: its weights do not sum to "
     "1."},
    {"patchtable-defaults", "opensubdiv", Kind::Documented,
     "PatchTable, as it comes, smooths what is infinitely sharp below the sharp level and keeps boundary "
     "vertices of one face; useInfSharpPatch and generateLegacySharpCornerPatches change that."},
    {"sharpness-cut-off", "opensubdiv", Kind::Documented,
     "Sharpness that has not decayed one level above the last is approximated with it."},
    {"bfr-chaikin", "opensubdiv", Kind::Error,
     "Bfr knows only the sharp edges at the vertices of a face; Chaikin's decay depends on others, too."},
}};

}  // namespace

std::span<const SurfaceDeviation> surface_deviations() {
    return kDeviations;
}

}  // namespace loopcheck::compare
