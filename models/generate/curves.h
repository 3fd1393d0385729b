// Every curve of the folder: name, purpose, control points. To add a curve, add one entry.
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

std::vector<CurveModel> curves();

}  // namespace loopcheck::models
