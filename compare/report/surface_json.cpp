#include "compare/report/document.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(std::optional<double> value) {
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(int level, const core::Result<AtlasError>& error) {
    if (!error) return {{"level", level}, {"error", core::to_string(error.error())}};
    return {{"level", level},
            {"exact", error->is_rounding()},
            {"position", error->largest[0]},
            {"first", error->relative[1]},
            {"second", error->relative[2]},
            {"unbalance", error->unbalance[0]}};
}

Json json_of(const FaceClass& face_class, const SurfaceStats& s) {
    return {{"class", to_string(face_class)},
            {"faces", s.faces},
            {"samples", s.samples},
            {"position", s.position},
            {"predicted", s.predicted},
            {"bound_use", s.bound_use},
            {"beyond_bound", s.beyond},
            {"normal_degrees", s.normal},
            {"first", s.first},
            {"second", s.second},
            {"rate", json_of(s.rate)},
            {"lambda", json_of(s.lambda)}};
}

}  // namespace

Json json_of(const SurfaceComparison& c) {
    Json out{{"method", c.check.way.name},
             {"smooth_level", c.check.smooth_level},
             {"sharp_level", c.check.sharp_level},
             {"boundary", core::name(c.options.boundary)},
             {"creasing", core::name(c.options.creasing)},
             {"verdict", name(c.verdict)},
             {"notes", c.notes},
             {"diagonal", c.diagonal},
             {"without_surface", c.without_surface}};
    out["deviations"] = Json::array();
    for (int i = 0; i < kSurfaceDeviations; ++i) {
        const DeviationCount& seen = c.deviations[i];
        if (seen.expected + seen.possible + seen.shown == 0) continue;
        out["deviations"].push_back({{"name", name(static_cast<SurfaceDeviationId>(i))},
                                     {"expected", seen.expected},
                                     {"shown", seen.shown},
                                     {"missing", seen.missing},
                                     {"largest", seen.largest}});
    }
    out["classes"] = Json::array();
    for (const auto& [face_class, stats] : c.classes) out["classes"].push_back(json_of(face_class, stats));
    return out;
}

std::string atlas_as_json(const Atlas& atlas, std::span<const Subject> subjects, int exit_code) {
    Json out = document("atlas", subjects, exit_code);
    out["comparisons"] = Json::array();
    out["atlas"] = Json::array();
    for (const AtlasRow& row : atlas.rows) {
        Json entry{{"method", row.way}, {"class", to_string(row.corner)}, {"levels", Json::array()}};
        for (std::size_t i = 0; i < row.levels.size(); ++i)
            entry["levels"].push_back(json_of(atlas.levels[i], row.levels[i]));
        entry["rate"] = json_of(row.rate);
        entry["lambda"] = json_of(row.lambda);
        out["atlas"].push_back(std::move(entry));
    }
    return dump(out);
}

std::string surface_as_json(const SurfaceReport& report, std::span<const Subject> subjects) {
    Json out = document("limit", subjects, report.exit_code());
    out["comparisons"] = Json::array();
    out["model"] = report.model;
    out["surfaces"] = Json::array();
    for (const SurfaceComparison& c : report.comparisons) out["surfaces"].push_back(json_of(c));
    return dump(out);
}

}  // namespace loopcheck::compare
