#include "core/loop/rows.h"

#include <algorithm>
#include <map>
#include <tuple>

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
    float half_at(Index e, Index v) const { return halves_[e][t_.edge_ends[e][0] == v ? 0 : 1]; }

    void add_vertex_point(Index v, VertexRule rule) {
        Mask mask{.parent = rule, .child = rule, .ring = static_cast<int>(t_.ring(v).size())};
        if (rule == VertexRule::Crease || rule == VertexRule::Corner) sharpen(mask, v);
        const auto ring = t_.ring(v);
        add_row(mask, [&](int place) { return place == mask.ring ? v : t_.other_end(ring[place], v); });
    }

    // Crease and corner vertices: finds the crease, and what is left of the sharpness in the child.
    void sharpen(Mask& mask, Index v) {
        const auto ring = t_.ring(v);
        const auto crease_of = [&](auto&& sharpness_of) {
            std::vector<int> sharp;
            for (int i = 0; i < mask.ring; ++i)
                if (is_sharp(sharpness_of(ring[i]))) sharp.push_back(i);
            return sharp;
        };
        const auto parent = crease_of([&](Index e) { return s_.edge[e]; });
        const auto child = crease_of([&](Index e) { return half_at(e, v); });
        const float child_vertex = uniform_decay(s_.vertex[v]);
        if (mask.parent == VertexRule::Crease) mask.parent_crease = {parent[0], parent[1]};

        mask.child = rule_of(child_vertex, static_cast<int>(child.size()));
        if (mask.child == mask.parent) return;
        mask.share = share_of_parent(v, child_vertex);
        if (mask.share == 1)
            mask.child = mask.parent;
        else if (mask.child == VertexRule::Crease)
            mask.child_crease = {child[0], child[1]};
    }

    // The mean of the sharpnesses that come to their end at v in this step, at most 1.
    float share_of_parent(Index v, float child_vertex) const {
        float sum = 0;
        int count = 0;
        const auto add = [&](float s) {
            sum += s;
            ++count;
        };
        if (is_sharp(s_.vertex[v]) && !is_sharp(child_vertex)) add(s_.vertex[v]);
        for (const Index e : t_.ring(v)) {
            const float s = s_.edge[e];
            if (is_sharp(s) && !is_sharp(half_at(e, v))) add(s);
        }
        return std::min(1.0F, sum / static_cast<float>(count));
    }

    void add_edge_point(Index e) {
        Mask mask{.point = Mask::Point::Edge};
        const float s = s_.edge[e];
        if (is_sharp(s)) {
            mask.parent = mask.child = VertexRule::Crease;
            const bool child_is_crease = is_sharp(halves_[e][0]) && is_sharp(halves_[e][1]);
            const float share = options_.crease_share == CreaseShare::Clamped ? std::min(1.0F, s) : s;
            if (!child_is_crease && share != 1) {
                mask.child = VertexRule::Smooth;
                mask.share = share;
            }
        }
        add_row(mask, [&](int place) {
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
};

}  // namespace

Rows make_rows(const Topology& topology, const Sharpness& sharpness,
               std::span<const std::array<float, 2>> halves, const SchemeOptions& options) {
    return RowBuilder(topology, sharpness, halves, options).build();
}

}  // namespace loopcheck::core
