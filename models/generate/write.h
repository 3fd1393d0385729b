// Models as text: OBJ with tags, points of curves, and the index of the folder.
#pragma once

#include <string>
#include <vector>

#include "models/generate/curves.h"
#include "models/generate/mesh.h"
#include "models/generate/reject.h"

namespace loopcheck::models {

/// The OBJ file of a model: purpose, vertices, faces, tags. Coordinates are rounded to the decimals of the
/// mesh and written with the fewest digits, so that the text is the same on every machine.
std::string obj_text(const Model& model);

/// The text file of a curve or a grid: purpose, then a point a line.
std::string points_text(const CurveModel& curve);

/// README.md: what the folder holds, file by file.
std::string index_text(const std::vector<Model>& models, const std::vector<CurveModel>& curves,
                       const std::vector<GridModel>& grids, const std::vector<Reject>& rejects);

}  // namespace loopcheck::models
