// Text of the files; see the header.
#include "models/generate/write.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <set>
#include <utility>

namespace loopcheck::models {
namespace {

std::string shortest(double value) {
    std::array<char, 32> text = {};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end};
}

std::size_t boundary_edge_count(const Mesh& mesh) {
    std::set<std::pair<int, int>> unpaired;
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const int from = face[i], to = face[(i + 1) % 3];
            if (unpaired.erase({to, from}) == 0) unpaired.insert({from, to});
        }
    }
    return unpaired.size();
}

std::string tag_text(const Mesh& mesh) {
    std::string text;
    if (mesh.interpolate_boundary) {
        text += "t interpolateboundary 1/0/0 " +
                std::to_string(static_cast<int>(*mesh.interpolate_boundary)) + "\n";
    }
    if (mesh.crease_method == CreaseMethod::Chaikin) text += "t creasemethod 0/0/1 chaikin\n";
    for (const auto& [from, to, sharpness] : mesh.creases) {
        text += "t crease 2/1/0 " + std::to_string(from) + " " + std::to_string(to) + " " +
                shortest(sharpness) + "\n";
    }
    for (const auto& [vertex, sharpness] : mesh.corners) {
        text += "t corner 1/1/0 " + std::to_string(vertex) + " " + shortest(sharpness) + "\n";
    }
    for (const int face : mesh.holes) text += "t hole 1/0/0 " + std::to_string(face) + "\n";
    return text;
}

constexpr const char* kIndexHead = R"(# Models

Small meshes, each with one purpose in its name, control points of curves
(`curves/`) and surfaces (`grids/`), and files that a reader must refuse (`reject/`).
Every file here, this one too, is written by `loopcheck_models models`, the program in
[generate/](generate/); change the program, not the files. To add a model, add one entry to
[generate/catalogue.cpp](generate/catalogue.cpp), to add a curve one to [generate/curves.cpp](generate/curves.cpp).

The format of meshes is OBJ. The first line is the purpose. Faces are counter-clockwise seen from outside, and
`f` counts from 1 as usual. The tags are those of the OpenSubdiv test shapes and count from 0:

| Tag | Meaning |
|---|---|
| `t crease 2/1/0 a b s` | edge a b has sharpness s; 10 and more is infinite |
| `t corner 1/1/0 v s` | vertex v has sharpness s |
| `t hole 1/0/0 f` | face f is a hole |
| `t interpolateboundary 1/0/0 n` | 0 none, 1 edge and corner, 2 edge only |
| `t creasemethod 0/0/1 chaikin` | sharpness decays by Chaikin's rule, not uniformly |

The shapes are off-centre and lopsided on purpose: symmetry hides errors.

)";

}  // namespace

std::string obj_text(const Model& model) {
    const Mesh& mesh = model.mesh;
    std::string text = "# " + model.purpose + "\n";
    for (const Point& point : mesh.points) {
        text += "v";
        for (const double coordinate : point) text += " " + shortest(rounded(coordinate, mesh.decimals));
        text += "\n";
    }
    for (const Face& face : mesh.faces) {
        text += "f";
        for (const int vertex : face) text += " " + std::to_string(vertex + 1);
        text += "\n";
    }
    return text + tag_text(mesh);
}

std::string points_text(const CurveModel& curve) {
    std::string text = "# " + curve.purpose + "\n";
    for (const auto& point : curve.points)
        for (std::size_t i = 0; i < point.size(); ++i)
            text += shortest(rounded(point[i], curve.decimals)) + (i + 1 < point.size() ? " " : "\n");
    return text;
}

std::string index_text(const std::vector<Model>& models, const std::vector<CurveModel>& curves,
                       const std::vector<GridModel>& grids, const std::vector<Reject>& rejects) {
    std::string text = kIndexHead;
    text += "## Meshes\n\n| File | Purpose | Vertices | Faces | Boundary edges |\n|---|---|--:|--:|--:|\n";
    for (const auto& [name, purpose, mesh] : models) {
        text += "| [" + name + ".obj](" + name + ".obj) | " + purpose + " | " +
                std::to_string(mesh.points.size()) + " | " + std::to_string(mesh.faces.size()) + " | " +
                std::to_string(boundary_edge_count(mesh)) + " |\n";
    }
    text += "\n## Curves\n\nControl points, one a line, for `loopcheck curve`.\n\n";
    text += "| File | Purpose | Points | Dimension |\n|---|---|--:|--:|\n";
    for (const CurveModel& curve : curves) {
        text += "| [" + curve.name + ".txt](curves/" + curve.name + ".txt) | " + curve.purpose + " | " +
                std::to_string(curve.points.size()) + " | " + std::to_string(curve.points.front().size()) +
                " |\n";
    }
    text += "\n## Grids\n\nControl points of surfaces, row after row, for `loopcheck grid`.\n\n";
    text += "| File | Purpose | Rows | Columns |\n|---|---|--:|--:|\n";
    for (const auto& [points, columns] : grids) {
        text += "| [" + points.name + ".txt](grids/" + points.name + ".txt) | " + points.purpose + " | " +
                std::to_string(points.points.size() / static_cast<std::size_t>(columns)) + " | " +
                std::to_string(columns) + " |\n";
    }
    text += "\n## Files to refuse\n\nEach is wrong in one way, and must be refused with this code.\n\n";
    text += "| File | Code | Why |\n|---|---|---|\n";
    for (const Reject& reject : rejects) {
        text += "| [" + reject.file + "](reject/" + reject.file + ") | `" + reject.code + "` | " +
                reject.reason + " |\n";
    }
    return text;
}

}  // namespace loopcheck::models
