// The curve as a picture.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <iterator>
#include <numeric>

#include "compare/report/curve.h"

namespace loopcheck::compare {
namespace {

// Colours that are told apart by most people, from Okabe and Ito's set.
constexpr std::array kColours{"#e69f00", "#009e73", "#56b4e9"};
constexpr double kWidth = 900, kMargin = 40, kLegendLine = 22, kMostHeight = 900;
constexpr double kUnseen = 0.1;  // of a pixel
constexpr std::size_t kMostFlatPoints = 100000;

struct Box {
    glm::dvec3 low, high, half;  // half: of the extent, so that it is finite where coordinates are large
};

Box box_of(const std::vector<glm::dvec3>& points) {
    glm::dvec3 low(points.front()), high(points.front());
    for (const glm::dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {low, high, high / 2.0 - low / 2.0};
}

// From the two coordinates that vary most to the page, y up.
class Page {
  public:
    explicit Page(const std::vector<glm::dvec3>& points) {
        const Box box = box_of(points);
        const auto axes = drawn_axes(points);
        across_ = axes[0];
        up_ = axes[1];
        left_ = box.low[across_];
        top_ = box.high[up_];
        const double width = 2 * box.half[across_], height = 2 * box.half[up_];
        scale_ = std::min(width > 0 ? (kWidth - 2 * kMargin) / width : 1e300,
                          height > 0 ? (kMostHeight - 2 * kMargin) / height : 1e300);
        if (!(scale_ < 1e300)) scale_ = 1;
        height_ = height * scale_ + 2 * kMargin;
    }

    std::string at(const glm::dvec3& p) const {
        return fmt::format("{:.3f} {:.3f}", kMargin + (p[across_] - left_) * scale_,
                           kMargin + (top_ - p[up_]) * scale_);
    }
    /// A distance that no one sees, in model units.
    double unseen() const { return kUnseen / scale_; }
    double height() const { return height_; }
    std::string axes() const { return fmt::format("{} and {}", "xyz"[across_], "xyz"[up_]); }

  private:
    int across_ = 0, up_ = 1;
    double left_ = 0, top_ = 0, scale_ = 1, height_ = 0;
};

std::string polyline(const Page& page, const std::vector<glm::dvec3>& points, bool closed) {
    std::string path;
    for (std::size_t i = 0; i < points.size(); ++i) path += (i == 0 ? "M" : " L") + page.at(points[i]);
    return path + (closed ? " Z" : "");
}

// The curve itself: its Bezier points, for the degrees that a path can have; else the fewest points that are
// not seen to differ.
std::string curve_path(const Page& page, const core::Curve<glm::dvec3>& curve) {
    const auto spline = core::spline_of(curve);
    const double first = curve.first(), last = curve.last();
    std::string path = "M" + page.at(core::evaluate(spline, first));
    for (std::size_t s = core::span_of(spline, first);
         s < spline.points.size() && spline.knots[s] < last && spline.degree <= 3; ++s) {
        const double a = std::max(first, spline.knots[s]), b = std::min(last, spline.knots[s + 1]);
        if (a >= b) continue;
        path += std::array{" L", " Q", " C"}[spline.degree - 1];
        for (int k = 1; k <= spline.degree; ++k)
            path += " " + page.at(core::blossom(
                              spline, s, [&](std::size_t r) { return static_cast<int>(r) < k ? b : a; }));
    }
    if (spline.degree <= 3) return path;
    const auto flat = core::flatten(spline, first, last, page.unseen(), kMostFlatPoints);
    if (flat) return polyline(page, flat->points, false);
    // Too many: where the knots are, at least.
    std::vector<glm::dvec3> at_knots;
    for (const double t : spline.knots)
        if (first <= t && t <= last) at_knots.push_back(core::evaluate(spline, t));
    return polyline(page, at_knots, false);
}

// The polygon of a level, `magnify` times as far from the curve; what is outside the domain is left out.
std::vector<glm::dvec3> magnified(const core::Curve<glm::dvec3>& curve,
                                  const core::CurveLevel<glm::dvec3>& level, double magnify) {
    const auto spline = core::spline_of(curve);
    std::vector<glm::dvec3> out;
    for (std::size_t i = 0; i < level.points.size(); ++i) {
        const double t = level.parameters[i];
        if (magnify == 1) out.push_back(level.points[i]);
        if (magnify == 1 || t < curve.first() || t > curve.last()) continue;
        const glm::dvec3 p = core::evaluate(spline, t);
        out.push_back(p + magnify * (level.points[i] - p));
    }
    return out;
}

std::string line_of(const std::string& path, std::string_view style) {
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n", path, style);
}

}  // namespace

std::array<int, 2> drawn_axes(const std::vector<glm::dvec3>& points) {
    const glm::dvec3 half = box_of(points).half;
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return half[a] > half[b]; });
    return {std::min(order[0], order[1]), std::max(order[0], order[1])};
}

std::string curve_as_svg(const CurveReport& report, double magnify) {
    const auto& curve = report.curve;
    const auto& levels = report.comparison.levels;
    const bool closed = curve.shape().ends == core::Ends::Closed;
    const int drawn = std::min(kDrawnLevels, static_cast<int>(levels.size()) - 1);
    std::vector<std::vector<glm::dvec3>> polygons;
    std::vector<glm::dvec3> all = curve.points();
    for (int l = 1; l <= drawn; ++l) {
        polygons.push_back(magnified(curve, levels[l], magnify));
        all.insert(all.end(), polygons.back().begin(), polygons.back().end());
    }
    const Page page(all);
    constexpr std::string_view kGrey = "stroke=\"#999999\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"";
    std::string body = line_of(polyline(page, curve.points(), closed), kGrey);
    std::vector<std::pair<std::string, std::string>> legend{{std::string(kGrey), "control polygon"}};
    const std::string thick = "stroke=\"#222222\" stroke-width=\"2.4\"";
    body += line_of(curve_path(page, curve), thick);
    for (int l = 1; l <= drawn; ++l) {
        const std::string style = fmt::format("stroke=\"{}\" stroke-width=\"1.3\"", kColours[l - 1]);
        body += line_of(polyline(page, polygons[l - 1], closed), style);
        legend.emplace_back(
            style, magnify == 1 ? fmt::format("level {}", l)
                                : fmt::format("level {}, distance from the curve x {:.6g}", l, magnify));
    }
    for (const glm::dvec3& p : curve.points()) {
        const std::string at = page.at(p);
        const std::size_t blank = at.find(' ');
        body += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3\" fill=\"#999999\"/>\n", at.substr(0, blank),
                            at.substr(blank + 1));
    }
    legend.emplace_back(thick, fmt::format("exact curve, degree {}, {} ends", curve.shape().degree,
                                           core::name(curve.shape().ends)));
    const double height = page.height() + kLegendLine * static_cast<double>(legend.size()) + kMargin / 2;
    double y = page.height();
    for (const auto& [style, text] : legend) {
        body += line_of(fmt::format("M{} {} h36", kMargin, y), style);
        body += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", kMargin + 46, y + 4, text);
        y += kLegendLine;
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.3f}\" width=\"{0}\" "
        "height=\"{1:.3f}\" "
        "font-family=\"sans-serif\" font-size=\"14\">\n<title>{2} control points, {3}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{4}</svg>\n",
        kWidth, height, curve.size(), page.axes(), body);
}

}  // namespace loopcheck::compare
