#include "compare/surface/surface_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "compare/surface/face_walk.h"
#include "core/loop/evaluate.h"

namespace loopcheck::compare {
namespace {

using core::Derivative;
using core::Index;
using core::kDerivatives;
using Id = SurfaceDeviationId;
using Stencil = core::SurfaceStencil<double>;

double largest_coordinate(const glm::dvec3& p) {
    return larger(larger(std::abs(p.x), std::abs(p.y)), std::abs(p.z));
}

using Values = std::array<glm::dvec3, kDerivatives>;

template <class Rows>
Values values_of(const Rows& rows, std::span<const glm::dvec3> positions) {
    Values out{};
    for (int d = 0; d < kDerivatives; ++d)
        for (std::size_t j = 0; j < rows.columns.size(); ++j)
            out[d] += rows.weights[d][j] * positions[rows.columns[j]];
    return out;
}

double largest_of(const Values& values, int first, int last) {
    double out = 0;
    for (int d = first; d <= last; ++d) out = larger(out, largest_coordinate(values[d]));
    return out;
}

// Between two planes, in degrees; 0 where the exact tangents do not span one.
double angle(const Values& a, const Values& exact) {
    const auto normal = [](const Values& x) { return glm::cross(x[1], x[2]); };
    const glm::dvec3 n = normal(a), m = normal(exact);
    if (!(glm::length(m) > 1e-9 * glm::length(exact[1]) * glm::length(exact[2]))) return 0;
    return std::atan2(glm::length(glm::cross(n, m)), std::abs(glm::dot(n, m))) * 180 / std::numbers::pi;
}

FaceClass face_class(const std::array<CornerClass, 3>& corners) {
    FaceClass out;
    for (const CornerClass& c : corners) {
        if (c.kind == CornerClass::Kind::SemiSharp) return {false, c};
        if (c == CornerClass{} || c == out.corner) continue;
        if (out.corner != CornerClass{}) out.several = true;
        out.corner = c;
    }
    return out.several ? FaceClass{true, {}} : out;
}

// Parameters of one face.  Those around an irregular corner stand for that corner only: in the approximated
// patch of another one they are left out, because that corner has its own.
struct Sample {
    core::SurfaceLocation location;
    int corner;
};

std::vector<Sample> samples_of(Index face, const std::array<CornerClass, 3>& classes, int count, int level) {
    std::vector<int> corners;
    for (int i = 0; i < 3; ++i)
        if (classes[i] != CornerClass{}) corners.push_back(i);
    std::vector<Sample> out;
    const bool regular = corners.empty();
    if (regular) corners.push_back(face % 3);
    const auto parameters = crowded_parameters(regular ? 2 : level + 4);
    const std::size_t each = regular ? kLeastSamples : std::max<std::size_t>(2, count / corners.size());
    for (const int corner : corners) {
        out.push_back({location_at(face, corner, {0, 0}), corner});
        const std::size_t taken = std::min(each, parameters.size());
        for (std::size_t i = 0; i < taken; ++i) {
            // Evenly over all octaves, and others in the next face.
            const std::size_t at =
                (i * parameters.size() / taken + 7 * static_cast<std::size_t>(face)) % parameters.size();
            out.push_back({location_at(face, corner, parameters[at]), corner});
        }
    }
    return out;
}

// Error over bound, in the coordinate where that is largest.
double share_of(const glm::dvec3& error, const glm::dvec3& bound) {
    double out = 0;
    for (int i = 0; i < 3; ++i) out = larger(out, error[i] == 0 ? 0 : std::abs(error[i]) / bound[i]);
    return out;
}

bool is_semi_sharp(CornerClass c) {
    return c.kind == CornerClass::Kind::SemiSharp;
}

// What is known of one mesh under one way while its samples are judged.
class Judge {
  public:
    Judge(const core::TriangleMesh& mesh, const core::SchemeOptions& truth, SurfaceComparison& out,
          LocalErrors& local)
        : mesh_(mesh), exact_(mesh, truth), out_(out), local_(local) {}

