#include "reference/opensubdiv/limit.h"

#include <utility>
#include <vector>

#include "reference/opensubdiv/refiner.h"

namespace loopcheck::reference {
namespace {

using namespace internal;

template <class Real>
core::Result<core::Limits> limit_levels(const core::TriangleMesh& mesh, const Far::TopologyRefiner& base,
                                        int levels) {
    core::Limits out;
    const auto take = [&](const Far::TopologyRefiner&, const std::vector<Value<Real>>&,
                          core::LimitLevel limit) { out.levels.push_back(std::move(limit)); };
    if (auto error = visit_levels<Real>(mesh.positions(), base, levels, take)) return tl::unexpected(*error);
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
