// OpenSubdiv's stencil table of one level, to be timed.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// The vertices of one level as rows over the control vertices: Far::StencilTableReal, made once.
template <class Real>
class OpensubdivStencilTable {
  public:
    /// Errors   Unsupported and SubjectFailed, as `opensubdiv_refine`.
    static core::Result<OpensubdivStencilTable> make(const core::TriangleMesh& mesh,
                                                     const core::SchemeOptions& options, int level);
    OpensubdivStencilTable(OpensubdivStencilTable&&) noexcept;
    OpensubdivStencilTable& operator=(OpensubdivStencilTable&&) noexcept;
    ~OpensubdivStencilTable();

    /// UpdateValues into a buffer that is used again.
    void update();

    /// What it wrote, in OpenSubdiv's order.
    std::vector<glm::dvec3> positions() const;

  private:
    struct State;
    explicit OpensubdivStencilTable(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

extern template class OpensubdivStencilTable<float>;
extern template class OpensubdivStencilTable<double>;

}  // namespace loopcheck::reference
