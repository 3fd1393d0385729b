#include "core/loop/tessellation/tessellate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/loop/adaptive/pattern.h"
#include "core/loop/evaluate.h"
#include "core/loop/tessellation/deviation.h"
#include "core/loop/tessellation/fans.h"
#include "core/loop/tessellation/lattice.h"
#include "core/loop/tessellation/surface_piece.h"

namespace loopcheck::core {
namespace {

// How often a piece that is not regular is split for its hull: then its points are an eighth as far apart.
constexpr int kHullLevels = 3;

// A lattice triangle in use.
struct Leaf {
    Index face;
    int level;
    std::array<LatticePoint, 3> corners;
    SurfacePiece surface;
    Triangle vertices{};
    Triangle midpoints{kNone, kNone, kNone};  // those that are in use
    SplitPattern pattern{};                   // of its vertices and midpoints
    std::array<Deviation, 3> deviations{};
    bool judged = false;  // the pattern and the deviations are those of its midpoints
};

std::array<LatticePoint, 3> midpoints_of(const std::array<LatticePoint, 3>& c) {
    return {midpoint(c[0], c[1]), midpoint(c[1], c[2]), midpoint(c[2], c[0])};
}

// The corner or midpoint of a leaf that a vertex of its pattern is: 0 to 2, or 3 to 5.
int place_of(const Leaf& leaf, Index vertex) {
    for (int i = 0; i < 3; ++i)
        if (leaf.vertices[i] == vertex) return i;
    return 3 + static_cast<int>(std::find(leaf.midpoints.begin(), leaf.midpoints.end(), vertex) -
                                leaf.midpoints.begin());
}

Barycentric barycentric_of(int place) {
    Barycentric out{0, 0, 0};
    if (place < 3) {
        out[place] = 1;
    } else {
        out[place - 3] = 0.5;
        out[next_corner(place - 3)] = 0.5;
    }
    return out;
}

// Rounding, in units of u M.  A step of refinement is a convex combination of at most n + 1 terms with
// weights right to 2 kLoopWeightUlps = 14 u: it carries the error of a level on and adds n + 15.  A limit
// mask, rounded once, adds n + 2.  What is regular from level r on has points that are sums like x + y - z:
// they carry 3 r (n + 15), add 5 and are at most 3 M large.  The quartic's points are convex combinations of
// 12 of them, which adds 3 * 14; a `restricted` at halves averages 4 times, and adds 3 * 4 a level.  So at
// level l a position is off by at most 3 (r (n + 15) + 16 + 4 (l - r)), and that is below 3 (l + 1)(n + 30).
//
// Points of a hull are positions of levels up to l + 3, so they are off by a length of sqrt 3 E(l + 3) at
// most; the triangles are exactly what they are.  `deviation_of` passes that on once; in `distance_to_star`
// it counts once for the height, tan 80 degrees < 5.7 times for what is aside, and once for a point that is
// so much beyond the border: 7.7 sqrt 3 < 13.4.  The rest of 16, and that is 2.6 E(3) > 1000 u M, is for
// evaluating distances.
class Tessellator {
  public:
    Tessellator(const TriangleMesh& mesh, const SchemeOptions& options);

    bool is_empty() const { return leaves_.empty(); }
    void close();
    void judge(double tolerance);
    std::size_t triangle_count() const { return triangles_.size(); }
    bool is_within(double tolerance) const {
        return std::all_of(bounds_.begin(), bounds_.end(), [&](double b) { return b <= tolerance; });
    }
    std::vector<std::size_t> failing(double tolerance, Splitting splitting) const;
    std::optional<Error> beyond(double tolerance, std::size_t to_split,
                                const TessellationLimits& limits) const;
    void split_leaf(std::size_t i);
    Tessellation result() const;

  private:
    Index find(Index face, const LatticePoint& point) const;
    Index number(const Leaf& leaf, int corner);
    bool must_split(Leaf& leaf) const;
    Deviation irregular_deviation(const SurfacePiece& piece, const PlacedTriangle& triangle,
                                  double tolerance) const;
    void judge_leaf(Leaf& leaf, double tolerance) const;
    PlacedTriangle placed(const Triangle& t) const {
        return placed_triangle({positions_[t[0]], positions_[t[1]], positions_[t[2]]});
    }
    double star_bound(Index t, const Deviation& deviation, const Fans& fans,
                      std::span<const PlacedTriangle> all) const;

