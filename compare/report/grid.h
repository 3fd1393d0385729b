// Reports of a grid of control points.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/curve/tensor_comparison.h"
#include "compare/subject.h"

namespace loopcheck::compare {

/// One grid in double and in float.
struct GridReport {
    std::string file;
    std::size_t rows = 0, columns = 0;
    core::Ends u = core::Ends::Natural, v = core::Ends::Natural;
    double largest_coordinate = 0;
    struct Entry {
        core::Precision precision;
        TensorComparison comparison;
    };
    std::vector<Entry> comparisons;

    Verdict worst() const;
};

/// A table a precision: a line a level.
std::string grid_as_text(const GridReport& report, std::string_view version);

/// The document of docs/report.schema.json.
std::string grid_as_json(const GridReport& report, std::span<const Subject> subjects);

}  // namespace loopcheck::compare