    void judge(const Sample& sample, FaceWalk& walk, const std::optional<core::SurfaceRows>& rows) {
        const auto& [face, u, v] = sample.location;
        const PatchAt patch = walk.patch_at(u, v, settings_of(out_.check));
        if (patch.kind == PatchAt::Kind::Approximate && patch.corner != sample.corner) return;
        SurfaceStats& stats = out_.classes[face_class(walk.classes())];
        ++stats.samples;
        if (!rows) {
            ++stats.beyond;
            return;
        }
        const Stencil exact = exact_.stencil(face, u, v).value();
        const core::SurfaceRows off = difference(*rows, exact);
        report(stats, *rows, exact, patch);
        const double use = patch.kind == PatchAt::Kind::Regular ? regular_use(off, *rows, exact, patch, walk)
                                                                : approximate_use(stats, off, exact, patch);
        stats.bound_use = larger(stats.bound_use, use);
        if (!(use <= 1)) ++stats.beyond;
    }

  private:
    DeviationCount& count(Id id) { return out_.deviations[static_cast<int>(id)]; }

    void report(SurfaceStats& stats, const core::SurfaceRows& rows, const Stencil& exact,
                const PatchAt& patch) {
        const Values a = values_of(rows, mesh_.positions()), b = values_of(exact, mesh_.positions());
        stats.position = larger(stats.position, largest_coordinate(a[0] - b[0]));
        if (exact.smoothness != core::Smoothness::NoPlane) stats.normal = larger(stats.normal, angle(a, b));
        if (exact.smoothness != core::Smoothness::Regular) return;
        Values off;
        for (int d = 0; d < kDerivatives; ++d) off[d] = a[d] - (order(d) == 2 ? patch.turn : 1.) * b[d];
        const double first = largest_of(b, 1, 2), both = largest_of(b, 1, 5);
        if (first > 0) stats.first = larger(stats.first, largest_of(off, 1, 2) / first);
        if (both > 0) stats.second = larger(stats.second, largest_of(off, 3, 5) / both);
    }

    // On a regular triangle: the largest error over its bound, in weights.
    double regular_use(const core::SurfaceRows& off, const core::SurfaceRows& rows, const Stencil& exact,
                       const PatchAt& patch, const FaceWalk& walk) {
        double use = use_of(off, exact, 0, 0);
        if (misses_chaikin(walk) && !(use <= 1)) {
            DeviationCount& seen = count(Id::BfrChaikin);
            ++seen.shown;
            seen.largest = larger(seen.largest, size_of(off.weights[0]));
            return share_of(values_of(off, mesh_.positions())[0], (1 + kPatchMagnitude) * walk.spread().half);
        }
        if (exact.smoothness != core::Smoothness::Regular) return use;
        use = larger(use, use_of(off, exact, 1, 2));
        return larger(use, patch.turn > 0 ? use_of(off, exact, 3, 5) : turned_use(off, rows, exact));
    }

    bool misses_chaikin(const FaceWalk& walk) {
        const bool out = out_.check.way.method == reference::SurfaceMethod::Bfr &&
                         out_.options.creasing == core::Creasing::Chaikin &&
                         std::any_of(walk.classes().begin(), walk.classes().end(), is_semi_sharp);
        if (out) ++count(Id::BfrChaikin).possible;
        return out;
    }

    // Second derivatives of a turned triangle must be those of the opposite sign.
    double turned_use(const core::SurfaceRows& off, const core::SurfaceRows& rows, const Stencil& exact) {
        Stencil opposite = exact;
        double size = 0;
        for (int d = 3; d <= 5; ++d) {
            size = std::max(size, size_of(exact.weights[d]) / allowed(exact, d));
            for (double& w : opposite.weights[d]) w = -w;
        }
        const double use = use_of(difference(rows, opposite), exact, 3, 5), plain = use_of(off, exact, 3, 5);
        if (!(size > 2)) return std::min(use, plain);  // too small to have a sign
        DeviationCount& seen = count(Id::SecondDerivativeSign);
        ++seen.expected;
        if (use <= 1) {
            ++seen.shown;
            for (int d = 3; d <= 5; ++d) seen.largest = larger(seen.largest, size_of(off.weights[d]));
            return use;
        }
        if (!(plain <= 1)) return use;
        ++seen.missing;
        return plain;
    }

