// loopcheck curve: a B-spline curve, its subdivision, its limit and its peers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "compare/cli/command.h"
#include "compare/curve/lab_report.h"
#include "compare/memory.h"
#include "compare/report/html/curve_case.h"
#include "compare/words.h"
#include "core/bspline/limit.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

constexpr std::size_t kMostFlatPoints = 1'000'000;

struct CurveFlags {
    std::string points, ends, peer, json, csv, svg, matrix;
    std::string section;  // of the lab report
    WorkFlags work;
    HtmlFlags html;
    int degree = 3;
    bool closed = false, lab_report = false;
    std::optional<double> tolerance;
    double magnify = 1;
};

std::optional<core::Curve<glm::dvec3>> curve_or_complain(const Context& context, const CurveFlags& flags,
                                                         const core::PointsFile& file) {
    const core::CurveShape shape{flags.degree,
                                 flags.closed ? core::Ends::Closed : core::parse_ends(flags.ends).value()};
    auto curve = core::Curve<glm::dvec3>::make(file.points, shape);
    if (curve) return std::move(*curve);
    complain(context, flags.points, on_its_line(curve.error(), file));
    return std::nullopt;
}

// Points of the last level: at most 2^L times as many.
double last_level_points(const core::Curve<glm::dvec3>& curve, const CurveFlags& flags) {
    return std::ldexp(static_cast<double>(curve.size()), flags.work.levels);
}

std::optional<core::Error> check_size(const core::Curve<glm::dvec3>& curve, const CurveFlags& flags) {
    const double points = last_level_points(curve, flags);
    const double weights =
        flags.matrix.empty() ? 0 : static_cast<double>(curve.size()) * (curve.shape().degree + 1);
    const double shown = flags.html.wanted() ? std::min(points, static_cast<double>(flags.html.vertices)) : 0;
    const double bytes =
        points * kCurveBytesPerPoint + shown * kShownBytesPerPoint + weights * kMatrixBytesPerWeight;
    return check_memory(fmt::format("Level {} has up to {:.0f} points", flags.work.levels, points), bytes,
                        flags.work.memory_limit());
}

ToleranceReport report_tolerance(const core::Curve<glm::dvec3>& curve, double tolerance) {
    ToleranceReport out{.tolerance = tolerance};
    const auto flat =
        core::flatten(core::spline_of(curve), curve.first(), curve.last(), tolerance, kMostFlatPoints);
    if (flat) out.flat_points = flat->points.size();
    if (curve.shape().ends == core::Ends::Clamped) return out;
    out.level = core::level_for_tolerance(curve, tolerance);
    out.level_points = core::point_count(curve.shape(), curve.size(), *out.level);
    out.distance = core::polygon_distance(curve, *out.level);
    return out;
}

bool write_matrix(const Context& context, const CurveFlags& flags, const core::Curve<glm::dvec3>& curve) {
    const auto matrix = core::subdivision_matrix(curve.shape(), curve.size());
    if (!matrix) {
        complain(context, flags.points, matrix.error());
        return false;
    }
    return write_or_complain(
        context, flags.matrix,
        core::matrix_market(
            *matrix,
            fmt::format("rows: the points of level 1\ncolumns: the points of {}\ndegree "
                        "{}, {} ends",
                        printable(flags.points), curve.shape().degree, core::name(curve.shape().ends))));
}

bool write_files(const Context& context, const CurveFlags& flags, const CurveReport& report) {
    const auto write = [&](const std::string& path, auto make) {
        return path.empty() || write_or_complain(context, path, make());
    };
    return write(flags.json, [&] { return curve_as_json(report, context.subjects); }) &&
           write(flags.csv, [&] { return curve_as_csv(report); }) &&
           write(flags.svg, [&] { return curve_as_svg(report, flags.magnify); }) &&
           write(flags.html.path,
                 [&] { return curve_as_html(report, flags.html.vertices, context.subjects); }) &&
           (flags.matrix.empty() || write_matrix(context, flags, report.curve));
}

// The subject that was asked for, in each precision that it has.
std::vector<const Subject*> peers(const Context& context, const Subject& subject) {
    std::vector<const Subject*> out{&subject};
    for (const Subject& other : context.subjects)
        if (other.family == subject.family && other.name != subject.name && subject.name == subject.family)
            out.push_back(&other);
    return out;
}

