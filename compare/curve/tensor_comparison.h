// Bicubic B-spline surfaces against OpenSubdiv's Catmull-Clark scheme, which on a grid of quads is the same.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/statistics.h"
#include "core/bspline/tensor_surface.h"
#include "reference/opensubdiv/catmull_clark.h"

namespace loopcheck::compare {

/// What is done with a grid.
struct TensorCase {
    core::Ends u = core::Ends::Natural, v = core::Ends::Natural;  ///< Natural or Closed
    int levels = 3;
    core::Precision precision = core::Precision::Double;
    core::BoundaryRule boundary = core::BoundaryRule::EdgeAndCorner;  ///< of OpenSubdiv
};

/// One quantity at all vertices of a level, the largest of each.  NaN where there was one.
struct TensorMeasure {
    double difference = 0;        ///< |ours - OpenSubdiv's|
    double ours_error = 0;        ///< |ours - exact|
    double opensubdiv_error = 0;  ///< |OpenSubdiv's - exact|
    double ours_bound = 0;        ///< of ours_error, by rounding alone
    double opensubdiv_bound = 0;
    double bound_use = 0;  ///< error / bound, of either side: above 1 the surfaces differ
};

/// Positions in model units, per coordinate; normals in radians, 0 to pi.
struct TensorLevel {
    int level = 0;
    std::size_t vertices = 0;
    TensorMeasure position, limit, normal;
    std::size_t normals = 0;  ///< that were compared: rounding alone could turn the others anywhere
};

struct TensorComparison {
    Verdict verdict = Verdict::Identical;  ///< or WithinRounding, Differs, or Failed
    std::string note;                      ///< why it is Differs or Failed, in a sentence
    std::vector<TensorLevel> levels;       ///< from 0
};

/// Peak memory of `compare_tensor`, in bytes per vertex of the last level, and per row and column there, each
/// of which has basis functions in 38 digits.  A test measures it.
inline constexpr double kGridBytesPerVertex = 950, kGridBytesPerLine = 5000;

/// The grid as quads: vertex i columns + j is point (i, j), and du x dv points out of the faces.
core::MeshData quad_mesh(const core::Grid<glm::dvec3>& grid, core::Ends u, core::Ends v);

/// Roundings a level of OpenSubdiv's masks: three in a face point, a sum of four, and eight in a vertex
/// point, a sum of nine that begins with a face point.  Their weights are powers of two.  On creases, with
/// 3/4, two.
inline constexpr int kCatmullClarkStepRoundings = 11;

/// Error of a position at a level by rounding, M being the largest |coordinate| of the grid, k the roundings
/// a level, t the smallest positive number.
///
///     rounding_of(k level) M + 8 t level
///
/// Proof   The weights are exact, not negative and sum to 1, and every product of them down to level 0 meets
///         at most k level roundings.  A vertex is at most 13 products, 9 and 4 of a face point, each of
///         which may lose t / 2 to underflow, and what was lost before is averaged.
double position_bound(double largest, int level, int roundings, core::Precision precision);

/// Error of a limit position whose level is off by `before`:
///
///     before + growth rounding_of(k) (M + before) + 8 t
///
/// Proof   The mask is one of averages, so what was off before is averaged.  OpenSubdiv adds up nine products
///         of weights rounded once, in float twice: k = 11, growth 1.  Ours are two masks one after the other
///         that see 2 c_0 - c_1 beyond an end, each with a phantom, a weight, a product and two sums: k = 10,
///         and the absolute values sum to 3/6 + 4/6 + 1/6 = 4/3 each, growth 16/9.
double limit_bound(double largest, double before, double growth, int roundings, core::Precision precision);

/// Error of a coordinate of a tangent, in units in which it is the derivative with respect to the parameter
/// of its level:
///
///     2 before + growth rounding_of(10) (M + before) + 8 t
///
/// Proof   The longest mask is c_1 - c_0, at an end: 2.  Ours see it as -(2 c_0 - c_1)/2 + c_1/2 times the
///         other direction's 4/3: growth 8/3.  OpenSubdiv's are in these units but for a factor 12 inside:
///         1 there, and 2 at most at an end, of at most nine terms with one rounded weight.
double tangent_bound(double largest, double before, double growth, core::Precision precision);

/// Subdivides a grid by ourselves and by OpenSubdiv, pairs vertices by ancestry and compares positions, limit
/// positions and limit normals with each other and with the exact ones, at all levels from 0.
///
/// Exact are the positions of our rules in 38 digits, and, for limits, the surface of level 0 evaluated at
/// the vertex's parameters.
///
/// With EdgeAndCorner they are the same surface: inside, at boundaries and at corners, in position, limit and
/// tangent plane.  OpenSubdiv's tangents are the derivatives, 12 times as long inside and as long at the rim:
/// a grid has no irregular vertex, and at regular ones its masks are right.
/// EdgeOnly is the same where no vertex has just one face; else OpenSubdiv moves a corner c to
/// (6 c + a + b)/8, a and b its neighbours, where a natural end keeps it.
///
/// Errors   those of `TensorSurface::make` and `opensubdiv_catmull_clark`; Unsupported where an
///          end is Open or Clamped.
core::Result<TensorComparison> compare_tensor(const core::Grid<glm::dvec3>& grid, const TensorCase& what);

/// The same with a refinement made before, of this grid; its precision is that of ours.
core::Result<TensorComparison> compare_tensor(const core::Grid<glm::dvec3>& grid, core::Ends u, core::Ends v,
                                              const reference::CatmullClark& theirs);

}  // namespace loopcheck::compare
