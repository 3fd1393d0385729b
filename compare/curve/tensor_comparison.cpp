#include "compare/curve/tensor_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "compare/curve/grid_places.h"
#include "compare/limit/plane.h"
#include "core/mesh/rounding.h"

namespace loopcheck::compare {
namespace {

using core::Ends;
using core::Grid;
using core::HighPrecision;
using core::Index;
using core::Precision;
using glm::dvec3;
using ExactPoint = core::Point<HighPrecision>;

core::SurfaceShape bicubic(Ends u, Ends v) {
    return {{3, u}, {3, v}};
}

std::optional<core::Error> check_ends(Ends u, Ends v) {
    for (const Ends ends : {u, v})
        if (ends != Ends::Natural && ends != Ends::Closed)
            return core::Error{core::ErrorCode::Unsupported,
                               fmt::format("A mesh of quads has no {} ends.", core::name(ends))};
    return std::nullopt;
}

template <class To, class P>
Grid<core::Point<To>> converted(const Grid<P>& grid) {
    return {grid.rows, grid.columns, core::convert_points<To>(grid.points)};
}

// The numbers of the precision, so that both sides and the exact surface begin with the same.
Grid<dvec3> rounded_to(const Grid<dvec3>& grid, Precision precision) {
    return precision == Precision::Float ? converted<double>(converted<float>(grid)) : grid;
}

// NaN is larger than all else, and stays.
void keep_largest(double& largest, double value) {
    if (!std::isnan(largest) && !(value <= largest)) largest = value;
}

void add(TensorMeasure& measure, double difference, double ours, double theirs, double ours_bound,
         double theirs_bound) {
    keep_largest(measure.difference, difference);
    keep_largest(measure.ours_error, ours);
    keep_largest(measure.opensubdiv_error, theirs);
    keep_largest(measure.ours_bound, ours_bound);
    keep_largest(measure.opensubdiv_bound, theirs_bound);
    keep_largest(measure.bound_use, use_of(ours, ours_bound));
    keep_largest(measure.bound_use, use_of(theirs, theirs_bound));
}

double distance(const dvec3& p, const ExactPoint& exact) {
    double out = 0;
    keep_largest(out, static_cast<double>(abs(HighPrecision(p.x) - exact.x)));
    keep_largest(out, static_cast<double>(abs(HighPrecision(p.y) - exact.y)));
    keep_largest(out, static_cast<double>(abs(HighPrecision(p.z) - exact.z)));
    return out;
}

struct OurLevel {
    Grid<dvec3> positions, limits, du, dv;
};

template <class Real>
core::Result<std::vector<OurLevel>> our_levels(const Grid<dvec3>& grid, const core::SurfaceShape& shape,
                                               std::size_t count) {
    auto surface = core::TensorSurface<core::Point<Real>>::make(converted<Real>(grid), shape);
    std::vector<OurLevel> out;
    for (std::size_t level = 0; surface && level < count; ++level) {
        if (level > 0) surface = core::subdivide(*surface);
        if (!surface) break;
        const auto limits = core::limits(*surface).value();
        out.push_back({converted<double>(surface->grid()), converted<double>(limits.positions),
                       converted<double>(limits.du), converted<double>(limits.dv)});
    }
    if (!surface) return tl::unexpected(surface.error());
    return out;
}

// The vertices of all levels, by subdivision in 38 digits and by evaluation of level 0.
class ExactSurface {
  public:
    ExactSurface(const Grid<dvec3>& grid, const core::SurfaceShape& shape)
        : surface_(core::TensorSurface<ExactPoint>::make(converted<HighPrecision>(grid), shape).value()),
          spline_(core::spline_of(surface_)) {
        find_functions();
    }

    void go_to_next_level() {
        surface_ = core::subdivide(surface_).value();
        ++level_;
        find_functions();
    }

    const Grid<ExactPoint>& positions() const { return surface_.grid(); }

    // Limit position and derivatives with respect to the parameters of the level.
    core::TensorPoint<ExactPoint> limit(std::size_t i, std::size_t j) const {
        auto out = core::evaluate(spline_, along_u_[j], along_v_[i]);
        out.du = step() * out.du;
        out.dv = step() * out.dv;
        return out;
    }

