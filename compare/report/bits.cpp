#include "compare/report/bits.h"

#include <fmt/format.h>

#include "compare/report/document.h"
#include "compare/report/table.h"
#include "compare/words.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;
using Kind = core::LatticeAddress::Kind;

std::string address_in_words(const core::LatticeAddress& a, int level) {
    const core::Index segments = core::Index{1} << level;
    switch (a.kind) {
        case Kind::Vertex:
            return fmt::format("vertex {} of the model", a.index);
        case Kind::Edge:
            return fmt::format("edge {} of the model, {}/{} of the way", a.index, a.i, segments);
        default:
            return fmt::format("face {} of the model, ({}, {})/{}", a.index, a.i, a.j, segments);
    }
}

Json json_of(const BitDifference& d) {
    Json out{{"face", d.face}, {"vertex", d.vertex}};
    switch (d.address.kind) {
        case Kind::Vertex:
            out["on_vertex"] = d.address.index;
            break;
        case Kind::Edge:
            out["on_edge"] = d.address.index;
            out["i"] = d.address.i;
            break;
        case Kind::Face:
            out["in_face"] = d.address.index;
            out["i"] = d.address.i;
            out["j"] = d.address.j;
            break;
    }
    out["error"] = d.error;
    out["a"] = position_json(d.ours);
    out["b"] = position_json(d.theirs);
    return out;
}

}  // namespace

std::string bits_as_text(const BitReport& report, const Subject& ours, const Subject& theirs) {
    const BitComparison& c = report.comparison;
    const std::string_view precision = core::name(c.precision);
    std::string out =
        fmt::format("{}: the bits of level {}, without the exact rules\n", printable(report.model), c.level);
    out += fmt::format("a = {} {} ({}), b = {} {} ({})\n", ours.name, ours.version, precision, theirs.name,
                       theirs.version, precision);
    out += fmt::format("boundary {}, creasing {}, weights {}\n", core::name(c.options.boundary),
                       core::name(c.options.creasing), core::name(c.options.weights));
    if (report.creases) out += creases_in_words(*report.creases) + "\n";
    out +=
        fmt::format("M = {:.6g}, u M = {:.3g}; blocks: {}, of at most {} faces; {} refines {} faces\n\n",
                    c.largest_coordinate, c.unit(), c.blocks, c.largest_block, theirs.name, c.faces_refined);
    const double error = c.worst ? c.worst->error : 0;
    out +=
        table({{"level", "vertices", "identical", "max |a-b|", "/ (u M)", "faces that differ"},
               {fmt::format("{}", c.level), fmt::format("{}", c.vertices), fmt::format("{}", c.identical),
                number_cell(error), number_cell(error / c.unit()), fmt::format("{}", c.faces_that_differ)}});
    if (c.worst)
        out += fmt::format("\nworst\n  vertex {} of level {} ({}): |a-b| = {:.6g} = {}\n{}{}",
                           c.worst->vertex, c.level, address_in_words(c.worst->address, c.level), error,
                           in_units(error, c.unit()), vector_as_text(ours.name, c.worst->ours),
                           vector_as_text(theirs.name, c.worst->theirs));
    out += fmt::format("\nverdict: {}\n", name(c.verdict()));
    if (!report.next.empty())
        out += fmt::format(
            "  Without the exact rules, rounding cannot be told from other masks or a known deviation.\n"
            "  This can: {}\n",
            printable(report.next));
    return out;
}

std::string bits_as_json(std::span<const BitReport> reports, std::span<const Subject> subjects,
                         int exit_code) {
    Json out = document("compare", subjects, exit_code);
    out["comparisons"] = Json::array();
    out["bits"] = Json::array();
    for (const BitReport& report : reports) {
        const BitComparison& c = report.comparison;
        Json entry{{"model", report.model},
                   {"precision", core::name(c.precision)},
                   {"boundary", core::name(c.options.boundary)},
                   {"creasing", core::name(c.options.creasing)},
                   {"weights", core::name(c.options.weights)}};
        if (report.creases) {
            entry["crease_angle"] = report.creases->degrees;
            entry["crease_edges"] = report.creases->edges;
        }
        entry.update(Json{{"M", c.largest_coordinate},
                          {"unit", c.unit()},
                          {"level", c.level},
                          {"vertices", c.vertices},
                          {"identical", c.identical},
                          {"faces_that_differ", c.faces_that_differ},
                          {"blocks", c.blocks},
                          {"largest_block", c.largest_block},
                          {"faces_refined", c.faces_refined},
                          {"verdict", name(c.verdict())}});
        if (c.worst) entry["worst"] = json_of(*c.worst);
        if (!report.next.empty()) entry["next"] = report.next;
        out["bits"].push_back(std::move(entry));
    }
    return dump(out);
}

}  // namespace loopcheck::compare
