#include "core/loop/lattice/refined_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_numbers.h"
#include "core/loop/lattice/split_order.h"

namespace loopcheck::core {
namespace {

using Kind = LatticeAddress::Kind;

class RefinedMesh {
  public:
    RefinedMesh(const TriangleMesh& mesh, const SchemeOptions& options, const LatticeRefiner& refiner,
                LevelOrder order)
        : mesh_(mesh),
          t_(mesh.topology()),
          options_(options),
          refiner_(refiner),
          order_(order),
          n_(refiner.order().segments()),
          split_(t_, refiner.order().level()) {}

    template <class Real>
    MeshData run() {
        const auto control = convert_points<Real>(mesh_.positions());
        out_.positions = convert_points<double>(control);  // isolated vertices stay
        out_.positions.resize(static_cast<std::size_t>(refiner_.order().vertex_count()));
        const auto faces = static_cast<std::size_t>(refiner_.order().face_count());
        out_.face_sizes.assign(faces, 3);
        out_.face_corners.resize(3 * faces);
        const auto child = child_faces();
        const NumberPattern pattern(refiner_.order().level());
        const SplitNumbers split_numbers(pattern, t_);
        std::vector<Index> numbers(static_cast<std::size_t>(lattice_place(n_, 0, n_)) + 1);
        refiner_.template refine_by_face<Real>(control, [&](Index f, std::span<const Point<Real>> points) {
            if (order_ == LevelOrder::Split)
                split_numbers.of_face(f, numbers);
            else
                number_by_address(f, numbers);
            for (std::size_t k = 0; k < points.size(); ++k)
                out_.positions[numbers[k]] = glm::dvec3(points[k]);
            add_faces(f, child, numbers);
        });
        const SharpnessLevels levels(mesh_, options_, refiner_.order().level());
        const LatticeSharpness& sharpness = levels[refiner_.order().level()];
        add_creases(sharpness);
        add_corners(sharpness);
        for (Index f = 0; f < t_.face_count(); ++f)
            for (std::size_t k = 0; mesh_.holes()[f] && k < child.size(); ++k)
                out_.holes.push_back(static_cast<Index>(f * child.size() + k));
        return std::move(out_);
    }

  private:
    void number_by_address(Index f, std::span<Index> numbers) const {
        auto next = numbers.begin();
        for (Index j = 0; j <= n_; ++j)
            for (Index i = 0; i + j <= n_; ++i)
                *next++ = static_cast<Index>(refiner_.order().vertex_at(t_, f, i, j));
    }

    // The number of every lattice triangle among those of its face.
    std::vector<Index> child_faces() const {
        std::vector<Index> out;
        const std::int64_t count = std::int64_t{n_} * n_;
        out.reserve(static_cast<std::size_t>(count));
        for (std::int64_t t = 0; t < count; ++t)
            out.push_back(
                static_cast<Index>(order_ == LevelOrder::Split ? split_.face(0, triangle_at(n_, t)) : t));
        return out;
    }

    void add_faces(Index f, const std::vector<Index>& child, std::span<const Index> numbers) {
        Index* faces = out_.face_corners.data() + 3 * child.size() * static_cast<std::size_t>(f);
        auto next = child.begin();
        const auto add = [&](Index a, Index b, Index c) {
            Index* face = faces + 3 * static_cast<std::size_t>(*next++);
            face[0] = a;
            face[1] = b;
            face[2] = c;
        };
        for (Index j = 0; j < n_; ++j) {
            const Index* row = numbers.data() + lattice_place(n_, 0, j);
            const Index* above = numbers.data() + lattice_place(n_, 0, j + 1);
            for (Index i = 0; i + j < n_; ++i) {
                add(row[i], row[i + 1], above[i]);
                if (i + j + 1 < n_) add(above[i + 1], above[i], row[i + 1]);
            }
        }
    }

    // Point k of edge e, ends included.
    Index on_edge(Index e, Index k) const {
        if (k == 0 || k == n_) return t_.edge_ends[e][k == 0 ? 0 : 1];
        const LatticeAddress address{Kind::Edge, e, k, 0};
        return static_cast<Index>(order_ == LevelOrder::Split ? split_.vertex(address)
                                                              : refiner_.order().index_of(address));
    }

    void add_creases(const LatticeSharpness& sharpness) {
        std::vector<std::pair<std::int64_t, EdgeSharpness>> creases;
        for (Index e = 0; e < t_.edge_count(); ++e) {
            if (t_.is_boundary_edge(e) || (sharpness.is_even(e) && !is_sharp(sharpness.at_end(e, 0))))
                continue;
            for (Index q = 0; q < n_; ++q) {
                const float s = sharpness.of_segment(e, q);
                const Index last_born = q % 2 == 1 || n_ == 1 ? q : q + 1;
                if (is_sharp(s))
                    creases.push_back(
                        {split_.edge(e, q), {on_edge(e, last_born), on_edge(e, 2 * q + 1 - last_born), s}});
            }
        }
        if (order_ == LevelOrder::Split)
            std::sort(creases.begin(), creases.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [number, crease] : creases) out_.creases.push_back(crease);
    }

    void add_corners(const LatticeSharpness& sharpness) {
        for (Index v = 0; v < t_.vertex_count; ++v) {
            const bool is_inferred = options_.boundary == BoundaryRule::EdgeAndCorner &&
                                     t_.is_boundary_vertex(v) && t_.face_count_at(v) == 1;
            if (!t_.is_isolated(v) && !is_inferred && is_sharp(sharpness.of_vertex(v)))
                out_.corners.push_back({v, sharpness.of_vertex(v)});
        }
    }

    const TriangleMesh& mesh_;
    const Topology& t_;
    SchemeOptions options_;
    const LatticeRefiner& refiner_;
    LevelOrder order_;
    Index n_;
    SplitOrder split_;
    MeshData out_;
};

}  // namespace

Result<MeshData> refined_mesh(const TriangleMesh& mesh, const SchemeOptions& options, Precision precision,
                              int level, LevelOrder order) {
    if (auto error = check_fits(mesh, precision)) return tl::unexpected(std::move(*error));
    const auto refiner = LatticeRefiner::make(mesh, options, level);
    if (!refiner) return tl::unexpected(refiner.error());
    if (!refiner->order().fits_index())
        return fail(ErrorCode::TooLarge,
                    fmt::format("Level {} has more vertices or corners of faces than 2^31 - 1.", level));
    RefinedMesh refined(mesh, options, *refiner, order);
    return precision == Precision::Float ? refined.run<float>() : refined.run<double>();
}

}  // namespace loopcheck::core
