// --adaptive, and what goes with it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "compare/cli/command.h"
#include "core/loop/adaptive/refine.h"

namespace loopcheck::compare {

struct AdaptiveFlags {
    bool on = false;
    double degrees = 60;
    std::string neighbours = "edge", split = "smooth";
    std::optional<std::string> faces = {};

    void add_to(CLI::App& command);
    /// Which faces are subdivided; nothing, with a message, where --faces names none of the mesh.
    std::optional<core::Criterion> criterion(const Context& context, const core::TriangleMesh& mesh) const;
    /// The same in words.
    std::string in_words() const;
};

/// Refines adaptively in the precision asked for, with no more faces than fit into `bytes`.
core::Result<core::AdaptiveRefinement> refine_adaptively(const core::TriangleMesh& mesh,
                                                         const core::SchemeOptions& options,
                                                         const core::Criterion& criterion,
                                                         core::Precision precision, int levels, double bytes);

}  // namespace loopcheck::compare
