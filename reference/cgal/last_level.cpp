#include "reference/cgal/last_level.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/version.h>

#include <algorithm>

namespace loopcheck::reference {

std::string cgal_version() {
    return CGAL_STR(CGAL_VERSION);
}

template <class Real>
struct CgalLastLevel<Real>::State {
    using Mesh = CGAL::Surface_mesh<typename CGAL::Simple_cartesian<Real>::Point_3>;
    Mesh control, mesh;
};

template <class Real>
CgalLastLevel<Real>::CgalLastLevel(std::unique_ptr<State> state) : state_(std::move(state)) {}
template <class Real>
CgalLastLevel<Real>::CgalLastLevel(CgalLastLevel&&) noexcept = default;
template <class Real>
CgalLastLevel<Real>& CgalLastLevel<Real>::operator=(CgalLastLevel&&) noexcept = default;
template <class Real>
CgalLastLevel<Real>::~CgalLastLevel() = default;

template <class Real>
core::Result<CgalLastLevel<Real>> CgalLastLevel<Real>::make(const core::TriangleMesh& mesh) {
    const auto is_sharp = [](float s) { return s > 0; };
    const core::Topology& t = mesh.topology();
    bool closed = true;
    for (core::Index e = 0; e < t.edge_count(); ++e) closed = closed && !t.is_boundary_edge(e);
    for (core::Index v = 0; v < t.vertex_count; ++v) closed = closed && !t.is_isolated(v);
    if (!closed || std::any_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_sharp) ||
        std::any_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_sharp))
        return core::fail(core::ErrorCode::Unsupported,
                          "CGAL is given closed meshes only, without sharpness and isolated vertices.");
    auto state = std::make_unique<State>();
    for (const auto& p : mesh.positions())
        state->control.add_vertex({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)});
    using Vertex = typename State::Mesh::Vertex_index;
    const auto vertex = [](core::Index v) { return Vertex(static_cast<typename Vertex::size_type>(v)); };
    for (core::Index f = 0; f < t.face_count(); ++f) {
        const auto& [a, b, c] = t.triangles[f];
        if (state->control.add_face(vertex(a), vertex(b), vertex(c)) == State::Mesh::null_face())
            return core::fail(core::ErrorCode::SubjectFailed, "CGAL did not accept the face.",
                              {core::Place::Kind::Face, f});
    }
    state->mesh = state->control;
    return CgalLastLevel(std::move(state));
}

template <class Real>
void CgalLastLevel<Real>::clear() {
    state_->mesh = state_->control;
}

template <class Real>
void CgalLastLevel<Real>::refine(int levels) {
    CGAL::Subdivision_method_3::Loop_subdivision(
        state_->mesh, CGAL::parameters::number_of_iterations(static_cast<unsigned>(levels)));
}

template <class Real>
std::vector<glm::dvec3> CgalLastLevel<Real>::positions() const {
    std::vector<glm::dvec3> out;
    out.reserve(state_->mesh.number_of_vertices());
    for (const auto v : state_->mesh.vertices()) {
        const auto& p = state_->mesh.point(v);
        out.emplace_back(p.x(), p.y(), p.z());
    }
    return out;
}

template class CgalLastLevel<float>;
template class CgalLastLevel<double>;

}  // namespace loopcheck::reference
