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

}  // namespace loopcheck::compare
