#include "core/loop/corner_view.h"

#include <algorithm>

namespace loopcheck::core {

bool CornerView::is_regular() const {
    if (!settled) return false;
    switch (star.rule()) {
        case VertexRule::Smooth:
            return sector.faces == 6;
        case VertexRule::Dart:
            return false;
        case VertexRule::Crease:
            return sector.faces == 3;
        case VertexRule::Corner:
            return star.sharp.size() >= 2 && sector.faces == 1;
    }
    return false;
}

CornerView view_from(const SchemeLevel& level, Index face, int corner) {
    const Topology& t = level.topology;
    const Index v = t.triangles[face][corner];
    CornerView view;
    view.settled = !has_finite_sharpness(t, level.sharpness, v);
    if (!view.settled) return view;
    view.star = star_of(t, level.sharpness, v);
    const auto ring = t.ring(v);
    const int position =
        static_cast<int>(std::find(ring.begin(), ring.end(), t.face_edges[face][corner]) - ring.begin());
    for (const Sector& sector : view.star.sectors()) {
        const int place = (position - sector.first + view.star.ring) % view.star.ring;
        if (place < sector.faces) {
            view.sector = sector;
            view.place = place;
        }
    }
    return view;
}

}  // namespace loopcheck::core
