#include "core/loop/limit.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <limits>

#include "core/loop/sublevel.h"

namespace loopcheck::core {
namespace {

using High = HighPrecision;
using HighWeights = std::vector<High>;

const High& pi() {
    static const High value = boost::math::constants::pi<High>();
    return value;
}

HighWeights no_weights(int ring) {
    return HighWeights(ring + std::size_t{1}, High(0));
}

// -- Position.

HighWeights smooth_position(int n, Weights weights) {
    const High b = ring_weight<High>(weights, n);
    const High w = 1 / (n + 3 / (8 * b));
    HighWeights out(n + std::size_t{1}, w);
    out[n] = 1 - n * w;
    return out;
}

// With the sharp edge at ring position `sharp`.
HighWeights dart_position(int n, int sharp, Weights weights) {
    const High b = ring_weight<High>(weights, n);
    const High q = (5 - sqrt(High(21))) / 2;
    HighWeights l = no_weights(n);
    l[n] = 1;
    for (int i = 1; i < n; ++i) l[i] = (8 * b / 3) * (1 - (pow(q, i) + pow(q, n - i)) / (1 + pow(q, n)));
    l[0] = 2 * b + (l[1] + l[n - 1]) / 4;
    High sum = 0;
    for (const High& x : l) sum += x;
    HighWeights out = no_weights(n);
    out[n] = l[n] / sum;
    for (int i = 0; i < n; ++i) out[(i + sharp) % n] = l[i] / sum;
    return out;
}

HighWeights position_weights(const Star& star, Weights weights) {
    switch (star.rule()) {
        case VertexRule::Smooth:
            return smooth_position(star.ring, weights);
        case VertexRule::Dart:
            return dart_position(star.ring, star.sharp.front(), weights);
        case VertexRule::Crease: {
            HighWeights out = no_weights(star.ring);
            for (const int end : star.sharp) out[end] += High(1) / 6;
            out[star.ring] = High(2) / 3;
            return out;
        }
        case VertexRule::Corner:
            break;
    }
    HighWeights out = no_weights(star.ring);
    out[star.ring] = 1;
    return out;
}

// -- Tangents.

HighWeights wave(int n, int first, High (*function)(const High&)) {
    HighWeights out = no_weights(n);
    for (int i = 0; i < n; ++i) out[(i + first) % n] = function(2 * pi() * i / n);
    return out;
}
High cosine(const High& x) {
    return cos(x);
}
// A multiple of pi, which is 0 in truth, must not leave noise behind.
High sine(const High& x) {
    const High s = sin(x);
    return abs(s) < 8 * std::numeric_limits<High>::epsilon() ? High(0) : s;
}

HighWeights across_crease(const Star& star, const Sector& sector) {
    HighWeights out = no_weights(star.ring);
    const auto edge = [&](int i) -> High& { return out[(sector.first + i) % star.ring]; };
    const int k = sector.faces;
    if (k == 1) {
        edge(0) += 1;
        edge(1) += 1;
        out[star.ring] = -2;
        return out;
    }
    const High theta = pi() / k;
    const High c = k == 2 ? High(0) : k == 3 ? High(1) / 2 : High(cos(theta));
    const High inside = (1 + 2 * c) * tan(theta / 2);
    for (int i = 1; i < k; ++i) edge(i) += inside * sin(i * theta);
    edge(0) -= c;
    edge(k) -= c;
    out[star.ring] = -1;
    return out;
}

HighWeights spoke(const Star& star, int position) {
    HighWeights out = no_weights(star.ring);
    out[position % star.ring] = 1;
    out[star.ring] = -1;
    return out;
}

HighWeights dart_even(const Star& star, Weights weights) {
    const HighWeights from_sharp = dart_tangent(star.ring, weights).weights;
    HighWeights out = from_sharp;
    for (int i = 0; i < star.ring; ++i) out[(i + star.sharp.front()) % star.ring] = from_sharp[i];
    return out;
}

SectorMasks<High> sector_masks(const Star& star, const Sector& sector, Weights weights) {
    SectorMasks<High> out{sector, no_normal(star, sector), {}, {}};
    if (out.no_normal != NoNormal::None) return out;
    switch (star.rule()) {
        case VertexRule::Smooth:
            out.tangent1 = wave(star.ring, 0, cosine);
            out.tangent2 = wave(star.ring, 0, sine);
            break;
        case VertexRule::Dart:
            out.tangent1 = dart_even(star, weights);
            out.tangent2 = wave(star.ring, star.sharp.front(), sine);
            break;
        case VertexRule::Crease:
            out.tangent1 = no_weights(star.ring);
            out.tangent1[sector.first] += 1;
            out.tangent1[(sector.first + sector.faces) % star.ring] -= 1;
            out.tangent2 = across_crease(star, sector);
            break;
        case VertexRule::Corner:
            out.tangent1 = spoke(star, sector.first);
            out.tangent2 = spoke(star, sector.first + sector.faces);
            break;
    }
    return out;
}

template <class Scalar>
std::vector<Scalar> rounded(const HighWeights& weights) {
    std::vector<Scalar> out;
    out.reserve(weights.size());
    for (const High& w : weights) out.push_back(static_cast<Scalar>(w));
    return out;
}

template <class Scalar>
LimitMasks<Scalar> rounded(const LimitMasks<High>& masks) {
    LimitMasks<Scalar> out{rounded<Scalar>(masks.position), {}};
    for (const auto& s : masks.sectors)
        out.sectors.push_back(
            {s.sector, s.no_normal, rounded<Scalar>(s.tangent1), rounded<Scalar>(s.tangent2)});
    return out;
}

LimitMasks<High> settled_masks(const Star& star, Weights weights) {
    LimitMasks<High> out{position_weights(star, weights), {}};
    for (const Sector& sector : star.sectors()) out.sectors.push_back(sector_masks(star, sector, weights));
    return out;
}

// -- Semi-sharp vertices: the ring is refined until no finite sharpness is left at it.

// weights over the ring of a refined vertex become weights over the ring of its parent.
HighWeights over_parent(const HighWeights& child, const std::vector<HighWeights>& rows) {
    if (child.empty()) return {};
    HighWeights out(rows.front().size(), High(0));
    for (std::size_t i = 0; i < child.size(); ++i)
        for (std::size_t j = 0; j < out.size(); ++j) out[j] += child[i] * rows[i][j];
    return out;
}

// The refinement of a vertex and its ring as a matrix over them, in ring order, the vertex last.
std::vector<HighWeights> ring_matrix(const SubLevel& part, const Rows& rows, Weights weights) {
    const Topology& t = part.level.topology;
    const Index v = part.kept.front();
    const auto ring = t.ring(v);
    const auto table = weights_of<High>(rows, weights);
    std::vector<HighWeights> matrix;
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Index row = i < ring.size() ? t.vertex_count + ring[i] : v;
        const auto columns = rows.columns_of(row);
        const auto& w = table[rows.mask_of_row[row]];
        HighWeights& out = matrix.emplace_back(no_weights(static_cast<int>(ring.size())));
        // Columns are vertices; of two spokes to one vertex (glued triangles) either will do.
        for (std::size_t j = 0; j < columns.size(); ++j) {
            std::size_t place = 0;
            while (place < ring.size() && t.other_end(ring[place], v) != columns[j]) ++place;
            out[place] += w[j];
        }
    }
    return matrix;
}

LimitMasks<High> semi_sharp_masks(const SchemeLevel& level, const SchemeOptions& options, Index v) {
    const auto part_around = [&](const SchemeLevel& whole, Index vertex) {
        const auto kept = vertices_to_keep(whole.topology, std::array{vertex}, options.creasing);
        return sublevel_around(whole.topology, whole.sharpness, kept);
    };
    SubLevel part = part_around(level, v);
    std::vector<std::vector<HighWeights>> steps;
    while (has_finite_sharpness(part.level.topology, part.level.sharpness, part.kept.front())) {
        const Step step = next_level(part.level, options).value();  // a ring is never too large
        steps.push_back(ring_matrix(part, step.rows, options.weights));
        part = part_around(step.child, part.kept.front());
    }
    LimitMasks<High> out =
        settled_masks(star_of(part.level.topology, part.level.sharpness, part.kept.front()), options.weights);
    const auto carry_back = [&](HighWeights& weights) {
        for (auto step = steps.rbegin(); step != steps.rend(); ++step) weights = over_parent(weights, *step);
        // What is 0 in truth may be left as noise.
        for (High& w : weights)
            if (abs(w) < High("1e-35")) w = 0;
    };
    carry_back(out.position);
    for (auto& sector : out.sectors) {
        carry_back(sector.tangent1);
        carry_back(sector.tangent2);
    }
    return out;
}

// -- The vertices of a level.

template <class Real>
LimitLevel limit_level(const SchemeLevel& level, const SchemeOptions& options,
                       std::span<const Point<Real>> positions) {
    LimitTable<Real> table(level, options);
    const std::vector<Real> none;
    LimitLevel out;
    for (Index v = 0; v < level.topology.vertex_count; ++v) {
        const LimitMasks<Real>& masks = table.masks(v);
        const auto add = [&](std::vector<glm::dvec3>& to, const std::vector<Real>& weights) {
            to.emplace_back(sum_over_ring<Real>(level.topology, v, weights, positions));
        };
        add(out.positions, masks.position);
        add(out.tangent1, masks.sectors.empty() ? none : masks.sectors.front().tangent1);
        add(out.tangent2, masks.sectors.empty() ? none : masks.sectors.front().tangent2);
    }
    return out;
}

}  // namespace

