// The cow: the one model that is there to be looked at.
#pragma once

#include "models/generate/mesh.h"

namespace loopcheck::models {

/// A walking cow of triangles: closed, of genus 0, y up, its hooves near y = 0, facing +x.
Mesh cow();

/// The same cow with infinitely sharp soles and a semi-sharp edge round the muzzle.
Mesh cow_with_creases();

}  // namespace loopcheck::models
