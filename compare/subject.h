// An implementation under test.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/refinement.h"
#include "core/mesh/surface.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// A subject: what it is, what it can do, and the functions that do it.
struct Subject {
    using Refine = std::function<core::Result<core::Refinement>(const core::TriangleMesh&,
                                                                const core::SchemeOptions&, int)>;
    using Limit =
        std::function<core::Result<core::Limits>(const core::TriangleMesh&, const core::SchemeOptions&, int)>;

    std::string name;          ///< as on the command line: "opensubdiv-float"
    std::string family = {};   ///< the implementation behind it, without the precision: "opensubdiv"
    std::string version = {};  ///< "3.5.0"
    core::Precision precision = core::Precision::Double;
    std::string supports = {};       ///< what it can do, in one sentence
    bool has_weight_option = false;  ///< follows SchemeOptions::weights; else it always has Loop's weights
    double bytes_per_vertex = 0;     ///< peak memory while it refines, per vertex of the last level
    Refine refine = {};
    Limit limit = {};                   ///< in the vertex order of `refine`; empty where it has no limits
    double limit_bytes_per_vertex = 0;  ///< peak memory of that, per vertex of the last level
};

/// The one table of subjects: ours first, then the peers that were found when this was built.
std::vector<Subject> built_in_subjects();

/// The subject of that name, or null.
const Subject* find_subject(std::span<const Subject> subjects, std::string_view name);

/// The subject of the same family in another precision, or null.
const Subject* in_precision(std::span<const Subject> subjects, const Subject& subject,
                            core::Precision precision);

/// The rules a subject is meant to follow when asked for `options`.
core::SchemeOptions options_for(const Subject& subject, core::SchemeOptions options);

}  // namespace loopcheck::compare
