#include "compare/deep/neighbourhood.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/loop/sharpness.h"

namespace loopcheck::compare {
namespace {

using core::Index;

// Calls visit(v) for a vertex v of the block, and under Chaikin's rule for those at the other end of its
// semi-sharp edges.
template <class Visit>
void for_each_kept(const core::TriangleMesh& mesh, core::Creasing creasing, Index v, Visit visit) {
    visit(v);
    if (creasing == core::Creasing::Uniform) return;
    for (const Index e : mesh.topology().ring(v))
        if (core::is_semi_sharp(mesh.edge_sharpness()[e])) visit(mesh.topology().other_end(e, v));
}

// The face to the left of edge e as it leads out of v, or kNone: the first face runs along e.
Index face_left_of(const core::Topology& t, Index e, Index v) {
    return t.edge_faces[e][t.edge_ends[e][0] == v ? 0 : 1];
}

void sort_uniquely(std::vector<Index>& of) {
    std::sort(of.begin(), of.end());
    of.erase(std::unique(of.begin(), of.end()), of.end());
}

// Makes the mesh of these faces, which are ascending and among which the block begins at `first`.
class Extraction {
  public:
    Extraction(const core::TriangleMesh& mesh, const std::vector<Index>& faces, FaceBlock block, Index first)
        : mesh_(mesh),
          t_(mesh.topology()),
          faces_(faces),
          block_(block),
          first_(first),
          triangles_(faces.size()) {}

    core::TriangleMesh run() {
        std::vector<Index> vertices;
        vertices.reserve(3 * faces_.size());
        for (const Index f : faces_)
            vertices.insert(vertices.end(), t_.triangles[f].begin(), t_.triangles[f].end());
        sort_uniquely(vertices);
        for (const Index v : vertices) add_vertex(v);
        for (std::size_t k = 0; k < faces_.size(); ++k) add_face(k);
        return core::TriangleMesh::make(std::move(data_)).value();
    }

  private:
    static constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);

    std::size_t place_of(Index f) const {
        if (block_.has(f)) return static_cast<std::size_t>(first_ + f - block_.first);
        const auto at = std::lower_bound(faces_.begin(), faces_.end(), f);
        return at != faces_.end() && *at == f ? static_cast<std::size_t>(at - faces_.begin()) : kAbsent;
    }

    // A copy of v for every fan of faces around it.
    void add_vertex(Index v) {
        const auto ring = t_.ring(v);
        const auto place = [&](std::size_t k) {
            const Index f = face_left_of(t_, ring[k], v);
            return f == core::kNone ? kAbsent : place_of(f);
        };
        // Around an inner vertex begin after a gap, where there is one.
        std::size_t begin = 0;
        if (!t_.is_boundary_vertex(v))
            for (std::size_t k = 0; k < ring.size(); ++k)
                if (place(k) == kAbsent) begin = k;
        bool in_fan = false;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const std::size_t face = place((begin + k) % ring.size());
            if (face == kAbsent) {
                in_fan = false;
                continue;
            }
            if (!in_fan) add_copy(v);
            in_fan = true;
            const auto& corners = t_.triangles[faces_[face]];
            const auto corner = std::find(corners.begin(), corners.end(), v) - corners.begin();
            triangles_[face][static_cast<std::size_t>(corner)] =
                static_cast<Index>(data_.positions.size() - 1);
        }
    }

    void add_copy(Index v) {
        if (core::is_sharp(mesh_.vertex_sharpness()[v]))
            data_.corners.push_back(
                {static_cast<Index>(data_.positions.size()), mesh_.vertex_sharpness()[v]});
        data_.positions.push_back(mesh_.positions()[v]);
    }

    void add_face(std::size_t k) {
        const Index f = faces_[k];
        data_.add_face(triangles_[k]);
        if (mesh_.holes()[f]) data_.holes.push_back(static_cast<Index>(k));
        for (int i = 0; i < 3; ++i) {
            const float sharpness = mesh_.edge_sharpness()[t_.face_edges[f][i]];
            if (core::is_sharp(sharpness))
                data_.creases.push_back({triangles_[k][i], triangles_[k][core::next_corner(i)], sharpness});
        }
    }

    const core::TriangleMesh& mesh_;
    const core::Topology& t_;
    const std::vector<Index>& faces_;
    FaceBlock block_;
    Index first_;
    std::vector<core::Triangle> triangles_;
    core::MeshData data_;
};

}  // namespace

Neighbourhood neighbourhood_of(const core::TriangleMesh& mesh, core::Creasing creasing, FaceBlock block) {
    std::vector<Index> own, kept;
    for (Index f = block.first; f < block.last; ++f)
        for (const Index v : mesh.topology().triangles[f]) own.push_back(v);
    sort_uniquely(own);
    for (const Index v : own) for_each_kept(mesh, creasing, v, [&](Index other) { kept.push_back(other); });
    sort_uniquely(kept);
    std::vector<Index> faces;
    for (const Index v : kept)
        for (const Index e : mesh.topology().ring(v)) {
            const Index f = face_left_of(mesh.topology(), e, v);
            if (f != core::kNone && !block.has(f)) faces.push_back(f);
        }
    sort_uniquely(faces);
    auto at = std::lower_bound(faces.begin(), faces.end(), block.first);
    const auto first = static_cast<Index>(at - faces.begin());
    at = faces.insert(at, static_cast<std::size_t>(block.size()), 0);
    std::iota(at, at + block.size(), block.first);
    return {Extraction(mesh, faces, block, first).run(), first};
}

GrowingBlock::GrowingBlock(const core::TriangleMesh& mesh, core::Creasing creasing)
    : mesh_(mesh),
      creasing_(creasing),
      own_(static_cast<std::size_t>(mesh.vertex_count()), 0),
      kept_(own_),
      edge_(static_cast<std::size_t>(mesh.topology().edge_count()), 0),
      face_(static_cast<std::size_t>(mesh.face_count()), 0) {
    restart();
}

void GrowingBlock::restart() {
    ++block_;
    size_ = 0;
    faces_ = edges_ = 0;
}

void GrowingBlock::add(Index f) {
    const core::Topology& t = mesh_.topology();
    const auto is_new = [&](Index& counted_by) { return std::exchange(counted_by, block_) != block_; };
    ++size_;
    const auto keep = [&](Index v) {
        if (!is_new(kept_[v])) return;
        for (const Index out : t.ring(v)) {
            const Index g = face_left_of(t, out, v);
            if (g == core::kNone || !is_new(face_[g])) continue;
            ++faces_;
            for (const Index e : t.face_edges[g]) edges_ += is_new(edge_[e]) ? 1 : 0;
        }
    };
    for (const Index v : t.triangles[f])
        if (is_new(own_[v])) for_each_kept(mesh_, creasing_, v, keep);
}

}  // namespace loopcheck::compare
