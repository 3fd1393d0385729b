#include "compare/surface/surface_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
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

// Between two planes, in degrees; 0 where tangents do not span one.
double angle(const Values& a, const Values& exact) {
    // Of tangents of about unit length, so that no product overflows.
    const auto normal = [](const Values& x) {
        const double u = largest_coordinate(x[1]), v = largest_coordinate(x[2]);
        return u > 0 && v > 0 ? glm::cross(x[1] / u, x[2] / v) : glm::dvec3(0);
    };
    const glm::dvec3 n = normal(a), m = normal(exact);
    if (glm::length(m) <= 1e-9 || glm::length(n) <= 1e-9) return 0;
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

// What all samples of a face share.
struct FaceAround {
    std::array<CornerClass, 3> classes;
    Spread spread;

    FaceClass face_class() const { return compare::face_class(classes); }
    bool is_semi_sharp() const { return std::any_of(classes.begin(), classes.end(), compare::is_semi_sharp); }
};

// True where `LocalErrors` looked at this place in a patch: around the sample's own corner, and not too near.
bool is_measured(const Sample& sample, const PatchAt& patch) {
    if (patch.kind != PatchAt::Kind::Approximate) return true;
    if (patch.corner != sample.corner) return false;
    const auto& [face, u, v] = sample.location;
    const std::array<double, 3> distance{u + v, 1 - u, 1 - v};
    const double in_parent = std::ldexp(distance[sample.corner], patch.depth - 1);
    return in_parent == 0 || in_parent > std::ldexp(1, -1 - kAtlasOctaves);
}

// All that is exact at a sample.
struct SampleTruth {
    std::shared_ptr<const FaceAround> face;
    std::array<PatchAt, 2> patches;  // by `blurs`
    std::optional<Stencil> surface;  // where a patch `is_measured`
};

// Where sharpness is finite the share of a rule is a mean in float, in whatever ring order one sums: the
// weights are as right as if all were done in float, 2^29 times the roundoff of double.
constexpr double kFloatShares = 0x1p29;

// The weights of the box-spline end cap are 12 constants of six digits: their sum is off by at most so much.
constexpr double kSixDigits = 12 * 0.5e-6;

// What is known of one mesh under one way while its samples are judged.
class Judge {
  public:
    Judge(const core::TriangleMesh& mesh, SurfaceComparison& out, LocalErrors& local)
        : mesh_(mesh), out_(out), local_(local) {}

    void judge(const Sample& sample, const SampleTruth& truth, const std::optional<core::SurfaceRows>& rows) {
        const PatchAt& patch = truth.patches[blurs(settings_of(out_.check)) ? 1 : 0];
        if (!is_measured(sample, patch)) return;
        SurfaceStats& stats = out_.classes[truth.face->face_class()];
        FaceNumbers& numbers = out_.faces[sample.location.face];
        numbers.face_class = truth.face->face_class();
        ++stats.samples;
        if (!rows) {
            ++stats.beyond;
            numbers.position = std::numeric_limits<double>::infinity();
            return;
        }
        const Stencil& exact = *truth.surface;
        const core::SurfaceRows off = difference(*rows, exact);
        report(stats, numbers, *rows, exact, patch);
        bound_ = 0;
        const double use = patch.kind == PatchAt::Kind::Regular
                               ? regular_use(off, *rows, exact, patch, *truth.face)
                               : approximate_use(stats, off, exact, patch, *truth.face);
        enlarge(numbers.bound, bound_);
        stats.bound_use = larger(stats.bound_use, use);
        if (!(use <= 1)) ++stats.beyond;
    }

  private:
    DeviationCount& count(Id id) { return out_.deviations[static_cast<int>(id)]; }

    // The first value replaces none.
    static void enlarge(double& largest, double value) {
        largest = std::isnan(largest) ? value : larger(largest, value);
    }

    void report(SurfaceStats& stats, FaceNumbers& numbers, const core::SurfaceRows& rows,
                const Stencil& exact, const PatchAt& patch) {
        const Values a = values_of(rows, mesh_.positions()), b = values_of(exact, mesh_.positions());
        const double position = largest_coordinate(a[0] - b[0]);
        stats.position = larger(stats.position, position);
        enlarge(numbers.position, position);
        if (exact.smoothness != core::Smoothness::NoPlane) {
            const double normal = angle(a, b);
            stats.normal = larger(stats.normal, normal);
            enlarge(numbers.normal, normal);
        }
        if (exact.smoothness != core::Smoothness::Regular) return;
        Values off;
        for (int d = 0; d < kDerivatives; ++d) off[d] = a[d] - (order(d) == 2 ? patch.turn : 1.) * b[d];
        const double first = largest_of(b, 1, 2), both = largest_of(b, 1, 5);
        if (first > 0) stats.first = larger(stats.first, largest_of(off, 1, 2) / first);
        if (both > 0) stats.second = larger(stats.second, largest_of(off, 3, 5) / both);
    }

    // On a regular triangle: the largest error over its bound, in weights.
    double regular_use(const core::SurfaceRows& off, const core::SurfaceRows& rows, const Stencil& exact,
                       const PatchAt& patch, const FaceAround& face) {
        const double rounding = face.is_semi_sharp() ? kFloatShares : 1;
        double use = use_of(off, exact, patch.depth, 0, 0) / rounding;
        bound_ = allowed(exact, 0, patch.depth) * rounding * out_.largest_coordinate;
        if (exact.smoothness == core::Smoothness::Regular) {
            use = larger(use, use_of(off, exact, patch.depth, 1, 2) / rounding);
            use = larger(use, patch.turn > 0 && !face.is_semi_sharp()
                                  ? use_of(off, exact, patch.depth, 3, 5)
                                  : turned_use(off, rows, exact, patch.depth, face));
        }
        return misses_chaikin(face) ? chaikin_use(off, face, use) : use;
    }

    // Where Bfr cannot know all of Chaikin's neighbours.
    bool misses_chaikin(const FaceAround& face) const {
        return out_.check.way.method == reference::SurfaceMethod::Bfr &&
               out_.options.creasing == core::Creasing::Chaikin && face.is_semi_sharp();
    }

    // The edge point that Bfr has wrong is one of level 1, so where `use` says that a sample is beyond its
    // bound the points of the whole face bound the error.
    double chaikin_use(const core::SurfaceRows& off, const FaceAround& face, double use) {
        DeviationCount& seen = count(Id::BfrChaikin);
        ++seen.possible;
        if (use <= 1) return use;
        ++seen.shown;
        seen.largest = larger(seen.largest, size_of(off.weights[0]));
        const glm::dvec3 bound = (1 + kPatchMagnitude) * face.spread.half;
        bound_ = largest_coordinate(bound);
        return share_of(values_of(off, mesh_.positions())[0], bound);
    }

    // Second derivatives of a turned triangle must be those of the opposite sign.  Where sharpness is finite,
    // how far OpenSubdiv refines is not predicted, and either sign may be there.
    double turned_use(const core::SurfaceRows& off, const core::SurfaceRows& rows, const Stencil& exact,
                      int depth, const FaceAround& face) {
        const double rounding = face.is_semi_sharp() ? kFloatShares : 1;
        Stencil opposite = exact;
        double size = 0;
        for (int d = 3; d <= 5; ++d) {
            size = std::max(size, size_of(exact.weights[d]) / allowed(exact, d, depth));
            for (double& w : opposite.weights[d]) w = -w;
        }
        const double use = use_of(difference(rows, opposite), exact, depth, 3, 5) / rounding,
                     plain = use_of(off, exact, depth, 3, 5) / rounding;
        if (!(size > 2)) return std::min(use, plain);  // too small to have a sign
        DeviationCount& seen = count(Id::SecondDerivativeSign);
        ++(face.is_semi_sharp() ? seen.possible : seen.expected);
        if (use <= 1) {
            ++seen.shown;
            for (int d = 3; d <= 5; ++d) seen.largest = larger(seen.largest, size_of(off.weights[d]));
            return use;
        }
        if (!(plain <= 1)) return use;
        if (!face.is_semi_sharp()) ++seen.missing;
        return plain;
    }

    // On an approximated triangle: the largest error over its bound, in coordinates.
    double approximate_use(SurfaceStats& stats, const core::SurfaceRows& off, const Stencil& exact,
                           const PatchAt& patch, const FaceAround& face) {
        // The atlas knows patches with one irregular corner and nothing semi-sharp before.
        const AtlasError* known = patch.kind == PatchAt::Kind::Approximate && !face.is_semi_sharp()
                                      ? local_.of(out_.check.way, patch.corner_class)
                                      : nullptr;
        tally(off, exact, patch, known);
        const Values error = values_of(off, mesh_.positions());
        const bool derivatives = known != nullptr && exact.smoothness == core::Smoothness::Regular;
        double use = 0;
        for (int d = 0; d < (derivatives ? kDerivatives : 1); ++d) {
            const glm::dvec3 bound = bound_of(exact, patch, known, d);
            use = larger(use, share_of(error[d], bound));
            if (d > 0) continue;
            bound_ = largest_coordinate(bound);
            stats.predicted = std::max(stats.predicted, bound_);
        }
        return misses_chaikin(face) ? chaikin_use(off, face, use) : use;
    }

    glm::dvec3 bound_of(const Stencil& exact, const PatchAt& patch, const AtlasError* known, int d) const {
        const glm::dvec3 rounding(2 * allowed(exact, d, patch.depth) * out_.largest_coordinate);
        if (known == nullptr) {
            const bool six_digits = out_.check.way.method == reference::SurfaceMethod::PatchBox;
            return (1 + kPatchMagnitude) * patch.spread.half +
                   (six_digits ? kSixDigits : 0) * patch.spread.middle + rounding;
        }
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
    static double allowed(const Stencil& exact, int d, int depth = 0) {
        return allowed_rounding(exact, static_cast<Derivative>(d), depth);
    }
    static double use_of(const core::SurfaceRows& off, const Stencil& exact, int depth, int first, int last) {
        double use = 0;
        for (int d = first; d <= last; ++d)
            use = larger(use, size_of(off.weights[d]) / allowed(exact, d, depth));
        return use;
    }

    const core::TriangleMesh& mesh_;
    SurfaceComparison& out_;
    LocalErrors& local_;
    double bound_ = 0;  // of the position of the sample that is judged
};

// The rules that OpenSubdiv follows where chaikin-overweight is on the list, and whether that matters.
std::pair<core::SchemeOptions, bool> rules_as_done(const core::TriangleMesh& mesh,
                                                   const core::SchemeOptions& options, int levels) {
    for (const KnownDeviation& deviation : known_deviations())
        if (deviation.family == "opensubdiv" && is_predicted(deviation, mesh, options, levels))
            return {deviation.as_done(options), true};
    return {options, false};
}

// The edges around the corners of a face: the width of its rows, but for vertices that are in several rings.
Index width_of(const core::Topology& t, Index face) {
    Index out = 0;
    for (const Index v : t.triangles[face]) out += static_cast<Index>(t.ring(v).size());
    return out;
}

double stencil_work(const core::Topology& t) {
    double work = 0;
    for (Index v = 0; v < t.vertex_count; ++v)
        if (t.ring(v).size() != 6) work += std::pow(static_cast<double>(t.ring(v).size()), 3);
    return work;
}

Index stride_of(const core::TriangleMesh& mesh) {
    double work = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) work += std::pow(width_of(mesh.topology(), f), 3);
    return static_cast<Index>(work / kMostWork) / 2 * 2 + 1;
}

// The exact surface under some rules, face after face.
struct Truth {
    core::SchemeOptions rules;
    core::SchemeLevel control;
    core::LimitSurface<double> surface;
    std::optional<FaceWalk> walk;  // of the face that is looked at
    std::shared_ptr<const FaceAround> around;

    Truth(const core::TriangleMesh& mesh, const core::SchemeOptions& options)
        : rules(options), control(core::control_level(mesh, options.boundary)), surface(mesh, options) {}

    void enter(const core::TriangleMesh& mesh, Index face) {
        walk.emplace(control, rules, mesh.positions(), face);
        around = std::make_shared<const FaceAround>(FaceAround{walk->classes(), walk->spread()});
    }
};

// Checks with the same levels, on the same samples.
struct Group {
    std::vector<std::size_t> members;  // numbers of checks
    std::size_t truth = 0;
    bool overweight = false;                 // `rules_as_done`
    bool blurring = false, keeping = false;  // a member that `blurs`, one that does not
    std::vector<Sample> waiting;
    std::vector<SampleTruth> truths;  // of those that wait
};

bool look_alike(const SurfaceCheck& a, const SurfaceCheck& b) {
    return a.smooth_level == b.smooth_level && a.sharp_level == b.sharp_level && a.samples == b.samples;
}

// Looks at the faces one after the other, judging many at once.  What is exact is computed once for all
// checks, and what is refined for it once for all levels.
class Run {
  public:
    Run(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
        std::span<const SurfaceCheck> checks, const SurfaceEvaluator& evaluate, LocalErrors& local)
        : mesh_(mesh), evaluate_(evaluate), local_(local), out_(checks.size()) {
        for (std::size_t i = 0; i < checks.size(); ++i) {
            SurfaceComparison& c = out_[i];
            c.check = checks[i];
            c.options = options;
            c.diagonal = mesh.diagonal();
            c.largest_coordinate = mesh.largest_coordinate();
            c.stride = stride_of(mesh);
            c.faces.resize(static_cast<std::size_t>(mesh.face_count()));
            Group& group = group_of(c.check, options);
            c.overweight = group.overweight;
            group.members.push_back(i);
            (blurs(settings_of(c.check)) ? group.blurring : group.keeping) = true;
        }
    }

    std::vector<SurfaceComparison> compare(const SurfaceProgress& progress) && {
        const Index stride = stride_of(mesh_);
        for (Index f = 0; f < mesh_.face_count(); f += stride) {
            if (const auto why = core::no_limit_surface(mesh_, truths_.front()->rules.boundary, f)) {
                if (absent_.empty())
                    for (SurfaceComparison& c : out_) c.reason = core::to_string(*why);
                absent_.push_back({f, 1. / 4, 1. / 4});
                continue;
            }
            for (const auto& truth : truths_) truth->enter(mesh_, f);
            for (Group& group : groups_) look_at(group, f);
            if (waiting_columns_ >= kAtOnce) judge_waiting();
            if (progress) progress(f, mesh_.face_count());
        }
        judge_waiting();
        judge_absent();
        for (SurfaceComparison& c : out_)
            if (c.notes.empty()) give_verdict(c);
        return std::move(out_);
    }

  private:
    static constexpr std::size_t kAtOnce = 500000;  // columns of rows, about 60 bytes each

    Group& group_of(const SurfaceCheck& check, const core::SchemeOptions& options) {
        for (Group& group : groups_)
            if (look_alike(check, out_[group.members.front()].check)) return group;
        const auto [rules, overweight] = rules_as_done(mesh_, options, check.sharp_level);
        Group& group = groups_.emplace_back();
        group.overweight = overweight;
        while (group.truth < truths_.size() && truths_[group.truth]->rules != rules) ++group.truth;
        if (group.truth == truths_.size()) truths_.push_back(std::make_unique<Truth>(mesh_, rules));
        return group;
    }

    // Counts the face and lets its samples wait.
    void look_at(Group& group, Index face) {
        Truth& truth = *truths_[group.truth];
        const FaceAround& around = *truth.around;
        for (const std::size_t i : group.members) {
            SurfaceStats& stats = out_[i].classes[around.face_class()];
            ++stats.faces;
            for (const CornerClass& c : around.classes)
                if (const auto lambda = eigenvalue(c); lambda && c != CornerClass{})
                    stats.lambda = std::max(stats.lambda.value_or(0), *lambda);
        }
        const SurfaceCheck& check = out_[group.members.front()].check;
        const int count = std::min(check.samples, std::max(kLeastSamples, kMostSamples / mesh_.face_count()));
        const auto samples = samples_of(face, around.classes, count,
                                        around.is_semi_sharp() ? check.sharp_level : check.smooth_level);
        for (const Sample& sample : samples) group.truths.push_back(truth_at(group, sample));
        group.waiting.insert(group.waiting.end(), samples.begin(), samples.end());
        waiting_columns_ += samples.size() * static_cast<std::size_t>(width_of(mesh_.topology(), face));
    }

    SampleTruth truth_at(const Group& group, const Sample& sample) {
        Truth& truth = *truths_[group.truth];
        const auto& [face, u, v] = sample.location;
        SampleTruth out{truth.around, {}, std::nullopt};
        bool measured = false;
        reference::SurfaceSettings settings = settings_of(out_[group.members.front()].check);
        settings.method = reference::SurfaceMethod::PatchGregory;
        const auto find = [&](reference::PatchSharpness sharpness) {
            settings.sharpness = sharpness;
            PatchAt& patch = out.patches[blurs(settings) ? 1 : 0];
            patch = truth.walk->patch_at(u, v, settings);
            measured = measured || is_measured(sample, patch);
        };
        if (group.keeping) find(reference::PatchSharpness::Exact);
        if (group.blurring) find(reference::PatchSharpness::Default);
        if (measured) out.surface = truth.surface.stencil(face, u, v).value();
        return out;
    }

    void judge_waiting() {
        for (Group& group : groups_) {
            std::vector<core::SurfaceLocation> locations;
            for (const Sample& sample : group.waiting) locations.push_back(sample.location);
            for (const std::size_t i : group.members) {
                SurfaceComparison& c = out_[i];
                const auto rows = ask(c, locations);
                if (!rows) continue;
                Judge judge(mesh_, c, local_);
                for (std::size_t j = 0; j < locations.size(); ++j)
                    judge.judge(group.waiting[j], group.truths[j], (*rows)[j]);
            }
            group.waiting.clear();
            group.truths.clear();
        }
        waiting_columns_ = 0;
    }

    // Where there is no surface there must be none.
    void judge_absent() {
        for (SurfaceComparison& c : out_) {
            const auto rows = ask(c, absent_);
            if (!rows) continue;
            c.without_surface = absent_.size();
            for (const auto& row : *rows)
                if (row) ++c.unwanted_surface;
        }
    }

    // Nothing where nothing is asked, or the evaluator has failed, now or before: then that is the verdict.
    std::optional<std::vector<std::optional<core::SurfaceRows>>> ask(
        SurfaceComparison& c, std::span<const core::SurfaceLocation> locations) {
        if (locations.empty() || !c.notes.empty()) return std::nullopt;
        auto rows = evaluate_(mesh_, c.options, settings_of(c.check), locations);
        if (rows) return std::move(*rows);
        const core::Error& error = rows.error();
        c.verdict = error.code == core::ErrorCode::Unsupported ? Verdict::NotSupported : Verdict::Failed;
        c.notes = {fmt::format("{}: {}", c.check.way.name, core::to_string(error))};
        return std::nullopt;
    }

    const core::TriangleMesh& mesh_;
    const SurfaceEvaluator& evaluate_;
    LocalErrors& local_;
    std::vector<SurfaceComparison> out_;
    std::vector<std::unique_ptr<Truth>> truths_;
    std::vector<Group> groups_;
    std::size_t waiting_columns_ = 0;
    std::vector<core::SurfaceLocation> absent_;
};

std::vector<SurfaceComparison> too_much_work(double work, const core::SchemeOptions& options,
                                             std::span<const SurfaceCheck> checks) {
    std::vector<SurfaceComparison> out(checks.size());
    for (std::size_t i = 0; i < checks.size(); ++i) {
        out[i].check = checks[i];
        out[i].options = options;
        out[i].verdict = Verdict::NotSupported;
        out[i].notes = {
            fmt::format("Too many edges at its irregular vertices: their numbers cubed add up to {:.3g}, and "
                        "at most {:.3g} are looked at.",
                        work, kMostStencilWork)};
    }
    return out;
}

}  // namespace

reference::SurfaceSettings settings_of(const SurfaceCheck& check) {
    return {check.way.method, check.smooth_level, check.sharp_level, check.way.sharpness};
}

std::string to_string(FaceClass c) {
    return c.several ? "several" : to_string(c.corner);
}

std::vector<SurfaceComparison> compare_surfaces(const core::TriangleMesh& mesh,
                                                const core::SchemeOptions& options,
                                                std::span<const SurfaceCheck> checks,
                                                const SurfaceEvaluator& evaluate, LocalErrors& local,
                                                const SurfaceProgress& progress) {
    if (checks.empty()) return {};
    if (const double work = stencil_work(mesh.topology()); work > kMostStencilWork)
        return too_much_work(work, options, checks);
    auto out = Run(mesh, options, checks, evaluate, local).compare(progress);
    for (SurfaceComparison& c : out)
        if (c.verdict == Verdict::NotSupported || c.verdict == Verdict::Failed) {
            c.classes.clear();
            c.faces.clear();
            c.deviations = {};
        }
    return out;
}

}  // namespace loopcheck::compare
