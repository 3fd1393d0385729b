#include "bench/support/agreement.h"

#include <fmt/format.h>

#include <cmath>

#include "core/loop/lattice/split_order.h"
#include "core/mesh/rounding.h"

namespace loopcheck::bench {

double allowed_distance(const core::TriangleMesh& mesh, int level, core::Precision precision) {
    constexpr int kEachLevel = 2 * (15 + 7), kRow = 2 * 64;
    return core::rounding_of(kEachLevel * level + kRow, precision) * mesh.largest_coordinate();
}

std::vector<core::Index> split_numbers(const core::TriangleMesh& mesh, int level) {
    const core::LatticeOrder order(mesh.topology(), level);
    const core::SplitOrder split(mesh.topology(), level);
    std::vector<core::Index> out(static_cast<std::size_t>(order.vertex_count()));
    for (std::size_t v = 0; v < out.size(); ++v)
        out[v] = static_cast<core::Index>(split.vertex(order.address_of(static_cast<std::int64_t>(v))));
    return out;
}

std::string distances(std::string_view what, std::span<const glm::dvec3> points,
                      std::span<const glm::dvec3> expected, double allowed) {
    if (points.size() != expected.size())
        return fmt::format("{}: {}, expected are {}", what, points.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int d = 0; d < 3; ++d)
            if (const double distance = std::abs(points[i][d] - expected[i][d]); !(distance <= allowed))
                return fmt::format("{}: number {} is off by {:.3g}, allowed are {:.3g}", what, i, distance,
                                   allowed);
    return {};
}

}  // namespace loopcheck::bench
