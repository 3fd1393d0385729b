// OpenMesh's LoopT to be timed: nothing but the refinement.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// A mesh that OpenMesh has taken over.  What OpenMesh throws is thrown.
template <class Real>
class OpenmeshLastLevel {
  public:
    /// Errors   those of `openmesh_refine`.
    static core::Result<OpenmeshLastLevel> make(const core::TriangleMesh& mesh,
                                                const core::SchemeOptions& options);
    OpenmeshLastLevel(OpenmeshLastLevel&&) noexcept;
    OpenmeshLastLevel& operator=(OpenmeshLastLevel&&) noexcept;
    ~OpenmeshLastLevel();

    /// Back to the control mesh.
    void clear();

    /// Refines in place.
    void refine(int levels);

    /// In OpenMesh's order.
    std::vector<glm::dvec3> positions() const;

  private:
    struct State;
    explicit OpenmeshLastLevel(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

extern template class OpenmeshLastLevel<float>;
extern template class OpenmeshLastLevel<double>;

}  // namespace loopcheck::reference
