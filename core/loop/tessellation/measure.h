// How far the limit surface is from a tessellation, by looking.
#pragma once

#include <cstddef>
#include <limits>

#include "core/loop/tessellation/tessellate.h"
#include "core/mesh/surface.h"

namespace loopcheck::core {

/// What was found at many points of the surface.
struct MeasuredDistance {
    double largest = 0;
    SurfaceLocation at;
    /// The largest of distance - bound of its triangle: not above 0 but for rounding.
    double excess = -std::numeric_limits<double>::infinity();
    std::size_t samples = 0;
};

/// The distances from points of the limit surface to the tessellation.
///
/// Over every triangle the surface is evaluated at the points with barycentric coordinates i/n, j/n, k/n, and
/// the nearest of the triangles that share a vertex with it is sought: among these the bound promises one.
///
/// Range    n >= 1.
/// Requires the mesh and the options that the tessellation was made of.
MeasuredDistance measure(const TriangleMesh& mesh, const SchemeOptions& options,
                         const Tessellation& tessellation, int n);

}  // namespace loopcheck::core
