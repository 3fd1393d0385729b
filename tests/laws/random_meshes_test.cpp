// Meshes that are in no file: random triangulations with random sharpness, compared with every peer.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "compare/referee.h"
#include "tests/support/models.h"

namespace loopcheck::compare {
namespace {

using core::Index;

// The engine's output is fixed by the standard; the distributions are not, so none is used.
using Random = std::mt19937;

double coordinate(Random& random) {
    return static_cast<double>(random()) / 0x1p31 - 1;
}

void add_points(core::MeshData& data, int count, Random& random) {
    for (int i = 0; i < count; ++i) {
        const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
        data.positions.emplace_back(x, y, z);
    }
}

void add_triangle(core::MeshData& data, Index a, Index b, Index c, Random& random) {
    std::array<Index, 3> triangle{a, b, c};
    std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
    data.add_face(triangle);
}

// A closed bipyramid, an open grid with random diagonals, or a torus with random diagonals.
core::MeshData random_shape(Random& random) {
    core::MeshData data;
    const int kind = static_cast<int>(random() % 3);
    if (kind == 0) {
        const int n = 3 + static_cast<int>(random() % 12);
        add_points(data, n + 2, random);
        for (Index i = 0; i < n; ++i) {
            add_triangle(data, i, (i + 1) % n, n, random);
            add_triangle(data, (i + 1) % n, i, n + 1, random);
        }
        return data;
    }
    const bool wraps = kind == 2;
    const int least = wraps ? 3 : 1;
    const int columns = least + static_cast<int>(random() % 4), rows = least + static_cast<int>(random() % 4);
    const int width = wraps ? columns : columns + 1, height = wraps ? rows : rows + 1;
    add_points(data, width * height, random);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Index a = y * width + x, b = y * width + (x + 1) % width;
            const Index c = (y + 1) % height * width + x, d = (y + 1) % height * width + (x + 1) % width;
            if (random() % 2 == 0) {
                add_triangle(data, a, b, d, random);
                add_triangle(data, a, d, c, random);
            } else {
                add_triangle(data, a, b, c, random);
                add_triangle(data, b, d, c, random);
            }
        }
    return data;
}

void add_sharpness(core::MeshData& data, const core::Topology& topology, Random& random) {
    constexpr std::array<float, 10> kSharpness{0.05F, 0.3F, 0.5F, 1, 1.2F, 1.5F, 2.5F, 3, 7.75F, 10};
    for (const auto& [a, b] : topology.edge_ends)
        if (random() % 3 == 0) data.creases.push_back({a, b, kSharpness[random() % kSharpness.size()]});
    for (Index v = 0; v < topology.vertex_count; ++v)
        if (random() % 6 == 0) data.corners.push_back({v, kSharpness[random() % kSharpness.size()]});
}

class RandomMeshes : public testing::TestWithParam<unsigned> {};

TEST_P(RandomMeshes, AgreeWithEveryPeer) {
    Random random(GetParam());
    const auto subjects = built_in_subjects();
    std::size_t identical = 0, deviations = 0, within = 0, limit_deviations = 0;
    for (int trial = 0; trial < 60; ++trial) {
        core::MeshData data = random_shape(random);
        auto mesh = core::TriangleMesh::make(data);
        ASSERT_TRUE(mesh) << core::to_string(mesh.error());
        if (trial % 3 != 0) {
            add_sharpness(data, mesh->topology(), random);
            mesh = core::TriangleMesh::make(data);
            ASSERT_TRUE(mesh) << core::to_string(mesh.error());
        }
        core::SchemeOptions options;
        options.boundary = static_cast<core::BoundaryRule>(random() % 3);
        options.creasing = static_cast<core::Creasing>(random() % 2);
        Referee referee(*mesh, options, tests::levels_up_to(4));
        for (const Subject& peer : subjects) {
            if (peer.family == "ours") continue;
            const Subject* ours = in_precision(subjects, *find_subject(subjects, "ours"), peer.precision);
            const Comparison c = referee.judge(*ours, peer);
            identical += c.verdict == Verdict::Identical ? 1 : 0;
            deviations += c.verdict == Verdict::KnownDeviation ? 1 : 0;
            within += c.verdict == Verdict::WithinRounding ? 1 : 0;
            const bool right =
                peer.family == "opensubdiv"
                    ? c.verdict == Verdict::Identical || c.verdict == Verdict::KnownDeviation
                    : c.verdict <= Verdict::WithinRounding || c.verdict == Verdict::NotSupported;
            if (peer.limit) {
                const LimitComparison limits = referee.judge_limits(*ours, peer);
                limit_deviations += limits.verdict == Verdict::KnownDeviation ? 1 : 0;
                EXPECT_LE(limits.verdict, Verdict::KnownDeviation) << fmt::format(
                    "trial {}: limits of {}: {}", trial, peer.name, fmt::join(limits.notes, "\n"));
            }
            EXPECT_TRUE(right) << fmt::format("trial {}: {} against {}: {} {}", trial, c.subject, c.reference,
                                              name(c.verdict), c.notes.empty() ? "" : c.notes.front());
        }
    }
    fmt::print("{} identical, {} within rounding, {} known deviations; {} of limits\n", identical, within,
               deviations, limit_deviations);
    EXPECT_GT(limit_deviations, 60U);
    EXPECT_GT(identical, 60U);
    EXPECT_GT(deviations, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMeshes, testing::Range(1U, 5U));

}  // namespace
}  // namespace loopcheck::compare
