// From a file on disk to a mesh that can be subdivided.
#pragma once

#include <cstddef>
#include <filesystem>

#include "core/mesh/io/model.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {

/// A validated mesh with what its file says beside it.
struct LoadedModel {
    core::Model model;  ///< `data` is empty: it became the mesh
    core::TriangleMesh mesh;
};

/// Reads and validates a model; polygons are split by a fan if `triangulate`, with a warning that says so.
/// Errors: those of `read_model` and `TriangleMesh::make`, with the line of the file where it is known.
core::Result<LoadedModel> load_model(const std::filesystem::path& path, bool triangulate);

/// Creases that were tagged by angle, and on how many edges.
struct CreaseTags {
    double degrees = 0;
    std::size_t edges = 0;
};

/// Makes edges infinitely sharp where faces meet at more than an angle: `core::with_creases`, in degrees.
CreaseTags tag_creases(core::TriangleMesh& mesh, double degrees);

/// The rules for a model: what the caller asked for, else what the file says, else the defaults.
core::SchemeOptions options_for_model(const core::Model& model, std::optional<core::BoundaryRule> boundary,
                                      std::optional<core::Creasing> creasing, core::Weights weights);

}  // namespace loopcheck::compare
