// loopcheck merge: the report of a suite from those of its shards.
#include "compare/report/merge.h"

#include <array>
#include <memory>

#include "compare/cli/command.h"
#include "compare/memory.h"
#include "compare/words.h"
#include "core/mesh/io/atomic_file.h"

namespace loopcheck::compare {
namespace {

struct MergeFlags {
    std::vector<std::string> shards;
    std::string json, junit;
};

core::Result<ShardReport> read_shard_file(const std::string& path) {
    return core::read_file(path).and_then(
        [&](const std::string& bytes) { return read_shard(path, bytes, available_memory()); });
}

int run_merge(const Context& context, const MergeFlags& flags) {
    const std::array outputs{flags.json, flags.junit};
    if (outputs_clash(context, outputs, flags.shards)) return kExitUsage;
    std::vector<ShardReport> shards;
    bool all_read = true;
    for (const std::string& path : flags.shards) {
        auto report = read_shard_file(path);
        if (report)
            shards.push_back(std::move(*report));
        else
            complain(context, path, report.error());
        all_read = all_read && report;
    }
    if (shards.empty()) return kExitUsage;
    const auto merged = merge_shards(std::move(shards));
    if (!merged)
        for (const std::string& sentence : merged.error()) context.err << printable(sentence) << "\n";
    if (!merged || !all_read) return kExitUsage;
    context.out << suite_as_text(merged->suite, merged->subjects);
    bool written = flags.json.empty() || write_or_complain(context, flags.json, merged->json);
    if (!flags.junit.empty())
        written = write_or_complain(context, flags.junit, suite_as_junit(merged->suite)) && written;
    return written ? merged->suite.exit_code() : kExitUsage;
}

}  // namespace

Command add_merge(CLI::App& program) {
    auto flags = std::make_shared<MergeFlags>();
    CLI::App* command = program.add_subcommand(
        "merge", "Put the reports of all shards of a suite together, as if it had been one run");
    command->add_option("shard", flags->shards, "reports of suite --shard --json, of every shard once")
        ->required();
    command->add_option("--json", flags->json, "write the report as JSON");
    command->add_option("--junit", flags->junit, "write the report as JUnit XML");
    return [flags](const Context& context) { return run_merge(context, *flags); };
}

}  // namespace loopcheck::compare
