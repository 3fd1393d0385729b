// A measurement in a process of its own: no warm heap, no buffer that was touched before.
#pragma once

#include <string>
#include <vector>

#include "bench/support/case.h"

namespace loopcheck::bench {

struct Fresh {
    double prepare_seconds = 0;  ///< to take over the mesh, and all that is not timed
    double work_seconds = 0;
    double bytes = 0;  ///< peak of what both needed beside our mesh; NaN where the system does not say
};

/// Measures the subject once, in this process, in which nothing else was measured.
core::Result<Fresh> measure_here(const Subject& subject, const core::TriangleMesh& mesh);

/// A line for another process, and what `run_fresh` makes of it.
std::string to_line(const Fresh& fresh);

/// Runs this program with these arguments, which print such a line.
/// Errors   SubjectFailed.
core::Result<Fresh> run_fresh(const std::vector<std::string>& arguments);

}  // namespace loopcheck::bench
