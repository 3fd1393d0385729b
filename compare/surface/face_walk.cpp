#include "compare/surface/face_walk.h"

#include <algorithm>
#include <glm/common.hpp>

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

// An infinitely sharp feature that PatchTable, as it comes, does not keep: all but smooth boundaries of two
// faces or more and boundary corners of one face.
bool is_blurred(const CornerView& view) {
    if (!view.settled || (view.star.sharp.empty() && !view.star.pinned)) return false;
    const bool plain = view.star.open && view.star.sharp.size() == 2;
    return !plain || view.star.pinned != (view.sector.faces == 1);
}

bool blurs(const SurfaceSettings& settings) {
    return settings.method != SurfaceMethod::Bfr && settings.sharpness == PatchSharpness::Default;
}

// Where a parameter is in one of the four children of its triangle.
int descend(double& u, double& v) {
    const int k = u >= 0.5 ? 1 : v >= 0.5 ? 2 : u + v <= 0.5 ? 0 : 3;
    u = k == 3 ? 1 - 2 * u : k == 1 ? 2 * u - 1 : 2 * u;
    v = k == 3 ? 1 - 2 * v : k == 2 ? 2 * v - 1 : 2 * v;
    return k;
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

// A triangle with what is around it.
struct FaceWalk::Node {
    core::SubLevel part;
    Index face = 0;
    std::vector<glm::dvec3> positions;  // per vertex of the part
    std::array<CornerView, 3> views;
    std::array<CornerClass, 3> classes;
    std::optional<core::Step> step;  // to the children, made when first needed
    core::Points<double> refined;
    std::array<std::unique_ptr<Node>, 4> children;

    Node(const core::SchemeLevel& level, std::span<const glm::dvec3> points, Index whole_face)
        : part(core::sublevel_around(level.topology, level.sharpness, level.topology.triangles[whole_face])),
          face(static_cast<Index>(std::lower_bound(part.faces.begin(), part.faces.end(), whole_face) -
                                  part.faces.begin())) {
        for (const Index v : part.vertices) positions.push_back(points[v]);
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
    : options_(options), root_(std::make_unique<Node>(control, positions, face)) {}

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
        parent.refined = core::apply<double>(parent.step->rows, options_.weights, parent.positions);
    }
    slot = std::make_unique<Node>(parent.step->child, parent.refined, 4 * parent.face + k);
    return *slot;
}

PatchAt FaceWalk::patch_at(double u, double v, const SurfaceSettings& settings) {
    Node *node = root_.get(), *above = nullptr;
    PatchAt out;
    for (;; ++out.depth) {
        const bool blurred = blurs(settings) && node->any(is_blurred);
        if (node->is_regular() && !blurred) return out;
        const bool sharp = blurred || node->any(is_semi_sharp);
        if (out.depth >= (sharp ? settings.sharp_level : settings.smooth_level)) {
            out.kind = blurred ? Kind::Blurred : sharp ? Kind::SemiSharp : Kind::Crowded;
            break;
        }
        above = node;
        const int k = descend(u, v);
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
