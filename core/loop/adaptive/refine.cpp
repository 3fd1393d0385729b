#include "core/loop/adaptive/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

namespace loopcheck::core {
namespace {

using Flags = std::vector<std::uint8_t>;

// 1 where a face around the vertex is not subdividable.
Flags frozen_vertices(const Topology& t, const Flags& is_subdividable) {
    Flags out(t.vertex_count, 0);
    for (Index f = 0; f < t.face_count(); ++f)
        if (!is_subdividable[f])
            for (const Index v : t.triangles[f]) out[v] = 1;
    return out;
}

// Of the rows of uniform refinement those that are wanted; a vertex that stays is its own row.
Rows select_rows(Rows all, const Topology& t, const Flags& is_frozen, const std::vector<Index>& split_edges) {
    Rows out;
    out.masks = std::move(all.masks);
    const auto kept = static_cast<Index>(out.masks.size());
    out.masks.push_back({.parent = VertexRule::Corner, .child = VertexRule::Corner});
    out.offsets.push_back(0);
    const auto add = [&](std::span<const Index> columns, Index mask) {
        out.columns.insert(out.columns.end(), columns.begin(), columns.end());
        out.offsets.push_back(out.columns.size());
        out.mask_of_row.push_back(mask);
    };
    for (Index v = 0; v < t.vertex_count; ++v)
        is_frozen[v] ? add({&v, 1}, kept) : add(all.columns_of(v), all.mask_of_row[v]);
    for (const Index e : split_edges) {
        const std::size_t row = static_cast<std::size_t>(t.vertex_count) + e;
        add(all.columns_of(row), all.mask_of_row[row]);
    }
    return out;
}

Sharpness child_sharpness(const Sharpness& s, const std::vector<std::array<float, 2>>& halves,
                          const Flags& is_frozen, const PartialSplit& split) {
    Sharpness child;
    for (const EdgeOrigin& origin : split.edges) {
        const bool is_half = origin.kind == EdgeOrigin::Kind::Half;
        child.edge.push_back(is_half                                 ? halves[origin.parent][origin.part]
                             : origin.kind == EdgeOrigin::Kind::Kept ? s.edge[origin.parent]
                                                                     : 0);
    }
    for (std::size_t v = 0; v < s.vertex.size(); ++v)
        child.vertex.push_back(is_frozen[v] ? s.vertex[v] : uniform_decay(s.vertex[v]));
    child.vertex.resize(split.topology.vertex_count, 0);
    return child;
}

std::vector<VertexClass> child_classes(const SchemeLevel& parent, const PartialSplit& split,
                                       const Sharpness& sharpness) {
    const auto all = comes_from_finite_sharpness(parent);
    Flags from_finite(all.begin(), all.begin() + parent.topology.vertex_count);
    for (const Index e : split.split_edges) from_finite.push_back(all[parent.topology.vertex_count + e]);
    return classify(split.topology, sharpness, from_finite);
}

// Follows what uniform refinement does to the same things.
class UniformStep {
  public:
    UniformStep(const AdaptiveLevel& level, const Flags& is_frozen, const PartialSplit& split,
                const SchemeOptions& options)
        : t_(level.scheme.topology),
          sharpness_(level.scheme.sharpness),
          parent_(level.uniform),
          is_frozen_(is_frozen),
          split_(split),
          chaikin_(options.creasing == Creasing::Chaikin) {}

    UniformNumbers build() const {
        UniformNumbers out;
        out.vertices = parent_.vertices + parent_.edges;
        out.edges = 2 * parent_.edges + 3 * parent_.faces;
        out.faces = 4 * parent_.faces;
        for (Index v = 0; v < t_.vertex_count; ++v) {
            out.vertex.push_back(parent_.vertex[v]);
            out.same_position.push_back(!is_frozen_[v] && is_same_vertex_point(v) ? 1 : 0);
        }
        for (const Index e : split_.split_edges) {
            const std::int64_t number = parent_.edge[e];
            out.vertex.push_back(number == kNone ? kNone : parent_.vertices + number);
            out.same_position.push_back(is_same_edge_point(e) ? 1 : 0);
        }
        for (const EdgeOrigin& origin : split_.edges) {
            out.edge.push_back(edge_number(origin));
            out.same_sharpness.push_back(is_same_edge(origin) ? 1 : 0);
        }
        for (const FaceOrigin& origin : split_.faces) {
            const std::int64_t number = parent_.face[origin.parent];
            out.face.push_back(number == kNone || origin.child == kNone ? kNone : 4 * number + origin.child);
        }
        return out;
    }

