#include "compare/curve/carrier.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace loopcheck::compare {
namespace {

using core::Index;

constexpr std::array kOpen{CarrierKind::StripWithCorners, CarrierKind::StripOneFace};
constexpr std::array kClosed{CarrierKind::Rim, CarrierKind::Crease};

// Joins two rows of vertices, which begin at `below` and `above`, by triangles.  A square is cut from its
// lower left corner where rises(i) is true, else from its lower right.
template <class Rises>
void add_band(core::MeshData& data, Index below, Index above, Index length, bool closed, Rises rises) {
    for (Index i = 0; i + (closed ? 0 : 1) < length; ++i) {
        const Index j = (i + 1) % length;
        const std::array corners{below + i, below + j, above + j, above + i};
        const auto add = [&](int a, int b, int c) {
            data.add_face(core::Triangle{corners[a], corners[b], corners[c]});
        };
        if (rises(i)) {
            add(0, 1, 2);
            add(0, 2, 3);
        } else {
            add(0, 1, 3);
            add(1, 2, 3);
        }
    }
}

// The polygon, and copies of it beside.
void add_rows(core::MeshData& data, std::span<const glm::dvec3> points, std::span<const double> aside) {
    for (const double offset : aside)
        for (const glm::dvec3& p : points) data.positions.push_back({p.x, p.y, p.z + offset});
}

}  // namespace

std::string_view name(CarrierKind kind) {
    switch (kind) {
        case CarrierKind::StripWithCorners:
            return "boundary of a strip, sharp ends";
        case CarrierKind::StripOneFace:
            return "boundary of a strip, ends of one face";
        case CarrierKind::Rim:
            return "rim of an annulus";
        case CarrierKind::Crease:
            return "crease inside an annulus";
    }
    return "unknown";
}

std::span<const CarrierKind> carriers_for(core::Ends ends) {
    if (ends == core::Ends::Natural) return kOpen;
    if (ends == core::Ends::Closed) return kClosed;
    return {};
}

core::Result<Carrier> make_carrier(CarrierKind kind, std::span<const glm::dvec3> points) {
    if (points.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max() / 8))
        return core::fail(core::ErrorCode::TooLarge, "There are too many points for a mesh.");
    const auto n = static_cast<Index>(points.size());
    core::MeshData data;
    core::SchemeOptions options{.boundary = core::BoundaryRule::EdgeOnly};
    switch (kind) {
        case CarrierKind::StripWithCorners:
            add_rows(data, points, std::array{0.0, 1.0});
            add_band(data, 0, n, n, false, [](Index) { return true; });
            data.corners = {{0, core::kInfiniteSharpness}, {n - 1, core::kInfiniteSharpness}};
            break;
        case CarrierKind::StripOneFace:
            options.boundary = core::BoundaryRule::EdgeAndCorner;
            if (n == 2) {  // one square has two faces at one of its lower corners
                data.positions = {points[0], points[1], points[0] + glm::dvec3(0, 0, 1)};
                data.add_face(core::Triangle{0, 1, 2});
            } else {
                add_rows(data, points, std::array{0.0, 1.0});
                add_band(data, 0, n, n, false, [n](Index i) { return i >= n / 2; });
            }
            break;
        case CarrierKind::Rim:
            add_rows(data, points, std::array{0.0, 1.0});
            add_band(data, 0, n, n, true, [](Index) { return true; });
            break;
        case CarrierKind::Crease:
            add_rows(data, points, std::array{0.0, 1.0, -1.0});
            add_band(data, 0, n, n, true, [](Index) { return true; });
            add_band(data, 2 * n, 0, n, true, [](Index) { return true; });
            for (Index i = 0; i < n; ++i) data.creases.push_back({i, (i + 1) % n, core::kInfiniteSharpness});
            break;
    }
    auto mesh = core::TriangleMesh::make(std::move(data));
    if (!mesh) return tl::unexpected(mesh.error());
    Carrier out{std::move(*mesh), options, kind == CarrierKind::Rim || kind == CarrierKind::Crease, {}};
    out.polygon.resize(points.size());
    std::iota(out.polygon.begin(), out.polygon.end(), 0);
    return out;
}

core::Result<std::vector<Index>> refined_polygon(std::span<const Index> polygon, bool closed,
                                                 const core::RefinedLevel& parent,
                                                 const core::RefinedLevel& child) {
    const auto n = static_cast<Index>(polygon.size());
    std::vector<Index> place(parent.positions.size(), core::kNone);
    for (Index i = 0; i < n; ++i) place[polygon[i]] = i;
    std::vector<Index> out(closed ? 2 * polygon.size() : 2 * polygon.size() - 1, core::kNone);
    bool twice = false;
    const auto found = [&](Index at, Index vertex) {
        twice = twice || out[at] != core::kNone;
        out[at] = vertex;
    };
    for (Index v = 0; v < static_cast<Index>(child.ancestors.size()); ++v) {
        const core::Ancestor& from = child.ancestors[v];
        if (from.kind == core::Ancestor::Kind::Vertex) {
            if (place[from.index] != core::kNone) found(2 * place[from.index], v);
            continue;
        }
        const core::Triangle& face = parent.triangles[from.index / 3];
        const Index a = place[face[from.index % 3]], b = place[face[core::next_corner(from.index % 3)]];
        if (a == core::kNone || b == core::kNone) continue;
        if (std::abs(a - b) == 1)
            found(2 * std::min(a, b) + 1, v);
        else if (closed && std::abs(a - b) == n - 1)
            found(2 * n - 1, v);
    }
    if (twice || std::find(out.begin(), out.end(), core::kNone) != out.end())
        return core::fail(core::ErrorCode::SubjectFailed,
                          "Its ancestry does not lead from the control polygon to the refined one.");
    return out;
}

}  // namespace loopcheck::compare
