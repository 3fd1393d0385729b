#include "compare/surface/surface_deviations.h"

namespace loopcheck::compare {

std::string_view name(SurfaceDeviationId id) {
    switch (id) {
        case SurfaceDeviationId::Approximation:
            return "bfr-approximation";
        case SurfaceDeviationId::SecondDerivativeSign:
            return "second-derivative-sign";
        case SurfaceDeviationId::BoxEndCap:
            return "bspline-endcap";
        case SurfaceDeviationId::PatchDefaults:
            return "patchtable-defaults";
        case SurfaceDeviationId::SharpnessCutOff:
            return "sharpness-cut-off";
        case SurfaceDeviationId::BfrChaikin:
            return "bfr-chaikin";
    }
    return {};
}

}  // namespace loopcheck::compare
