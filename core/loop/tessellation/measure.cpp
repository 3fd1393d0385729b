#include "core/loop/tessellation/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/loop/evaluate.h"
#include "core/loop/tessellation/deviation.h"
#include "core/loop/tessellation/fans.h"

namespace loopcheck::core {
namespace {

double nearest(const glm::dvec3& point, const std::vector<PlacedTriangle>& triangles) {
    double distance = std::numeric_limits<double>::infinity();
    for (const PlacedTriangle& triangle : triangles)
        distance = std::min(distance, distance_to(triangle, point));
    return distance;
}

// The parameter with barycentric coordinates i/n, j/n and the rest over n.
SurfaceLocation sample_of(const TessellationTriangle& triangle, int i, int j, int n) {
    const auto& [a, b, c] = triangle.parameters;
    const auto mean = [&](int axis) {
        return std::clamp((i * a[axis] + j * b[axis] + (n - i - j) * c[axis]) / n, 0.0, 1.0);
    };
    const double u = mean(0);
    return {triangle.face, u, std::min(mean(1), 1 - u)};  // rounding must not leave the face
}

}  // namespace

MeasuredDistance measure(const TriangleMesh& mesh, const SchemeOptions& options,
                         const Tessellation& tessellation, int n) {
    const int exponent = std::ilogb(mesh.largest_coordinate());  // as in `tessellate`
    std::vector<glm::dvec3> control;
    for (const glm::dvec3& p : mesh.positions()) control.push_back(times_power_of_two(p, -exponent));
    std::vector<Triangle> triangles;
    std::vector<PlacedTriangle> placed;
    for (const TessellationTriangle& t : tessellation.triangles) {
        const auto at = [&](int i) {
            return times_power_of_two(tessellation.positions[t.vertices[i]], -exponent);
        };
        triangles.push_back(t.vertices);
        placed.push_back(placed_triangle({at(0), at(1), at(2)}));
    }
    const Fans fans(tessellation.positions.size(), triangles);
    LimitSurface<double> surface(mesh, options);
    MeasuredDistance out;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::vector<PlacedTriangle> star;
        for (const Index s : fans.star(static_cast<Index>(t))) star.push_back(placed[s]);
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j) {
                const SurfaceLocation at = sample_of(tessellation.triangles[t], i, j, n);
                const auto stencil = surface.stencil(at.face, at.u, at.v).value();
                const double distance = std::ldexp(
                    nearest(apply<double>(stencil, control).at(Derivative::Position), star), exponent);
                ++out.samples;
                out.excess = std::max(out.excess, distance - tessellation.triangles[t].bound);
                if (distance <= out.largest) continue;
                out.largest = distance;
                out.at = at;
            }
    }
    return out;
}

}  // namespace loopcheck::core
