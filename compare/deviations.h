// What is known to be wrong, or different, in a subject.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/loop/limit.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// A vertex whose limit is asked for, as far as its masks depend on it.
struct LimitVertex {
    enum class Sharpness : std::uint8_t {
        Settled,  ///< no finite sharpness is left at it
        Finite,
    };
    core::Star star;  ///< of the rule that it refines by, a finite sharpness counted as infinite
    Sharpness sharpness = Sharpness::Settled;

    auto operator<=>(const LimitVertex&) const = default;
};
LimitVertex limit_vertex(const core::SchemeLevel& level, core::Index v);

/// A difference that is on the list: it is expected where the rules as the subject really follows them say
/// so, by the amount they say; absent, larger or elsewhere, it is not.
struct KnownDeviation {
    enum class Kind : std::uint8_t {
        Error,          ///< against the subject's own rules
        Approximation,  ///< meant to be near, not right
        Documented,     ///< the subject says so itself
    };

    std::string_view name;
    std::string_view family;  ///< of the subject, see Subject::family
    Kind kind;
    std::string_view what;      ///< one sentence
    std::string_view versions;  ///< of the subject in which it was seen

    // At most one of the two is set.  Those at surfaces are predicted by compare/surface, the others are
    // shown by `demonstrate`.

    /// In refinement: the rules the subject really follows when asked for `options`.
    core::SchemeOptions (*as_done)(core::SchemeOptions options) = nullptr;
    /// At limits: the vertices whose masks are not those of the limit, and the masks the subject has there.
    bool (*applies)(const LimitVertex& vertex) = nullptr;
    core::LimitMasks<core::HighPrecision> (*limit_as_done)(const core::Star& star) = nullptr;
};

/// Its page: docs/deviations/NAME.md.
std::string page_of(const KnownDeviation& deviation);

/// "error", "approximation", "documented".
std::string_view name(KnownDeviation::Kind kind);

/// The list.
std::span<const KnownDeviation> known_deviations();

/// The deviation of that name, or null.
const KnownDeviation* find_deviation(std::span<const KnownDeviation> list, std::string_view name);

/// True where a deviation in refinement changes a mask on the way to level `levels`, so that it must show.
/// False for those at limits.  Cost: that of refining the mesh until its sharpness has decayed.
bool is_predicted(const KnownDeviation& deviation, const core::TriangleMesh& mesh,
                  const core::SchemeOptions& options, int levels);

/// The masks of a subject that deviate at the vertices of one level.  The first of the list that applies to a
/// vertex is its deviation.  What was made is kept.
class DeviatingMasks {
  public:
    struct Found {
        const KnownDeviation* deviation = nullptr;  ///< null where none applies
        core::LimitMasks<core::HighPrecision> masks;
    };

    DeviatingMasks(std::span<const KnownDeviation> list, std::string_view family)
        : list_(list), family_(family) {}

    /// Valid as long as this.
    const Found& at(const LimitVertex& vertex);

  private:
    std::span<const KnownDeviation> list_;
    std::string_view family_;
    std::map<LimitVertex, Found> found_;
};

}  // namespace loopcheck::compare
