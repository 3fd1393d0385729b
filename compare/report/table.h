// Tables for a reader at a terminal.
#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"

namespace loopcheck::compare {

/// Columns padded to their widest cell; the first is aligned left, the others right.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// Three digits, and plain zero.
std::string number_cell(double value);

/// The largest of some errors in units of `per`, or how many are not finite.
std::string largest_cell(const ErrorStats& errors, double per);

/// The columns of positions: what `first` stands for, then the statistics of a class or level.
std::vector<std::string> position_header(const std::string& first, const Comparison& c);
std::vector<std::string> position_row(const std::string& first, const ClassStats& stats, const Comparison& c);

/// A vector as decimals and as hexadecimal floating-point numbers, with a name before it.
std::string vector_as_text(const std::string& who, const glm::dvec3& p);

/// "vertex 7 of level 1 (edge point of face 3 edge 1; boundary; rule: edge point, crease)".
std::string vertex_in_words(const VertexRecord& record);

/// The three positions of a vertex, and its own numbers where they differ from ours; a line each.
std::string positions_as_text(const VertexRecord& record, const Comparison& c);

}  // namespace loopcheck::compare
