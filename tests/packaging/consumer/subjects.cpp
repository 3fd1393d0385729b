// Lists the subjects; that it links is the point.
#include <cstdio>

#include "compare/subject.h"

int main() {
    for (const auto& subject : loopcheck::compare::built_in_subjects())
        std::printf("%s %s\n", subject.name.c_str(), subject.version.c_str());
}