    // On an approximated triangle: the largest error over its bound, in coordinates.
    double approximate_use(SurfaceStats& stats, const core::SurfaceRows& off, const Stencil& exact,
                           const PatchAt& patch) {
        const AtlasError* known =
            patch.kind == PatchAt::Kind::Approximate ? local_.of(patch.corner_class) : nullptr;
        tally(off, exact, patch, known);
        const Values error = values_of(off, mesh_.positions());
        const bool derivatives = known != nullptr && exact.smoothness == core::Smoothness::Regular;
        double use = 0;
        for (int d = 0; d < (derivatives ? kDerivatives : 1); ++d) {
            const glm::dvec3 bound = bound_of(exact, patch, known, d);
            use = larger(use, share_of(error[d], bound));
            if (d == 0) stats.predicted = std::max(stats.predicted, largest_coordinate(bound));
        }
        return use;
    }

    glm::dvec3 bound_of(const Stencil& exact, const PatchAt& patch, const AtlasError* known, int d) const {
        const glm::dvec3 rounding(2 * allowed(exact, d) * mesh_.largest_coordinate());
        if (known == nullptr) return (1 + kPatchMagnitude) * patch.spread.half + rounding;
        const double scale = std::ldexp(1., order(d) * (patch.depth - 1));
        return scale * (known->largest[order(d)] * patch.spread.half +
                        known->unbalance[order(d)] * patch.spread.middle) +
               rounding;
    }

    void tally(const core::SurfaceRows& off, const Stencil& exact, const PatchAt& patch,
               const AtlasError* known) {
        const double size = size_of(off.weights[0]), unbalance = unbalance_of(off.weights[0]);
        const auto add = [&](Id id, bool expected, double value) {
            DeviationCount& seen = count(id);
            ++seen.possible;
            if (expected) ++seen.expected;
            if (!(value > allowed(exact, 0))) return;
            ++seen.shown;
            seen.largest = larger(seen.largest, size);
        };
        if (patch.kind == PatchAt::Kind::Blurred) return add(Id::PatchDefaults, true, size);
        if (patch.kind == PatchAt::Kind::SemiSharp) return add(Id::SharpnessCutOff, false, size);
        add(Id::Approximation, known != nullptr && !known->is_rounding(), size);
        if (known != nullptr && known->unbalance[0] > known->rounding[0]) add(Id::BoxEndCap, true, unbalance);
    }

    static int order(int d) { return order_of(static_cast<Derivative>(d)); }
    static double allowed(const Stencil& exact, int d) {
        return allowed_rounding(exact, static_cast<Derivative>(d));
    }
    static double use_of(const core::SurfaceRows& off, const Stencil& exact, int first, int last) {
        double use = 0;
        for (int d = first; d <= last; ++d) use = larger(use, size_of(off.weights[d]) / allowed(exact, d));
        return use;
    }

    const core::TriangleMesh& mesh_;
    core::LimitSurface<double> exact_;
    SurfaceComparison& out_;
    LocalErrors& local_;
};

// The rules that OpenSubdiv follows where chaikin-overweight is on the list, and whether that matters.
std::pair<core::SchemeOptions, bool> rules_as_done(const core::TriangleMesh& mesh,
                                                   const core::SchemeOptions& options, int levels) {
    for (const KnownDeviation& deviation : known_deviations())
        if (deviation.family == "opensubdiv" && is_predicted(deviation, mesh, options, levels))
            return {deviation.as_done(options), true};
    return {options, false};
}

// Judges the faces one after the other, asking for many at once.
class Run {
  public:
    Run(const core::TriangleMesh& mesh, const core::SchemeOptions& truth, SurfaceComparison& out,
        const SurfaceEvaluator& evaluate, LocalErrors& local)
        : mesh_(mesh),
          truth_(truth),
          control_(core::control_level(mesh, truth.boundary)),
          out_(out),
          evaluate_(evaluate),
          judge_(mesh, truth, out, local) {}

