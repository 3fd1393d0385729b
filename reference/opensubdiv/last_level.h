// OpenSubdiv's refinement at its cheapest: nothing is kept but values, in buffers used again.
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

/// How much OpenSubdiv makes of the topology of the last level: the faces only, or all, which a limit needs.
enum class LastTopology : std::uint8_t { Least, Full };

/// A mesh that OpenSubdiv has taken over, to be refined by Far in float or double.  What OpenSubdiv throws is
/// thrown, but by `make` and `refine`.
template <class Real>
class OpensubdivLastLevel {
  public:
    /// Errors   Unsupported and SubjectFailed, as `opensubdiv_refine`.
    static core::Result<OpensubdivLastLevel> make(const core::TriangleMesh& mesh,
                                                  const core::SchemeOptions& options);
    OpensubdivLastLevel(OpensubdivLastLevel&&) noexcept;
    OpensubdivLastLevel& operator=(OpensubdivLastLevel&&) noexcept;
    ~OpensubdivLastLevel();

    /// To a level with the least topology in it, and its positions.
    /// Errors   SubjectFailed; whatever OpenSubdiv says is one.
    std::optional<core::Error> refine(int level);

    /// Forgets what was refined; buffers are kept.
    void clear();

    /// RefineUniform.
    void refine_topology(int level, LastTopology last);

    /// Interpolate of every level.
    void interpolate();

    /// Limit of the last level, with the normals that its tangents make.  Requires its full topology.
    void limit();

    /// Of the last level, in OpenSubdiv's order.
    std::vector<glm::dvec3> positions() const;
    std::span<const internal::Value<Real>> values() const;  ///< the positions where they lie
    std::vector<core::Triangle> faces() const;
    std::vector<glm::dvec3> limit_positions() const;
    std::vector<glm::dvec3> limit_normals() const;

  private:
    struct State;
    explicit OpensubdivLastLevel(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

extern template class OpensubdivLastLevel<float>;
extern template class OpensubdivLastLevel<double>;

}  // namespace loopcheck::reference
