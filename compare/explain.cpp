#include "compare/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/matching.h"
#include "compare/words.h"
#include "core/mesh/high_precision.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

using core::Index;
using core::Mask;
using core::VertexRule;

std::string sharpness_in_words(float s) {
    return core::is_infinite(s) ? std::string("infinite") : core::shortest(s);
}

bool has_irrational_weights(const Mask& mask, core::Weights weights) {
    const bool smooth = core::detail::is_smooth(mask.parent) || core::detail::is_smooth(mask.child);
    return mask.point == Mask::Point::Vertex && smooth && weights == core::Weights::Loop &&
           !core::is_rational_loop_weight(mask.ring);
}

class Explainer {
  public:
    Explainer(const Witness& witness, int level, Index vertex, CountFrom from)
        : options_(witness.options),
          parent_(witness.levels[level - 1]),
          child_(witness.levels[level]),
          mask_(child_.rows.mask(vertex)),
          level_(level),
          vertex_(vertex),
          from_(from) {}

    std::string text() const {
        return fmt::format(
            "vertex {} of level {} (vertices counted from {})\n  {}\n  class: {}\n  rule: {}\n{}\n{}",
            number(vertex_), level_, static_cast<int>(from_), origin(),
            core::to_string(child_.scheme.classes[vertex_]), core::to_string(mask_), reasons(), mask_table());
    }

  private:
    const core::Topology& topology() const { return parent_.scheme.topology; }
    const core::Sharpness& sharpness() const { return parent_.scheme.sharpness; }
    Index number(Index v) const { return v + static_cast<Index>(from_); }
    Index edge() const { return vertex_ - topology().vertex_count; }

    std::string origin() const {
        if (mask_.point == Mask::Point::Vertex)
            return fmt::format("the vertex point of vertex {} of level {}", number(vertex_), level_ - 1);
        const auto [a, b] = topology().edge_ends[edge()];
        return fmt::format("the edge point of the edge between vertices {} and {} of level {}", number(a),
                           number(b), level_ - 1);
    }

    std::string reasons() const {
        std::string out;
        for (const std::string& reason :
             mask_.point == Mask::Point::Vertex ? vertex_reasons() : edge_reasons())
            out += fmt::format("  {}\n", reason);
        return out;
    }

    std::vector<std::string> vertex_reasons() const {
        const core::Topology& t = topology();
        if (t.is_isolated(vertex_)) return {"It is in no face, so it stays where it is."};
        const int faces = t.face_count_at(vertex_);
        const bool boundary = t.is_boundary_vertex(vertex_);
        std::vector<std::string> out{
            boundary
                ? fmt::format("It is a boundary vertex of {} face{}; boundary edges are infinitely sharp.",
                              faces, faces == 1 ? "" : "s")
                : fmt::format("It is an interior vertex of valence {}.", faces)};
        out.push_back(why_rule(boundary, faces));
        if (mask_.is_blended())
            out.push_back(
                fmt::format("A finite sharpness comes to its end in this step, and with it the {} rule; the "
                            "share of that rule is the mean of the sharpnesses that end here, at most 1: {}.",
                            core::name(mask_.parent), core::shortest(mask_.share)));
        if (core::detail::is_smooth(mask_.child)) out.push_back(smooth_formula());
        return out;
    }

    std::string why_rule(bool boundary, int faces) const {
        const float own = sharpness().vertex[vertex_];
        const auto ring = topology().ring(vertex_);
        const auto sharp = std::count_if(ring.begin(), ring.end(),
                                         [&](Index e) { return core::is_sharp(sharpness().edge[e]); });
        const bool keeps_corners = options_.boundary == core::BoundaryRule::EdgeAndCorner;
        if (keeps_corners && boundary && faces == 1)
            return "The boundary option edge-and-corner keeps boundary vertices of exactly one face: the "
                   "corner rule.";
        if (core::is_sharp(own))
            return fmt::format("Its own sharpness is {}: the corner rule.", sharpness_in_words(own));
        std::string out;
        switch (mask_.parent) {
            case VertexRule::Corner:
                out = fmt::format("{} of its edges are sharp; more than two: the corner rule.", sharp);
                break;
            case VertexRule::Crease:
                out = boundary ? "Exactly two of its edges are sharp, those of the boundary: the crease rule."
                               : "Exactly two of its edges are sharp: the crease rule.";
                break;
            case VertexRule::Dart:
                out = "One of its edges is sharp: a dart, which follows the smooth rule.";
                break;
            case VertexRule::Smooth:
                out = "None of its edges is sharp: the smooth rule.";
                break;
        }
        if (keeps_corners && boundary && faces > 1)
            out += "  The boundary option edge-and-corner keeps only boundary vertices of exactly one face.";
        return out;
    }

