// OpenSubdiv's refinement at its cheapest: nothing is kept but positions, in buffers used again.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"
#include "reference/opensubdiv/value.h"

namespace loopcheck::reference {

/// A mesh that OpenSubdiv has taken over.
class OpensubdivLastLevel {
  public:
    /// Errors   Unsupported and SubjectFailed, as `opensubdiv_refine`.
    static core::Result<OpensubdivLastLevel> make(const core::TriangleMesh& mesh,
                                                  const core::SchemeOptions& options,
                                                  core::Precision precision = core::Precision::Double);
    OpensubdivLastLevel(OpensubdivLastLevel&&) noexcept;
    OpensubdivLastLevel& operator=(OpensubdivLastLevel&&) noexcept;
    ~OpensubdivLastLevel();

    /// RefineUniform with the least topology in the last level, and Interpolate of every level.
    /// Errors   SubjectFailed; whatever OpenSubdiv says is one.
    std::optional<core::Error> refine(int level);

    /// Of the last level that was refined to, in OpenSubdiv's order.
    std::vector<glm::dvec3> positions() const;

    /// The same where they lie.  Requires the precision of Real.
    template <class Real>
    std::span<const internal::Value<Real>> values() const;

  private:
    struct State;
    explicit OpensubdivLastLevel(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace loopcheck::reference
