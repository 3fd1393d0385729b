#include "models/generate/curves.h"

#include <cmath>

namespace loopcheck::models {
namespace {

using Points = std::vector<std::vector<double>>;

Points helix(int count) {
    Points out;
    for (int i = 0; i < count; ++i)
        out.push_back({1.3 * std::cos(0.9 * i) + 0.2, 0.8 * std::sin(0.9 * i), 0.21 * i - 0.4});
    return out;
}

// 1 at one place, so that the curve over it is the graph of a basis function.
Points unit_pulse() {
    Points out;
    for (int i = -4; i <= 4; ++i) out.push_back({static_cast<double>(i), i == 0 ? 1.0 : 0.0});
    return out;
}

Points lopsided_ring(int count) {
    Points out;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * i / count;
        const double radius = 1.1 + 0.35 * std::cos(2.3 * i);
        out.push_back({radius * std::cos(angle) + 0.3, radius * std::sin(angle) - 0.1});
    }
    return out;
}

// Long, with every second difference another.
Points wandering(int count) {
    Points out;
    for (int i = 0; i < count; ++i)
        out.push_back({0.37 * i + std::sin(1.9 * i), std::cos(0.7 * i * i), std::sin(0.3 * i * i + 1)});
    return out;
}

Points hill(int rows, int columns) {
    Points out;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            out.push_back({0.9 * j + 0.1 * std::sin(2.1 * i + j), 1.1 * i + 0.1 * std::cos(1.3 * i * j),
                           1.7 * std::exp(-0.4 * ((i - 1) * (i - 1) + (j - 2) * (j - 2)))});
    return out;
}

// A ring of rings: `rows` around the axis, `columns` around the tube.
Points lopsided_torus(int rows, int columns) {
    constexpr double kTurn = 6.283185307179586;
    Points out;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double around = kTurn * i / rows, tube = kTurn * j / columns;
            const double radius = 2.2 + (0.7 + 0.15 * std::cos(2.0 * i)) * std::cos(tube);
            out.push_back(
                {radius * std::cos(around) + 0.2, radius * std::sin(around), 0.8 * std::sin(tube) - 0.1 * i});
        }
    return out;
}

}  // namespace

std::vector<CurveModel> curves() {
    return {
        {"lab",
         "the curve of the lab report",
         {{-0.8, 1.0},
          {-0.7, 0.8},
          {-0.5, 0.7},
          {-0.5, 1.0},
          {0.0, 0.1},
          {0.3, 0.6},
          {0.4, 0.5},
          {0.5, 1.0}}},
        {"pulse", "0 but for a 1 in the middle: the curve is the graph of a basis function", unit_pulse()},
        {"two-points", "the fewest points of an open curve", {{0.2, -0.3}, {1.7, 0.9}}},
        {"three-points",
         "the fewest points of a closed curve",
         {{0.2, -0.3, 0.4}, {1.7, 0.9, -0.2}, {0.6, 1.4, 1.1}}},
        {"four-points",
         "the fewest points of a cubic without end rules",
         {{0.1, 0.2}, {0.9, 1.3}, {1.8, -0.4}, {2.2, 0.7}}},
        {"helix", "a curve in space", helix(12)},
        {"ring", "closed, lopsided", lopsided_ring(7)},
        {"figure-eight",
         "closed, crosses itself",
         {{-1.1, -0.7}, {-1.2, 0.8}, {0.1, 0.1}, {1.3, -0.9}, {1.1, 0.7}, {-0.1, -0.05}}},
        {"straight-even",
         "points on a line, evenly spaced: every level is on the curve",
         {{0.5, 1.0}, {1.25, 1.5}, {2.0, 2.0}, {2.75, 2.5}, {3.5, 3.0}}},
        {"straight-uneven",
         "points on a line, unevenly spaced",
         {{0, 0}, {0.1, 0.2}, {1.3, 2.6}, {1.4, 2.8}, {4.0, 8.0}}},
        {"repeated",
         "one point three times in a row: the curve goes through it, with a corner",
         {{0.1, 0.2}, {0.8, 1.1}, {1.7, 0.4}, {1.7, 0.4}, {1.7, 0.4}, {2.4, 1.3}, {3.1, 0.1}}},
        {"one-place", "all points in one place", {{0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}}},
        {"there-and-back",
         "out and back the same way",
         {{0.2, 0.1}, {1.4, 0.6}, {2.9, 1.3}, {1.4, 0.6}, {0.2, 0.1}}},
        {"wandering", "many points in space, no two second differences alike", wandering(60)},
        {"magnitudes",
         "coordinates near one million, one and one millionth side by side",
         {{1000000.25, 0.5, 0.000001},
          {1000001.5, -0.25, 0.000003},
          {999999.75, 0.75, -0.000002},
          {1000002.0, 1.5, 0.000004},
          {1000000.5, -1.0, 0.000002}},
         6},
    };
}

std::vector<GridModel> grids() {
    return {{{"patch-2x2",
              "the smallest grid: a bilinear patch",
              {{0.1, 0.2, 0.3}, {1.4, 0.1, 0.9}, {0.2, 1.7, -0.4}, {1.9, 1.5, 0.6}}},
             2},
            {{"hill-4x5", "a hill: open both ways", hill(4, 5)}, 5},
            {{"ring-7x4", "a ring of rings: to be closed both ways, or one", lopsided_torus(7, 4)}, 4}};
}

}  // namespace loopcheck::models
