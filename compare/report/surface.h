// Reports of the limit surface: the atlas, and one model against the exact surface.
#pragma once

#include <span>
#include <string>

#include "compare/surface/surface_comparison.h"

namespace loopcheck::compare {

/// A table a way: a line a class, and per level the largest position error and what the derivatives are off
/// by, relative; then the rate and lambda.  'exact' where everything is rounding.
std::string atlas_as_text(const Atlas& atlas, std::string_view version);

/// One model by some ways.
struct SurfaceReport {
    std::string model;
    std::size_t vertices = 0, faces = 0;
    std::vector<SurfaceComparison> comparisons;

    /// That of the worst verdict; what a way does not support counts only where no other was compared.
    int exit_code() const;
};

/// The rules, then a table a way: a line a face class; and the verdicts in words.
std::string surface_as_text(const SurfaceReport& report, std::string_view version);

/// The document of docs/report.schema.json.
std::string atlas_as_json(const Atlas& atlas, std::span<const Subject> subjects, int exit_code);
std::string surface_as_json(const SurfaceReport& report, std::span<const Subject> subjects);

}  // namespace loopcheck::compare
