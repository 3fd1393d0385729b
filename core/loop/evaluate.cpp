#include "core/loop/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/loop/box_spline.h"
#include "core/loop/child_parameter.h"
#include "core/loop/face_part.h"

namespace loopcheck::core {
namespace {

// The most roundings in an entry of the product of some rows with what they are over.
int roundings_of(const Rows& rows, Weights weights) {
    int most = 0;
    for (const Mask& mask : rows.masks)
        most = std::max(most, static_cast<int>(places_of(mask).size()) + weight_ulps(mask, weights));
    return most;
}

template <class Scalar>
using Matrix = std::vector<std::vector<Scalar>>;

template <class Scalar>
void add_scaled(std::vector<Scalar>& to, const Scalar& factor, const std::vector<Scalar>& row) {
    for (std::size_t j = 0; j < to.size(); ++j) to[j] += factor * row[j];
}

// The corner at which a parameter is, or kNone.
template <class Scalar>
int corner_at(const Scalar& u, const Scalar& v) {
    if (u == 0 && v == 0) return 0;
    return u == 1 ? 1 : v == 1 ? 2 : kNone;
}

template <class Scalar>
int nearest_corner(const Scalar& u, const Scalar& v) {
    const Scalar a = 1 - u - v;
    return a >= u && a >= v ? 0 : u >= v ? 1 : 2;
}

int order_of(int derivative) {
    return derivative == 0 ? 0 : derivative <= static_cast<int>(Derivative::Dv) ? 1 : 2;
}

}  // namespace

// One triangle on the way down: the part of the level that decides its surface, and what its vertices are in
// terms of the control vertices.
template <class Scalar>
struct LimitSurface<Scalar>::Node {
    FacePart around;
    std::shared_ptr<const std::vector<Index>> columns;
    Matrix<Scalar> rows;      // per vertex of the part, over the columns; only of the near ones
    std::vector<Index> near;  // the corners and their neighbours, as numbers of the part, ascending
    double roundings = 0;
    std::optional<Step> step;  // to the children, made when first needed
    Matrix<Scalar> step_weights;
    std::array<std::unique_ptr<Node>, 4> children;

