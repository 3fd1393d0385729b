// loopcheck_models OUTDIR: writes OUTDIR/*.obj, OUTDIR/curves/*, OUTDIR/grids/*, OUTDIR/reject/* and
// OUTDIR/README.md.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "models/generate/catalogue.h"
#include "models/generate/curves.h"
#include "models/generate/reject.h"
#include "models/generate/write.h"

namespace {

namespace fs = std::filesystem;
using namespace loopcheck::models;

constexpr int kWriteFailed = 1;
constexpr int kBadUsage = 2;

void write_file(const fs::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
}

void write_all(const fs::path& folder) {
    const std::vector<Model> models = catalogue();
    const std::vector<Reject> refused = rejects();
    const std::vector<CurveModel> points = curves();
    const std::vector<GridModel> surfaces = grids();
    fs::create_directories(folder / "reject");
    fs::create_directories(folder / "curves");
    fs::create_directories(folder / "grids");
    for (const Model& model : models) write_file(folder / (model.name + ".obj"), obj_text(model));
    for (const CurveModel& curve : points)
        write_file(folder / "curves" / (curve.name + ".txt"), points_text(curve));
    for (const GridModel& grid : surfaces)
        write_file(folder / "grids" / (grid.points.name + ".txt"), points_text(grid.points));
    for (const Reject& reject : refused) write_file(folder / "reject" / reject.file, reject.text);
    write_file(folder / "README.md", index_text(models, points, surfaces, refused));
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("Usage: loopcheck_models OUTDIR. It takes the folder to write to, and nothing else.\n",
                   stderr);
        return kBadUsage;
    }
    try {
        write_all(arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "The models could not be written: %s.\n", error.what());
        return kWriteFailed;
    }
    return 0;
}
