// Every model of the folder: name, purpose, mesh. To add a model, add one entry.
#pragma once

#include <vector>

#include "models/generate/mesh.h"

namespace loopcheck::models {

std::vector<Model> catalogue();

}  // namespace loopcheck::models
