// Every curve and grid of the folder: name, purpose, control points. To add one, add one entry.
#pragma once

#include <string>
#include <vector>

namespace loopcheck::models {

/// Control points with two or three coordinates each.
struct CurveModel {
    std::string name;
    std::string purpose;
    std::vector<std::vector<double>> points;
    int decimals = 4;
};

/// Row after row.
struct GridModel {
    CurveModel points;
    int columns = 0;
};

std::vector<CurveModel> curves();
std::vector<GridModel> grids();

}  // namespace loopcheck::models
