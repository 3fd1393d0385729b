#include "compare/surface/evaluator.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace loopcheck::compare {
namespace {

using reference::PatchSharpness;
using reference::SurfaceMethod;

constexpr std::array kWays{
    SurfaceWay{"bfr", SurfaceMethod::Bfr, PatchSharpness::Exact},
    SurfaceWay{"patch-gregory", SurfaceMethod::PatchGregory, PatchSharpness::Exact},
    SurfaceWay{"patch-box", SurfaceMethod::PatchBox, PatchSharpness::Exact},
    SurfaceWay{"patch-linear", SurfaceMethod::PatchLinear, PatchSharpness::Exact},
    SurfaceWay{"patch-default", SurfaceMethod::PatchGregory, PatchSharpness::Default},
};

}  // namespace

std::span<const SurfaceWay> surface_ways() {
    return kWays;
}

const SurfaceWay* find_way(std::string_view name) {
    const auto found =
        std::find_if(kWays.begin(), kWays.end(), [&](const SurfaceWay& way) { return way.name == name; });
    return found == kWays.end() ? nullptr : &*found;
}

std::vector<CornerParameter> crowded_parameters(int octaves) {
    constexpr std::array<double, kRadii> radii{127. / 128, 107. / 128, 91. / 128, 77. / 128, 67. / 128};
    constexpr std::array<double, kDirections> directions{
        0, 1, 65. / 128, 33. / 128, 97. / 128, 17. / 128, 113. / 128, 47. / 128, 81. / 128};
    std::vector<CornerParameter> out;
    for (int j = 0; j < octaves; ++j)
        for (const double direction : directions)
            for (const double radius : radii)
                out.push_back({std::ldexp(radius * (1 - direction), -j), std::ldexp(radius * direction, -j)});
    return out;
}

core::SurfaceLocation location_at(core::Index face, int corner, CornerParameter p) {
    switch (corner) {
        case 0:
            return {face, p.x, p.y};
        case 1:
            return {face, 1 - p.x - p.y, p.x};
        default:
            return {face, p.y, 1 - p.x - p.y};
    }
}

}  // namespace loopcheck::compare
