// The parts of the JSON reports that the HTML report has too.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "compare/report/curve.h"
#include "compare/report/report.h"
#include "compare/report/surface.h"

namespace loopcheck::compare {

/// How much of a level is told.
enum class Detail : std::uint8_t {
    Levels,
    Classes,  ///< and of each vertex class, and the worst vertices
};

// Each as in docs/report.schema.json.

/// Without the name of the model.
nlohmann::ordered_json json_of(const Comparison& comparison, const std::optional<LimitComparison>& limits,
                               Detail detail);
nlohmann::ordered_json json_of(const UnreadableModel& bad);
nlohmann::ordered_json json_of(const SurfaceComparison& comparison);
nlohmann::ordered_json json_of(const CurveReport& report);
/// The report of a suite; `comparisons` is the array of its rows.
nlohmann::ordered_json suite_document(const SuiteResult& suite, std::span<const Subject> subjects,
                                      nlohmann::ordered_json comparisons);

/// Writes into the report of a shard the checksum of all the rest of it.  Requires that it has one.
void seal(nlohmann::ordered_json& report);

}  // namespace loopcheck::compare