    const TriangleMesh& mesh_;
    SchemeOptions options_;
    int exponent_;  // all is computed for the mesh over 2^exponent_, so that no square over- or underflows
    CornerLimits limits_;
    std::vector<Leaf> leaves_;
    std::unordered_map<VertexKey, Index, VertexKeyHash> numbers_;
    std::vector<glm::dvec3> positions_;
    // Of the latest round, leaf by leaf.
    std::vector<Triangle> triangles_;
    std::vector<double> bounds_;
};

Tessellator::Tessellator(const TriangleMesh& mesh, const SchemeOptions& options)
    : mesh_(mesh), options_(options), exponent_(std::ilogb(mesh.largest_coordinate())), limits_(options) {
    const SchemeLevel control = control_level(mesh, options.boundary);
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : mesh.positions()) points.push_back(times_power_of_two(p, -exponent_));
    std::vector<std::uint8_t> used(points.size(), 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (no_limit_surface(mesh, options.boundary, f)) continue;
        leaves_.push_back({f, 0, kFaceCorners, SurfacePiece(control, points, f, options.creasing)});
        for (const Index v : control.topology.triangles[f]) used[v] = 1;
    }
    LimitTable<double> table(control, options);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!used[v]) continue;
        numbers_.emplace(VertexKey{VertexKey::Kind::Vertex, v, 0, 0}, static_cast<Index>(positions_.size()));
        positions_.push_back(sum_over_ring<double>(control.topology, v, table.masks(v).position, points));
    }
    for (Leaf& leaf : leaves_)
        for (int i = 0; i < 3; ++i) leaf.vertices[i] = find(leaf.face, leaf.corners[i]);
}

Index Tessellator::find(Index face, const LatticePoint& point) const {
    const auto found = numbers_.find(key_of(mesh_.topology(), face, point));
    return found == numbers_.end() ? kNone : found->second;
}

// The number of a corner, which is new where no leaf has had it yet.
Index Tessellator::number(const Leaf& leaf, int corner) {
    const VertexKey key = key_of(mesh_.topology(), leaf.face, leaf.corners[corner]);
    const auto [found, is_new] = numbers_.try_emplace(key, static_cast<Index>(positions_.size()));
    if (is_new) positions_.push_back(limits_.at(leaf.surface, corner));
    return found->second;
}

// Looks up the midpoints that are in use, and says whether that asks for a split.
bool Tessellator::must_split(Leaf& leaf) const {
    const auto points = midpoints_of(leaf.corners);
    int count = 0;
    for (int i = 0; i < 3; ++i) {
        if (leaf.midpoints[i] == kNone) {
            leaf.midpoints[i] = find(leaf.face, points[i]);
            if (leaf.midpoints[i] == kNone) continue;
            leaf.judged = false;
        }
        ++count;
        if (!leaf.surface.is_regular() || count == 3) return true;
        for (const LatticePoint& end : {leaf.corners[i], leaf.corners[next_corner(i)]})
            if (find(leaf.face, midpoint(points[i], end)) != kNone) return true;
    }
    return false;
}

void Tessellator::split_leaf(std::size_t i) {
    const Leaf parent = std::move(leaves_[i]);
    const auto& c = parent.corners;
    const auto m = midpoints_of(c);
    const std::array<std::array<LatticePoint, 3>, 4> corners{
        {{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[1], m[2], m[0]}}};
    auto surfaces = parent.surface.children(options_);
    for (int k = 0; k < 4; ++k) {
        Leaf child{parent.face, parent.level + 1, corners[k], std::move(surfaces[k])};
        for (int j = 0; j < 3; ++j) child.vertices[j] = number(child, j);
        if (k == 0)
            leaves_[i] = std::move(child);
        else
            leaves_.push_back(std::move(child));
    }
}

void Tessellator::close() {
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < leaves_.size(); ++i) {
            if (!must_split(leaves_[i])) continue;
            split_leaf(i);
            changed = true;
        }
    }
}

