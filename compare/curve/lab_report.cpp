#include "compare/curve/lab_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "compare/report/table.h"
#include "core/bspline/limit.h"
#include "core/bspline/subdivide.h"
#include "core/loop/weights.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

using core::Curve;
using core::Ends;
using core::Evaluation;

constexpr int kDense = 1000;  // parameters an interval

template <class P>
Curve<P> curve_of(const std::vector<glm::dvec3>& points, Ends ends) {
    return Curve<P>::make(std::vector<P>(points.begin(), points.end()), {3, ends}).value();
}

// next(k) is the parameter of sample k; the samples are those from 1 to the first that is not below 6.
template <class P, class Next>
LabCount count_by(std::string_view stepping, Next next) {
    const auto curve = curve_of<P>(lab_points(), Ends::Open);
    const auto spline = core::spline_of(curve);
    LabCount out{.stepping = stepping};
    for (auto t = next(0); t < curve.last(); t = next(static_cast<int>(out.samples))) {
        const P all = core::evaluate(spline, t, {Evaluation::AllPoints, &out.all_points});
        const P local = core::evaluate(spline, t, {Evaluation::Local, &out.local});
        out.same_points = out.same_points && all == local;
        ++out.samples;
    }
    return out;
}

template <class Real>
auto accumulated(Real step) {
    return [step, t = Real(1)](int k) mutable { return k == 0 ? t : t += step; };
}

std::string evaluations() {
    std::vector<std::vector<std::string>> rows{
        {"how t is stepped", "samples", "all points", "localised", "points"}};
    for (const LabCount& c : lab_counts())
        rows.push_back({std::string(c.stepping), fmt::format("{}", c.samples),
                        fmt::format("{}", c.all_points), fmt::format("{}", c.local),
                        c.same_points ? "identical" : "differ"});
    auto next = accumulated(0.01f);
    std::string out =
        table(rows) +
        "  All points: 8 basis functions a sample.  Localised, floor(t) - 1 <= i < ceil(t) + 2: 4, and 3 "
        "where t is\n"
        "  whole.  Summed up in float, 0.01 reaches no whole number but the 1 it starts from:\n  t =";
    for (int k = 0; k <= 400; ++k) {
        const float t = next(k);
        if (k > 0 && k % 100 == 0) out += fmt::format(" {}{}", core::shortest(t), k < 400 ? "," : "\n");
    }
    return out + "  So 499 samples take 4 and one takes 3: 1999.\n";
}

std::string orders() {
    std::vector<std::vector<std::string>> rows{{"n in eq. 4", "degree", "intervals", "value in the middle"}};
    for (int order = 2; order <= 5; ++order) {
        const int degree = order - 1;
        rows.push_back({fmt::format("{}", order), fmt::format("{}", degree), fmt::format("{}", order),
                        core::shortest(core::limit_mask<double>(degree, 0)[degree / 2])});
    }
    return table(rows) +
           "  The n of eqs. 3 and 4 is the order, degree + 1: the cubic of eq. 5 is N^4, and N^3 is "
           "quadratic.\n";
}

// Eq. 5 on [0, 1), as printed.
double printed_third_piece(double t) {
    return (3 * t * t * t - 6 * t + 4) / 6;
}

std::string basis() {
    std::vector<std::vector<std::string>> rows{{"t", "3t^3 - 6t^1 + 4, as printed, / 6",
                                                "3t^3 - 6t^2 + 4, / 6", "sum of all four, as printed",
                                                "right"}};
    for (const double t : {0.0, 0.25, 0.5, 0.75}) {
        const double others = core::cubic_basis(t + 1) + core::cubic_basis(t - 1) + core::cubic_basis(t - 2);
        const double right = core::cubic_basis(t);
        rows.push_back({core::shortest(t), fmt::format("{:.6f}", printed_third_piece(t)),
                        fmt::format("{:.6f}", right), fmt::format("{:.6f}", others + printed_third_piece(t)),
                        fmt::format("{:.6f}", others + right)});
    }
    return table(rows) +
           "  The basis functions must sum to 1.  The second piece of eq. 5 is for -1 <= t < 0, printed with "
           "-1 twice.\n";
}

double two_scale_error(int degree, const std::vector<double>& mask) {
    std::vector<double> knots;
    for (int k = 0; k <= degree + 1; ++k) knots.push_back(k);
    const auto basis_at = [&](double t) { return core::basis_function<double>(knots, degree, 0, t); };
    double largest = 0;
    for (int k = 0; k <= kDense * (degree + 1); ++k) {
        const double t = static_cast<double>(k) / kDense;
        double sum = 0;
        for (std::size_t m = 0; m < mask.size(); ++m)
            sum += mask[m] * basis_at(2 * t - static_cast<double>(m));
        largest = std::max(largest, std::abs(basis_at(t) - sum));
    }
    return largest;
}