  private:
    HighPrecision step() const { return HighPrecision(std::ldexp(1.0, -level_)); }

    void find_functions() {
        const auto functions = [&](const core::Spline<HighPrecision>& direction, std::size_t count) {
            std::vector<core::BasisAt<HighPrecision>> out;
            out.reserve(count);
            for (std::size_t k = 0; k < count; ++k)
                out.push_back(core::basis_at(direction, HighPrecision(static_cast<double>(k) * step())));
            return out;
        };
        along_u_ = functions(spline_.u, surface_.grid().columns);
        along_v_ = functions(spline_.v, surface_.grid().rows);
    }

    core::TensorSurface<ExactPoint> surface_;
    core::TensorSpline<ExactPoint> spline_;
    std::vector<core::BasisAt<HighPrecision>> along_u_, along_v_;
    int level_ = 0;
};

struct Bounds {
    double position = 0, limit = 0, tangent = 0;
};

Bounds our_bounds(double largest, int level, Precision precision) {
    const double before = position_bound(largest, level, core::kBicubicStepRoundings, precision);
    return {before, limit_bound(largest, before, 16.0 / 9, 10, precision),
            tangent_bound(largest, before, 8.0 / 3, precision)};
}

Bounds their_bounds(double largest, int level, Precision precision) {
    const double before = position_bound(largest, level, kCatmullClarkStepRoundings, precision);
    return {before, limit_bound(largest, before, 1, 11, precision),
            tangent_bound(largest, before, 2, precision)};
}

// Between normals rather than planes: a surface turned inside out is another.
double angle(const Plane& a, const Plane& b) {
    const double between_planes = angle_between(a, b);
    return glm::dot(a.normal, b.normal) < 0 ? std::numbers::pi - between_planes : between_planes;
}

void add_normals(TensorLevel& out, const core::TensorPoint<ExactPoint>& exact, const Plane& ours,
                 const Plane& theirs, const Bounds& our_bound, const Bounds& their_bound) {
    const auto parts = [](const ExactPoint& t) {
        return DoubleDouble3{to_double_double(t.x), to_double_double(t.y), to_double_double(t.z)};
    };
    const auto exact_plane = [&](double e) {
        return plane_of(parts(exact.du), parts(exact.dv), dvec3(e), dvec3(e));
    };
    const Plane for_ours = exact_plane(our_bound.tangent), for_theirs = exact_plane(their_bound.tangent);
    if (!std::isfinite(for_ours.bound) || !std::isfinite(for_theirs.bound)) return;
    ++out.normals;
    add(out.normal, angle(ours, theirs), angle(ours, for_ours), angle(theirs, for_theirs), for_ours.bound,
        for_theirs.bound);
}

TensorLevel compare_level(int level, const OurLevel& ours, const reference::CatmullClarkLevel& theirs,
                          const GridPlaces& places, const ExactSurface& exact, double largest,
                          Precision precision) {
    const Bounds our = our_bounds(largest, level, precision), their = their_bounds(largest, level, precision);
    TensorLevel out;
    out.level = level;
    out.vertices = places.of_vertex.size();
    for (std::size_t k = 0; k < out.vertices; ++k) {
        const auto [i, j] = places.of_vertex[k];
        const auto add_points = [](TensorMeasure& measure, const dvec3& a, const dvec3& b,
                                   const ExactPoint& e, double a_bound, double b_bound) {
            add(measure, core::magnitude(a - b), distance(a, e), distance(b, e), a_bound, b_bound);
        };
        add_points(out.position, ours.positions.at(i, j), theirs.positions[k], exact.positions().at(i, j),
                   our.position, their.position);
        const auto limit = exact.limit(i, j);
        add_points(out.limit, ours.limits.at(i, j), theirs.limit.positions[k], limit.position, our.limit,
                   their.limit);
        add_normals(out, limit, plane_of(ours.du.at(i, j), ours.dv.at(i, j)),
                    plane_of(theirs.limit.tangent1[k], theirs.limit.tangent2[k]), our, their);
    }
    return out;
}

bool sizes_match(const reference::CatmullClarkLevel& theirs, std::size_t count) {
    return theirs.positions.size() == count && theirs.limit.positions.size() == count &&
           theirs.limit.tangent1.size() == count && theirs.limit.tangent2.size() == count;
}

// The first difference that rounding does not explain.
void judge(TensorComparison& out) {
    for (const TensorLevel& level : out.levels) {
        const std::pair<const char*, const TensorMeasure*> measures[] = {{"positions", &level.position},
                                                                         {"limit positions", &level.limit},
                                                                         {"limit normals", &level.normal}};
        for (const auto& [what, measure] : measures) {
            if (measure->difference != 0 && out.verdict == Verdict::Identical)
                out.verdict = Verdict::WithinRounding;
            if (measure->bound_use <= 1) continue;
            out.verdict = Verdict::Differs;
            out.note =
                fmt::format("At level {} the {} differ by {:.3g}; rounding explains {:.3g}.", level.level,
                            what, measure->difference, measure->ours_bound + measure->opensubdiv_bound);
            return;
        }
    }
}

}  // namespace

double position_bound(double largest, int level, int roundings, Precision precision) {
    return core::rounding_of(roundings * level, precision) * largest +
           8 * core::smallest_subnormal(precision) * level;
}

double limit_bound(double largest, double before, double growth, int roundings, Precision precision) {
    return before + growth * core::rounding_of(roundings, precision) * (largest + before) +
           8 * core::smallest_subnormal(precision);
}

double tangent_bound(double largest, double before, double growth, Precision precision) {
    return 2 * before + growth * core::rounding_of(10, precision) * (largest + before) +
           8 * core::smallest_subnormal(precision);
}

core::MeshData quad_mesh(const Grid<dvec3>& grid, Ends u, Ends v) {
    core::MeshData out;
    out.positions = grid.points;
    const std::size_t rows = grid.rows - (v == Ends::Closed ? 0 : 1);
    const std::size_t columns = grid.columns - (u == Ends::Closed ? 0 : 1);
    const auto vertex = [&](std::size_t i, std::size_t j) {
        return static_cast<Index>(i % grid.rows * grid.columns + j % grid.columns);
    };
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j)
            out.add_face(
                reference::Quad{vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j)});
    return out;
}

