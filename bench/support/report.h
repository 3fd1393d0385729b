// What was measured, as a table and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/support/measure.h"

namespace loopcheck::bench {

/// The processor and how this program was compiled: what the times belong to.
struct Machine {
    std::string processor;
    unsigned threads = 0;
    std::string compiler, flags;
    std::string instructions;  ///< that our refinement picked on this processor
};
Machine this_machine();
std::string as_text(const Machine& machine);
nlohmann::ordered_json as_json(const Machine& machine);

/// `item` is what costs are per, "vertex" or "sample".
std::string as_text(const CaseResult& result, std::string_view item);
nlohmann::ordered_json as_json(const CaseResult& result);

}  // namespace loopcheck::bench
