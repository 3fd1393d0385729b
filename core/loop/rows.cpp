#include "core/loop/rows.h"

#include <map>
#include <tuple>

#include "core/loop/mask_choice.h"
#include "core/loop/rules.h"

namespace loopcheck::core {
namespace {

class RowBuilder {
  public:
    RowBuilder(const Topology& topology, const Sharpness& sharpness,
               std::span<const std::array<float, 2>> halves, const SchemeOptions& options)
        : t_(topology), s_(sharpness), halves_(halves), options_(options) {
        const std::size_t count = t_.vertex_count + t_.edge_ends.size();
        rows_.offsets.reserve(count + 1);
        rows_.offsets.push_back(0);
        rows_.mask_of_row.reserve(count);
        rows_.columns.reserve(2 * t_.edge_ends.size() + t_.vertex_count + 4 * t_.edge_ends.size());
    }

    Rows build() && {
        const auto rules = vertex_rules(t_, s_);
        for (Index v = 0; v < t_.vertex_count; ++v) add_vertex_point(v, rules[v]);
        for (Index e = 0; e < t_.edge_count(); ++e) add_edge_point(e);
        return std::move(rows_);
    }

  private:
    void add_vertex_point(Index v, VertexRule rule) {
        const auto ring = t_.ring(v);
        Mask mask{.parent = rule, .child = rule, .ring = static_cast<int>(ring.size())};
        if (rule == VertexRule::Crease || rule == VertexRule::Corner) {
            parent_ring_.clear();
            child_ring_.clear();
            for (const Index e : ring) {
                parent_ring_.push_back(s_.edge[e]);
                child_ring_.push_back(halves_[e][t_.edge_ends[e][0] == v ? 0 : 1]);
            }
            mask = vertex_point_mask(s_.vertex[v], parent_ring_, child_ring_);
        }
        add_row(mask, [&](int place) { return place == mask.ring ? v : t_.other_end(ring[place], v); });
    }

    void add_edge_point(Index e) {
        add_row(edge_point_mask(s_.edge[e], halves_[e], options_.crease_share), [&](int place) {
            if (place < 2) return t_.edge_ends[e][place];
            const Index f = t_.edge_faces[e][place - 2];
            return t_.triangles[f][previous_corner(t_.corner_of_edge(f, e))];
        });
    }

    template <class VertexAt>
    void add_row(const Mask& mask, VertexAt&& vertex_at) {
        const Index id = mask_id(mask);
        for (const int place : places_[id]) rows_.columns.push_back(vertex_at(place));
        rows_.offsets.push_back(rows_.columns.size());
        rows_.mask_of_row.push_back(id);
    }

    // The masks repeat almost always: the same one as a moment ago, or one of few per valence.
    Index mask_id(const Mask& mask) {
        Index& latest = latest_[static_cast<int>(mask.point)];
        if (latest != kNone && rows_.masks[latest] == mask) return latest;
        const auto key = std::tuple(mask.point, mask.parent, mask.child, mask.ring, mask.parent_crease,
                                    mask.child_crease, mask.share);
        const auto [found, is_new] = ids_.try_emplace(key, static_cast<Index>(rows_.masks.size()));
        if (is_new) {
            rows_.masks.push_back(mask);
            places_.push_back(places_of(mask));
        }
        return latest = found->second;
    }

    using Key = std::tuple<Mask::Point, VertexRule, VertexRule, int, Mask::Ends, Mask::Ends, float>;

    const Topology& t_;
    const Sharpness& s_;
    std::span<const std::array<float, 2>> halves_;
    const SchemeOptions& options_;
    Rows rows_;
    std::vector<std::vector<int>> places_;
    std::map<Key, Index> ids_;
    std::array<Index, 2> latest_{kNone, kNone};
    std::vector<float> parent_ring_, child_ring_;  // of the vertex at hand
};

}  // namespace

Rows make_rows(const Topology& topology, const Sharpness& sharpness,
               std::span<const std::array<float, 2>> halves, const SchemeOptions& options) {
    return RowBuilder(topology, sharpness, halves, options).build();
}

}  // namespace loopcheck::core
