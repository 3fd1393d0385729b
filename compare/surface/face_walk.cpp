#include "compare/surface/face_walk.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/loop/child_parameter.h"

namespace loopcheck::compare {
namespace {

using core::CornerView;
using core::Index;
using reference::PatchSharpness;
using reference::SurfaceMethod;
using reference::SurfaceSettings;
using Kind = PatchAt::Kind;

bool is_semi_sharp(const CornerView& view) {
    return !view.settled;
}

// An infinitely sharp vertex that is irregular in another sector: OpenSubdiv refines all its faces.
bool is_irregular_beyond(const CornerView& view) {
    if (!view.settled || view.star.sharp.size() < 2) return false;
    const auto sectors = view.star.sectors();
    return std::any_of(sectors.begin(), sectors.end(),
                       [&](const core::Sector& s) { return s.faces != sectors.front().faces; });
}

// An infinitely sharp feature that PatchTable, as it comes, does not keep: all but smooth boundaries and
// boundary corners of one face.
bool is_blurred(const CornerView& view) {
    if (!view.settled || (view.star.sharp.empty() && !view.star.pinned)) return false;
    return !(view.star.open && view.star.sharp.size() == 2) || (view.star.pinned && view.sector.faces > 1);
}

// A boundary vertex of one face that is not kept: PatchTable, as it comes, keeps it in the patch of the last
// level.
bool is_legacy_corner(const CornerView& view) {
    return view.settled && view.star.open && !view.star.pinned && view.sector.faces == 1;
}

Spread spread_of(std::span<const glm::dvec3> points) {
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {(high - low) / 2., glm::abs(high + low) / 2.};
}

}  // namespace

bool blurs(const SurfaceSettings& settings) {
    return settings.method != SurfaceMethod::Bfr && settings.sharpness == PatchSharpness::Default;
}

// A triangle with what is around it.
struct FaceWalk::Node {
    core::SubLevel part;
    Index face = 0;
    std::vector<glm::dvec3> positions;  // per vertex of the part
    std::array<CornerView, 3> views;
    std::array<CornerClass, 3> classes;
    std::optional<core::Step> step;  // to the children, made when first needed
    std::vector<std::vector<double>> step_weights;
    std::array<std::unique_ptr<Node>, 4> children;

    template <class PositionOf>
    Node(const core::SchemeLevel& level, Index whole_face, const PositionOf& position_of)
        : part(core::sublevel_around(level.topology, level.sharpness, level.topology.triangles[whole_face])),
          face(static_cast<Index>(std::lower_bound(part.faces.begin(), part.faces.end(), whole_face) -
                                  part.faces.begin())) {
        for (const Index v : part.vertices) positions.push_back(position_of(v));
        for (int i = 0; i < 3; ++i) {
            views[i] = core::view_from(part.level, face, i);
            classes[i] = class_of(views[i]);
        }
    }
    bool any(bool (*holds)(const CornerView&)) const {
        return std::any_of(views.begin(), views.end(), holds);
    }
    // The corner that alone is irregular, or kNone.
    int irregular_corner() const {
        int found = core::kNone;
        for (int i = 0; i < 3; ++i) {
            if (classes[i] == CornerClass{}) continue;
            if (found != core::kNone) return core::kNone;
            found = i;
        }
        return found;
    }
    bool is_regular() const { return classes == std::array<CornerClass, 3>{}; }
};

FaceWalk::FaceWalk(const core::SchemeLevel& control, const core::SchemeOptions& options,
                   std::span<const glm::dvec3> positions, Index face)
    : options_(options),
      root_(std::make_unique<Node>(control, face, [&](Index v) { return positions[v]; })) {}

FaceWalk::~FaceWalk() = default;

const std::array<CornerClass, 3>& FaceWalk::classes() const {
    return root_->classes;
}

Spread FaceWalk::spread() const {
    return spread_of(root_->positions);
}

auto FaceWalk::child(Node& parent, int k) -> Node& {
    auto& slot = parent.children[k];
    if (slot) return *slot;
    if (!parent.step) {
        parent.step = core::next_level(parent.part.level, options_).value();  // never too large: a few faces
        parent.step_weights = core::weights_of<double>(parent.step->rows, options_.weights);
    }
    // Not all rows: those between vertices that are not kept mean nothing.
    const core::Rows& rows = parent.step->rows;
    const auto position_of = [&](Index v) {
        const auto columns = rows.columns_of(v);
        const auto& weights = parent.step_weights[rows.mask_of_row[v]];
        glm::dvec3 out(0);
        for (std::size_t j = 0; j < columns.size(); ++j) out += weights[j] * parent.positions[columns[j]];
        return out;
    };
    slot = std::make_unique<Node>(parent.step->child, 4 * parent.face + k, position_of);
    return *slot;
}

PatchAt FaceWalk::patch_at(double u, double v, const SurfaceSettings& settings) {
    Node *node = root_.get(), *above = nullptr;
    PatchAt out;
    for (;; ++out.depth) {
        const bool blurred = blurs(settings) && node->any(is_blurred);
        const bool regular = node->is_regular() && !blurred;
        if (regular && (!node->any(is_irregular_beyond) || out.depth >= settings.smooth_level)) return out;
        const bool legacy = blurs(settings) && node->any(is_legacy_corner);
        const bool sharp = blurred || node->any(is_semi_sharp);
        if (out.depth >= (sharp ? settings.sharp_level : settings.smooth_level)) {
            out.kind = blurred || legacy ? Kind::Blurred : sharp ? Kind::SemiSharp : Kind::Crowded;
            break;
        }
        above = node;
        const int k = core::descend(u, v);
        if (k == 3) out.turn = -out.turn;
        node = &child(*node, k);
    }
    const int corner = node->irregular_corner();
    if (out.kind == Kind::Crowded && above != nullptr && above->any(is_semi_sharp))
        out.kind = Kind::SemiSharp;
    if (out.kind == Kind::Crowded && above != nullptr && corner != core::kNone &&
        above->irregular_corner() == corner) {
        out.kind = Kind::Approximate;
        out.corner = corner;
        out.corner_class = node->classes[corner];
    }
    out.spread = spread_of(out.kind == Kind::Approximate ? above->positions : node->positions);
    return out;
}

}  // namespace loopcheck::compare
