#include "core/loop/limit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "tests/support/models.h"
#include "tests/support/scheme_walk.h"

namespace loopcheck::core {
namespace {

using tests::Observed;

constexpr int kMostFaces = 64;

// Unit roundoff of a scalar.
template <class Scalar>
double roundoff() {
    return static_cast<double>(std::numeric_limits<Scalar>::epsilon()) / 2;
}

// Vertex 0 of a wheel or fan whose ring is 1, 2, ..., in the order of the topology: the place of vertex i is
// i - 1, that of vertex 0 the last.
struct LocalMesh {
    SchemeLevel level;
    SchemeOptions options;
    Star star;

    LocalMesh(MeshData data, const std::vector<Index>& sharp, bool pinned) {
        for (const Index i : sharp) data.creases.push_back({0, i, kInfiniteSharpness});
        if (pinned) data.corners.push_back({0, kInfiniteSharpness});
        options.boundary = BoundaryRule::EdgeOnly;
        level = control_level(tests::mesh_of(std::move(data)), options.boundary);
        star = star_of(level.topology, level.sharpness, 0);
    }
};

std::size_t place_of(Index vertex, const Star& star) {
    return vertex == 0 ? star.ring : static_cast<std::size_t>(vertex) - 1;
}

// The refinement of the ring and its vertex, from our own rows.
template <class Scalar>
std::vector<std::vector<Scalar>> ring_matrix(const LocalMesh& mesh) {
    const Step step = next_level(mesh.level, mesh.options).value();
    const auto table = weights_of<Scalar>(step.rows, mesh.options.weights);
    const auto ring = mesh.level.topology.ring(0);
    std::vector<std::vector<Scalar>> matrix;
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Index row = i < ring.size() ? mesh.level.topology.vertex_count + ring[i] : 0;
        auto& out = matrix.emplace_back(ring.size() + 1, Scalar(0));
        const auto columns = step.rows.columns_of(row);
        for (std::size_t j = 0; j < columns.size(); ++j)
            out[place_of(columns[j], mesh.star)] += table[step.rows.mask_of_row[row]][j];
    }
    return matrix;
}

template <class Scalar>
std::vector<Scalar> times(const std::vector<Scalar>& left, const std::vector<std::vector<Scalar>>& matrix) {
    std::vector<Scalar> out(left.size(), Scalar(0));
    for (std::size_t i = 0; i < left.size(); ++i)
        for (std::size_t j = 0; j < out.size(); ++j) out[j] += left[i] * matrix[i][j];
    return out;
}

// Every local situation that has a mask: (name, mesh), faces up to `most`.
void for_each_star(int most, const std::function<void(const std::string&, const LocalMesh&)>& visit) {
    for (int n = 2; n <= most; ++n) {
        visit(fmt::format("interior {}", n), {tests::wheel(n), {}, false});
        visit(fmt::format("dart {}", n), {tests::wheel(n), {n / 2 + 1}, false});
        visit(fmt::format("cone {}", n), {tests::wheel(n), {}, true});
    }
    for (int k = 1; k <= most; ++k) {
        visit(fmt::format("boundary {}", k), {tests::open_fan(k), {}, false});
        visit(fmt::format("corner {}", k), {tests::open_fan(k), {}, true});
        const int other = 1 + (7 * k) % 11;  // the faces of the sector on the other side
        visit(fmt::format("crease {} + {}", k, other), {tests::wheel(k + other), {1, k + 1}, false});
        visit(fmt::format("crease {} + {}, wrapping", k, other),
              {tests::wheel(k + other), {2, k + 2 > k + other ? 1 : k + 2}, false});
        visit(fmt::format("inner corner {} + {} + 1", k, other),
              {tests::wheel(k + other + 1), {1, k + 1, k + other + 1}, false});
    }
}

// The eigenvalue that belongs to a tangent.
HighPrecision wave_eigenvalue(int turns, int faces) {
    return HighPrecision(3) / 8 + cos(turns * boost::math::constants::pi<HighPrecision>() / faces) / 4;
}
std::array<HighPrecision, 2> tangent_eigenvalues(const Star& star, const Sector& sector) {
    const HighPrecision half = HighPrecision(1) / 2;
    switch (star.rule()) {
        case VertexRule::Smooth:
            return {wave_eigenvalue(2, star.ring), wave_eigenvalue(2, star.ring)};
        case VertexRule::Dart:
            return {dart_tangent(star.ring, Weights::Loop).eigenvalue, wave_eigenvalue(2, star.ring)};
        case VertexRule::Crease:
            return {half, sector.faces == 1 ? HighPrecision(1) / 4 : wave_eigenvalue(1, sector.faces)};
        case VertexRule::Corner:
            break;
    }
    return {half, half};
}

// l M = mu l, entry by entry, relative to the sum of |l|.
template <class Scalar>
void check_eigenvector(const std::vector<Scalar>& l, const std::vector<std::vector<Scalar>>& matrix,
                       const Scalar& mu, Observed& residual) {
    const auto image = times(l, matrix);
    Scalar size(0);
    for (const Scalar& x : l) size += x < 0 ? Scalar(-x) : x;
    for (std::size_t j = 0; j < l.size(); ++j) {
        const Scalar off = image[j] - mu * l[j];
        // A term of row i has the weights' error and the sum's roundings; l itself is rounded once.
        const double allowed = (static_cast<double>(l.size()) + kLoopWeightUlps + 3) * roundoff<Scalar>();
        residual.add(std::abs(static_cast<double>(off / size)) / allowed,
                     static_cast<std::int64_t>(l.size()));
    }
}

template <class Scalar>
void expect_left_eigenvectors(const char* what) {
    Observed position(fmt::format("|l M - l| / bound, position, {}", what), "ring of", 1);
    Observed tangents(fmt::format("|l M - mu l| / bound, tangents, {}", what), "ring of", 1);
    int with_normal = 0;
    for_each_star(kMostFaces, [&](const std::string& name, const LocalMesh& mesh) {
        const auto matrix = ring_matrix<Scalar>(mesh);
        const auto masks = limit_masks<Scalar>(mesh.star, Weights::Loop);
        check_eigenvector(masks.position, matrix, Scalar(1), position);
        Scalar sum(0);
        for (const Scalar& w : masks.position) sum += w;
        EXPECT_NEAR(static_cast<double>(Scalar(sum - 1)), 0,
                    static_cast<double>(masks.position.size()) * roundoff<Scalar>())
            << name;
        for (const auto& sector : masks.sectors) {
            if (sector.no_normal != NoNormal::None) {
                EXPECT_TRUE(sector.tangent1.empty() && sector.tangent2.empty()) << name;
                continue;
            }
            ++with_normal;
            const auto mu = tangent_eigenvalues(mesh.star, sector.sector);
            check_eigenvector(sector.tangent1, matrix, static_cast<Scalar>(mu[0]), tangents);
            check_eigenvector(sector.tangent2, matrix, static_cast<Scalar>(mu[1]), tangents);
        }
    });
    EXPECT_GT(with_normal, 4 * kMostFaces);
    position.check();
    tangents.check();
}

TEST(LimitMask, IsALeftEigenvectorOfOurRowsInDouble) {
    expect_left_eigenvectors<double>("double");
}

TEST(LimitMask, IsALeftEigenvectorOfOurRowsIn38Digits) {
    expect_left_eigenvectors<HighPrecision>("38 digits");
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

// Takes out of x what the left vectors see of it: afterwards dot(l, x) = 0 for each, which refinement keeps.
class Annihilator {
  public:
    void add(std::vector<double> l) {
        for (const auto& seen : orthonormal_) subtract(l, seen);
        const double size = std::sqrt(dot(l, l));
        for (double& x : l) x /= size;
        orthonormal_.push_back(std::move(l));
    }
    void apply(std::vector<double>& x) const {
        for (const auto& l : orthonormal_) subtract(x, l);
    }

  private:
    static void subtract(std::vector<double>& x, const std::vector<double>& unit) {
        const double part = dot(x, unit);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] -= part * unit[i];
    }
    std::vector<std::vector<double>> orthonormal_;
};

// How fast refinement shrinks what the given masks do not see: the largest other eigenvalue.
double largest_other_eigenvalue(const std::vector<std::vector<double>>& matrix, const Annihilator& seen) {
    std::vector<double> x(matrix.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::cos(1.7 * static_cast<double>(i * i) + 0.3);
    double shrink = 0;
    for (int step = 0; step < 3000; ++step) {
        seen.apply(x);
        const double size = std::sqrt(dot(x, x));
        std::vector<double> next(x.size(), 0);
        for (std::size_t i = 0; i < x.size(); ++i) next[i] = dot(matrix[i], x) / size;
        shrink = std::sqrt(dot(next, next));
        x = std::move(next);
    }
    return shrink;
}

// The masks are of the right eigenvalues: what they leave over shrinks faster than the tangents.  Sectors are
// independent, so only the first is looked at, and the masks of the others are taken out with it.
TEST(LimitMask, TangentsAreTheSlowestToShrink) {
    Observed ratio("largest other eigenvalue / smaller tangent eigenvalue", "faces", 1);
    for_each_star(24, [&](const std::string& name, const LocalMesh& mesh) {
        const auto masks = limit_masks<double>(mesh.star, Weights::Loop);
        if (mesh.star.rule() == VertexRule::Crease && !mesh.star.open)
            return;  // two sectors, the boundary has one
        if (mesh.star.rule() == VertexRule::Corner && masks.sectors.size() != 1) return;
        const auto& sector = masks.sectors.front();
        if (sector.no_normal != NoNormal::None || masks.position.size() == 3) return;  // of 3 nothing is left
        Annihilator seen;
        for (const auto* l : {&masks.position, &sector.tangent1, &sector.tangent2}) seen.add(*l);
        const auto mu = tangent_eigenvalues(mesh.star, sector.sector);
        const double other = largest_other_eigenvalue(ring_matrix<double>(mesh), seen);
        ratio.add(other / static_cast<double>(std::min(mu[0], mu[1])), sector.sector.faces);
        EXPECT_LT(other, static_cast<double>(std::min(mu[0], mu[1]))) << name;
    });
    ratio.check();
}

// Where the answer is "undefined", what would be tangents is not the slowest, or not alone.
TEST(NoNormal, IsSaidWhereAnotherEigenvalueWinsOrTies) {
    const auto competitor = [](const LocalMesh& mesh) {
        const auto masks = limit_masks<double>(mesh.star, Weights::Loop);
        Annihilator seen;
        seen.add(masks.position);
        // what the tangents of a crease or corner would be
        std::vector<double> along(masks.position.size(), 0), other = along;
        const int k = mesh.star.ring - 1;
        along[0] = 1;
        if (mesh.star.rule() == VertexRule::Crease) {
            along[k] = -1;
            for (int i = 1; i < k; ++i) other[i] = std::sin(i * std::acos(-1.0) / k);
            other[0] = other[k] = 0;
        } else {
            along[k + 1] = -1;
            other[k] = 1;
            other[k + 1] = -1;
        }
        seen.add(along);
        seen.add(other);
        return largest_other_eigenvalue(ring_matrix<double>(mesh), seen);
    };
    for (int k = 1; k <= 12; ++k) {
        const LocalMesh crease(tests::open_fan(k), {}, false), corner(tests::open_fan(k), {}, true);
        const auto reason = [](const LocalMesh& mesh) {
            return no_normal(mesh.star, mesh.star.sectors().front());
        };
        EXPECT_EQ(reason(crease), k < 6    ? NoNormal::None
                                  : k == 6 ? NoNormal::SlowCrease
                                           : NoNormal::FoldedCrease);
        EXPECT_EQ(reason(corner), k < 3    ? NoNormal::None
                                  : k == 3 ? NoNormal::SlowCorner
                                           : NoNormal::FoldedCorner);
        const auto wave = [&](int j) { return 3.0 / 8 + std::cos(j * std::acos(-1.0) / k) / 4; };  // j < k
        EXPECT_EQ(k > 2 && wave(2) > 0.5 + 1e-12, reason(crease) == NoNormal::FoldedCrease) << k;
        EXPECT_EQ(k > 1 && wave(1) > 0.5 + 1e-12, reason(corner) == NoNormal::FoldedCorner) << k;
        // At a tie the power iteration approaches 1/2 like 1/steps.
        if (reason(corner) != NoNormal::None) {
            EXPECT_GT(competitor(corner), 0.5 - 1e-3) << k;
        }
    }
}

TEST(NoNormal, HasASentenceForEveryReason) {
    EXPECT_EQ(sentence(NoNormal::None), "");
    for (int i = 1; i <= static_cast<int>(NoNormal::FoldedCorner); ++i)
        EXPECT_TRUE(sentence(static_cast<NoNormal>(i)).ends_with('.')) << i;
}

TEST(LimitMask, HasTheFractionsOfTheLiterature) {
    const auto position = [](const LocalMesh& mesh) {
        return limit_masks<double>(mesh.star, Weights::Loop).position;
    };
    EXPECT_EQ(position({tests::wheel(6), {}, false}),
              (std::vector<double>{1.0 / 12, 1.0 / 12, 1.0 / 12, 1.0 / 12, 1.0 / 12, 1.0 / 12, 1.0 / 2}));
    EXPECT_EQ(position({tests::wheel(3), {}, false}),
              (std::vector<double>{1.0 / 5, 1.0 / 5, 1.0 / 5, 2.0 / 5}));
    EXPECT_EQ(position({tests::open_fan(3), {}, false}),
              (std::vector<double>{1.0 / 6, 0, 0, 1.0 / 6, 2.0 / 3}));
    EXPECT_EQ(position({tests::open_fan(3), {}, true}), (std::vector<double>{0, 0, 0, 0, 1}));
    EXPECT_EQ(position({tests::wheel(6), {1}, false}),
              (std::vector<double>{7.0 / 71, 29.0 / 426, 35.0 / 426, 6.0 / 71, 35.0 / 426, 29.0 / 426,
                                   110.0 / 213}));
    EXPECT_EQ(position({tests::wheel(3), {1}, false}),
              (std::vector<double>{9.0 / 37, 6.0 / 37, 6.0 / 37, 16.0 / 37}));
}

TEST(LimitMask, IsRoundedOnceFromThirtyEightDigits) {
    for_each_star(12, [](const std::string& name, const LocalMesh& mesh) {
        const auto exact = limit_masks<HighPrecision>(mesh.star, Weights::Loop).position;
        const auto in_double = limit_masks<double>(mesh.star, Weights::Loop).position;
        const auto in_float = limit_masks<float>(mesh.star, Weights::Loop).position;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            EXPECT_EQ(in_double[i], static_cast<double>(exact[i])) << name;
            EXPECT_EQ(in_float[i], static_cast<float>(exact[i])) << name;
        }
    });
}

// kLimitWeightUlps is for those who compute in double from a refinement weight that is already rounded.
TEST(LimitMask, ADirectFormulaIsWithinItsBound) {
    Observed relative("error of w = 1/(n + 3/(8b)) and 1 - n w in double, units of roundoff", "valence",
                      kLimitWeightUlps);
    const int most = tests::is_short_run() ? 200 : 1000;
    for (int n = 2; n <= most; ++n) {
        const Star star{n, false, false, {}};
        const auto exact = limit_masks<HighPrecision>(star, Weights::Loop).position;
        const double w = 1 / (n + 3 / (8 * loop_weight<double>(n)));
        const double centre = 1 - n * w;
        const auto add = [&](double got, const HighPrecision& wanted) {
            relative.add(
                tests::error_of_value(got, wanted) / static_cast<double>(wanted) / roundoff<double>(), n, got,
                static_cast<double>(wanted));
        };
        add(w, exact[0]);
        add(centre, exact[n]);
    }
    relative.check();
}

TEST(DartTangent, IsRegularAtValenceSix) {
    const DartTangent dart = dart_tangent(6, Weights::Loop);
    const double allowed = 64 * roundoff<HighPrecision>();  // a root to 2 bits less than all, and 12 sums
    EXPECT_NEAR(static_cast<double>(dart.eigenvalue - HighPrecision(1) / 2), 0, allowed);
    const std::array wanted{2.0, -0.25, -0.75, -1.0, -0.75, -0.25, 1.0};
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_NEAR(static_cast<double>(dart.weights[i] - wanted[i]), 0, allowed) << i;
}

TEST(DartTangent, ExistsForEveryValenceAndBothWeights) {
    for (const Weights weights : {Weights::Loop, Weights::Warren})
        for (const int n : {3, 4, 5, 6, 7, 31, 64, 360, 1000}) {
            const DartTangent dart = dart_tangent(n, weights);
            HighPrecision sum = 0, size = 0;
            for (const auto& w : dart.weights) {
                sum += w;
                size += abs(w);
            }
            EXPECT_LT(static_cast<double>(abs(sum) / size), (n + 64) * roundoff<HighPrecision>()) << n;
            EXPECT_GT(dart.eigenvalue, HighPrecision(3) / 8) << n;
            EXPECT_LT(dart.eigenvalue, HighPrecision(5) / 8) << n;
        }
}

// -- On whole meshes.

class LimitOfEveryModel : public testing::TestWithParam<std::string> {};

// The limit of a vertex at a level is that of its vertex point at the next, in 38 digits: position and plane.
TEST_P(LimitOfEveryModel, DoesNotChangeFromLevelToLevel) {
    const auto model = tests::load_model(GetParam());
    const auto steps = tests::steps_of(model.mesh, model.options, 4);
    const auto exact = tests::positions_of<HighPrecision>(steps, model.options.weights, model.mesh);
    const double size = model.mesh.largest_coordinate();
    // About 10 products of a row and a limit mask, each of at most 1100 terms of up to M.
    const double allowed = 1e4 * roundoff<HighPrecision>();
    Observed moved(model.name + ": limit from level to level, over M", "vertex", allowed);
    SchemeLevel control = control_level(model.mesh, model.options.boundary);
    for (std::size_t l = 0; l + 1 < exact.size(); ++l) {
        const SchemeLevel& here = l == 0 ? control : steps[l - 1].child;
        LimitTable<HighPrecision> table(here, model.options), next(steps[l].child, model.options);
        const auto limit = [](const SchemeLevel& level, Index v, const std::vector<HighPrecision>& weights,
                              const Points<HighPrecision>& points) {
            Vec3<HighPrecision> sum{};
            const auto ring = level.topology.ring(v);
            for (std::size_t i = 0; i < weights.size(); ++i) {
                const auto& p = points[i < ring.size() ? level.topology.other_end(ring[i], v) : v];
                sum = {sum.x + weights[i] * p.x, sum.y + weights[i] * p.y, sum.z + weights[i] * p.z};
            }
            return sum;
        };
        for (Index v = 0; v < here.topology.vertex_count; ++v) {
            const auto a = limit(here, v, table.masks(v).position, exact[l]);
            const auto b = limit(steps[l].child, v, next.masks(v).position, exact[l + 1]);
            for (const HighPrecision& d :
                 {HighPrecision(a.x - b.x), HighPrecision(a.y - b.y), HighPrecision(a.z - b.z)})
                moved.add(std::abs(static_cast<double>(d)) / size, v);
        }
    }
    moved.check();
}

// Refinement goes where the mask says: what is left shrinks by the largest eigenvalue there is, 5/8, or
// faster.
TEST_P(LimitOfEveryModel, IsWhereRefinementGoes) {
    const auto model = tests::load_model(GetParam());
    constexpr int kLevels = 5;
    const auto refined = refine<double>(model.mesh, model.options, kLevels).value();
    const auto limit = limits<double>(model.mesh, model.options, 0).value().levels.front().positions;
    const SchemeLevel control = control_level(model.mesh, model.options.boundary);
    // At level 0 the distance is at most 2 M.
    Observed distance(model.name + ": distance from the limit at level 5, over M", "vertex",
                      2 * std::pow(0.625, kLevels));
    for (Index v = 0; v < model.mesh.vertex_count(); ++v)
        for (int i = 0; i < 3; ++i)
            if (!has_finite_sharpness(control.topology, control.sharpness, v))
                distance.add(std::abs(refined.levels[kLevels].positions[v][i] - limit[v][i]) /
                                 model.mesh.largest_coordinate(),
                             v);
    distance.check();
}

INSTANTIATE_TEST_SUITE_P(Models, LimitOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

}  // namespace
}  // namespace loopcheck::core
