#include "compare/curve/curve_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "compare/memory.h"
#include "core/bspline/limit.h"
#include "core/bspline/running_error.h"
#include "core/mesh/high_precision.h"
#include "core/mesh/point.h"
#include "reference/boost_math/cardinal.h"

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using core::Precision;
using HighPoint = core::Point<HighPrecision>;
using DoubleCurve = core::Curve<glm::dvec3>;

constexpr std::size_t kMostSamples = 20000;
constexpr std::int64_t kMostBasisEvaluations = 4'000'000;
// What is equal in exact arithmetic differs by so much of M with 38 digits: fewer than 10^5 roundings.
constexpr double kEqualInHighPrecision = 1e-33;
// The bound is rounded, and so are coordinates and length of the distance itself, which is at most 21/24 of
// 7 M.
constexpr int kDistanceRoundings = core::kPolygonDistanceRoundings + 7 * (1 + core::kNormRoundings);

template <class To>
core::Result<core::Curve<core::Point<To>>> converted(const DoubleCurve& curve) {
    return core::Curve<core::Point<To>>::make(core::convert_points<To>(curve.points()), curve.shape());
}

template <Precision precision>
core::Curve<core::RunningError<precision>> bounds_of(const DoubleCurve& curve) {
    std::vector<core::RunningError<precision>> points;
    points.reserve(curve.size());
    for (const glm::dvec3& p : curve.points()) points.push_back(core::with_running_error<precision>(p));
    return core::Curve<core::RunningError<precision>>::make(std::move(points), curve.shape()).value();
}

glm::dvec3 rounded(const HighPoint& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

// |p - exact| a coordinate, the difference taken in 38 digits.
glm::dvec3 distance_from(const glm::dvec3& p, const HighPoint& exact) {
    return glm::abs(rounded(HighPoint{HighPrecision(p.x), HighPrecision(p.y), HighPrecision(p.z)} - exact));
}

double largest_use(const glm::dvec3& error, const glm::dvec3& bound) {
    return std::max({use_of(error.x, bound.x), use_of(error.y, bound.y), use_of(error.z, bound.z)});
}

// The curve in 38 digits.
struct Oracle {
    core::Spline<HighPoint> spline;
    HighPrecision first, last;

    explicit Oracle(const core::Curve<HighPoint>& curve)
        : spline(core::spline_of(curve)), first(curve.first()), last(curve.last()) {}
    bool has(const HighPrecision& t) const { return first <= t && t <= last; }
};

// Our points of one level against the same in 38 digits and against the curve.
PolygonStats polygon_stats(int level, const std::vector<glm::dvec3>& points,
                           const core::CurveLevel<HighPoint>& exact,
                           const std::vector<core::RunningError<Precision::Double>>& bounds,
                           const Oracle& oracle, std::size_t stride) {
    PolygonStats out{.level = level, .points = points.size()};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 error = distance_from(points[i], exact.points[i]);
        out.error = std::max(out.error, largest(error));
        out.bound_use = std::max(out.bound_use, largest_use(error, bounds[i].error));
        const HighPrecision& t = exact.parameters[i];
        if (!oracle.has(t)) continue;
        ++out.on_curve;
        if (i % stride != 0) continue;
        const HighPoint off = exact.points[i] - core::evaluate(oracle.spline, t);
        out.distance = std::max(out.distance, core::norm(rounded(off)));
    }
    return out;
}

double limit_error(const core::Curve<HighPoint>& level, const std::vector<HighPrecision>& parameters,
                   const Oracle& oracle, std::size_t stride) {
    const auto limits = core::limits(level);
    double out = 0;
    for (std::size_t i = 0; i < limits.positions.size(); i += stride) {
        const HighPoint on_curve = core::evaluate(oracle.spline, parameters[limits.first + i]);
        out = std::max(out, largest(glm::abs(rounded(limits.positions[i] - on_curve))));
    }
    return out;
}

std::string_view name(core::Evaluation method) {
    switch (method) {
        case core::Evaluation::AllPoints:
            return "all control points";
        case core::Evaluation::Local:
            return "localised";
        case core::Evaluation::DeBoor:
            return "de Boor";
    }
    return "unknown";
}

void add_sample(EvaluationStats& stats, const glm::dvec3& p, double t, const Oracle& oracle, double bound) {
    const double error = largest(distance_from(p, core::evaluate(oracle.spline, HighPrecision(t))));
    ++stats.samples;
    stats.error = std::max(stats.error, error);
    stats.bound_use = std::max(stats.bound_use, use_of(error, bound));
}

// k roundings of M, each of which may also be an underflow.
double evaluation_bound(int k, double M) {
    return core::rounding_of(k, Precision::Double) * M + k * core::smallest_subnormal(Precision::Double);
}

