#include "compare/witness.h"

#include <glm/common.hpp>

#include "core/mesh/high_precision.h"

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using core::Precision;

void keep_exact(WitnessLevel& level, const core::Points<HighPrecision>& points) {
    level.exact.reserve(points.size());
    level.exact_rest.reserve(points.size());
    for (const auto& p : points) {
        const glm::dvec3 high(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
        level.exact.push_back(high);
        level.exact_rest.emplace_back(static_cast<double>(HighPrecision(p.x - high.x)),
                                      static_cast<double>(HighPrecision(p.y - high.y)),
                                      static_cast<double>(HighPrecision(p.z - high.z)));
    }
}

}  // namespace

core::Result<Witness> make_witness(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                   int levels) {
    Witness out{options, {}, mesh.largest_coordinate(), mesh.diagonal()};
    out.levels.reserve(levels + std::size_t{1});
    auto points = core::convert_points<HighPrecision>(mesh.positions());

    WitnessLevel& control = out.levels.emplace_back();
    control.scheme = core::control_level(mesh, options.boundary);
    keep_exact(control, points);
    for (const Precision precision : {Precision::Double, Precision::Float})
        control.bounds[precision == Precision::Float] = core::control_bounds(mesh.positions(), precision);

    for (int l = 0; l < levels; ++l) {
        const WitnessLevel& parent = out.levels.back();
        auto step = core::next_level(parent.scheme, options);
        if (!step) return tl::unexpected(step.error());
        points = core::apply<HighPrecision>(step->rows, options.weights, points);

        WitnessLevel child;
        for (const Precision precision : {Precision::Double, Precision::Float})
            child.bounds[precision == Precision::Float] = core::next_bounds(
                step->rows, options.weights, parent.exact, parent.bound(precision), precision);
        keep_exact(child, points);
        child.scheme = std::move(step->child);
        child.rows = std::move(step->rows);
        child.ancestors = std::move(step->ancestors);
        out.levels.push_back(std::move(child));
    }
    return out;
}

glm::dvec3 distance_from_exact(const WitnessLevel& level, core::Index v, const glm::dvec3& p) {
    return glm::abs((p - level.exact[v]) - level.exact_rest[v]);
}

}  // namespace loopcheck::compare