  private:
    bool all_edges_same_at(Index v) const {
        const auto ring = t_.ring(v);
        return std::all_of(ring.begin(), ring.end(), [&](Index e) { return parent_.same_sharpness[e] != 0; });
    }

    // The faces of an edge are those of uniform refinement, and so are their corners.
    bool are_faces_same(Index e) const {
        const auto& faces = t_.edge_faces[e];
        return std::all_of(faces.begin(), faces.end(), [&](Index f) {
            return f == kNone || (parent_.face[f] != kNone &&
                                  std::all_of(t_.triangles[f].begin(), t_.triangles[f].end(),
                                              [&](Index v) { return parent_.same_position[v] != 0; }));
        });
    }

    bool is_same_vertex_point(Index v) const {
        const auto ring = t_.ring(v);
        return parent_.same_position[v] && all_edges_same_at(v) &&
               std::all_of(ring.begin(), ring.end(), [&](Index e) { return are_faces_same(e); });
    }

    // Under Chaikin's rule the halves of an edge, and so its point, depend on the other edges at its ends.
    bool are_halves_same(Index e) const {
        const auto& ends = t_.edge_ends[e];
        return parent_.same_sharpness[e] && (!chaikin_ || !is_semi_sharp(sharpness_.edge[e]) ||
                                             (all_edges_same_at(ends[0]) && all_edges_same_at(ends[1])));
    }

    bool is_same_edge_point(Index e) const { return are_halves_same(e) && are_faces_same(e); }

    std::int64_t edge_number(const EdgeOrigin& origin) const {
        const bool is_half = origin.kind == EdgeOrigin::Kind::Half;
        if (!is_half && origin.kind != EdgeOrigin::Kind::Cut) return kNone;
        const std::int64_t number = is_half ? parent_.edge[origin.parent] : parent_.face[origin.parent];
        if (number == kNone) return kNone;
        return is_half ? 3 * parent_.faces + 2 * number + origin.part : 3 * number + origin.part;
    }

    bool is_same_edge(const EdgeOrigin& origin) const {
        switch (origin.kind) {
            case EdgeOrigin::Kind::Half:
                return are_halves_same(origin.parent);
            case EdgeOrigin::Kind::Kept:
                return parent_.same_sharpness[origin.parent] &&
                       !is_semi_sharp(sharpness_.edge[origin.parent]);
            case EdgeOrigin::Kind::Cut:
            case EdgeOrigin::Kind::Inside:
                return true;  // not sharp
        }
        return false;
    }

