// Whether two results are the same but for rounding.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/mesh/point.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::bench {

template <class Real>
constexpr core::Precision kPrecisionOf =
    std::is_same_v<Real, float> ? core::Precision::Float : core::Precision::Double;

/// How far apart the coordinates of two results of `level` refinements may be.
///
/// Each refinement is in both a sum of at most 15 terms (a vertex of valence 14) with weights right to 7
/// roundings; then, at most once, comes a row of up to 64 terms: a stencil, the mask of a limit, or a patch.
double allowed_distance(const core::TriangleMesh& mesh, int level, core::Precision precision);

/// By vertex of a level in the order of core/loop/lattice, its number in that of `split`, which is
/// OpenSubdiv's.
std::vector<core::Index> split_numbers(const core::TriangleMesh& mesh, int level);

/// What is wrong with `points`, called `what`, next to what is expected; empty where nothing is.
std::string distances(std::string_view what, std::span<const glm::dvec3> points,
                      std::span<const glm::dvec3> expected, double allowed);

}  // namespace loopcheck::bench
