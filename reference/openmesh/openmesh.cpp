#include "reference/openmesh/openmesh.h"

#include <fmt/format.h>

#include <vector>

#include "reference/openmesh/control.h"

namespace loopcheck::reference {
namespace {

using core::Index;

template <class Real>
using Mesh = internal::OpenmeshMesh<Real>;

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
    auto made = internal::openmesh_control<Real>(control);
    if (!made) return tl::unexpected(made.error());
    Mesh<Real>& mesh = *made;
    internal::OpenmeshLoop<Real> loop;
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

}  // namespace

std::string openmesh_version() {
    return fmt::format("{}.{}", OM_GET_VER, OM_GET_MAJ);
}

core::Result<core::Refinement> openmesh_refine(const core::TriangleMesh& mesh,
                                               const core::SchemeOptions& options, int levels,
                                               core::Precision precision) {
    if (auto error = internal::check_openmesh(mesh, options, precision)) return tl::unexpected(*error);
    return internal::openmesh_contained([&] {
        auto out =
            precision == core::Precision::Float ? refine<float>(mesh, levels) : refine<double>(mesh, levels);
        if (out) out->precision = precision;
        return out;
    });
}

}  // namespace loopcheck::reference