EvaluationStats evaluation_stats(const core::Spline<glm::dvec3>& spline, core::Evaluation method,
                                 const std::vector<double>& parameters, const Oracle& oracle, double M) {
    EvaluationStats out{.method = std::string(name(method))};
    const double bound = evaluation_bound(core::evaluation_roundings(spline.degree), M);
    const auto cost =
        method == core::Evaluation::AllPoints ? static_cast<std::int64_t>(spline.points.size()) : 1;
    const auto in_all = static_cast<std::int64_t>(parameters.size());
    const auto stride = static_cast<std::size_t>(1 + in_all * cost / kMostBasisEvaluations);
    for (std::size_t i = 0; i < parameters.size(); i += stride) {
        const double t = parameters[i];
        add_sample(out, core::evaluate(spline, t, {method, &out.basis_evaluations}), t, oracle, bound);
    }
    return out;
}

// Nothing where Boost does not have the degree.
std::optional<EvaluationStats> boost_stats(const DoubleCurve& curve, const core::Spline<glm::dvec3>& spline,
                                           const std::vector<double>& parameters, const Oracle& oracle,
                                           double M) {
    const auto points = reference::boost_curve_points<glm::dvec3>(
        spline.degree, spline.points, -core::phantom_count(curve.shape()), parameters);
    if (!points) return std::nullopt;
    EvaluationStats out{.method = "Boost.Math " + reference::boost_version()};
    out.basis_evaluations = static_cast<std::int64_t>(parameters.size()) * (spline.degree + 1);
    const double bound = evaluation_bound(reference::boost_curve_roundings(spline.degree), M);
    for (std::size_t i = 0; i < parameters.size(); ++i)
        add_sample(out, (*points)[i], parameters[i], oracle, bound);
    return out;
}

std::vector<EvaluationStats> all_evaluations(const DoubleCurve& curve, const std::vector<double>& parameters,
                                             const Oracle& oracle, double M) {
    const auto spline = core::spline_of(curve);
    std::vector<EvaluationStats> out;
    for (const auto method : {core::Evaluation::AllPoints, core::Evaluation::Local, core::Evaluation::DeBoor})
        out.push_back(evaluation_stats(spline, method, parameters, oracle, M));
    if (!spline.one_apart) return out;
    if (auto boost = boost_stats(curve, spline, parameters, oracle, M)) out.push_back(std::move(*boost));
    return out;
}

// The parameters of a level that are in the domain, thinned out.
std::vector<double> samples_of(const DoubleCurve& curve, const core::CurveLevel<glm::dvec3>& level) {
    std::vector<double> out;
    const std::size_t stride = 1 + level.parameters.size() / kMostSamples;
    for (std::size_t i = 0; i < level.parameters.size(); i += stride)
        if (curve.first() <= level.parameters[i] && level.parameters[i] <= curve.last())
            out.push_back(level.parameters[i]);
    return out;
}

void judge(CurveComparison& c) {
    const auto blame = [&](std::string sentence) {
        c.own = Verdict::Differs;
        c.notes.push_back(std::move(sentence));
    };
    for (const PolygonStats& p : c.polygons) {
        if (!(p.bound_use <= 1))
            blame(fmt::format("Level {} is farther from 38 digits than rounding explains.", p.level));
        if (p.allowed && !(p.distance <= *p.allowed + kDistanceRoundings * c.unit()))
            blame(fmt::format("The polygon of level {} is {} from the curve; {} is allowed.", p.level,
                              p.distance, *p.allowed));
        if (p.limit_error && !(*p.limit_error <= kEqualInHighPrecision))
            blame(fmt::format("Limits of level {} are not on the curve.", p.level));
    }
    for (const EvaluationStats& e : c.evaluations)
        if (!(e.bound_use <= 1))
            blame(
                fmt::format("Evaluation by {} is farther from 38 digits than rounding explains.", e.method));
}

// Our subdivision in the precision of a subject, with a bound for both.
struct OwnLevel {
    std::vector<glm::dvec3> points;
    std::vector<glm::dvec3> bounds;
};

template <class Real, Precision precision>
std::vector<OwnLevel> own_levels(const DoubleCurve& curve, int levels) {
    const auto ours = core::curve_levels(converted<Real>(curve).value(), levels);
    const auto bounds = core::curve_levels(bounds_of<precision>(curve), levels);
    std::vector<OwnLevel> out(ours.size());
    for (std::size_t l = 0; l < ours.size(); ++l) {
        out[l].points.assign(ours[l].points.begin(), ours[l].points.end());
        for (const auto& bound : bounds[l].points) out[l].bounds.push_back(bound.error);
    }
    return out;
}

CarriedLevel compare_level(int level, const OwnLevel& ours, const core::RefinedLevel& theirs,
                           std::span<const core::Index> polygon) {
    CarriedLevel out{.level = level};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PointDifference d = difference_between(ours.points[i], theirs.positions[polygon[i]],
                                                     2.0 * ours.bounds[i], glm::dvec3(0));
        out.difference.add(d.error, d.identical);
        out.bound_use = std::max(out.bound_use, d.bound_use);
    }
    return out;
}

