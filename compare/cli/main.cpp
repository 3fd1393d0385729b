#include <csignal>
#include <iostream>

#include "compare/cli/cli.h"

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of write(), with a sentence
    const auto subjects = loopcheck::compare::built_in_subjects();
    const int code = loopcheck::compare::run({argv + 1, argv + argc}, subjects, std::cout, std::cerr);
    if (std::cout.flush()) return code;
    std::cerr << "The results could not be written to standard output.\n";
    return 2;
}
