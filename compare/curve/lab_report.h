// What the lab report that this project began with says of curves, and what is true, computed anew.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace loopcheck::compare {

/// Its curve: 8 control points in a plane.
std::vector<glm::dvec3> lab_points();

/// The names of the sections, in order.
std::vector<std::string_view> lab_report_sections();

/// The section of that name as text; all of them where it is empty.  Requires a name that exists.
std::string lab_report_as_text(std::string_view section);

/// Drawing the curve as the report does: samples, basis functions evaluated by each sum, and whether the
/// points are the same, bit for bit.
struct LabCount {
    std::string_view stepping;
    std::int64_t samples = 0, all_points = 0, local = 0;
    bool same_points = true;
};
std::vector<LabCount> lab_counts();

/// The largest distances from the limit of the lab's curve on [1, N-2] and on the two intervals at the ends,
/// by other ways to end the sum.
struct LabEnd {
    std::string_view treatment;
    glm::dvec3 at_start{0};  ///< at t = 0
    double inside = 0, at_ends = 0;
};
std::vector<LabEnd> lab_ends();

}  // namespace loopcheck::compare