template <class Scalar>
LimitMasks<Scalar> limit_masks(const Star& star, Weights weights) {
    return rounded<Scalar>(settled_masks(star, weights));
}

DartTangent dart_tangent(int n, Weights weights) {
    const High b = ring_weight<High>(weights, n);
    const auto eigenvalue = [](const High& phi) { return High(High(3) / 8 + cos(phi) / 4); };
    // The equation times cos(n phi/2), which is 0 near the ends of the bracket.
    const auto residual = [&](const High& phi) {
        const High mu = eigenvalue(phi), half_turn = n * phi / 2;
        return High(8 * (mu - High(1) / 2) * (mu - High(5) / 8 + n * b) * cos(half_turn) -
                    b * sin(half_turn) / tan(High(phi / 2)));
    };
    std::uintmax_t iterations = 200;  // about 15 are used
    const int bits = std::numeric_limits<High>::digits - 2;
    const auto [low, high] =
        boost::math::tools::toms748_solve(residual, High(pi() / n), High(299 * pi() / (100 * n)),
                                          boost::math::tools::eps_tolerance<High>(bits), iterations);
    const High phi = (low + high) / 2;
    const High mu = eigenvalue(phi);
    DartTangent out{mu, no_weights(n)};
    High sum = 0;
    for (int i = 1; i < n; ++i) {
        out.weights[i] = b / (mu - High(5) / 8) * (1 - cos(phi * (i - High(n) / 2)) / cos(n * phi / 2));
        sum += out.weights[i];
    }
    out.weights[0] = 2 * (mu - 1 + n * b) - 3 * sum / 4;
    out.weights[n] = 1;
    return out;
}

