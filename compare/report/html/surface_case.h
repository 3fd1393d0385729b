// What an HTML report shows of `limit`: the control mesh with what was seen of each face, and some levels.
#pragma once

#include <span>
#include <string>

#include "compare/report/surface.h"
#include "compare/subject.h"

namespace loopcheck::compare {

/// Deepest level of refinement shown beside the surfaces.
inline constexpr int kSurfaceLevels = 3;

/// The HTML file of one model by some ways.  Requires a build that has the page.
std::string surface_as_html(const SurfaceReport& report, const core::TriangleMesh& mesh,
                            const core::SchemeOptions& options, std::size_t most_vertices,
                            std::span<const Subject> subjects);

}  // namespace loopcheck::compare
