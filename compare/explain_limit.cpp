#include <fmt/format.h>

#include "compare/explain.h"
#include "compare/fractions.h"
#include "compare/words.h"
#include "core/loop/evaluate.h"

namespace loopcheck::compare {
namespace {

using core::HighPrecision;
using core::Index;

// 20 digits, and the fraction where it is one.
std::string weight_in_words(const HighPrecision& weight) {
    const auto fraction = as_fraction(weight);
    return fmt::format("{:<26} {:<14}", weight == 0 ? std::string("0") : weight.str(20),
                       fraction.value_or(""));
}

class LimitExplainer {
  public:
    LimitExplainer(const Witness& witness, int level, Index vertex, CountFrom from)
        : options_(witness.options),
          scheme_(witness.levels[level].scheme),
          level_(level),
          vertex_(vertex),
          from_(from),
          table_(scheme_, options_),
          masks_(table_.masks(vertex)) {}

    std::string text() {
        std::string out = fmt::format(
            "limit of vertex {} of level {} (vertices counted from {})\n  class: {}\n{}\n", number(vertex_),
            level_, static_cast<int>(from_), core::to_string(scheme_.classes[vertex_]), situation());
        out += fmt::format(
            "position mask, over the vertices of level {}, counter-clockwise, the vertex last\n", level_);
        out += rows({&masks_.position});
        for (std::size_t i = 0; i < masks_.sectors.size(); ++i) out += sector_in_words(masks_.sectors[i], i);
        return out;
    }

    const core::LimitMasks<HighPrecision>& masks() const { return masks_; }

  private:
    const core::Topology& topology() const { return scheme_.topology; }
    Index number(Index v) const { return v + static_cast<Index>(from_); }

    std::string situation() const {
        const core::Topology& t = topology();
        if (t.is_isolated(vertex_)) return "  It is in no face, so it stays where it is.\n";
        std::string out;
        if (core::has_finite_sharpness(t, scheme_.sharpness, vertex_))
            out +=
                "  A finite sharpness is left at it: its ring was refined until that was gone, and the masks "
                "are "
                "those of what it became, times the refinements.\n";
        const auto& position = masks_.position;
        const auto faces = t.face_count_at(vertex_);
        out += fmt::format("  It is {} vertex of {} face{}; its limit is {}.\n",
                           t.is_boundary_vertex(vertex_) ? "a boundary" : "an interior", faces,
                           faces == 1 ? "" : "s", position.back() == 1 ? "itself" : "the mean below");
        if (scheme_.classes[vertex_].kind == core::VertexClass::Kind::Interior && faces > 2)
            out += fmt::format("  The curvature of the surface around it is {}.\n",
                               core::name(core::curvature_at(faces)));
        return out;
    }

    std::string sector_in_words(const core::SectorMasks<HighPrecision>& sector, std::size_t i) const {
        std::string out = "\n";
        if (masks_.sectors.size() > 1)
            out += fmt::format("sector {}, {} face{} from the edge to vertex {} on\n", i + 1,
                               sector.sector.faces, sector.sector.faces == 1 ? "" : "s",
                               number(end(sector.sector.first)));
        if (sector.no_normal != core::NoNormal::None)
            return out + fmt::format("limit normal: undefined.  {}\n", core::sentence(sector.no_normal));
        return out + "tangent masks: two directions that span the tangent plane; lengths mean nothing\n" +
               rows({&sector.tangent1, &sector.tangent2});
    }

    Index end(int place) const {
        const auto ring = topology().ring(vertex_);
        return topology().other_end(ring[place % static_cast<int>(ring.size())], vertex_);
    }

    std::string rows(const std::vector<const std::vector<HighPrecision>*>& columns) const {
        const auto ring = topology().ring(vertex_).size();
        std::string out;
        for (std::size_t j = 0; j <= ring; ++j) {
            out += fmt::format("  {:>7} ", number(j < ring ? end(static_cast<int>(j)) : vertex_));
            for (const auto* weights : columns) out += " " + weight_in_words((*weights)[j]);
            out.erase(out.find_last_not_of(' ') + 1);
            out += "\n";
        }
        return out;
    }

    const core::SchemeOptions& options_;
    const core::SchemeLevel& scheme_;
    int level_;
    Index vertex_;
    CountFrom from_;
    core::LimitTable<HighPrecision> table_;
    const core::LimitMasks<HighPrecision>& masks_;
};

// The limit position by the exact rules, rounded.
glm::dvec3 exact_limit(const WitnessLevel& level, Index v, const std::vector<HighPrecision>& weights) {
    const core::Topology& t = level.scheme.topology;
    const auto ring = t.ring(v);
    glm::dvec3 out;
    for (int i = 0; i < 3; ++i) {
        HighPrecision sum = 0;
        for (std::size_t j = 0; j <= ring.size(); ++j) {
            const Index p = j < ring.size() ? t.other_end(ring[j], v) : v;
            sum += weights[j] * (HighPrecision(level.exact[p][i]) + level.exact_rest[p][i]);
        }
        out[i] = static_cast<double>(sum);
    }
    return out;
}

}  // namespace

core::Result<std::string> explain_limit(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                        int level, Index vertex, CountFrom from) {
    const auto witness = make_witness(mesh, options, level);
    if (!witness) return tl::unexpected(witness.error());
    if (auto error = no_such_vertex(*witness, level, vertex, from)) return tl::unexpected(*error);
    LimitExplainer explainer(*witness, level, vertex, from);
    return explainer.text() + "\nlimit position\n" +
           position_in_words("exact",
                             exact_limit(witness->levels[level], vertex, explainer.masks().position));
}

}  // namespace loopcheck::compare