    Node(const SchemeLevel& level, Index face, Creasing creasing)
        : around(face_part(level, face, creasing)),
          near(with_neighbours(around.part.level.topology, around.corners())) {
        std::sort(near.begin(), near.end());
    }
};

template <class Scalar>
LimitSurface<Scalar>::LimitSurface(const TriangleMesh& mesh, const SchemeOptions& options)
    : mesh_(mesh), options_(options), control_(control_level(mesh, options.boundary)) {}

template <class Scalar>
LimitSurface<Scalar>::~LimitSurface() = default;

template <class Scalar>
void LimitSurface<Scalar>::enter(Index face) {
    if (face == face_) return;
    face_ = face;
    root_ = std::make_unique<Node>(control_, face, options_.creasing);
    auto columns = std::make_shared<std::vector<Index>>();
    root_->rows.resize(root_->around.part.vertices.size());
    for (const Index v : root_->near) {
        root_->rows[v].assign(root_->near.size(), Scalar(0));
        root_->rows[v][columns->size()] = 1;
        columns->push_back(root_->around.part.vertices[v]);
    }
    root_->columns = std::move(columns);
}

template <class Scalar>
auto LimitSurface<Scalar>::child(Node& parent, int k) -> Node& {
    auto& slot = parent.children[k];
    if (slot) return *slot;
    if (!parent.step) {
        parent.step = next_level(parent.around.part.level, options_).value();  // never too large: a few faces
        parent.step_weights = weights_of<Scalar>(parent.step->rows, options_.weights);
    }
    const Rows& rows = parent.step->rows;
    slot = std::make_unique<Node>(parent.step->child, 4 * parent.around.face + k, options_.creasing);
    slot->columns = parent.columns;
    slot->roundings = parent.roundings + roundings_of(rows, options_.weights);
    slot->rows.resize(slot->around.part.vertices.size());
    for (const Index near : slot->near) {
        const Index v = slot->around.part.vertices[near];
        const auto& weights = parent.step_weights[rows.mask_of_row[v]];
        const auto columns = rows.columns_of(v);
        auto& row = slot->rows[near];
        row.assign(parent.columns->size(), Scalar(0));
        for (std::size_t j = 0; j < columns.size(); ++j) add_scaled(row, weights[j], parent.rows[columns[j]]);
    }
    return *slot;
}

template <class Scalar>
SurfaceStencil<Scalar> LimitSurface<Scalar>::regular(const Node& node, const Scalar& u, const Scalar& v,
                                                     int depth, int turn) const {
    SurfaceStencil<Scalar> out;
    out.columns = *node.columns;
    const PatchBasis<Scalar> basis = patch_basis(u, v);
    const auto magnitude = patch_basis_magnitude(static_cast<double>(u), static_cast<double>(v));
    for (int d = 0; d < kDerivatives; ++d) {
        const int order = order_of(d);
        // Every level doubles the parameter, the centre child also turns it.
        const double scale = std::ldexp(order == 1 ? turn : 1, order * depth);
        auto& weights = out.weights[d];
        weights.assign(out.columns.size(), Scalar(0));
        double terms = 0;
        for (int place = 0; place < kPatchPoints; ++place) {
            const PatchPoint& point = (*node.around.patch)[place];
            for (int i = 0; i < point.count; ++i)
                add_scaled(weights, Scalar(point.terms[i].second * basis[d][place]),
                           node.rows[point.terms[i].first]);
            terms += magnitude[d][place] * point.magnitude();
        }
        for (Scalar& w : weights) w *= scale;
        constexpr int kSum = 3 * kPatchPoints + 2;
        out.weight_error[d] = std::abs(scale) * terms * (node.roundings + kBasisRoundings + kSum);
    }
    return out;
}

template <class Scalar>
SurfaceStencil<Scalar> LimitSurface<Scalar>::at_corner(const Node& node, int corner) {
    const CornerView& view = node.around.views[corner];
    auto found = corner_masks_.find(view.star);
    if (found == corner_masks_.end())
        found = corner_masks_.emplace(view.star, limit_masks<Scalar>(view.star, options_.weights)).first;
    const LimitMasks<Scalar>& masks = found->second;
    const auto sector = std::find_if(masks.sectors.begin(), masks.sectors.end(),
                                     [&](const auto& s) { return s.sector == view.sector; });

    SurfaceStencil<Scalar> out;
    out.columns = *node.columns;
    out.no_normal = sector->no_normal;
    out.smoothness = out.no_normal == NoNormal::None ? Smoothness::TangentPlane : Smoothness::NoPlane;
    const Topology& t = node.around.part.level.topology;
    const Index v = t.triangles[node.around.face][corner];
    const auto ring = t.ring(v);
    const auto row_of = [&](const std::vector<Scalar>& mask, Derivative d) {
        auto& weights = out.weights[static_cast<int>(d)];
        weights.assign(out.columns.size(), Scalar(0));
        if (mask.empty()) return;
        double size = 0;
        for (std::size_t i = 0; i <= ring.size(); ++i) {
            add_scaled(weights, mask[i], node.rows[i < ring.size() ? t.other_end(ring[i], v) : v]);
            size += std::abs(static_cast<double>(mask[i]));
        }
        out.weight_error[static_cast<int>(d)] =
            size * (node.roundings + static_cast<double>(ring.size()) + 3);
    };
    const std::vector<Scalar> none;
    row_of(masks.position, Derivative::Position);
    row_of(sector->tangent1, Derivative::Du);
    row_of(sector->tangent2, Derivative::Dv);
    for (const Derivative d : {Derivative::Duu, Derivative::Duv, Derivative::Dvv}) row_of(none, d);
    return out;
}

template <class Scalar>
Result<SurfaceStencil<Scalar>> LimitSurface<Scalar>::stencil(Index face, const Scalar& u, const Scalar& v) {
    if (auto error = no_limit_surface(mesh_, options_.boundary, face)) return tl::unexpected(*error);
    if (!(u >= 0 && v >= 0 && u + v <= 1))
        return fail(ErrorCode::OutsideDomain, "Parameters must satisfy u >= 0, v >= 0 and u + v <= 1.",
                    {Place::Kind::Face, face});
    enter(face);
    Node* node = root_.get();
    Scalar x = u, y = v;
    int turn = 1;
    for (int depth = 0;; ++depth) {
        if (node->around.patch) return regular(*node, x, y, depth, turn);
        const int corner = depth < kDeepest ? corner_at(x, y) : nearest_corner(x, y);
        if (corner != kNone && node->around.views[corner].settled && !node->around.views[corner].is_regular())
            return at_corner(*node, corner);
        const int k = descend(x, y);
        if (k == 3) turn = -turn;
        node = &child(*node, k);
    }
}

Curvature curvature_at(int valence) {
    if (valence == 6) return Curvature::Continuous;
    return valence == 4 || valence == 5 ? Curvature::Bounded : Curvature::Unbounded;
}

std::string_view name(Curvature curvature) {
    switch (curvature) {
        case Curvature::Continuous:
            return "continuous";
        case Curvature::Bounded:
            return "bounded";
        case Curvature::Unbounded:
            return "unbounded";
    }
    return {};
}

std::optional<Error> no_limit_surface(const TriangleMesh& mesh, BoundaryRule boundary, Index face) {
    const Place place{Place::Kind::Face, face};
    if (face < 0 || face >= mesh.face_count())
        return Error{ErrorCode::IndexOutOfRange,
                     fmt::format("The mesh has the faces 0 to {}.", mesh.face_count() - 1), place};
    if (mesh.holes()[face])
        return Error{ErrorCode::NoLimitSurface, "It is a hole, which has no surface.", place};
    const Topology& t = mesh.topology();
    if (boundary == BoundaryRule::None)
        for (const Index v : t.triangles[face])
            if (t.is_boundary_vertex(v))
                return Error{ErrorCode::NoLimitSurface,
                             fmt::format("Its vertex {} is on the boundary; with the boundary option none "
                                         "there is no surface there.",
                                         v),
                             place};
    return std::nullopt;
}

template <class Scalar>
SurfaceRows as_rows(const SurfaceStencil<Scalar>& stencil) {
    SurfaceRows out{stencil.columns, {}};
    for (int d = 0; d < kDerivatives; ++d)
        for (const Scalar& w : stencil.weights[d]) out.weights[d].push_back(static_cast<double>(w));
    return out;
}

template <class Scalar>
Result<SurfacePoint<Scalar>> evaluate(const TriangleMesh& mesh, const SchemeOptions& options, Index face,
                                      const Scalar& u, const Scalar& v) {
    LimitSurface<Scalar> surface(mesh, options);
    const auto stencil = surface.stencil(face, u, v);
    if (!stencil) return tl::unexpected(stencil.error());
    const auto positions = convert_points<Scalar>(mesh.positions());
    return apply<Scalar>(*stencil, positions);
}

template class LimitSurface<double>;
template class LimitSurface<HighPrecision>;
template SurfaceRows as_rows(const SurfaceStencil<double>&);
template SurfaceRows as_rows(const SurfaceStencil<HighPrecision>&);
template Result<SurfacePoint<double>> evaluate(const TriangleMesh&, const SchemeOptions&, Index,
                                               const double&, const double&);
template Result<SurfacePoint<HighPrecision>> evaluate(const TriangleMesh&, const SchemeOptions&, Index,
                                                      const HighPrecision&, const HighPrecision&);

}  // namespace loopcheck::core
