#include <iostream>

#include "compare/cli/cli.h"

int main(int argc, char** argv) {
    const auto subjects = loopcheck::compare::built_in_subjects();
    return loopcheck::compare::run({argv + 1, argv + argc}, subjects, std::cout, std::cerr);
}
