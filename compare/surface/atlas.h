// The atlas: how far an approximation of the limit surface is off at each class of vertex, for any geometry.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compare/surface/corner_class.h"
#include "compare/surface/evaluator.h"
#include "compare/surface/row_difference.h"

namespace loopcheck::compare {

/// The largest error at a vertex of one class, at one level of approximation, in weights: where the control
/// points lie in [-1, 1], `largest` is the largest error of a coordinate.
struct AtlasError {
    /// By order: sum_j |w_j - exact w_j|, derivatives with respect to the parameters of a face of the control
    /// mesh, whichever of its corners the vertex is.
    ByOrder largest{};
    /// By order: the same over the sum of |exact w_j|, for derivatives of the longest of that order.  In the
    /// half of the last patch that is farther from the vertex: near an irregular vertex exact derivatives
    /// vanish or grow without bound.
    ByOrder relative{};
    /// By order: |sum_j (w_j - exact w_j)|; more than rounding where the surface does not move with its
    /// control points.
    ByOrder unbalance{};
    ByOrder rounding{};  ///< by order: what rounding explains of `largest`

    bool is_rounding() const { return largest[0] <= rounding[0]; }
};

/// Measures it on `local_mesh(c)` with smooth and sharp level as in `settings`, over all faces at the vertex
/// and the parameters of `crowded_parameters(sharp_level + kAtlasOctaves)` with the vertex itself.
/// Derivatives count inside the patch of the last level around the vertex only, and not at the vertex itself.
///
/// Errors   Unsupported where there is no local mesh, or more than kMostLocalFaces faces at the vertex that
/// are
///          not alike; those of `evaluate`.
core::Result<AtlasError> atlas_error(CornerClass c, const reference::SurfaceSettings& settings,
                                     const SurfaceEvaluator& evaluate);
inline constexpr int kAtlasOctaves = 6;
inline constexpr int kMostLocalFaces = 64;

/// The same for several ways at one level, each with its own result, for hardly more than one.
std::vector<core::Result<AtlasError>> atlas_errors(CornerClass c, std::span<const SurfaceWay> ways, int level,
                                                   const SurfaceEvaluator& evaluate);

/// The same at level 1, made once a class: the error in terms of the points around the vertex one level above
/// the approximated patch, which is the same at every level and on every mesh.
class LocalErrors {
  public:
    LocalErrors(std::span<const SurfaceWay> ways, SurfaceEvaluator evaluate)
        : ways_(ways.begin(), ways.end()), evaluate_(std::move(evaluate)) {}

    /// Null where it cannot be measured.  `way` must be one of the ways.
    const AtlasError* of(const SurfaceWay& way, CornerClass c);

  private:
    std::vector<SurfaceWay> ways_;
    SurfaceEvaluator evaluate_;
    std::map<CornerClass, std::vector<core::Result<AtlasError>>> known_;  // a result a way
};

/// One class under one way, at every level asked for.
struct AtlasRow {
    std::string way;
    CornerClass corner;
    std::vector<core::Result<AtlasError>> levels;
    std::optional<double> rate;    ///< of the position a level, from the last but one level to the last
    std::optional<double> lambda;  ///< `eigenvalue`
};

struct Atlas {
    std::vector<int> levels;
    std::vector<AtlasRow> rows;
};

/// The classes of the table: interior 3 to 20, boundary 1 to 8, corner 1 to 5, dart 3 to 10.
std::vector<CornerClass> atlas_classes();

using AtlasProgress = std::function<void(std::size_t done, std::size_t of, const std::string& what)>;

/// The table.  `levels` ascending.
Atlas make_atlas(std::span<const SurfaceWay> ways, std::span<const CornerClass> classes,
                 std::span<const int> levels, const SurfaceEvaluator& evaluate,
                 const AtlasProgress& progress = {});

}  // namespace loopcheck::compare
