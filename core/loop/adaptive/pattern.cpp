#include "core/loop/adaptive/pattern.h"

#include <algorithm>

namespace loopcheck::core {

SplitPattern split_pattern(const Triangle& corners, const Triangle& midpoints) {
    // Cuts corner i off; the corner keeps its place.
    const auto corner_child = [&](int i) {
        Triangle piece;
        piece[i] = corners[i];
        piece[next_corner(i)] = midpoints[i];
        piece[previous_corner(i)] = midpoints[previous_corner(i)];
        return piece;
    };
    const auto unsplit = std::count(midpoints.begin(), midpoints.end(), kNone);
    const auto edge_that = [&](bool is_split) {
        int i = 0;
        while ((midpoints[i] != kNone) != is_split) ++i;
        return i;
    };
    if (unsplit == 0)
        return {
            {{corner_child(0), corner_child(1), corner_child(2), {midpoints[1], midpoints[2], midpoints[0]}}},
            4};
    if (unsplit == 1) {
        const int ab = edge_that(false), bc = next_corner(ab), ca = previous_corner(ab);
        const Index a = corners[ab], b = corners[bc];
        return {{{{a, b, midpoints[bc]}, corner_child(ca), {midpoints[ca], a, midpoints[bc]}}}, 3};
    }
    if (unsplit == 2) {
        const int ab = edge_that(true);
        const Index a = corners[ab], b = corners[next_corner(ab)], c = corners[previous_corner(ab)];
        return {{{{a, midpoints[ab], c}, {midpoints[ab], b, c}}}, 2};
    }
    return {{{corners}}, 1};
}

}  // namespace loopcheck::core
