#include "compare/deviations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compare/limit/opensubdiv_masks.h"
#include "core/loop/refine.h"

namespace loopcheck::compare {
namespace {

using core::VertexRule;
using Kind = KnownDeviation::Kind;

bool is_settled(const LimitVertex& vertex, VertexRule rule) {
    return vertex.sharpness == LimitVertex::Sharpness::Settled && vertex.star.rule() == rule;
}

constexpr std::array kDeviations{
    KnownDeviation{
        .name = "chaikin-overweight",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "Where a Chaikin crease of sharpness s > 1 becomes smooth at one end in one step, OpenSubdiv "
                "gives the crease rule the weight s and the smooth rule the weight 1 - s < 0.",
        .versions = "3.5.0",
        .as_done =
            [](core::SchemeOptions options) {
                options.crease_share = core::CreaseShare::Unclamped;
                return options;
            },
    },
    KnownDeviation{
        .name = "limit-semi-sharp",
        .family = "opensubdiv",
        .kind = Kind::Documented,
        .what = "At a vertex that is still semi-sharp OpenSubdiv gives the limit of one that stays sharp for "
                "ever; once its sharpness has decayed the limit is right.",
        .versions = "3.5.0",
        .applies = [](const LimitVertex& v) { return v.sharpness == LimitVertex::Sharpness::Finite; },
        .limit_as_done = opensubdiv_limit_masks,
    },
    KnownDeviation{
        .name = "limit-dart",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what =
            "At an infinitely sharp dart OpenSubdiv takes the limit masks of a smooth vertex, which are not "
            "those of its own refinement there.",
        .versions = "3.5.0",
        .applies = [](const LimitVertex& v) { return is_settled(v, VertexRule::Dart); },
        .limit_as_done = opensubdiv_limit_masks,
    },
    KnownDeviation{
        .name = "limit-crease-tangent",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what =
            "Across a crease or boundary of four or more faces OpenSubdiv's tangent belongs to the edge rule "
            "3/8, 5/8; it refines by 1/2, 1/2.",
        .versions = "3.5.0",
        .applies =
            [](const LimitVertex& v) {
                return is_settled(v, VertexRule::Crease) && v.star.sectors().front().faces >= 4;
            },
        .limit_as_done = opensubdiv_limit_masks,
    },
    KnownDeviation{
        .name = "limit-corner-tangent",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "At a sharp corner OpenSubdiv's tangents lead along the first two edges of the ring, not "
                "along the "
                "two edges that bound a sector.",
        .versions = "3.5.0",
        .applies =
            [](const LimitVertex& v) {
                if (!is_settled(v, VertexRule::Corner) || v.star.sharp.size() < 2) return false;
                return v.star.sectors().front() != core::Sector{0, 1};
            },
        .limit_as_done = opensubdiv_limit_masks,
    },
    KnownDeviation{
        .name = "limit-valence-2",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "At an interior vertex of valence 2 OpenSubdiv's second tangent is the rounding error of "
                "sin(pi).",
        .versions = "3.5.0",
        .applies = [](const LimitVertex& v) { return is_settled(v, VertexRule::Smooth) && v.star.ring == 2; },
        .limit_as_done = opensubdiv_limit_masks,
    },
    KnownDeviation{
        .name = "bfr-approximation",
        .family = "opensubdiv",
        .kind = Kind::Approximation,
        .what =
            "Around an irregular vertex the triangles of the last level are approximated by one patch each.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "second-derivative-sign",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "Second derivatives have the wrong sign where a patch lies in a triangle turned by half a "
                "circle.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "bspline-endcap",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what =
            "The box-spline end cap is made with constants of six digits, also in double: its weights do not "
            "sum to 1.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "patchtable-defaults",
        .family = "opensubdiv",
        .kind = Kind::Documented,
        .what = "PatchTable, as it comes, smooths what is infinitely sharp below the sharp level and keeps "
                "boundary vertices of one face; useInfSharpPatch and generateLegacySharpCornerPatches change "
                "that.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "sharpness-cut-off",
        .family = "opensubdiv",
        .kind = Kind::Documented,
        .what = "Sharpness that has not decayed one level above the last is approximated with it.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "bfr-chaikin",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "Bfr knows only the sharp edges at the vertices of a face; whether the far half of a Chaikin "
                "edge "
                "stays sharp depends on others, and it is taken to.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "uniform-jump",
        .family = "opensubdiv",
        .kind = Kind::Documented,
        .what = "Where two unequal semi-sharp creases meet, the vertex jumps as the sharpness of one passes "
                "1: the "
                "share of the crease is the mean over those that end, and then one less ends.  Ours does the "
                "same.",
        .versions = "3.5.0",
    },
    KnownDeviation{
        .name = "fvar-limit-level-0",
        .family = "opensubdiv",
        .kind = Kind::Error,
        .what = "On an unrefined mesh LimitFaceVarying leaves some of the values at a seam unwritten.",
        .versions = "3.5.0",
    },
};

}  // namespace

std::string page_of(const KnownDeviation& deviation) {
    return fmt::format("docs/deviations/{}.md", deviation.name);
}

std::string_view name(KnownDeviation::Kind kind) {
    switch (kind) {
        case Kind::Error:
            return "error";
        case Kind::Approximation:
            return "approximation";
        case Kind::Documented:
            return "documented";
    }
    return {};
}

LimitVertex limit_vertex(const core::SchemeLevel& level, core::Index v) {
    return {core::star_of(level.topology, level.sharpness, v),
            core::has_finite_sharpness(level.topology, level.sharpness, v) ? LimitVertex::Sharpness::Finite
                                                                           : LimitVertex::Sharpness::Settled};
}

std::span<const KnownDeviation> known_deviations() {
    return kDeviations;
}

const KnownDeviation* find_deviation(std::span<const KnownDeviation> list, std::string_view name) {
    for (const KnownDeviation& deviation : list)
        if (deviation.name == name) return &deviation;
    return nullptr;
}

namespace {

bool is_anything_semi_sharp(const core::Sharpness& sharpness) {
    return std::any_of(sharpness.edge.begin(), sharpness.edge.end(), core::is_semi_sharp) ||
           std::any_of(sharpness.vertex.begin(), sharpness.vertex.end(), core::is_semi_sharp);
}

}  // namespace

bool is_predicted(const KnownDeviation& deviation, const core::TriangleMesh& mesh,
                  const core::SchemeOptions& options, int levels) {
    if (deviation.as_done == nullptr) return false;
    const core::SchemeOptions done = deviation.as_done(options);
    if (done == options) return false;
    core::SchemeLevel level = core::control_level(mesh, options.boundary);
    for (int l = 0; l < levels; ++l) {
        // The options that make masks differ say what becomes of a finite sharpness.
        if (!is_anything_semi_sharp(level.sharpness)) return false;
        const auto halves = core::half_edge_sharpness(level.topology, level.sharpness, options.creasing);
        const auto rows = core::make_rows(level.topology, level.sharpness, halves, options);
        const auto rows_done = core::make_rows(level.topology, level.sharpness, halves, done);
        if (rows.masks != rows_done.masks || rows.mask_of_row != rows_done.mask_of_row) return true;
        if (l + 1 == levels) break;
        auto step = core::next_level(level, options);
        if (!step) return false;
        level = std::move(step->child);
    }
    return false;
}

const DeviatingMasks::Found& DeviatingMasks::at(const LimitVertex& vertex) {
    const auto known = found_.find(vertex);
    if (known != found_.end()) return known->second;
    Found found;
    for (const KnownDeviation& deviation : list_)
        if (deviation.family == family_ && deviation.applies != nullptr && deviation.applies(vertex)) {
            found = {&deviation, deviation.limit_as_done(vertex.star)};
            break;
        }
    return found_.emplace(vertex, std::move(found)).first->second;
}

}  // namespace loopcheck::compare
