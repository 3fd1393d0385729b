// One curve held against its own limit, against 38 digits, and against the subjects that can carry it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/curve/carrier.h"
#include "compare/statistics.h"
#include "compare/subject.h"
#include "core/bspline/subdivide.h"

namespace loopcheck::compare {

/// One level of our subdivision in double.
struct PolygonStats {
    int level = 0;
    std::size_t points = 0;
    std::size_t on_curve = 0;  ///< whose parameter is in the domain; the others have no point of the curve
    double distance = 0;       ///< largest |c_i - P(t_i)|, both exact
    std::optional<double> allowed = {};      ///< core::polygon_distance; nothing for clamped knots
    double error = 0;                        ///< largest coordinate of |ours - exact|
    double bound_use = 0;                    ///< largest share of the rounding bound
    std::optional<double> limit_error = {};  ///< of limits, in 38 digits, over M; uniform knots only
};

/// One way of evaluation in double, at parameters of the last level: ours, and Boost.Math's basis functions.
struct EvaluationStats {
    std::string method;
    std::size_t samples = 0;
    std::int64_t basis_evaluations = 0;
    double error = 0;      ///< largest coordinate of |ours - exact|
    double bound_use = 0;  ///< of the roundings that the method may make
};

struct CarriedLevel {
    int level = 0;
    ErrorStats difference = {};  ///< the subject's points against ours in the same precision
    double bound_use = 0;        ///< largest |a - b| / (E_a + E_b)
};

/// A subject's refinement of a mesh that carries the curve.
struct CarriedComparison {
    std::string subject, version;
    core::Precision precision = core::Precision::Double;
    CarrierKind carrier = CarrierKind::StripWithCorners;
    Verdict verdict = Verdict::Identical;
    std::string note = {};  ///< why nothing was compared, or what is wrong
    std::vector<CarriedLevel> levels = {};
};

/// What is known of a curve.
struct CurveComparison {
    double largest_coordinate = 0;  ///< M, phantoms included
    std::size_t stride = 1;         ///< one point in so many was held against the exact curve
    std::vector<core::CurveLevel<glm::dvec3>> levels;
    std::vector<PolygonStats> polygons;
    std::vector<EvaluationStats> evaluations;
    std::vector<CarriedComparison> carried;
    Verdict own = Verdict::WithinRounding;  ///< of ours by itself
    std::vector<std::string> notes;         ///< what is wrong with ours, a sentence each

    double unit() const {
        return error_unit(largest_coordinate, core::Precision::Double, core::Precision::Double);
    }
    Verdict worst() const;  ///< of ours and of all subjects
};

using CurveProgress = std::function<void(const std::string&)>;

/// Peak memory of `compare_curve`, in bytes per point of the last level.  A test measures it.
inline constexpr double kCurveBytesPerPoint = 1000;

/// Peak memory of `core::subdivision_matrix`, in bytes per control point and degree + 1: the rows are in
/// fractions.  A test measures it.
inline constexpr double kMatrixBytesPerWeight = 320;

/// Subdivides the curve, and holds every level, in double, against 38 digits, against exact evaluation at the
/// same parameters, and against the bounds of core/bspline.
CurveComparison compare_curve(const core::Curve<glm::dvec3>& curve, int levels,
                              const CurveProgress& progress);

/// Has a subject refine each mesh that carries the curve, and compares the polygon's vertices with our
/// subdivision in the subject's precision, level by level.
///
/// Requires a cubic with Natural or Closed ends; else one entry that is not supported.  Never fails: what
/// goes wrong is the verdict.
std::vector<CarriedComparison> compare_carried(const core::Curve<glm::dvec3>& curve, int levels,
                                               const Subject& subject, double memory_limit,
                                               const CurveProgress& progress);

}  // namespace loopcheck::compare
