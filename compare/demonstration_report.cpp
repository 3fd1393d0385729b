#include <fmt/format.h>

#include <algorithm>

#include "compare/demonstration.h"
#include "compare/fractions.h"
#include "compare/report/document.h"
#include "compare/report/table.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

// Ten digits, and the fraction where it is one of small numbers.
std::string weight_cell(double weight) {
    if (weight == 0) return "0";
    const auto fraction = as_fraction(weight, kOfDouble);
    const std::string decimal = fmt::format("{:.10g}", weight);
    return fraction && *fraction != decimal ? fmt::format("{} = {}", decimal, *fraction) : decimal;
}

bool is_per_vertex(const Demonstration& d) {
    return d.exact.size() == d.mesh.positions.size();
}

std::string weights_table(const Demonstration& d) {
    std::vector<std::vector<std::string>> rows{{is_per_vertex(d) ? "vertex" : "", d.columns[0]}};
    if (!d.predicted.empty()) rows[0].push_back("predicted");
    rows[0].push_back(d.columns[1]);
    for (std::size_t v = 0; v < d.exact.size(); ++v) {
        const double predicted = d.predicted.empty() ? 0 : d.predicted[v];
        if (d.exact[v] == 0 && d.observed[v] == 0 && predicted == 0) continue;
        auto& row = rows.emplace_back();
        row.push_back(is_per_vertex(d) ? fmt::format("{}", v) : "value");
        row.push_back(weight_cell(d.exact[v]));
        if (!d.predicted.empty()) row.push_back(weight_cell(predicted));
        row.push_back(weight_cell(d.observed[v]));
    }
    return table(rows);
}

Json json_of(const Demonstration& d) {
    Json out{{"name", d.deviation->name},
             {"family", d.deviation->family},
             {"kind", name(d.deviation->kind)},
             {"what", d.deviation->what},
             {"page", page_of(*d.deviation)},
             {"seen_in", d.deviation->versions},
             {"status", name(d.status)},
             {"mesh_in_words", d.mesh_in_words},
             {"quantity", d.quantity},
             {"columns", {d.columns[0], d.columns[1]}},
             {"predicted_amount", d.predicted_amount},
             {"observed_amount", d.observed_amount},
             {"exact", d.exact},
             {"observed", d.observed}};
    if (!d.predicted.empty()) out["predicted"] = d.predicted;
    Json& mesh = out["mesh"] = {{"positions", Json::array()},
                                {"triangles", Json::array()},
                                {"sharp_edges", Json::array()},
                                {"sharp_vertices", Json::array()}};
    for (const auto& p : d.mesh.positions) mesh["positions"].push_back({p.x, p.y, p.z});
    core::for_each_face(d.mesh, [&](std::size_t, std::span<const core::Index> corners) {
        mesh["triangles"].push_back({corners[0], corners[1], corners[2]});
    });
    for (const auto& e : d.mesh.creases) mesh["sharp_edges"].push_back({e.a, e.b, e.sharpness});
    for (const auto& v : d.mesh.corners) mesh["sharp_vertices"].push_back({v.vertex, v.sharpness});
    return out;
}

}  // namespace

std::string demonstration_as_text(const Demonstration& d, std::string_view version) {
    const KnownDeviation& deviation = *d.deviation;
    std::string out =
        fmt::format("{} ({}, {}; seen in {}, here {})\n  {}\n\n", deviation.name, name(deviation.kind),
                    deviation.family, deviation.versions, version, deviation.what);
    out += fmt::format("mesh: {}\n{}\n{}\n", d.mesh_in_words, d.quantity, weights_table(d));
    out += fmt::format("sum |{} - {}|: {} {:.6g}, observed {:.6g}: {}\n", d.columns[1], d.columns[0],
                       d.predicted.empty() ? "predicted at most" : "predicted", d.predicted_amount,
                       d.observed_amount, name(d.status));
    return out + fmt::format("See {}.\n", page_of(deviation));
}

std::string demonstrations_as_json(std::span<const Demonstration> demonstrations,
                                   std::span<const Subject> subjects, int exit_code) {
    Json out = document("deviations", subjects, exit_code);
    out["comparisons"] = Json::array();
    out["deviations"] = Json::array();
    for (const Demonstration& d : demonstrations) out["deviations"].push_back(json_of(d));
    return dump(out);
}

}  // namespace loopcheck::compare
