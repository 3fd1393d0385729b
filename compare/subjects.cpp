#include "compare/subject.h"
#include "core/loop/limit.h"
#include "core/loop/refine.h"
#include "reference/opensubdiv/limit.h"
#include "reference/opensubdiv/opensubdiv.h"
#ifdef LOOPCHECK_HAS_OPENMESH
#include "reference/openmesh/openmesh.h"
#endif

namespace loopcheck::compare {
namespace {

using core::Precision;

// The function with the precision, which it takes last, filled in.
template <class Function>
auto in(Precision precision, Function function) {
    return [function, precision](const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                 int levels) { return function(mesh, options, levels, precision); };
}

struct NoLimit {};

// One implementation, in both precisions.
template <class Refine, class Limit = NoLimit>
void add_family(std::vector<Subject>& table, const Subject& family, Refine refine, Limit limit = {}) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        Subject subject = family;
        subject.family = family.name;
        subject.precision = precision;
        if (precision == Precision::Float) subject.name += "-float";
        subject.refine = in(precision, refine);
        if constexpr (!std::is_same_v<Limit, NoLimit>) subject.limit = in(precision, limit);
        table.push_back(std::move(subject));
    }
}

core::Result<core::Refinement> refine_ours(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           int levels, Precision precision) {
    return precision == Precision::Float ? core::refine<float>(mesh, options, levels)
                                         : core::refine<double>(mesh, options, levels);
}

core::Result<core::Limits> limits_ours(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                       int levels, Precision precision) {
    return precision == Precision::Float ? core::limits<float>(mesh, options, levels)
                                         : core::limits<double>(mesh, options, levels);
}

}  // namespace

std::vector<Subject> built_in_subjects() {
    std::vector<Subject> table;
    add_family(
        table,
        {.name = "ours",
         .version = LOOPCHECK_VERSION,
         .supports =
             "everything: all boundary options, creases, semi-sharp, Chaikin, Loop's and Warren's weights",
         .has_weight_option = true,
         .bytes_per_vertex = 300,
         .limit_bytes_per_vertex = 300},
        refine_ours, limits_ours);
    add_family(table,
               {.name = "opensubdiv",
                .version = reference::opensubdiv_version(),
                .supports = "all boundary options, creases, semi-sharp, Chaikin; 15 levels, valence 65 535",
                .bytes_per_vertex = 500,
                .limit_bytes_per_vertex = 600},
               reference::opensubdiv_refine, reference::opensubdiv_limit);
#ifdef LOOPCHECK_HAS_OPENMESH
    add_family(table,
               {.name = "openmesh",
                .version = reference::openmesh_version(),
                .supports = "no creases, no isolated vertices, boundary edge-only, valence 49",
                .bytes_per_vertex = 330},
               reference::openmesh_refine);
#endif
    return table;
}

const Subject* find_subject(std::span<const Subject> subjects, std::string_view name) {
    for (const Subject& subject : subjects)
        if (subject.name == name) return &subject;
    return nullptr;
}

const Subject* in_precision(std::span<const Subject> subjects, const Subject& subject,
                            core::Precision precision) {
    for (const Subject& other : subjects)
        if (other.family == subject.family && other.precision == precision) return &other;
    return nullptr;
}

core::SchemeOptions options_for(const Subject& subject, core::SchemeOptions options) {
    if (!subject.has_weight_option) options.weights = core::Weights::Loop;
    return options;
}

}  // namespace loopcheck::compare
