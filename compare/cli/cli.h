// The command line of loopcheck.
#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "compare/subject.h"

namespace loopcheck::compare {

/// Runs the program with the arguments after its name and gives the exit code: 0 agree, 1 differ, 2 bad usage
/// or unreadable input, 3 a subject failed or cannot do what was asked.  Results go to `out`; warnings,
/// errors and, where `err` is a terminal, progress go to `err`.
int run(const std::vector<std::string>& arguments, std::span<const Subject> subjects, std::ostream& out,
        std::ostream& err);

}  // namespace loopcheck::compare
