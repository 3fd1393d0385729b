// The control points of a curve as a text file.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"

namespace loopcheck::core {

/// Points as they were read.  In the plane z is 0.
struct PointsFile {
    int dimension = 3;  ///< 2 or 3
    std::vector<glm::dvec3> points;
    std::vector<long long> lines;  ///< the line of each point, from 1
};

/// Reads a point a line: two coordinates in every line, or three, separated by blanks, by commas or by
/// semicolons.  '#' begins a comment; empty lines are skipped; the first line with words may name the
/// columns. A coordinate is the double nearest to what is written.
///
/// Errors   CannotRead, TooLarge; BadSyntax and NotFinite, with the line; TooFewPoints where there is none.
Result<PointsFile> read_points(const std::filesystem::path& path);

/// The same from memory.
Result<PointsFile> parse_points(std::string_view bytes);

}  // namespace loopcheck::core
