#include "compare/loading.h"

#include <fmt/format.h>

#include <glm/trigonometric.hpp>
#include <utility>

#include "core/mesh/creases.h"

namespace loopcheck::compare {

core::Result<LoadedModel> load_model(const std::filesystem::path& path, bool triangulate) {
    auto model = core::read_model(path);
    if (!model) return tl::unexpected(model.error());
    if (triangulate) {
        auto triangles = core::triangulate(model->data);
        if (triangles.split > 0) {
            model->warnings.push_back(fmt::format(
                "{} polygons were split by a fan from their first corner: {} faces "
                "became {}.",
                triangles.split, model->data.face_sizes.size(), triangles.data.face_sizes.size()));
            if (!model->face_lines.empty()) {
                std::vector<core::Index> lines;
                for (const core::Index polygon : triangles.polygon_of)
                    lines.push_back(model->face_lines[polygon]);
                model->face_lines = std::move(lines);
            }
        }
        model->data = std::move(triangles.data);
    }
    auto mesh = core::TriangleMesh::make(std::move(model->data));
    if (!mesh) {
        core::Error error = mesh.error();
        if (const core::Place line = model->locate(error.place); line != error.place) {
            error.sentence = fmt::format("{}: {}", core::to_string(error.place), error.sentence);
            error.place = line;
        }
        return tl::unexpected(std::move(error));
    }
    return LoadedModel{std::move(*model), std::move(*mesh)};
}

CreaseTags tag_creases(core::TriangleMesh& mesh, double degrees) {
    core::CreasedMesh creased = core::with_creases(mesh, glm::radians(degrees));
    mesh = std::move(creased.mesh);
    return {degrees, creased.edges};
}

core::SchemeOptions options_for_model(const core::Model& model, std::optional<core::BoundaryRule> boundary,
                                      std::optional<core::Creasing> creasing, core::Weights weights) {
    core::SchemeOptions out;
    out.boundary = boundary.value_or(model.boundary.value_or(out.boundary));
    out.creasing = creasing.value_or(model.creasing.value_or(out.creasing));
    out.weights = weights;
    return out;
}

}  // namespace loopcheck::compare
