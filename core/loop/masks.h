// The masks of Loop subdivision: what a refined vertex takes from each vertex of its neighbourhood.  No mesh
// here, only the local picture.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/loop/weights.h"
#include "core/mesh/options.h"
#include "core/mesh/refinement.h"

namespace loopcheck::core {

/// One mask, as data.
///
/// A vertex point reads the n vertices of its ring, in ring order, then the vertex itself; an edge point
/// reads the two ends of its edge, then the vertices opposite it in its faces.  Where the rules of the parent
/// and of the child differ, because a finite sharpness came to its end in this step, the mask is
///
///     share * (mask of the parent's rule) + (1 - share) * (mask of the child's rule).
///
/// Source  [Loop87] (smooth), [Hoppe94] (creases, corners), [DeRose98] (blending).
struct Mask {
    enum class Point : std::uint8_t { Vertex, Edge };
    using Ends = std::array<int, 2>;

    Point point = Point::Vertex;
    VertexRule parent = VertexRule::Smooth;  ///< edge points: Smooth or Crease
    VertexRule child = VertexRule::Smooth;   ///< equal to `parent` where nothing is blended
    int ring = 0;                            ///< number of edges around the vertex; 0 for edge points
    Ends parent_crease{};  ///< ring positions of the two sharp edges, where the rule is Crease
    Ends child_crease{};
    float share = 1;  ///< share of the parent's rule

    bool operator==(const Mask&) const = default;

    bool is_blended() const { return parent != child; }
};

/// The rule in words: "edge point, crease" or "vertex point, 0.3 corner + 0.7 crease".
std::string to_string(const Mask& mask);

/// The places of the neighbourhood that a mask reads, in the order in which they are summed: ring positions
/// and then `ring` for the vertex itself; 0, 1 for the ends of an edge and 2, 3 for the vertices opposite it.
std::vector<int> places_of(const Mask& mask);

/// The weights at `places_of(mask)`.  They sum to 1.
///
/// Error  every weight has a relative error of at most `weight_ulps(mask)` units of roundoff.
template <class Scalar>
std::vector<Scalar> weights_of(const Mask& mask, Weights weights);

/// Relative error of the weights of a mask, in units of roundoff: 0 where all are fractions over a power of
/// two, kLoopWeightUlps at extraordinary vertices, twice that where rules are blended.
int weight_ulps(const Mask& mask, Weights weights);

namespace detail {

inline bool is_smooth(VertexRule rule) {
    return rule == VertexRule::Smooth || rule == VertexRule::Dart;
}

/// Adds share * (the mask of one rule) to `full`, a vertex point's weights over the whole ring and the
/// centre.
template <class Scalar>
void add_vertex_rule(std::vector<Scalar>& full, VertexRule rule, const Mask::Ends& crease, Weights weights,
                     const Scalar& share) {
    const auto n = static_cast<int>(full.size()) - 1;
    if (is_smooth(rule)) {
        const Scalar b = ring_weight<Scalar>(weights, n);
        const bool regular = weights == Weights::Loop && n == 6;
        for (int i = 0; i < n; ++i) full[i] += share * b;
        full[n] += share * (regular ? Scalar(5) / 8 : centre_weight<Scalar>(b, n));
    } else if (rule == VertexRule::Crease) {
        for (const int i : crease) full[i] += share * (Scalar(1) / 8);
        full[n] += share * (Scalar(3) / 4);
    } else {
        full[n] += share;
    }
}

}  // namespace detail

template <class Scalar>
std::vector<Scalar> weights_of(const Mask& mask, Weights weights) {
    const Scalar share(mask.share);
    const Scalar rest = 1 - share;
    if (mask.point == Mask::Point::Edge) {
        const Scalar half = Scalar(1) / 2, end = Scalar(3) / 8, opposite = Scalar(1) / 8;
        if (!mask.is_blended()) {
            if (mask.parent == VertexRule::Crease) return {half, half};
            return {end, end, opposite, opposite};
        }
        const Scalar blended = share * half + rest * end;
        return {blended, blended, opposite * rest, opposite * rest};
    }
    std::vector<Scalar> full(mask.ring + std::size_t{1}, Scalar(0));
    detail::add_vertex_rule<Scalar>(full, mask.parent, mask.parent_crease, weights,
                                    mask.is_blended() ? share : Scalar(1));
    if (mask.is_blended())
        detail::add_vertex_rule<Scalar>(full, mask.child, mask.child_crease, weights, rest);
    std::vector<Scalar> out;
    for (const int place : places_of(mask)) out.push_back(full[place]);
    return out;
}

}  // namespace loopcheck::core
