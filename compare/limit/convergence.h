// How the vertices of a refinement approach their limits.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compare/witness.h"

namespace loopcheck::compare {

/// The vertices of one class at one level, against their own limits; all by the exact rules.
struct ConvergencePoint {
    core::VertexClass vertex_class;
    int level = 0;
    std::size_t vertices = 0;
    /// Largest |p - limit of p|, model units; 0 where it is below 2^-90 M, which is rounding.
    double distance = 0;
    std::optional<double> factor;  ///< `convergence_factor`
};

/// A point a level and class, for levels 0 to `levels` - 1.
std::vector<ConvergencePoint> convergence(const Witness& witness, int levels);

/// The factor by which the largest distance of a class from its limits shrinks a level in the end, on a mesh
/// whose last known level is `level`; nothing where it is not known.
///
///     interior n, n not 6    5/8 - n b(n)                                 (Loop: (3/8 + cos(2 pi/n)/4)^2)
///     boundary, crease       1/4
///     interior 6             the largest of 1/4 and, of every valence n that occurs, 3/8 + cos(2 pi/n)/4
///
/// Proof
///   * Let m be the mean of the ring of a smooth interior vertex v.  Its vertex point is (1 - n b) v + n b m,
///     the mean of its edge points 3/8 v + 5/8 m: their difference v - m, and with it the distance from the
///     limit, which is a point between the two, shrinks by 5/8 - n b at each level.
///   * On a crease or boundary the vertices are a cubic B-spline; v - (a + 4 v + c)/6 is a sixth of a second
///     difference, and second differences of the next level are averages of a quarter of these.
///   * A regular vertex keeps to 1/4 itself, but new ones come near an irregular vertex at each level.  Their
///     rings there are scaled by the subdominant eigenvalue 3/8 + cos(2 pi/n)/4 of its ring, whose
///     eigenvectors are no linear functions of a regular ring: what is left of them in p - limit does not
///     vanish.  At n = 6 they are linear, it vanishes, and the next eigenvalue is 1/4.
///
/// Range   nothing for darts, corners, isolated and semi-sharp vertices; for crease where there is a dart;
///         for interior 6 where something but smooth vertices, and creases and boundaries with 3 faces on
///         each side, is left.
std::optional<double> convergence_factor(core::VertexClass vertex_class, const core::SchemeLevel& level,
                                         core::Weights weights);

}  // namespace loopcheck::compare