Verdict verdict_of(const CarriedLevel& level) {
    if (!(level.bound_use <= 1) || level.difference.not_finite > 0) return Verdict::Differs;
    return level.difference.identical == level.difference.count ? Verdict::Identical
                                                                : Verdict::WithinRounding;
}

void refuse(CarriedComparison& out, const core::Error& error) {
    out.verdict = error.code == core::ErrorCode::Unsupported ? Verdict::NotSupported : Verdict::Failed;
    out.note = core::to_string(error);
}

void compare_carrier(CarriedComparison& out, const DoubleCurve& curve, std::span<const OwnLevel> ours,
                     const Subject& subject, double memory_limit) {
    const auto levels = static_cast<int>(ours.size()) - 1;
    const auto carrier = make_carrier(out.carrier, curve.points());
    if (!carrier) return refuse(out, carrier.error());
    if (auto error = check_memory(carrier->mesh, levels, subject.bytes_per_vertex, memory_limit))
        return refuse(out, *error);
    const auto refined = subject.refine(carrier->mesh, carrier->options, levels);
    if (!refined) return refuse(out, refined.error());
    if (refined->levels.size() != ours.size())
        return refuse(out, {core::ErrorCode::SubjectFailed, "It made another number of levels."});
    std::vector<core::Index> polygon = carrier->polygon;
    for (int l = 0; l <= levels; ++l) {
        if (l > 0) {
            auto next = refined_polygon(polygon, carrier->closed, refined->levels[l - 1], refined->levels[l]);
            if (!next) return refuse(out, next.error());
            polygon = std::move(*next);
        }
        out.levels.push_back(compare_level(l, ours[l], refined->levels[l], polygon));
        out.verdict = std::max(out.verdict, verdict_of(out.levels.back()));
    }
}

}  // namespace

Verdict CurveComparison::worst() const {
    Verdict out = own;
    for (const CarriedComparison& c : carried) out = std::max(out, c.verdict);
    return out;
}

CurveComparison compare_curve(const DoubleCurve& curve, int levels, const CurveProgress& progress) {
    CurveComparison out;
    out.largest_coordinate = core::largest_coordinate(core::extended_points(curve));
    out.levels = core::curve_levels(curve, levels);
    const auto high = converted<HighPrecision>(curve).value();
    const Oracle oracle(high);
    const auto exact = core::curve_levels(high, levels);
    const auto bounds = core::curve_levels(bounds_of<Precision::Double>(curve), levels);
    const bool uniform = curve.shape().ends != core::Ends::Clamped;
    for (int l = 0; l <= levels; ++l) {
        progress(fmt::format("level {} of {}", l, levels));
        const std::size_t stride = 1 + out.levels[l].points.size() / kMostSamples;
        out.stride = std::max(out.stride, stride);
        out.polygons.push_back(
            polygon_stats(l, out.levels[l].points, exact[l], bounds[l].points, oracle, stride));
        // Rounding in 38 digits, where the polygon is on the curve.
        if (out.polygons.back().distance <= kEqualInHighPrecision * out.largest_coordinate)
            out.polygons.back().distance = 0;
        if (!uniform) continue;
        out.polygons.back().allowed = core::polygon_distance(curve, l);
        if (curve.shape().degree == 1) continue;  // no limits: every point is on the polygon
        const auto level = core::Curve<HighPoint>::make(exact[l].points, curve.shape());
        out.polygons.back().limit_error =
            limit_error(*level, exact[l].parameters, oracle, stride) /
            std::max(out.largest_coordinate, std::numeric_limits<double>::min());
    }
    progress("evaluation");
    out.evaluations =
        all_evaluations(curve, samples_of(curve, out.levels.back()), oracle, out.largest_coordinate);
    judge(out);
    return out;
}

std::vector<CarriedComparison> compare_carried(const DoubleCurve& curve, int levels, const Subject& subject,
                                               double memory_limit, const CurveProgress& progress) {
    const CarriedComparison blank{
        .subject = subject.name, .version = subject.version, .precision = subject.precision};
    const auto kinds = carriers_for(curve.shape().ends);
    if (curve.shape().degree != 3 || kinds.empty()) {
        std::vector<CarriedComparison> out(1, blank);
        refuse(out.front(), {core::ErrorCode::Unsupported,
                             "Boundaries and creases are cubics with natural ends or closed."});
        return out;
    }
    const bool in_float = subject.precision == Precision::Float;
    if (in_float && !converted<float>(curve)) {
        std::vector<CarriedComparison> out(1, blank);
        refuse(out.front(), {core::ErrorCode::Unsupported, "A coordinate is too large for float."});
        return out;
    }
    const auto ours = in_float ? own_levels<float, Precision::Float>(curve, levels)
                               : own_levels<double, Precision::Double>(curve, levels);
    std::vector<CarriedComparison> out;
    for (const CarrierKind kind : kinds) {
        progress(fmt::format("{}: {}", subject.name, name(kind)));
        out.push_back(blank);
        out.back().carrier = kind;
        compare_carrier(out.back(), curve, ours, subject, memory_limit);
    }
    return out;
}

}  // namespace loopcheck::compare
