#include "reference/opensubdiv/limit.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <vector>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

using namespace internal;

template <class Real>
core::LimitLevel limit_of_last_level(const Far::PrimvarRefinerReal<Real>& primvars,
                                     const std::vector<Value<Real>>& values) {
    std::vector<Value<Real>> position(values.size()), tangent1(values.size()), tangent2(values.size());
    primvars.Limit(values, position, tangent1, tangent2);
    return {to_positions(position), to_positions(tangent1), to_positions(tangent2)};
}

// Limit() knows the last level only, so every level is the last of a refiner.  The values of the level before
// are those of the refiner before.
template <class Real>
core::Result<core::Limits> limit_levels(const core::TriangleMesh& mesh, const Far::TopologyRefiner& base,
                                        int levels) {
    core::Limits out;
    auto values = control_values<Real>(mesh);
    for (int l = 0; l <= levels; ++l) {
        const auto refiner = refined_uniformly(base, l);
        if (!refiner) return tl::unexpected(refiner.error());
        const Far::PrimvarRefinerReal<Real> primvars(**refiner);
        if (l > 0) {
            std::vector<Value<Real>> refined((*refiner)->GetLevel(l).GetNumVertices());
            primvars.Interpolate(l, values, refined);
            values = std::move(refined);
        }
        out.levels.push_back(limit_of_last_level(primvars, values));
        if (!caught_messages().empty()) return failed(caught_messages());
    }
    return out;
}

}  // namespace

core::Result<core::Limits> opensubdiv_limit(const core::TriangleMesh& mesh,
                                            const core::SchemeOptions& options, int levels,
                                            core::Precision precision) {
    if (auto error = check_supported(mesh, options, levels)) return tl::unexpected(*error);
    if (auto error = core::check_fits(mesh, precision)) return tl::unexpected(*error);
    return contained([&]() -> core::Result<core::Limits> {
        const auto base = make_refiner(mesh, options);
        if (!base) return tl::unexpected(base.error());
        auto out = precision == core::Precision::Float ? limit_levels<float>(mesh, **base, levels)
                                                       : limit_levels<double>(mesh, **base, levels);
        if (out) out->precision = precision;
        return out;
    });
}

}  // namespace loopcheck::reference
