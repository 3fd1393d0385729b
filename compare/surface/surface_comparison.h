// The limit surface of OpenSubdiv against the exact one, face class by face class, with the verdict.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/surface/atlas.h"
#include "compare/surface/surface_deviations.h"

namespace loopcheck::compare {

/// How a surface is looked at.
struct SurfaceCheck {
    SurfaceWay way;
    int smooth_level = 2;
    int sharp_level = 6;
    /// Most parameters a face; fewer where the mesh has many faces, so that all are about kMostSamples.
    int samples = 64;
};
reference::SurfaceSettings settings_of(const SurfaceCheck& check);
inline constexpr int kMostSamples = 100000;
inline constexpr int kLeastSamples = 6;  ///< a face
/// Most work on a mesh: the sum over its faces of the cubed number of edges around their corners.  Where it
/// is more, only every so many-th face is looked at.
inline constexpr double kMostWork = 2e8;
/// Largest sum over the irregular vertices of a mesh of their cubed number of edges: what OpenSubdiv's
/// stencils take.  At the limit, that is for one vertex of valence 736, all ways together take some 20
/// seconds, and a refined face 4 MB; above it no way is compared.
inline constexpr double kMostStencilWork = 4e8;

/// What a face is counted under: its only irregular class, or several.
struct FaceClass {
    bool several = false;  ///< corners of different irregular classes
    CornerClass corner;

    auto operator<=>(const FaceClass&) const = default;
};
std::string to_string(FaceClass c);

/// The faces of a class.  An error is NaN where a result is not finite.
struct SurfaceStats {
    std::size_t faces = 0, samples = 0;
    double position = 0;  ///< largest coordinate of the difference, in model units
    double normal = 0;    ///< largest angle between the normals as planes, in degrees
    /// Largest coordinate of the difference of du and dv over the largest of the exact ones at that
    /// parameter.
    double first = 0;
    /// The same of duu, duv, dvv, over the largest of the exact ones of both orders; the sign as predicted.
    double second = 0;
    double predicted = 0;  ///< largest bound of the position, in model units
    double bound_use = 0;  ///< largest error over its bound, of positions and of derivatives where predicted
    std::size_t beyond = 0;        ///< samples beyond a bound
    std::optional<double> rate;    ///< of `position` a level, from this check to the one two levels deeper
    std::optional<double> lambda;  ///< the largest `eigenvalue` of the class
};

/// What was seen of a face; NaN where it was not looked at or has no surface.
struct FaceNumbers {
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    double position = kNone;  ///< as in `SurfaceStats`; infinite where the surface is missing
    double bound = kNone;     ///< largest bound of the position, in model units
    double normal = kNone;    ///< as in `SurfaceStats`
    FaceClass face_class;
};

/// How often a deviation was to be seen and was seen, in samples.
struct DeviationCount {
    std::size_t expected = 0;  ///< must show there
    std::size_t possible = 0;  ///< may show there, and nowhere else
    std::size_t shown = 0;     ///< shows, as predicted
    std::size_t missing = 0;   ///< expected, and the exact value is there instead
    double largest = 0;        ///< sum_j |w_j - exact w_j|, in weights of its own order of derivative
};

/// The outcome for one way on one mesh.
struct SurfaceComparison {
    SurfaceCheck check;
    core::SchemeOptions options;
    Verdict verdict = Verdict::WithinRounding;
    std::vector<std::string> notes;  ///< the verdict in words, a sentence each
    std::map<FaceClass, SurfaceStats> classes;
    std::vector<FaceNumbers> faces;  ///< one a face of the mesh; empty where nothing was compared
    std::array<DeviationCount, kSurfaceDeviations> deviations{};
    core::Index stride = 1;            ///< every so many-th face was looked at
    std::size_t without_surface = 0;   ///< faces that have none: holes, and boundaries under the option none
    std::string reason;                ///< why the first of these has none
    std::size_t unwanted_surface = 0;  ///< faces that have one nevertheless
    bool overweight = false;           ///< chaikin-overweight changes the exact surface here
    double diagonal = 0, largest_coordinate = 0;
};

using SurfaceProgress = std::function<void(std::size_t face, std::size_t of)>;

/// Compares some ways, at some levels, with the exact surface; the outcomes in the order of the checks. Never
/// throws and never fails: what goes wrong is the verdict.
///
/// Cost     the exact surface is computed once for all checks with the same levels and samples, and refined
///          once for all.  Time is bounded by kMostSamples, kMostWork and kMostStencilWork.  Memory: the rows
///          of some 500 000 columns at once, thrice, and what OpenSubdiv needs for the mesh.
///
/// The prediction.  OpenSubdiv refines exactly down to the last level L and is exact on regular triangles; an
/// irregular one gets an approximation there.  Both are linear in the points around it, so with the points
/// Q one level above,
///
///     error of derivative d at a parameter = 2^(order (L-1)) sum_j e_j Q_j,      sum_j e_j = 0,
///
/// where e depends on the class of the irregular corner and the place in the patch only.  Hence, per
/// coordinate, |error| <= 2^(order (L-1)) A (half the spread of Q), with A the `LocalErrors` of the class on
/// the same places; where the weights do not sum to 0 (the box end cap), their sum times the middle of Q is
/// added.  On regular triangles the weights themselves are compared, sum_j |w_j - exact w_j| <=
/// `allowed_rounding`.
///
/// Where sharpness has not decayed, or level 1 leaves two irregular corners together, or a class has no local
/// mesh, and where PatchTable smooths what is sharp, both surfaces are near the points of the triangle: the
/// exact one is within their range, and the weights of a patch add up to at most kPatchMagnitude; then
/// positions alone are judged, |error| <= (1 + kPatchMagnitude) (half the spread).
///
/// A second derivative in a turned regular triangle must be the exact one with the opposite sign.
///
/// Where sharpness at the corners of a face is finite, less is known of how far OpenSubdiv refines, and its
/// shares are means in float: weights may be off as if they were computed in float, approximated patches are
/// held by the spread, and second derivatives may have either sign; under Chaikin's rule Bfr is held by the
/// spread of the points of the whole face.
///
/// Range    1 <= smooth_level <= sharp_level <= reference::kOpensubdivMaxSurfaceLevel.  NotSupported where no
///          face has a surface, and above kMostStencilWork; the notes say why.
std::vector<SurfaceComparison> compare_surfaces(const core::TriangleMesh& mesh,
                                                const core::SchemeOptions& options,
                                                std::span<const SurfaceCheck> checks,
                                                const SurfaceEvaluator& evaluate, LocalErrors& local,
                                                const SurfaceProgress& progress = {});
inline constexpr double kPatchMagnitude = 2;

/// Sets verdict and notes from what was counted: Differs where a sample is beyond its bound or a deviation
/// that must show does not or is not on the list, KnownDeviation where one shows.
void give_verdict(SurfaceComparison& comparison, std::span<const KnownDeviation> list = known_deviations());

/// The same with the rates: also two levels deeper, where there are such levels, and both must be right.
/// `local` must know the ways of the checks.
std::vector<SurfaceComparison> compare_surfaces_with_rates(
    const core::TriangleMesh& mesh, const core::SchemeOptions& options, std::span<const SurfaceCheck> checks,
    const SurfaceEvaluator& evaluate, LocalErrors& local, const SurfaceProgress& progress = {});

}  // namespace loopcheck::compare