std::string two_scale() {
    const std::vector<double> four{1. / 8, 4. / 8, 6. / 8, 4. / 8, 1. / 8},
        three{1. / 4, 3. / 4, 3. / 4, 1. / 4};
    std::vector<std::vector<std::string>> rows{{"N(t) = sum_m s_m N(2t - m)", "cubic", "quadratic"}};
    rows.push_back({"s = (1, 4, 6, 4, 1)/8, order 4", fmt::format("{:.1e}", two_scale_error(3, four)),
                    fmt::format("{:.1e}", two_scale_error(2, four))});
    rows.push_back({"s = (1, 3, 3, 1)/4, n = 3 in the text", fmt::format("{:.1e}", two_scale_error(3, three)),
                    fmt::format("{:.1e}", two_scale_error(2, three))});
    return table(rows) +
           "  Largest error over t.  In eq. 6 basis function i of the coarse level is a sum of N_(2i+m)(2t), "
           "and n is 4\n"
           "  for the cubic; with n = 3 it refines the quadratic.\n";
}

std::string matrix() {
    constexpr int kPoints = 5;
    constexpr std::array kPrinted{8, 4, 1, 8, 8, 8, 8, 8, 8};
    const auto S = core::subdivision_matrix({3, Ends::Natural}, kPoints).value();
    std::vector<std::vector<std::string>> rows{
        {"row of 8 S", "c0", "c1", "c2", "c3", "c4", "sum", "c0 as printed", "sum"}};
    for (core::Index i = 0; i < S.row_count(); ++i) {
        std::array<double, kPoints> row{};
        for (std::size_t k = S.offsets[i]; k < S.offsets[i + 1]; ++k) row[S.columns[k]] = 8 * S.weights[k];
        double sum = 0;
        rows.push_back({fmt::format("{}", i)});
        for (const double weight : row) {
            rows.back().push_back(core::shortest(weight));
            sum += weight;
        }
        rows.back().push_back(core::shortest(sum));
        rows.back().push_back(fmt::format("{}", kPrinted[i]));
        rows.back().push_back(core::shortest(sum - row[0] + kPrinted[i]));
    }
    return table(rows) +
           "  Every row of 8 S sums to 8, so that a curve that is moved is subdivided alike.  One step is\n"
           "  C_(i+1) = S C_i; eq. 11 has C_i + 1.\n";
}

std::string ends() {
    std::vector<std::vector<std::string>> rows{
        {"end treatment", "x at t = 0", "y at t = 0", "off on [1, N-2]", "off on the two ends"}};
    for (const LabEnd& end : lab_ends())
        rows.push_back({std::string(end.treatment), fmt::format("{:.6f}", end.at_start.x),
                        fmt::format("{:.6f}", end.at_start.y), fmt::format("{:.1e}", end.inside),
                        fmt::format("{:.6f}", end.at_ends)});
    return table(rows) +
           "  off: the largest distance from the limit of subdivision at the same t.  The 'analytical' curve "
           "of the report\n"
           "  is the plain sum, which is the limit on [1, N-2] only.\n";
}

std::string convergence() {
    const auto curve = curve_of<glm::dvec3>(lab_points(), Ends::Natural);
    const auto limit = core::spline_of(curve);
    const auto plain = core::spline_of(curve_of<glm::dvec3>(lab_points(), Ends::Open));
    std::vector<std::vector<std::string>> rows{
        {"level", "points", "from the limit", "4^-k max|d2|/6", "from the plain sum on [1, N-2]", "beyond"}};
    const auto levels = core::curve_levels(curve, 5);
    for (std::size_t l = 0; l < levels.size(); ++l) {
        double all = 0, inside = 0, beyond = 0;
        for (std::size_t i = 0; i < levels[l].points.size(); ++i) {
            const double t = levels[l].parameters[i];
            const glm::dvec3& c = levels[l].points[i];
            const double off = core::norm(
                c -
                core::evaluate(plain, t, {.method = Evaluation::AllPoints, .basis_evaluations = nullptr}));
            all = std::max(all, core::norm(c - core::evaluate(limit, t)));
            double& which = plain.first() <= t && t <= plain.last() ? inside : beyond;
            which = std::max(which, off);
        }
        rows.push_back({fmt::format("{}", l), fmt::format("{}", levels[l].points.size()),
                        fmt::format("{:.9f}", all),
                        fmt::format("{:.9f}", core::polygon_distance(curve, static_cast<int>(l))),
                        fmt::format("{:.9f}", inside), fmt::format("{:.6f}", beyond)});
    }
    return table(rows) +
           "  A quarter a level, everywhere from the limit; from the report's curve inside only.\n";
}