    const Topology& t_;
    const Sharpness& sharpness_;
    const UniformNumbers& parent_;
    const Flags& is_frozen_;
    const PartialSplit& split_;
    bool chaikin_;
};

UniformNumbers numbers_of_control_mesh(const Topology& t) {
    UniformNumbers out;
    const auto count = [](auto& numbers, std::int64_t size) {
        numbers.resize(static_cast<std::size_t>(size));
        std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
        return size;
    };
    out.vertices = count(out.vertex, t.vertex_count);
    out.edges = count(out.edge, t.edge_count());
    out.faces = count(out.face, t.face_count());
    out.same_position.assign(out.vertex.size(), 1);
    out.same_sharpness.assign(out.edge.size(), 1);
    return out;
}

// Nothing, or why the things of the next uniform level cannot be numbered in 64 bits.
std::optional<Error> check_numbers(const UniformNumbers& uniform) {
    constexpr std::int64_t kMost = std::int64_t{1} << 59;
    if (uniform.edges < kMost && uniform.faces < kMost) return std::nullopt;
    return Error{ErrorCode::TooLarge, "Uniform refinement would have 2^60 edges or more at the next level."};
}

}  // namespace

AdaptiveLevel adaptive_control_level(const TriangleMesh& mesh, BoundaryRule boundary) {
    AdaptiveLevel level;
    level.scheme = control_level(mesh, boundary);
    level.positions.assign(mesh.positions().begin(), mesh.positions().end());
    level.control_face.resize(mesh.face_count());
    std::iota(level.control_face.begin(), level.control_face.end(), Index{0});
    level.uniform = numbers_of_control_mesh(mesh.topology());
    return level;
}

Result<AdaptiveStep> adaptive_step(const AdaptiveLevel& level, const Flags& is_subdividable,
                                   const SchemeOptions& options, double most_faces) {
    const SchemeLevel& parent = level.scheme;
    if (auto error = check_numbers(level.uniform)) return tl::unexpected(*error);
    auto split = split_where(parent.topology, edges_to_split(parent.topology, is_subdividable), most_faces);
    if (!split) return tl::unexpected(split.error());

    const Flags is_frozen = frozen_vertices(parent.topology, is_subdividable);
    const auto halves = half_edge_sharpness(parent.topology, parent.sharpness, options.creasing);
    AdaptiveStep step;
    step.counts = {split->faces_with_unsplit, split->split_edges.size()};
    step.rows = select_rows(make_rows(parent.topology, parent.sharpness, halves, options), parent.topology,
                            is_frozen, split->split_edges);
    AdaptiveLevel& child = step.child;
    child.positions = apply<double>(step.rows, options.weights, level.positions);
    for (const FaceOrigin& origin : split->faces)
        child.control_face.push_back(level.control_face[origin.parent]);
    child.uniform = UniformStep(level, is_frozen, *split, options).build();
    child.scheme.sharpness = child_sharpness(parent.sharpness, halves, is_frozen, *split);
    child.scheme.classes = child_classes(parent, *split, child.scheme.sharpness);
    step.ancestors = std::move(split->ancestors);
    child.scheme.topology = std::move(split->topology);
    return step;
}

template <class Real>
Result<AdaptiveRefinement> refine_adaptively(const TriangleMesh& mesh, const SchemeOptions& options,
                                             const Criterion& criterion, int levels, double most_faces) {
    const Precision precision = std::is_same_v<Real, float> ? Precision::Float : Precision::Double;
    if (auto error = check_fits(mesh, precision)) return tl::unexpected(*error);
    auto positions = convert_points<Real>(mesh.positions());
    AdaptiveLevel level = adaptive_control_level(mesh, options.boundary);
    AdaptiveRefinement out;
    out.refinement.precision = precision;
    std::vector<Ancestor> ancestors;
    AdaptiveRecord record;
    double faces = 0;
    for (int l = 0;; ++l) {
        faces += static_cast<double>(level.control_face.size());
        out.refinement.levels.push_back(as_refined_level(level.scheme, std::move(ancestors)));
        out.refinement.levels.back().positions = convert_points<double>(positions);
        record.control_face = level.control_face;
        record.classes = level.scheme.classes;
        record.uniform_vertex = level.uniform.vertex;
        record.same_position = level.uniform.same_position;
        out.records.push_back(std::move(record));
        if (l == levels) {
            out.last = std::move(level);
            return out;
        }

        const Flags flags = criterion(level);
        if (flags.size() != level.control_face.size())
            return fail(ErrorCode::IndexOutOfRange, fmt::format("The criterion gave {} flags for {} faces.",
                                                                flags.size(), level.control_face.size()));
        auto step = adaptive_step(level, flags, options, most_faces - faces);
        if (!step) return tl::unexpected(step.error());
        record = {};
        record.counts = step->counts;
        record.subdividable =
            static_cast<std::size_t>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
        positions = apply<Real>(step->rows, options.weights, positions);
        ancestors = std::move(step->ancestors);
        level = std::move(step->child);
    }
}

template Result<AdaptiveRefinement> refine_adaptively<float>(const TriangleMesh&, const SchemeOptions&,
                                                             const Criterion&, int, double);
template Result<AdaptiveRefinement> refine_adaptively<double>(const TriangleMesh&, const SchemeOptions&,
                                                              const Criterion&, int, double);

}  // namespace loopcheck::core
