#include "reference/openmesh/openmesh.h"

#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

namespace loopcheck::reference {
namespace {

using core::Index;

// LoopT sums points through the type of the normals: left at its default, float, it makes a double mesh right
// to 7 digits only.
template <class Real>
struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::VectorT<Real, 3>;
    using Normal = OpenMesh::VectorT<Real, 3>;
};
template <class Real>
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits<Real>>;

std::optional<std::string> why_unsupported(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                           core::Precision precision) {
    const auto is_sharp = [](float s) { return s > 0; };
    const double largest = precision == core::Precision::Float ? double{std::numeric_limits<float>::max()}
                                                               : std::numeric_limits<double>::max();
    if (mesh.largest_coordinate() > largest / kOpenmeshHeadroom)
        return fmt::format(
            "OpenMesh's LoopT sums before it weighs, and overflows for a coordinate of {:.3g}.",
            mesh.largest_coordinate());
    if (options.weights != core::Weights::Loop) return "OpenMesh's LoopT has Loop's weights only.";
    if (std::any_of(mesh.edge_sharpness().begin(), mesh.edge_sharpness().end(), is_sharp) ||
        std::any_of(mesh.vertex_sharpness().begin(), mesh.vertex_sharpness().end(), is_sharp))
        return "OpenMesh's LoopT has no creases and no corners.";
    const core::Topology& t = mesh.topology();
    for (Index v = 0; v < t.vertex_count; ++v) {
        if (t.is_isolated(v))
            return fmt::format(
                "OpenMesh's LoopT loses the position of an isolated vertex, such as vertex {}.", v);
        if (!t.is_boundary_vertex(v) && t.face_count_at(v) > kOpenmeshMaxValence)
            return fmt::format("OpenMesh's LoopT reads past its weight table at valence {} (vertex {}).",
                               t.face_count_at(v), v);
        if (options.boundary == core::BoundaryRule::EdgeAndCorner && t.is_boundary_vertex(v) &&
            t.face_count_at(v) == 1)
            return fmt::format(
                "OpenMesh's LoopT has the boundary rule edge-only; edge-and-corner keeps vertex {}, which "
                "has one face.",
                v);
    }
    return std::nullopt;
}

// Where each side of each face is: OpenMesh names halfedges, we number sides 3 f + i.
template <class Real>
struct Sides {
    std::vector<core::Triangle> triangles;
    std::vector<Index> side_of_halfedge;

    explicit Sides(const Mesh<Real>& mesh) : side_of_halfedge(mesh.n_halfedges(), core::kNone) {
        triangles.reserve(mesh.n_faces());
        for (const auto f : mesh.faces()) {
            auto halfedge = mesh.halfedge_handle(f);
            core::Triangle triangle{};
            for (int i = 0; i < 3; ++i) {
                triangle[i] = mesh.from_vertex_handle(halfedge).idx();
                side_of_halfedge[halfedge.idx()] = 3 * f.idx() + i;
                halfedge = mesh.next_halfedge_handle(halfedge);
            }
            triangles.push_back(triangle);
        }
    }
};

// LoopT keeps the vertices and appends one a edge, in the order of the edges.
template <class Real>
std::vector<core::Ancestor> child_ancestors(const Mesh<Real>& parent, const Sides<Real>& sides) {
    std::vector<core::Ancestor> out;
    out.reserve(parent.n_vertices() + parent.n_edges());
    for (const auto v : parent.vertices()) out.push_back({core::Ancestor::Kind::Vertex, v.idx()});
    for (const auto e : parent.edges()) {
        const Index first = sides.side_of_halfedge[parent.halfedge_handle(e, 0).idx()];
        const Index second = sides.side_of_halfedge[parent.halfedge_handle(e, 1).idx()];
        out.push_back({core::Ancestor::Kind::Edge, first == core::kNone ? second : first});
    }
    return out;
}

template <class Real>
core::RefinedLevel take_level(const Mesh<Real>& mesh, std::vector<core::Ancestor> ancestors) {
    core::RefinedLevel out;
    out.ancestors = std::move(ancestors);
    out.positions.reserve(mesh.n_vertices());
    for (const auto v : mesh.vertices()) {
        const auto& p = mesh.point(v);
        out.positions.emplace_back(p[0], p[1], p[2]);
    }
    return out;
}

template <class Real>
core::Result<core::Refinement> refine(const core::TriangleMesh& control, int levels) {
    Mesh<Real> mesh;
    std::vector<OpenMesh::VertexHandle> vertices;
    for (const auto& p : control.positions())
        vertices.push_back(
            mesh.add_vertex({static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}));
    for (const auto& [a, b, c] : control.topology().triangles)
        if (!mesh.add_face(vertices[a], vertices[b], vertices[c]).is_valid())
            return core::fail(core::ErrorCode::SubjectFailed, "OpenMesh did not accept the face.",
                              {core::Place::Kind::Face, static_cast<std::int64_t>(mesh.n_faces())});

    OpenMesh::Subdivider::Uniform::LoopT<Mesh<Real>, Real> loop;
    loop.attach(mesh);
    core::Refinement out;
    std::vector<core::Ancestor> ancestors;
    for (int l = 0; l <= levels; ++l) {
        const Sides<Real> sides(mesh);
        out.levels.push_back(take_level<Real>(mesh, std::move(ancestors)));
        out.levels.back().triangles = sides.triangles;
        if (l == levels) break;
        ancestors = child_ancestors<Real>(mesh, sides);
        loop(1);
    }
    loop.detach();
    return out;
}

// OpenMesh's error stream is global to the process, and its first use, which sets it up, is not safe in two
// threads at once.
void silence() {
    static std::once_flag once;
    std::call_once(once, [] { omerr().disable(); });
}

}  // namespace

std::string openmesh_version() {
    return fmt::format("{}.{}", OM_GET_VER, OM_GET_MAJ);
}

core::Result<core::Refinement> openmesh_refine(const core::TriangleMesh& mesh,
                                               const core::SchemeOptions& options, int levels,
                                               core::Precision precision) {
    if (auto why = why_unsupported(mesh, options, precision))
        return core::fail(core::ErrorCode::Unsupported, *why);
    if (auto error = core::check_fits(mesh, precision)) return tl::unexpected(*error);
    silence();
    try {
        auto out =
            precision == core::Precision::Float ? refine<float>(mesh, levels) : refine<double>(mesh, levels);
        if (out) out->precision = precision;
        return out;
    } catch (const std::exception& e) {
        return core::fail(core::ErrorCode::SubjectFailed, fmt::format("OpenMesh failed: {}", e.what()));
    }
}

}  // namespace loopcheck::reference
