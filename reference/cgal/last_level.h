// CGAL's Loop subdivision to be timed: nothing but the refinement.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/error.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference {

/// Version of the CGAL headers this was compiled with, "5.5.1".
std::string cgal_version();

/// A mesh that CGAL has taken over, as a Surface_mesh of points with Cartesian coordinates.  What CGAL throws
/// is thrown.
template <class Real>
class CgalLastLevel {
  public:
    /// Takes    closed meshes without sharpness and without isolated vertices.
    /// Errors   Unsupported (all else), SubjectFailed (a face that CGAL did not accept).
    static core::Result<CgalLastLevel> make(const core::TriangleMesh& mesh);
    CgalLastLevel(CgalLastLevel&&) noexcept;
    CgalLastLevel& operator=(CgalLastLevel&&) noexcept;
    ~CgalLastLevel();

    /// Back to the control mesh.
    void clear();

    /// Subdivision_method_3::Loop_subdivision, in place.
    void refine(int levels);

    /// In CGAL's order.
    std::vector<glm::dvec3> positions() const;

  private:
    struct State;
    explicit CgalLastLevel(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

extern template class CgalLastLevel<float>;
extern template class CgalLastLevel<double>;

}  // namespace loopcheck::reference