std::string warren() {
    std::vector<std::vector<std::string>> rows{
        {"valence n", "Loop, and Hoppe et al.", "Warren, 3/(8n)", "difference"}};
    for (int n = 3; n <= 8; ++n) {
        const double loop = core::loop_weight<double>(n), simple = core::warren_weight<double>(n);
        rows.push_back({fmt::format("{}", n), fmt::format("{:.6f}", loop), fmt::format("{:.6f}", simple),
                        fmt::format("{:.6f}", std::abs(loop - simple))});
    }
    return table(rows) +
           "  Eq. 18, the weight of a neighbour, is Warren's simplification; Hoppe et al. use Loop's own "
           "formula.\n";
}

struct Section {
    std::string_view name, title;
    std::string (*text)();
};
constexpr std::array kSections{
    Section{"evaluations", "Basis functions evaluated to draw the curve", evaluations},
    Section{"orders", "Order and degree (eqs. 2 to 5)", orders},
    Section{"basis", "The pieces of the cubic (eq. 5)", basis},
    Section{"two-scale", "The two-scale relation (eq. 6)", two_scale},
    Section{"matrix", "The subdivision matrix (eqs. 11 and 13)", matrix},
    Section{"convergence", "Does the refined curve converge to the analytical one?", convergence},
    Section{"ends", "The ends of the curve", ends},
    Section{"warren", "The weights of Loop's scheme (eq. 18)", warren}};

}  // namespace

std::vector<glm::dvec3> lab_points() {
    return {{-0.8, 1.0, 0.5}, {-0.7, 0.8, 0.5}, {-0.5, 0.7, 0.5}, {-0.5, 1.0, 0.5},
            {0.0, 0.1, 0.5},  {0.3, 0.6, 0.5},  {0.4, 0.5, 0.5},  {0.5, 1.0, 0.5}};
}

std::vector<LabCount> lab_counts() {
    return {count_by<glm::vec3>("float, t += 0.01 (the report)", accumulated(0.01f)),
            count_by<glm::dvec3>("t = 1 + k/100", [](int k) { return 1 + k / 100.0; }),
            count_by<glm::dvec3>("double, t += 0.01", accumulated(0.01))};
}

std::vector<LabEnd> lab_ends() {
    auto points = lab_points();
    const auto limit = core::spline_of(curve_of<glm::dvec3>(points, Ends::Natural));
    const auto plain = core::spline_of(curve_of<glm::dvec3>(points, Ends::Open));
    points.insert(points.begin(), points.front());
    points.push_back(points.back());
    const auto doubled = core::spline_of(curve_of<glm::dvec3>(points, Ends::Open));
    const core::EvaluationOptions sum{Evaluation::AllPoints, nullptr};
    const auto basis_sum = [&](double t) {
        double out = 0;
        for (std::size_t i = 0; i < plain.points.size(); ++i)
            out += core::cubic_basis(t - static_cast<double>(i));
        return out;
    };
    const std::array<std::pair<std::string_view, std::function<glm::dvec3(double)>>, 4> treatments{
        {{"natural: c_-1 = 2 c_0 - c_1", [&](double t) { return core::evaluate(limit, t, sum); }},
         {"plain sum", [&](double t) { return core::evaluate(plain, t, sum); }},
         {"plain sum over the sum of the basis",
          [&](double t) { return core::evaluate(plain, t, sum) / basis_sum(t); }},
         {"end points doubled", [&](double t) { return core::evaluate(doubled, t + 1, sum); }}}};
    std::vector<LabEnd> out;
    for (const auto& [name, at] : treatments) {
        LabEnd end{.treatment = name, .at_start = at(0)};
        const auto steps = static_cast<int>(limit.last()) * kDense;
        for (int k = 0; k <= steps; ++k) {
            const double t = static_cast<double>(k) / kDense;
            double& which = plain.first() <= t && t <= plain.last() ? end.inside : end.at_ends;
            which = std::max(which, core::norm(at(t) - core::evaluate(limit, t)));
        }
        out.push_back(end);
    }
    return out;
}

std::vector<std::string_view> lab_report_sections() {
    std::vector<std::string_view> out;
    for (const Section& section : kSections) out.push_back(section.name);
    return out;
}

std::string lab_report_as_text(std::string_view wanted) {
    std::string out;
    for (const Section& section : kSections) {
        if (!wanted.empty() && section.name != wanted) continue;
        out += fmt::format("{}{}\n{}", out.empty() ? "" : "\n", section.title, section.text());
    }
    return out;
}

}  // namespace loopcheck::compare
