#include "compare/deviations.h"

#include <array>

#include "core/loop/refine.h"

namespace loopcheck::compare {
namespace {

constexpr std::array kDeviations{
    KnownDeviation{
        .name = "chaikin-overweight",
        .family = "opensubdiv",
        .kind = KnownDeviation::Kind::Error,
        .what = "Where a Chaikin crease of sharpness s > 1 becomes smooth at one end in one step, OpenSubdiv "
                "gives the "
                "crease rule the weight s and the smooth rule the weight 1 - s < 0.",
        .page = "docs/deviations/chaikin-overweight.md",
        .as_done =
            [](core::SchemeOptions options) {
                options.crease_share = core::CreaseShare::Unclamped;
                return options;
            },
    },
};

}  // namespace

std::span<const KnownDeviation> known_deviations() {
    return kDeviations;
}

bool is_predicted(const KnownDeviation& deviation, const core::TriangleMesh& mesh,
                  const core::SchemeOptions& options, int levels) {
    const core::SchemeOptions done = deviation.as_done(options);
    if (done == options) return false;
    core::SchemeLevel level = core::control_level(mesh, options.boundary);
    for (int l = 0; l < levels; ++l) {
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

}  // namespace loopcheck::compare
