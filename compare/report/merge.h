// One suite from the reports of its shards.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "compare/report/report.h"

namespace loopcheck::compare {

/// The report of a shard.
struct ShardReport {
    std::string file;
    SuiteResult suite;                   ///< with its shard; of the statistics what the text of a suite needs
    std::vector<Subject> subjects;       ///< their names, versions and precisions
    nlohmann::ordered_json comparisons;  ///< as they stand in the file
};

/// Reads what `suite --shard --json` wrote, with at most so many bytes of memory.
/// Errors  BadSyntax where it is anything else, or was changed since; OutOfMemory.
core::Result<ShardReport> read_shard(std::string file, std::string_view bytes, double memory_limit);

struct MergedSuite {
    SuiteResult suite;
    std::vector<Subject> subjects;
    std::string json;
};

/// The suite that all shards together are.  Text, JSON and JUnit XML of it are those of the suite in one run,
/// but that a file name that is not UTF-8 stays as JSON has it.  Requires at least one shard.
/// Errors  sentences: shards of different suites, a shard that is missing or there twice, or does not have
///         exactly its cases.
tl::expected<MergedSuite, std::vector<std::string>> merge_shards(std::vector<ShardReport> shards);

}  // namespace loopcheck::compare
