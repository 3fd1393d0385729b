#include "core/loop/refine.h"

#include <type_traits>

namespace loopcheck::core {
namespace {

Sharpness child_sharpness(const Topology& parent, const Sharpness& sharpness,
                          std::span<const std::array<float, 2>> halves) {
    Sharpness child;
    child.edge.assign(3 * parent.triangles.size(), 0);
    child.edge.reserve(child.edge.size() + 2 * halves.size());
    for (const auto& half : halves) child.edge.insert(child.edge.end(), half.begin(), half.end());
    child.vertex.reserve(sharpness.vertex.size() + halves.size());
    for (const float s : sharpness.vertex) child.vertex.push_back(uniform_decay(s));
    child.vertex.resize(sharpness.vertex.size() + halves.size(), 0);
    return child;
}

}  // namespace

std::vector<std::uint8_t> comes_from_finite_sharpness(const SchemeLevel& parent) {
    std::vector<std::uint8_t> out;
    out.reserve(parent.topology.vertex_count + parent.topology.edge_ends.size());
    for (Index v = 0; v < parent.topology.vertex_count; ++v)
        out.push_back(has_finite_sharpness(parent.topology, parent.sharpness, v) ? 1 : 0);
    for (const float s : parent.sharpness.edge) out.push_back(is_semi_sharp(s) ? 1 : 0);
    return out;
}

RefinedLevel as_refined_level(const SchemeLevel& level, std::vector<Ancestor> ancestors) {
    RefinedLevel out;
    out.triangles = level.topology.triangles;
    out.ancestors = std::move(ancestors);
    const auto rules = vertex_rules(level.topology, level.sharpness);
    out.tags.reserve(rules.size());
    for (Index v = 0; v < level.topology.vertex_count; ++v)
        out.tags.push_back({rules[v], level.topology.is_boundary_vertex(v)});
    return out;
}

SchemeLevel control_level(const TriangleMesh& mesh, BoundaryRule boundary) {
    SchemeLevel level{mesh.topology(), control_sharpness(mesh, boundary), {}};
    level.classes = classify(level.topology, level.sharpness, {});
    return level;
}

Result<Step> next_level(const SchemeLevel& level, const SchemeOptions& options) {
    auto topology = split(level.topology);
    if (!topology) return tl::unexpected(topology.error());
    const auto halves = half_edge_sharpness(level.topology, level.sharpness, options.creasing);
    Step step;
    step.rows = make_rows(level.topology, level.sharpness, halves, options);
    step.ancestors = ancestors_of_split(level.topology);
    step.child.topology = std::move(*topology);
    step.child.sharpness = child_sharpness(level.topology, level.sharpness, halves);
    step.child.classes =
        classify(step.child.topology, step.child.sharpness, comes_from_finite_sharpness(level));
    return step;
}

template <class Real>
Result<Refinement> refine(const TriangleMesh& mesh, const SchemeOptions& options, int levels) {
    const Precision precision = std::is_same_v<Real, float> ? Precision::Float : Precision::Double;
    if (auto error = check_fits(mesh, precision)) return tl::unexpected(*error);
    auto positions = convert_points<Real>(mesh.positions());

    Refinement out;
    out.precision = precision;
    SchemeLevel level = control_level(mesh, options.boundary);
    std::vector<Ancestor> ancestors;
    for (int l = 0;; ++l) {
        out.levels.push_back(as_refined_level(level, std::move(ancestors)));
        out.levels.back().positions = convert_points<double>(positions);
        if (l == levels) return out;
        auto step = next_level(level, options);
        if (!step) return tl::unexpected(step.error());
        positions = apply<Real>(step->rows, options.weights, positions);
        ancestors = std::move(step->ancestors);
        level = std::move(step->child);
    }
}

template Result<Refinement> refine<float>(const TriangleMesh&, const SchemeOptions&, int);
template Result<Refinement> refine<double>(const TriangleMesh&, const SchemeOptions&, int);

}  // namespace loopcheck::core