int run_curve(const Context& context, const CurveFlags& flags) {
    if (flags.lab_report) {
        context.out << lab_report_as_text(flags.section);
        return 0;
    }
    if (flags.points.empty()) {
        context.err << "curve takes a file of points, or --lab-report.\n";
        return kExitUsage;
    }
    if (!flags.html.check(context)) return kExitUsage;
    const std::array outputs{flags.json, flags.csv, flags.svg, flags.matrix, flags.html.path};
    const std::array inputs{flags.points};
    if (outputs_clash(context, outputs, inputs)) return kExitUsage;
    const Subject* subject = flags.peer.empty() ? nullptr : find_or_complain(context, flags.peer, "double");
    if (!flags.peer.empty() && subject == nullptr) return kExitUsage;
    const auto file = core::read_points(flags.points);
    if (!file) {
        complain(context, flags.points, file.error());
        return kExitUsage;
    }
    auto curve = curve_or_complain(context, flags, *file);
    if (!curve) return kExitUsage;
    if (const auto error = check_size(*curve, flags)) {
        complain(context, flags.points, *error);
        return kExitUsage;
    }
    CurveReport report{flags.points, file->dimension, std::move(*curve), {}, std::nullopt};
    if (flags.tolerance) report.tolerance = report_tolerance(report.curve, *flags.tolerance);
    {
        Progress progress(context);
        const auto show = [&](const std::string& line) { progress.show(line); };
        report.comparison = compare_curve(report.curve, flags.work.levels, show);
        // What is left beside the curve.
        const double left =
            flags.work.memory_limit() - last_level_points(report.curve, flags) * kCurveBytesPerPoint;
        if (subject != nullptr)
            for (const Subject* peer : peers(context, *subject))
                for (auto& one : compare_carried(report.curve, flags.work.levels, *peer, left, show))
                    report.comparison.carried.push_back(std::move(one));
    }
    context.out << curve_as_text(report);
    return write_files(context, flags, report) ? exit_code(report.comparison.worst()) : kExitUsage;
}

}  // namespace

Command add_curve(CLI::App& program) {
    auto flags = std::make_shared<CurveFlags>();
    flags->ends = core::name(core::Ends::Natural);
    CLI::App* command = program.add_subcommand(
        "curve", "Subdivide a B-spline curve and hold it against its limit, 38 digits and OpenSubdiv");
    command->add_option("points", flags->points, "a text file with the 2 or 3 coordinates of a point a line");
    flags->work.add_levels_to(*command);
    CLI::Option* closed = command->add_flag("--closed", flags->closed, "join the last point to the first");
    command->add_option("--ends", flags->ends, "natural, closed, open or clamped")
        ->capture_default_str()
        ->check(CLI::IsMember({"natural", "closed", "open", "clamped"}))
        ->excludes(closed);
    command->add_option("--degree", flags->degree, "of the polynomials")
        ->capture_default_str()
        ->check(CLI::Range(1, core::kMaxDegree));
    command->add_option("--compare", flags->peer,
                        "a subject whose boundaries and creases are held against the curve: opensubdiv");
    command
        ->add_option("--tolerance", flags->tolerance,
                     "say which level, and how many points, are within this distance of the curve")
        ->check(check_positive);
    command->add_option("--json", flags->json, "write the report as JSON");
    flags->html.add_to(*command, 100'000);
    command->add_option("--csv", flags->csv, "write every point of every level, and where the curve is");
    CLI::Option* svg = command->add_option("--svg", flags->svg, "write a picture");
    command
        ->add_option("--magnify", flags->magnify, "in the picture, so many times the distance from the curve")
        ->check(check_positive)
        ->needs(svg);
    command->add_option("--matrix", flags->matrix, "write the subdivision matrix as a Matrix Market file");
    CLI::Option* lab =
        command->add_flag("--lab-report", flags->lab_report,
                          "instead of all that: what the lab report says of curves, and what is true");
    command->add_option("--section", flags->section, "of it")
        ->needs(lab)
        ->check(CLI::IsMember(lab_report_sections()));
    return [flags](const Context& context) { return run_curve(context, *flags); };
}

}  // namespace loopcheck::compare