template <class Scalar>
const LimitMasks<Scalar>& LimitTable<Scalar>::masks(Index v) {
    if (has_finite_sharpness(level_.topology, level_.sharpness, v)) {
        const auto found = semi_sharp_.find(v);
        if (found != semi_sharp_.end()) return found->second;
        return semi_sharp_.emplace(v, rounded<Scalar>(semi_sharp_masks(level_, options_, v))).first->second;
    }
    Star star = star_of(level_.topology, level_.sharpness, v);
    const auto found = by_star_.find(star);
    if (found != by_star_.end()) return found->second;
    auto masks = limit_masks<Scalar>(star, options_.weights);
    return by_star_.emplace(std::move(star), std::move(masks)).first->second;
}

template <class Real>
Result<Limits> limits(const TriangleMesh& mesh, const SchemeOptions& options, int levels) {
    const Precision precision = std::is_same_v<Real, float> ? Precision::Float : Precision::Double;
    if (auto error = check_fits(mesh, precision)) return tl::unexpected(*error);
    Limits out{precision, {}};
    auto positions = convert_points<Real>(mesh.positions());
    SchemeLevel level = control_level(mesh, options.boundary);
    for (int l = 0;; ++l) {
        out.levels.push_back(limit_level<Real>(level, options, positions));
        if (l == levels) return out;
        auto step = next_level(level, options);
        if (!step) return tl::unexpected(step.error());
        positions = apply<Real>(step->rows, options.weights, positions);
        level = std::move(step->child);
    }
}

template LimitMasks<float> limit_masks<float>(const Star&, Weights);
template LimitMasks<double> limit_masks<double>(const Star&, Weights);
template LimitMasks<HighPrecision> limit_masks<HighPrecision>(const Star&, Weights);
template class LimitTable<float>;
template class LimitTable<double>;
template class LimitTable<HighPrecision>;
template Result<Limits> limits<float>(const TriangleMesh&, const SchemeOptions&, int);
template Result<Limits> limits<double>(const TriangleMesh&, const SchemeOptions&, int);

}  // namespace loopcheck::core
