// OpenSubdiv's Bfr to be timed: every patch is prepared, then evaluated again and again.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// A point of the limit surface and its first derivatives by the (u, v) of the face.
struct SurfaceSample {
    glm::dvec3 position, du, dv;
};

/// The Bfr::Surface of every face of a mesh in double, with its patch points.
class OpensubdivPreparedSurface {
  public:
    /// Bfr's own levels of approximation.
    ///
    /// Takes    meshes without sharpness and holes, and boundary options that leave every face its surface.
    /// Errors   Unsupported (all else) and SubjectFailed, as `opensubdiv_surface`.
    static core::Result<OpensubdivPreparedSurface> make(const core::TriangleMesh& mesh,
                                                        const core::SchemeOptions& options);
    OpensubdivPreparedSurface(OpensubdivPreparedSurface&&) noexcept;
    OpensubdivPreparedSurface& operator=(OpensubdivPreparedSurface&&) noexcept;
    ~OpensubdivPreparedSurface();

    /// Whether the surface of the face is a single box spline, and so exact but for rounding.
    bool is_regular(core::Index face) const;

    /// Evaluate() at every (u, v) of a face.  Requires as many samples.
    void evaluate(core::Index face, std::span<const glm::dvec2> parameters,
                  std::span<SurfaceSample> samples) const;

  private:
    struct State;
    explicit OpensubdivPreparedSurface(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

}  // namespace loopcheck::reference
