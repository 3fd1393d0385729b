// Reports of comparisons of bits alone.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "compare/deep/bits.h"
#include "compare/loading.h"
#include "compare/subject.h"

namespace loopcheck::compare {

struct BitReport {
    std::string model;  ///< as named on the command line
    std::optional<CreaseTags> creases = {};
    BitComparison comparison;
    std::string next;  ///< where bits differ: the command that tells why
};

/// The rules, the blocks, one line of counts, the worst vertex and the verdict in words.  Requires subjects
/// of ours and of OpenSubdiv in the precision of the comparison.
std::string bits_as_text(const BitReport& report, const Subject& ours, const Subject& theirs);

/// The document of docs/report.schema.json.
std::string bits_as_json(std::span<const BitReport> reports, std::span<const Subject> subjects,
                         int exit_code);

}  // namespace loopcheck::compare