// The deviation over a piece that is not regular.  Where its points are too far away it is split, up to
// kHullLevels times, unless what has become regular exceeds the tolerance already.
Deviation Tessellator::irregular_deviation(const SurfacePiece& piece, const PlacedTriangle& triangle,
                                           double tolerance) const {
    Deviation regular, all;
    std::vector<SurfacePiece> irregular;
    std::vector<glm::dvec3> hull;
    const auto add_children = [&](const SurfacePiece& parent, std::vector<SurfacePiece>& to) {
        for (SurfacePiece& child : parent.children(options_)) {
            hull.clear();
            child.add_hull(kWholeTriangle, hull);
            const Deviation deviation = deviation_of(hull, triangle);
            all = larger(all, deviation);
            if (child.is_regular())
                regular = larger(regular, deviation);
            else
                to.push_back(std::move(child));
        }
    };
    piece.add_hull(kWholeTriangle, hull);
    all = deviation_of(hull, triangle);
    for (int level = 0; level < kHullLevels; ++level) {
        if (all.distance <= tolerance || regular.height > tolerance) break;
        all = regular;
        std::vector<SurfacePiece> next;
        if (level == 0) add_children(piece, next);
        for (const SurfacePiece& parent : irregular) add_children(parent, next);
        irregular = std::move(next);
    }
    return all;
}

void Tessellator::judge_leaf(Leaf& leaf, double tolerance) const {
    leaf.pattern = split_pattern(leaf.vertices, leaf.midpoints);
    std::vector<glm::dvec3> hull;
    for (int p = 0; p < leaf.pattern.count; ++p) {
        const Triangle& t = leaf.pattern.pieces[p];
        const PlacedTriangle triangle = placed(t);
        if (!leaf.surface.is_regular()) {
            leaf.deviations[p] = irregular_deviation(leaf.surface, triangle, tolerance);
            continue;
        }
        SubTriangle within;
        for (int i = 0; i < 3; ++i) within[i] = barycentric_of(place_of(leaf, t[i]));
        hull.clear();
        leaf.surface.add_hull(within, hull);
        leaf.deviations[p] = deviation_of(hull, triangle);
    }
    leaf.judged = true;
}

double Tessellator::star_bound(Index t, const Deviation& deviation, const Fans& fans,
                               std::span<const PlacedTriangle> all) const {
    const Triangle& corners = triangles_[t];
    if (!std::all_of(corners.begin(), corners.end(), [&](Index v) { return fans.is_closed(v); }))
        return std::numeric_limits<double>::infinity();
    const auto is_corner = [&](Index v) {
        return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    std::vector<PlacedTriangle> star;
    std::vector<BorderEdge> border;
    for (const Index s : fans.star(t)) {
        star.push_back(all[s]);
        for (int i = 0; i < 3; ++i) {
            const Index a = triangles_[s][i], b = triangles_[s][next_corner(i)];
            if (!is_corner(a) && !is_corner(b)) border.push_back({positions_[a], positions_[b]});
        }
    }
    return distance_to_star(deviation, all[t], star, border);
}

// Makes the triangles of this round and their bounds.
void Tessellator::judge(double tolerance) {
    const double scaled_tolerance = std::ldexp(tolerance, -exponent_);
    triangles_.clear();
    bounds_.clear();
    std::vector<Deviation> deviations;
    std::vector<PlacedTriangle> all;
    for (Leaf& leaf : leaves_) {
        if (!leaf.judged) judge_leaf(leaf, scaled_tolerance);
        for (int p = 0; p < leaf.pattern.count; ++p) {
            triangles_.push_back(leaf.pattern.pieces[p]);
            deviations.push_back(leaf.deviations[p]);
            all.push_back(placed(triangles_.back()));
        }
    }
    const Fans fans(positions_.size(), triangles_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Deviation& deviation = deviations[t];
        double bound = deviation.distance;
        if (deviation.distance > scaled_tolerance && deviation.height <= scaled_tolerance)
            bound = std::min(bound, star_bound(static_cast<Index>(t), deviation, fans, all));
        bounds_.push_back(std::ldexp(bound, exponent_));
    }
}

std::vector<std::size_t> Tessellator::failing(double tolerance, Splitting splitting) const {
    std::vector<std::size_t> out;
    std::size_t t = 0;
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        bool fails = splitting == Splitting::Everywhere;
        for (int p = 0; p < leaves_[i].pattern.count; ++p) fails |= !(bounds_[t++] <= tolerance);
        if (fails) out.push_back(i);
    }
    return out;
}

