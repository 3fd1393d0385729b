#include "compare/report/html/curve_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "compare/report/html/chunk.h"
#include "compare/report/html/report_page.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<glm::dvec3>;

constexpr std::size_t kMostSamples = 100'000, kMostPerSpan = 64;

// Evenly in each span, its ends among them.
Points samples_of(const core::Curve<glm::dvec3>& curve, const core::Spline<glm::dvec3>& spline) {
    const double first = curve.first(), last = curve.last();
    const auto knots = static_cast<std::size_t>(std::count_if(
        spline.knots.begin(), spline.knots.end(), [&](double t) { return first <= t && t <= last; }));
    const std::size_t per_span =
        std::clamp<std::size_t>(kMostSamples / std::max<std::size_t>(1, knots), 1, kMostPerSpan);
    Points out{core::evaluate(spline, first)};
    for (std::size_t i = 0; i + 1 < spline.knots.size(); ++i) {
        const double a = std::max(first, spline.knots[i]), b = std::min(last, spline.knots[i + 1]);
        for (std::size_t j = 1; a < b && j <= per_span; ++j) {
            const double share = static_cast<double>(j) / static_cast<double>(per_span);
            out.push_back(core::evaluate(spline, j == per_span ? b : a + share * (b - a)));
        }
    }
    return out;
}

// The curve at the parameter of each point; NaN outside the domain.
Points on_curve(const core::CurveLevel<glm::dvec3>& level, const core::Curve<glm::dvec3>& curve,
                const core::Spline<glm::dvec3>& spline) {
    Points out;
    out.reserve(level.points.size());
    for (const double t : level.parameters)
        out.push_back(curve.first() <= t && t <= curve.last()
                          ? core::evaluate(spline, t)
                          : glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    return out;
}

std::string curve_chunk(const CurveReport& report, std::size_t most_points) {
    const auto spline = core::spline_of(report.curve);
    ChunkWriter chunk;
    const auto axes = drawn_axes(report.curve.points());
    Json header{{"kind", "curve"},
                {"file", report.file},
                {"dimension", report.dimension},
                {"degree", report.curve.shape().degree},
                {"ends", core::name(report.curve.shape().ends)},
                {"drawn", {axes[0], axes[1]}},
                {"levels", Json::array()},
                {"left_out", Json::array()}};
    const auto& levels = report.comparison.levels;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        if (levels[l].points.size() > most_points) {
            header["left_out"].push_back({{"level", l}, {"points", levels[l].points.size()}});
            continue;
        }
        const ArrayRef points = chunk.add(levels[l].points);
        const ArrayRef feet = chunk.add(on_curve(levels[l], report.curve, spline), points);
        header["levels"].push_back({{"level", l}, {"points", points}, {"on_curve", feet}});
    }
    header["exact"] = chunk.add(samples_of(report.curve, spline));
    header["curve"] = json_of(report);
    return std::move(chunk).text(std::move(header));
}

CaseSummary::Result result_of(const CurveComparison& c) {
    std::vector<double> differences;
    for (const PolygonStats& p : c.polygons) differences.push_back(p.error);
    return {"ours", "exact", "curve", c.own, {}, largest_of(differences), c.unit(), c.notes};
}

CaseSummary::Result result_of(const CarriedComparison& c, double largest_coordinate) {
    std::vector<double> differences;
    for (const CarriedLevel& level : c.levels)
        differences.push_back(level.difference.not_finite > 0 ? std::numeric_limits<double>::infinity()
                                                              : level.difference.max);
    std::vector<std::string> notes;
    if (!c.note.empty()) notes.push_back(c.note);
    return {c.subject,
            "ours",
            std::string(name(c.carrier)),
            c.verdict,
            {},
            largest_of(differences),
            error_unit(largest_coordinate, c.precision, c.precision),
            std::move(notes)};
}

}  // namespace

std::string curve_as_html(const CurveReport& report, std::size_t most_points,
                          std::span<const Subject> subjects) {
    const CurveComparison& c = report.comparison;
    CaseSummary summary;
    summary.of.model = report.file;
    summary.of.vertices = report.curve.size();
    summary.of.chunk = curve_chunk(report, most_points);
    summary.results.push_back(result_of(c));
    for (const CarriedComparison& carried : c.carried)
        summary.results.push_back(result_of(carried, c.largest_coordinate));
    const auto count = [&](Verdict verdict) {
        return static_cast<std::size_t>(std::count_if(summary.results.begin(), summary.results.end(),
                                                      [&](const auto& r) { return r.verdict == verdict; }));
    };
    const int code = exit_code(c.worst());
    std::string sentence = fmt::format("{}: {} of 1 curve, levels 0 to {}: {}", code == 0 ? "agree" : "FAIL",
                                       counted(summary.results.size(), "comparison"), c.levels.size() - 1,
                                       verdicts_in_words(count));
    return report_page({"curve", code, std::move(sentence), static_cast<int>(c.levels.size()) - 1, subjects},
                       {std::move(summary)});
}

}  // namespace loopcheck::compare
