// What is known to be wrong, or different, in a subject.
#pragma once

#include <span>
#include <string_view>

#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// A difference that is on the list: it is expected where the rules as the subject really follows them say
/// so, by the amount they say; absent, larger or elsewhere, it is not.
struct KnownDeviation {
    enum class Kind { Error, Approximation, Documented };

    std::string_view name;
    std::string_view family;  ///< of the subject, see Subject::family
    Kind kind;
    std::string_view what;  ///< one sentence
    std::string_view page;  ///< in docs/
    /// The rules the subject really follows when asked for `options`.
    core::SchemeOptions (*as_done)(core::SchemeOptions options);
};

/// The list.
std::span<const KnownDeviation> known_deviations();

/// True where the deviation changes a mask on the way to level `levels`, so that it must show.
bool is_predicted(const KnownDeviation& deviation, const core::TriangleMesh& mesh,
                  const core::SchemeOptions& options, int levels);

}  // namespace loopcheck::compare
