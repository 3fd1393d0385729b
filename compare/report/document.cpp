#include "compare/report/document.h"

#include "core/mesh/io/number.h"

namespace loopcheck::compare {

nlohmann::ordered_json document(std::string_view command, std::span<const Subject> subjects, int exit_code) {
    nlohmann::ordered_json out{
        {"schema", 1}, {"loopcheck", LOOPCHECK_VERSION}, {"command", command}, {"exit_code", exit_code}};
    out["subjects"] = nlohmann::ordered_json::array();
    for (const Subject& subject : subjects)
        out["subjects"].push_back({{"name", subject.name},
                                   {"version", subject.version},
                                   {"precision", core::name(subject.precision)}});
    return out;
}

nlohmann::ordered_json position_json(const glm::dvec3& p) {
    return {{"decimal", {p.x, p.y, p.z}},
            {"hex", {core::hexfloat(p.x), core::hexfloat(p.y), core::hexfloat(p.z)}}};
}

std::string dump(const nlohmann::ordered_json& json) {
    return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string dump_compact(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace loopcheck::compare