core::Result<TensorComparison> compare_tensor(const Grid<dvec3>& given, Ends u, Ends v,
                                              const reference::CatmullClark& theirs) {
    const core::SurfaceShape shape = bicubic(u, v);
    if (auto error = check_ends(u, v)) return tl::unexpected(*error);
    const Grid<dvec3> grid = rounded_to(given, theirs.precision);
    const std::size_t levels = theirs.levels.size();
    const auto ours = theirs.precision == Precision::Float ? our_levels<float>(grid, shape, levels)
                                                           : our_levels<double>(grid, shape, levels);
    if (!ours) return tl::unexpected(ours.error());
    ExactSurface exact(grid, shape);
    const double largest = core::largest_coordinate(grid.points);
    TensorComparison out;
    if (levels == 0) out = {Verdict::Failed, "There is no level.", {}};
    std::optional<GridPlaces> places = places_of_grid(grid.rows, grid.columns, u, v);
    for (std::size_t l = 0; l < levels; ++l) {
        if (l > 0) {
            exact.go_to_next_level();
            places = places_of_children(*places, theirs.levels[l].ancestors);
        }
        if (!places || !sizes_match(theirs.levels[l], places->of_vertex.size())) {
            out.verdict = Verdict::Failed;
            out.note = fmt::format("The vertices of level {} are not those of the refined grid.", l);
            return out;
        }
        out.levels.push_back(compare_level(static_cast<int>(l), (*ours)[l], theirs.levels[l], *places, exact,
                                           largest, theirs.precision));
    }
    judge(out);
    return out;
}

core::Result<TensorComparison> compare_tensor(const Grid<dvec3>& grid, const TensorCase& what) {
    if (auto error = check_ends(what.u, what.v)) return tl::unexpected(*error);
    if (auto error =
            core::check_surface(bicubic(what.u, what.v), grid.rows, grid.columns, grid.points.size()))
        return tl::unexpected(*error);
    const auto theirs = reference::opensubdiv_catmull_clark(quad_mesh(grid, what.u, what.v), what.boundary,
                                                            what.levels, what.precision);
    if (!theirs) return tl::unexpected(theirs.error());
    return compare_tensor(grid, what.u, what.v, *theirs);
}

}  // namespace loopcheck::compare
