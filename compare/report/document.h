// What every JSON report begins with.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "compare/subject.h"

namespace loopcheck::compare {

/// Schema, version, command, exit code and subjects.
nlohmann::ordered_json document(std::string_view command, std::span<const Subject> subjects, int exit_code);

/// A position as decimal and as hexadecimal numbers.
nlohmann::ordered_json position_json(const glm::dvec3& p);

/// Not-a-number and infinity become null; bytes that are not UTF-8, in a file name for instance, are
/// replaced.
std::string dump(const nlohmann::ordered_json& json);
/// The same in one line.
std::string dump_compact(const nlohmann::ordered_json& json);

}  // namespace loopcheck::compare
