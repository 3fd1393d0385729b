#include "core/loop/face_part.h"

#include <algorithm>

namespace loopcheck::core {
namespace {

// The ring of six around a regular corner, counter-clockwise from the face's next corner on.
std::array<PatchPoint, 6> ring_of_six(const Topology& t, Index v, const CornerView& view) {
    const auto ring = t.ring(v);
    const auto edge = [&](int i) { return t.other_end(ring[(view.sector.first + i) % view.star.ring], v); };
    const int k = view.sector.faces;
    std::array<PatchPoint, 6> six;
    for (int i = 0; i < std::min(k + 1, 6); ++i) six[i] = PatchPoint(edge(i));
    if (k == 3) {
        six[4] = PatchPoint::across(v, edge(3), edge(2));
        six[5] = PatchPoint::across(v, edge(0), edge(1));
    } else if (k == 1) {
        six[2] = PatchPoint::across(v, edge(1), edge(0));
        six[3] = PatchPoint::opposite(v, edge(0));
        six[4] = PatchPoint::opposite(v, edge(1));
        six[5] = PatchPoint::across(v, edge(0), edge(1));
    }
    std::rotate(six.begin(), six.begin() + view.place, six.end());
    return six;
}

Patch patch_of(const SchemeLevel& level, Index face, const std::array<CornerView, 3>& views) {
    const Triangle& corners = level.topology.triangles[face];
    Patch patch;
    for (int i = 0; i < 3; ++i) {
        const auto six = ring_of_six(level.topology, corners[i], views[i]);
        patch[i] = PatchPoint(corners[i]);
        patch[3 + i] = six[5];
        patch[6 + 2 * i] = six[3];
        patch[7 + 2 * i] = six[4];
    }
    return patch;
}

}  // namespace

PatchPoint PatchPoint::across(Index x, Index y, Index z) {
    PatchPoint p;
    p.terms = {{{x, 1}, {y, 1}, {z, -1}}};
    p.count = 3;
    return p;
}

PatchPoint PatchPoint::opposite(Index v, Index e) {
    PatchPoint p;
    p.terms = {{{v, 2}, {e, -1}, {}}};
    p.count = 2;
    return p;
}

FacePart face_part(const SchemeLevel& level, Index face, Creasing creasing) {
    const Topology& whole = level.topology;
    FacePart out;
    out.part =
        sublevel_around(whole, level.sharpness, vertices_to_keep(whole, whole.triangles[face], creasing));
    out.face = static_cast<Index>(std::lower_bound(out.part.faces.begin(), out.part.faces.end(), face) -
                                  out.part.faces.begin());
    for (int i = 0; i < 3; ++i) out.views[i] = view_from(out.part.level, out.face, i);
    if (std::all_of(out.views.begin(), out.views.end(),
                    [](const CornerView& view) { return view.is_regular(); }))
        out.patch = patch_of(out.part.level, out.face, out.views);
    return out;
}

}  // namespace loopcheck::core