    // An error where the evaluator gives one.
    std::optional<core::Error> faces(const SurfaceProgress& progress) {
        const auto cap = static_cast<int>(kMostSamples / mesh_.face_count());
        const int count = std::min(out_.check.samples, std::max(kLeastSamples, cap));
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (core::no_limit_surface(mesh_, truth_.boundary, f)) {
                ++out_.without_surface;
                absent_.push_back({f, 1. / 4, 1. / 4});
                continue;
            }
            const FaceWalk walk(control_, truth_, mesh_.positions(), f);
            const auto& classes = walk.classes();
            SurfaceStats& stats = out_.classes[face_class(classes)];
            ++stats.faces;
            for (const CornerClass& c : classes)
                if (const auto lambda = eigenvalue(c); lambda && c != CornerClass{})
                    stats.lambda = std::max(stats.lambda.value_or(0), *lambda);
            const bool sharp = std::any_of(classes.begin(), classes.end(), is_semi_sharp);
            const auto samples =
                samples_of(f, classes, count, sharp ? out_.check.sharp_level : out_.check.smooth_level);
            waiting_.insert(waiting_.end(), samples.begin(), samples.end());
            if (waiting_.size() >= kAtOnce)
                if (auto error = judge_waiting()) return error;
            if (progress) progress(f, mesh_.face_count());
        }
        if (auto error = judge_waiting()) return error;
        return judge_absent();
    }

  private:
    static constexpr std::size_t kAtOnce = 20000;  // 2 KB each

    std::optional<core::Error> judge_waiting() {
        if (waiting_.empty()) return std::nullopt;
        std::vector<core::SurfaceLocation> locations;
        for (const Sample& sample : waiting_) locations.push_back(sample.location);
        const auto rows = evaluate_(mesh_, out_.options, settings_of(out_.check), locations);
        if (!rows) return rows.error();
        std::optional<FaceWalk> walk;
        Index face = core::kNone;
        for (std::size_t i = 0; i < waiting_.size(); ++i) {
            if (waiting_[i].location.face != face) {
                face = waiting_[i].location.face;
                walk.emplace(control_, truth_, mesh_.positions(), face);
            }
            judge_.judge(waiting_[i], *walk, (*rows)[i]);
        }
        waiting_.clear();
        return std::nullopt;
    }

    // Where there is no surface there must be none.
    std::optional<core::Error> judge_absent() {
        if (absent_.empty()) return std::nullopt;
        const auto rows = evaluate_(mesh_, out_.options, settings_of(out_.check), absent_);
        if (!rows) return rows.error();
        for (const auto& row : *rows)
            if (row) ++out_.unwanted_surface;
        return std::nullopt;
    }

    const core::TriangleMesh& mesh_;
    core::SchemeOptions truth_;
    core::SchemeLevel control_;
    SurfaceComparison& out_;
    const SurfaceEvaluator& evaluate_;
    Judge judge_;
    std::vector<Sample> waiting_;
    std::vector<core::SurfaceLocation> absent_;
};

}  // namespace

reference::SurfaceSettings settings_of(const SurfaceCheck& check) {
    return {check.way.method, check.smooth_level, check.sharp_level, check.way.sharpness};
}

std::string to_string(FaceClass c) {
    return c.several ? "several" : to_string(c.corner);
}

SurfaceComparison compare_surface(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                  const SurfaceCheck& check, const SurfaceEvaluator& evaluate,
                                  LocalErrors& local, const SurfaceProgress& progress) {
    SurfaceComparison out;
    out.check = check;
    out.options = options;
    out.diagonal = mesh.diagonal();
    out.largest_coordinate = mesh.largest_coordinate();
    const auto [truth, overweight] = rules_as_done(mesh, options, check.sharp_level);
    out.overweight = overweight;
    if (const auto error = Run(mesh, truth, out, evaluate, local).faces(progress)) {
        out.verdict = error->code == core::ErrorCode::Unsupported ? Verdict::NotSupported : Verdict::Failed;
        out.classes.clear();
        out.deviations = {};
        out.notes = {fmt::format("{}: {}", check.way.name, core::to_string(*error))};
        return out;
    }
    give_verdict(out);
    return out;
}

}  // namespace loopcheck::compare
