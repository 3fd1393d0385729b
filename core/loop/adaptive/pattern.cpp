#include "core/loop/adaptive/pattern.h"

#include <algorithm>
#include <utility>

namespace loopcheck::core {

SplitPattern split_pattern(const Triangle& corners, const Triangle& midpoints) {
    const auto unsplit = std::count(midpoints.begin(), midpoints.end(), kNone);
    // Counted from edge i: the one that differs from the two others, where there is one.
    const auto turned = [&](bool split) {
        int i = 0;
        while ((midpoints[i] != kNone) != split) ++i;
        const int j = next_corner(i), k = previous_corner(i);
        return std::pair(Triangle{corners[i], corners[j], corners[k]},
                         Triangle{midpoints[i], midpoints[j], midpoints[k]});
    };
    if (unsplit == 0) {
        const auto [a, b, c] = corners;
        const auto [ab, bc, ca] = midpoints;
        return {{{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}}, 4};
    }
    if (unsplit == 1) {
        const auto [v, m] = turned(false);
        return {{{{v[0], v[1], m[1]}, {m[1], v[2], m[2]}, {m[2], v[0], m[1]}}}, 3};
    }
    if (unsplit == 2) {
        const auto [v, m] = turned(true);
        return {{{{v[0], m[0], v[2]}, {m[0], v[1], v[2]}}}, 2};
    }
    return {{{corners}}, 1};
}

}  // namespace loopcheck::core
