#include "compare/limit/convergence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "compare/limit/oracle.h"

namespace loopcheck::compare {
namespace {

using core::Index;
using core::VertexRule;
using Kind = core::VertexClass::Kind;

// Zero where it may be all rounding, of coordinates up to `largest`.
double distance(const DoubleDouble3& limit, const glm::dvec3& p, const glm::dvec3& rest, double largest) {
    glm::dvec3 d;
    for (int i = 0; i < 3; ++i) d[i] = (p[i] - limit[i].high) + (rest[i] - limit[i].low);
    const double length = std::hypot(d.x, d.y, d.z);
    return length <= 0x1p-90 * largest ? 0 : length;
}

// What the rings around the irregular vertices of a level shrink by, at most, and at least 1/4; nothing where
// that is not known of one of them.
std::optional<double> slowest_ring(const core::SchemeLevel& level) {
    double out = 1. / 4;
    for (Index v = 0; v < level.topology.vertex_count; ++v) {
        if (level.topology.is_isolated(v)) continue;
        if (core::has_finite_sharpness(level.topology, level.sharpness, v)) return std::nullopt;
        const core::Star star = core::star_of(level.topology, level.sharpness, v);
        if (star.rule() == VertexRule::Smooth) {
            if (star.ring != 6) out = std::max(out, 3. / 8 + std::cos(2 * std::numbers::pi / star.ring) / 4);
            continue;
        }
        const auto sectors = star.sectors();
        const bool regular =
            star.rule() == VertexRule::Crease &&
            std::all_of(sectors.begin(), sectors.end(), [](const auto& s) { return s.faces == 3; });
        if (!regular) return std::nullopt;
    }
    return out;
}

bool has_dart(const core::SchemeLevel& level) {
    return std::any_of(level.classes.begin(), level.classes.end(), [](const core::VertexClass& c) {
        return c.kind == Kind::Dart || c.kind == Kind::SemiSharp;
    });
}

}  // namespace

std::optional<double> convergence_factor(core::VertexClass vertex_class, const core::SchemeLevel& level,
                                         core::Weights weights) {
    switch (vertex_class.kind) {
        case Kind::Interior: {
            const int n = vertex_class.valence;
            if (n == 6) return slowest_ring(level);
            return 5. / 8 - n * core::ring_weight<double>(weights, n);
        }
        case Kind::Boundary:
            return 1. / 4;
        case Kind::Crease:
            if (has_dart(level)) return std::nullopt;
            return 1. / 4;
        default:
            return std::nullopt;
    }
}

std::vector<ConvergencePoint> convergence(const Witness& witness, int levels) {
    std::vector<ConvergencePoint> out;
    std::map<core::VertexClass, std::optional<double>> factors;
    for (int l = 0; l < levels; ++l) {
        const WitnessLevel& level = witness.levels[l];
        LimitOracle oracle(level, witness.options);
        std::map<core::VertexClass, ConvergencePoint> points;
        for (Index v = 0; v < level.scheme.topology.vertex_count; ++v) {
            ConvergencePoint& point = points[level.scheme.classes[v]];
            ++point.vertices;
            point.distance =
                std::max(point.distance, distance(oracle.position(v), level.exact[v], level.exact_rest[v],
                                                  witness.largest_coordinate));
        }
        for (auto& [vertex_class, point] : points) {
            point.vertex_class = vertex_class;
            point.level = l;
            if (!factors.contains(vertex_class))
                factors[vertex_class] = convergence_factor(vertex_class, witness.levels[levels - 1].scheme,
                                                           witness.options.weights);
            point.factor = factors[vertex_class];
            out.push_back(point);
        }
    }
    return out;
}

}  // namespace loopcheck::compare
