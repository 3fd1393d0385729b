// loopcheck subjects: what can be compared here.
#include <fmt/format.h>

#include "compare/cli/command.h"

namespace loopcheck::compare {
namespace {

int run_subjects(const Context& context) {
    for (const Subject& subject : context.subjects)
        context.out << fmt::format("{:<17} {:<8} {:<7} {}\n", subject.name, subject.version,
                                   core::name(subject.precision), subject.supports);
    return 0;
}

}  // namespace

Command add_subjects(CLI::App& program) {
    program.add_subcommand("subjects",
                           "List what can be compared here, with versions and what each supports");
    return run_subjects;
}

}  // namespace loopcheck::compare
