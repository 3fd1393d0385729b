// What the ways to refine with OpenMesh share.  Internal to reference/openmesh: only its sources include it.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <exception>
#include <optional>
#include <string_view>
#include <type_traits>

#include "core/mesh/error.h"
#include "core/mesh/options.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::reference::internal {

// LoopT sums points through the type of the normals: left at its default, float, it makes a double mesh right
// to 7 digits only.
template <class Real>
struct OpenmeshTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Real, 3>;
    using Normal = OpenMesh::VectorT<Real, 3>;
};
template <class Real>
using OpenmeshMesh = OpenMesh::TriMesh_ArrayKernelT<OpenmeshTraits<Real>>;
template <class Real>
using OpenmeshLoop = OpenMesh::Subdivider::Uniform::LoopT<OpenmeshMesh<Real>, Real>;

/// Unsupported or NotFinite where LoopT has no way to refine the mesh so; else nothing.
std::optional<core::Error> check_openmesh(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                          core::Precision precision);

/// Keeps OpenMesh from printing.
void silence_openmesh();

/// SubjectFailed with this reason.
tl::unexpected<core::Error> openmesh_failed(std::string_view why);

/// Runs work(), which returns a Result; an exception becomes SubjectFailed.
template <class Work>
std::invoke_result_t<Work> openmesh_contained(Work work) {
    silence_openmesh();
    try {
        return work();
    } catch (const std::exception& e) {
        return openmesh_failed(e.what());
    }
}

/// The mesh as one of OpenMesh's.
///
/// Errors   SubjectFailed, with the face that it did not accept.
template <class Real>
core::Result<OpenmeshMesh<Real>> openmesh_control(const core::TriangleMesh& control) {
    OpenmeshMesh<Real> mesh;
    std::vector<OpenMesh::VertexHandle> vertices;
    for (const auto& p : control.positions())
        vertices.push_back(
            mesh.add_vertex({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}));
    for (const auto& [a, b, c] : control.topology().triangles)
        if (!mesh.add_face(vertices[a], vertices[b], vertices[c]).is_valid())
            return core::fail(core::ErrorCode::SubjectFailed, "OpenMesh did not accept the face.",
                              {core::Place::Kind::Face, static_cast<std::int64_t>(mesh.n_faces())});
    return mesh;
}

}  // namespace loopcheck::reference::internal