// Why the work cannot go on, if so.
std::optional<Error> Tessellator::beyond(double tolerance, std::size_t to_split,
                                         const TessellationLimits& limits) const {
    double worst = 0;
    const Leaf* worst_leaf = &leaves_.front();
    const Leaf* deepest = nullptr;
    std::size_t t = 0;
    for (const Leaf& leaf : leaves_)
        for (int p = 0; p < leaf.pattern.count; ++p, ++t) {
            if (bounds_[t] > worst) {
                worst = bounds_[t];
                worst_leaf = &leaf;
            }
            const bool is_deep = leaf.level >= std::min(limits.most_levels, kMostLevels);
            if (is_deep && !(bounds_[t] <= tolerance)) deepest = &leaf;
        }
    const auto error = [&](std::string what) {
        return Error{ErrorCode::TooLarge,
                     fmt::format("The tolerance {:.3g} may need more than {}; so far the surface is within "
                                 "{:.3g}.",
                                 tolerance, what, worst),
                     {Place::Kind::Face, worst_leaf->face}};
    };
    if (deepest) return error(fmt::format("{} levels", deepest->level));
    const std::size_t most = std::min(limits.most_triangles, kMostTessellationTriangles);
    if (triangles_.size() + 3 * to_split > most) return error(fmt::format("{} triangles", most));
    return std::nullopt;
}

Tessellation Tessellator::result() const {
    Tessellation out;
    for (const glm::dvec3& p : positions_) out.positions.push_back(times_power_of_two(p, exponent_));
    std::size_t t = 0;
    for (const Leaf& leaf : leaves_) {
        const auto mid = midpoints_of(leaf.corners);
        if (static_cast<std::size_t>(leaf.level) >= out.leaves.size()) out.leaves.resize(leaf.level + 1, 0);
        ++out.leaves[leaf.level];
        for (int p = 0; p < leaf.pattern.count; ++p, ++t) {
            TessellationTriangle triangle{triangles_[t], leaf.face, {}, bounds_[t]};
            for (int i = 0; i < 3; ++i) {
                const int place = place_of(leaf, triangles_[t][i]);
                const LatticePoint& point = place < 3 ? leaf.corners[place] : mid[place - 3];
                triangle.parameters[i] = {static_cast<double>(point.u) / kLatticeUnit,
                                          static_cast<double>(point.v) / kLatticeUnit};
            }
            out.bound = std::max(out.bound, triangle.bound);
            out.triangles.push_back(triangle);
        }
    }
    std::stable_sort(out.triangles.begin(), out.triangles.end(),
                     [](const auto& a, const auto& b) { return a.face < b.face; });
    return out;
}

}  // namespace

Result<Tessellation> tessellate(const TriangleMesh& mesh, const SchemeOptions& options, double tolerance,
                                const TessellationLimits& limits, Splitting splitting,
                                const std::function<void(std::size_t triangles)>& progress) {
    if (!(tolerance > 0 && std::isfinite(tolerance)))
        return fail(ErrorCode::OutsideDomain, "The tolerance must be positive and finite.");
    if (options.crease_share == CreaseShare::Unclamped)
        return fail(
            ErrorCode::Unsupported,
            "With the unclamped share of the crease rule weights may be negative, and nothing is known "
            "to enclose the surface.");
    if (auto error = check_fits(mesh, Precision::Double)) return tl::unexpected(*error);
    Tessellator work(mesh, options);
    if (work.is_empty()) return fail(ErrorCode::NoLimitSurface, "No face has a limit surface.");
    for (;;) {
        work.close();
        work.judge(tolerance);
        if (progress) progress(work.triangle_count());
        const bool is_done = work.is_within(tolerance);
        const auto failing = is_done ? std::vector<std::size_t>{} : work.failing(tolerance, splitting);
        if (auto error = work.beyond(tolerance, failing.size(), limits)) return tl::unexpected(*error);
        if (is_done) return work.result();
        for (const std::size_t leaf : failing) work.split_leaf(leaf);
    }
}

}  // namespace loopcheck::core
