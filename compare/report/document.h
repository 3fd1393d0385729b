// What every JSON report begins with.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "compare/subject.h"

namespace loopcheck::compare {

/// Schema, version, command, exit code and subjects.
nlohmann::ordered_json document(std::string_view command, std::span<const Subject> subjects, int exit_code);

/// Not-a-number and infinity become null; bytes that are not UTF-8, in a file name for instance, are
/// replaced.
std::string dump(const nlohmann::ordered_json& json);
/// The same in one line.
std::string dump_compact(const nlohmann::ordered_json& json);

}  // namespace loopcheck::compare
