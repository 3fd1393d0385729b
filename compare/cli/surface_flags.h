// What the commands about the limit surface share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "compare/surface/evaluator.h"

namespace loopcheck::compare {

/// --method: the name of a way, or 'all'.
struct WayFlag {
    std::string method;

    void add_to(CLI::App& command);
    std::vector<SurfaceWay> ways() const;
};

}  // namespace loopcheck::compare
