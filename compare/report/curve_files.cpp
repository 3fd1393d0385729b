// The curve as JSON and as CSV.
#include <fmt/format.h>

#include <iterator>

#include "compare/report/document.h"
#include "compare/report/json.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::optional<double> value) {
    return value ? Json(*value) : Json();
}

Json json_of(const PolygonStats& p) {
    return {{"level", p.level},
            {"points", p.points},
            {"on_curve", p.on_curve},
            {"distance", p.distance},
            {"allowed", json_of(p.allowed)},
            {"error", p.error},
            {"bound_use", p.bound_use},
            {"limit_error", json_of(p.limit_error)}};
}

Json json_of(const EvaluationStats& e) {
    return {{"method", e.method},
            {"samples", e.samples},
            {"basis_evaluations", e.basis_evaluations},
            {"error", e.error},
            {"bound_use", e.bound_use}};
}

Json json_of(const CarriedComparison& c) {
    Json out{{"subject", c.subject},
             {"precision", core::name(c.precision)},
             {"carrier", name(c.carrier)},
             {"verdict", name(c.verdict)},
             {"note", c.note}};
    out["levels"] = Json::array();
    for (const CarriedLevel& level : c.levels)
        out["levels"].push_back({{"level", level.level},
                                 {"points", level.difference.count},
                                 {"identical", level.difference.identical},
                                 {"max", level.difference.max},
                                 {"not_finite", level.difference.not_finite},
                                 {"bound_use", level.bound_use}});
    return out;
}

Json json_of(const ToleranceReport& t) {
    return {{"tolerance", t.tolerance},
            {"level", t.level ? Json(*t.level) : Json()},
            {"level_points", t.level_points},
            {"distance", t.distance},
            {"flat_points", t.flat_points ? Json(*t.flat_points) : Json()}};
}

}  // namespace

Json json_of(const CurveReport& report) {
    const CurveComparison& c = report.comparison;
    Json out{{"points", report.curve.size()},
             {"dimension", report.dimension},
             {"degree", report.curve.shape().degree},
             {"ends", core::name(report.curve.shape().ends)},
             {"domain", {report.curve.first(), report.curve.last()}},
             {"largest_coordinate", c.largest_coordinate},
             {"stride", c.stride},
             {"verdict", name(c.own)},
             {"notes", c.notes}};
    for (const char* list : {"levels", "evaluations", "carried"}) out[list] = Json::array();
    for (const PolygonStats& p : c.polygons) out["levels"].push_back(json_of(p));
    for (const EvaluationStats& e : c.evaluations) out["evaluations"].push_back(json_of(e));
    for (const CarriedComparison& one : c.carried) out["carried"].push_back(json_of(one));
    if (report.tolerance) out["tolerance"] = json_of(*report.tolerance);
    return out;
}

std::string curve_as_json(const CurveReport& report, std::span<const Subject> subjects) {
    Json out = document("curve", subjects, exit_code(report.comparison.worst()));
    out["comparisons"] = Json::array();
    out["model"] = report.file;
    out["curve"] = json_of(report);
    return dump(out);
}

std::string curve_as_csv(const CurveReport& report) {
    const auto spline = core::spline_of(report.curve);
    std::string out = "level,index,t,x,y,z,curve_x,curve_y,curve_z,distance\n";
    const auto add = [&](const glm::dvec3& p) {
        for (int i = 0; i < 3; ++i) out += "," + core::shortest(p[i]);
    };
    const auto& levels = report.comparison.levels;
    for (std::size_t l = 0; l < levels.size(); ++l)
        for (std::size_t i = 0; i < levels[l].points.size(); ++i) {
            const double t = levels[l].parameters[i];
            fmt::format_to(std::back_inserter(out), "{},{},{}", l, i, core::shortest(t));
            add(levels[l].points[i]);
            if (report.curve.first() <= t && t <= report.curve.last()) {
                const glm::dvec3 p = core::evaluate(spline, t);
                add(p);
                out += "," + core::shortest(core::norm(levels[l].points[i] - p));
            } else {
                out += ",,,,";
            }
            out += '\n';
        }
    return out;
}

}  // namespace loopcheck::compare
