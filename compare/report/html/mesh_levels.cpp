#include "compare/report/html/mesh_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "compare/fractions.h"
#include "compare/limit/convergence.h"
#include "compare/memory.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

using core::Index;
using core::VertexClass;
using Json = nlohmann::ordered_json;
using Indices = std::vector<std::uint32_t>;

Indices flat(const std::vector<core::Triangle>& triangles) {
    Indices out;
    out.reserve(3 * triangles.size());
    for (const core::Triangle& t : triangles) out.insert(out.end(), t.begin(), t.end());
    return out;
}

std::vector<std::int32_t> coded(const std::vector<core::Ancestor>& ancestors) {
    std::vector<std::int32_t> out;
    out.reserve(ancestors.size());
    for (const core::Ancestor& a : ancestors)
        out.push_back(a.kind == core::Ancestor::Kind::Vertex ? a.index : -1 - a.index);
    return out;
}

// The ends of edges that are sharp, or still semi-sharp, and no boundary.
Indices sharp_edges(const core::SchemeLevel& scheme) {
    Indices out;
    for (Index e = 0; e < scheme.topology.edge_count(); ++e) {
        if (!core::is_sharp(scheme.sharpness.edge[e]) || scheme.topology.is_boundary_edge(e)) continue;
        const auto& ends = scheme.topology.edge_ends[e];
        out.insert(out.end(), ends.begin(), ends.end());
    }
    return out;
}

Json weights_in_words(const core::Mask& mask, core::Weights weights) {
    Json out = Json::array();
    for (const auto& weight : core::weights_of<core::HighPrecision>(mask, weights))
        out.push_back(as_fraction(weight).value_or(core::shortest(static_cast<double>(weight))));
    return {{"weights", std::move(out)}};
}

}  // namespace

int shown_levels(const core::TriangleMesh& mesh, int levels, std::size_t most_vertices) {
    int out = 0;
    while (out <= levels && level_size(mesh, out).vertices <= static_cast<double>(most_vertices)) ++out;
    return out;
}

double shown_bytes(const core::TriangleMesh& mesh, int levels, std::size_t most_vertices,
                   std::size_t comparisons, Scope scope) {
    const int shown = shown_levels(mesh, levels, most_vertices);
    if (shown == 0) return 0;
    const double compared =
        kComparedBytesPerVertex + (scope == Scope::Limits ? kComparedLimitsBytesPerVertex : 0);
    return level_size(mesh, shown - 1).vertices *
           (kShownBytesPerVertex + static_cast<double>(comparisons) * compared);
}

float to_float(double x) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    if (std::abs(x) > kLargest) return x > 0 ? kInfinity : -kInfinity;
    return static_cast<float>(x);
}

bool LevelWriter::Less::operator()(const core::Mask& a, const core::Mask& b) const {
    const auto key = [](const core::Mask& m) {
        return std::tie(m.point, m.parent, m.child, m.ring, m.parent_crease, m.child_crease, m.share);
    };
    return key(a) < key(b);
}

LevelWriter::LevelWriter(ChunkWriter& chunk, const Witness& witness, int shown)
    : chunk_(chunk), witness_(witness), shown_(shown), weights_(Json::array()) {
    std::set<VertexClass> classes;
    for (int l = 0; l < shown; ++l)
        classes.insert(witness.levels[l].scheme.classes.begin(), witness.levels[l].scheme.classes.end());
    classes_.assign(classes.begin(), classes.end());
    std::set<std::string> rules;
    for (int l = 1; l < shown; ++l)
        for (const core::Mask& mask : witness.levels[l].rows.masks) rules.insert(core::to_string(mask));
    rules_.assign(rules.begin(), rules.end());
}

Json LevelWriter::add(int level) {
    const WitnessLevel& exact = witness_.levels[level];
    const core::SchemeLevel& scheme = exact.scheme;
    Json out{{"level", level}, {"vertices", scheme.topology.vertex_count}};
    out["triangles"] = chunk_.add(flat(scheme.topology.triangles));
    out["sharp"] = chunk_.add(sharp_edges(scheme));
    if (level > 0) out["ancestors"] = chunk_.add(coded(exact.ancestors));
    Indices classes;
    classes.reserve(scheme.classes.size());
    for (const VertexClass& c : scheme.classes)
        classes.push_back(static_cast<std::uint32_t>(std::lower_bound(classes_.begin(), classes_.end(), c) -
                                                     classes_.begin()));
    out["classes"] = chunk_.add_indices(classes, classes_.size());
    if (level > 0) add_rows(out, level);
    out["exact"] = chunk_.add(exact.exact);
    return out;
}

std::uint32_t LevelWriter::index_of_mask(const core::Mask& mask) {
    const auto [place, is_new] = masks_.emplace(mask, static_cast<std::uint32_t>(masks_.size()));
    if (is_new) weights_.push_back(weights_in_words(mask, witness_.options.weights));
    return place->second;
}

void LevelWriter::add_rows(Json& out, int level) {
    const core::Rows& rows = witness_.levels[level].rows;
    Indices rule_of_mask, number_of_mask;
    for (const core::Mask& mask : rows.masks) {
        rule_of_mask.push_back(static_cast<std::uint32_t>(
            std::lower_bound(rules_.begin(), rules_.end(), core::to_string(mask)) - rules_.begin()));
        number_of_mask.push_back(index_of_mask(mask));
    }
    Indices rules, masks;
    for (const Index mask : rows.mask_of_row) {
        rules.push_back(rule_of_mask[mask]);
        masks.push_back(number_of_mask[mask]);
    }
    out["rules"] = chunk_.add_indices(rules, rules_.size());
    out["masks"] = chunk_.add(masks);
    out["ring_at"] = chunk_.add(Indices(rows.offsets.begin(), rows.offsets.end()));
    out["ring"] = chunk_.add(Indices(rows.columns.begin(), rows.columns.end()));
}

void LevelWriter::finish(Json& header) && {
    header["largest_coordinate"] = witness_.largest_coordinate;
    header["classes"] = Json::array();
    for (const VertexClass& c : classes_) header["classes"].push_back(core::to_string(c));
    header["rules"] = rules_;
    header["masks"] = std::move(weights_);
    header["left_out"] = Json::array();
    for (std::size_t l = static_cast<std::size_t>(shown_); l < witness_.levels.size(); ++l)
        header["left_out"].push_back(
            {{"level", l}, {"vertices", witness_.levels[l].scheme.topology.vertex_count}});
    header["convergence"] = Json::array();
    for (const ConvergencePoint& point : convergence(witness_, shown_))
        header["convergence"].push_back({{"class", core::to_string(point.vertex_class)},
                                         {"level", point.level},
                                         {"vertices", point.vertices},
                                         {"distance", point.distance},
                                         {"factor", point.factor ? Json(*point.factor) : Json()}});
}

}  // namespace loopcheck::compare