    std::string smooth_formula() const {
        const int n = mask_.ring;
        if (options_.weights == core::Weights::Warren)
            return fmt::format("Warren's weight of each neighbour: {} = {}.",
                               n == 3 ? "3/16" : fmt::format("3/(8*{})", n),
                               core::warren_weight<core::Rational>(n).str());
        const std::string formula = fmt::format(
            "Loop's weight of each neighbour: b({0}) = (5/8 - (3/8 + cos(2 pi/{0})/4)^2)/{0} = ", n);
        return formula +
               (core::is_rational_loop_weight(n) ? core::loop_weight<core::Rational>(n).str()
                                                 : core::loop_weight<core::HighPrecision>(n).str(20)) +
               ".";
    }

    std::vector<std::string> edge_reasons() const {
        const float s = sharpness().edge[edge()];
        if (topology().is_boundary_edge(edge())) return {"It is a boundary edge: the midpoint of its ends."};
        if (!core::is_sharp(s)) return {"It is smooth: 3/8 of each end, 1/8 of each vertex opposite."};
        if (!mask_.is_blended())
            return {fmt::format("Its sharpness is {}: the midpoint of its ends.", sharpness_in_words(s))};
        return {fmt::format(
            "Its sharpness {} comes to its end in this step: that share of the crease rule, the rest of "
            "the smooth rule.",
            core::shortest(s))};
    }

    std::string mask_table() const {
        const auto decimals = core::weights_of<core::HighPrecision>(mask_, options_.weights);
        const bool irrational = has_irrational_weights(mask_, options_.weights);
        std::vector<core::Rational> fractions;
        if (!irrational) fractions = core::weights_of<core::Rational>(mask_, options_.weights);
        std::string out =
            fmt::format("mask, over the vertices of level {}, in the order of summation\n", level_ - 1);
        const auto columns = child_.rows.columns_of(vertex_);
        for (std::size_t j = 0; j < columns.size(); ++j)
            out += fmt::format("  {:>7}  {:<24} {}\n", number(columns[j]), decimals[j].str(20),
                               irrational ? std::string("(irrational)") : fractions[j].str());
        return out;
    }

    const core::SchemeOptions& options_;
    const WitnessLevel& parent_;
    const WitnessLevel& child_;
    const Mask& mask_;
    int level_;
    Index vertex_;
    CountFrom from_;
};

std::string computed_by(const Subject& subject, const core::TriangleMesh& mesh, const Witness& witness,
                        int level, Index vertex) {
    const auto made = subject.refine(mesh, options_for(subject, witness.options), level);
    if (!made) return fmt::format("  {:<17} {}\n", subject.name, core::to_string(made.error()));
    const auto pairing = match(witness, *made);
    if (!pairing) return fmt::format("  {:<17} {}\n", subject.name, core::to_string(pairing.error()));
    return position_in_words(subject.name, made->levels[level].positions[pairing->vertex_of[level][vertex]]);
}

}  // namespace

std::optional<core::Error> no_such_vertex(const Witness& witness, int level, Index vertex, CountFrom from) {
    const Index count = witness.levels[level].scheme.topology.vertex_count;
    if (vertex >= 0 && vertex < count) return std::nullopt;
    return core::Error{core::ErrorCode::IndexOutOfRange,
                       fmt::format("Level {} has the vertices {} to {}.", level, static_cast<int>(from),
                                   count - 1 + static_cast<Index>(from))};
}

core::Result<std::string> explain(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                  int level, Index vertex, std::span<const Subject> subjects,
                                  CountFrom from) {
    const auto witness = make_witness(mesh, options, level);
    if (!witness) return tl::unexpected(witness.error());
    if (auto error = no_such_vertex(*witness, level, vertex, from)) return tl::unexpected(*error);
    std::string out = Explainer(*witness, level, vertex, from).text() + "\nposition\n";
    out += position_in_words("exact", witness->levels[level].exact[vertex]);
    for (const Subject& subject : subjects) out += computed_by(subject, mesh, *witness, level, vertex);
    return out;
}

}  // namespace loopcheck::compare
