#include "compare/surface/corner_class.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/loop/limit.h"

namespace loopcheck::compare {
namespace {

using Kind = CornerClass::Kind;
using core::Index;

constexpr int kDeep = 3;  // lattice steps from the vertex: its ring, and the rings of that

bool is_closed(Kind kind) {
    return kind != Kind::Boundary && kind != Kind::Corner;
}

bool has_sharp_spoke(Kind kind) {
    return kind == Kind::Dart || kind == Kind::CreasedCone;
}

// The numbers of the lattice points: vertex 0, then spoke by spoke, then wedge by wedge.
struct Lattice {
    int wedges, spokes;

    Index operator()(int wedge, int a, int b) const {
        if (a == 0 && b == 0) return 0;
        if (b == 0) return 1 + kDeep * wedge + a - 1;
        if (a == 0) return 1 + kDeep * ((wedge + 1) % spokes) + b - 1;
        return 1 + kDeep * spokes + 3 * wedge + (a == 2 ? 2 : b - 1);
    }
    Index count() const { return 1 + kDeep * spokes + 3 * wedges; }
};

}  // namespace

std::string to_string(CornerClass c) {
    const auto with = [&](const char* word) { return fmt::format("{} {}", word, c.faces); };
    switch (c.kind) {
        case Kind::Regular:
            return "regular";
        case Kind::Interior:
            return with("interior");
        case Kind::Boundary:
            return with("boundary");
        case Kind::Corner:
            return with("corner");
        case Kind::Dart:
            return with("dart");
        case Kind::Cone:
            return with("cone");
        case Kind::CreasedCone:
            return with("creased cone");
        case Kind::SemiSharp:
            return "semi-sharp";
    }
    return {};
}

CornerClass class_of(const core::CornerView& view) {
    if (!view.settled) return {Kind::SemiSharp, 0};
    if (view.is_regular()) return {};
    const int faces = view.sector.faces;
    switch (view.star.rule()) {
        case core::VertexRule::Smooth:
            return {Kind::Interior, faces};
        case core::VertexRule::Dart:
            return {Kind::Dart, faces};
        case core::VertexRule::Crease:
            return {Kind::Boundary, faces};
        case core::VertexRule::Corner:
            break;
    }
    if (view.star.sharp.size() >= 2) return {Kind::Corner, faces};
    return {view.star.sharp.empty() ? Kind::Cone : Kind::CreasedCone, faces};
}

std::optional<double> eigenvalue(CornerClass c) {
    const auto of_angle = [](double angle) { return 3. / 8 + std::cos(angle) / 4; };
    const double n = c.faces, pi = std::numbers::pi;
    switch (c.kind) {
        case Kind::Regular:
            return 1. / 2;
        case Kind::Interior:
            return of_angle(2 * pi / n);
        case Kind::Boundary:
        case Kind::Corner:
        case Kind::CreasedCone:
            return std::max(1. / 2, of_angle(pi / n));
        case Kind::Dart:
            if (c.faces < 3) return std::nullopt;
            return std::max(of_angle(2 * pi / n),
                            static_cast<double>(core::dart_tangent(c.faces, core::Weights::Loop).eigenvalue));
        case Kind::Cone:
            return 5. / 8;
        case Kind::SemiSharp:
            break;
    }
    return std::nullopt;
}

std::optional<core::TriangleMesh> local_mesh(CornerClass c) {
    if (c.kind == Kind::Regular) c = {Kind::Interior, 6};
    if (c.kind == Kind::SemiSharp || c.faces < (is_closed(c.kind) ? 3 : 1)) return std::nullopt;
    const Lattice at{c.faces, is_closed(c.kind) ? c.faces : c.faces + 1};
    core::MeshData data;
    data.positions.resize(at.count());  // no error depends on them
    for (int w = 0; w < c.faces; ++w) data.add_face(core::Triangle{0, at(w, 1, 0), at(w, 0, 1)});
    for (int w = 0; w < c.faces; ++w)
        for (int a = 0; a < kDeep; ++a)
            for (int b = 0; a + b < kDeep; ++b) {
                if (a + b > 0) data.add_face(core::Triangle{at(w, a, b), at(w, a + 1, b), at(w, a, b + 1)});
                if (a + b + 1 < kDeep)
                    data.add_face(core::Triangle{at(w, a + 1, b), at(w, a + 1, b + 1), at(w, a, b + 1)});
            }
    if (has_sharp_spoke(c.kind))
        for (int a = 0; a < kDeep; ++a)
            data.creases.push_back({at(0, a, 0), at(0, a + 1, 0), core::kInfiniteSharpness});
    if (c.kind == Kind::Corner || c.kind == Kind::Cone || c.kind == Kind::CreasedCone)
        data.corners.push_back({0, core::kInfiniteSharpness});
    auto mesh = core::TriangleMesh::make(std::move(data));
    if (!mesh) return std::nullopt;
    return std::move(*mesh);
}

}  // namespace loopcheck::compare
