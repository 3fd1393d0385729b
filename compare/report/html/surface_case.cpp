#include "compare/report/html/surface_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compare/report/html/mesh_levels.h"
#include "compare/report/html/report_page.h"
#include "compare/report/json.h"

namespace loopcheck::compare {
namespace {

using Json = nlohmann::ordered_json;

bool was_looked_at(const FaceNumbers& face) {
    return !std::isnan(face.position);
}

// The classes of the faces of some comparisons, and what faces are that none looked at.
class FaceClasses {
  public:
    explicit FaceClasses(std::span<const SurfaceComparison> comparisons) {
        std::set<FaceClass> classes;
        for (const SurfaceComparison& c : comparisons)
            for (const FaceNumbers& face : c.faces)
                if (was_looked_at(face)) classes.insert(face.face_class);
        classes_.assign(classes.begin(), classes.end());
    }

    std::uint32_t index_of(const FaceNumbers& face) const {
        const auto found = was_looked_at(face)
                               ? std::lower_bound(classes_.begin(), classes_.end(), face.face_class)
                               : classes_.end();
        return static_cast<std::uint32_t>(found - classes_.begin());
    }
    std::size_t count() const { return classes_.size() + 1; }
    Json names() const {
        Json out = Json::array();
        for (const FaceClass& c : classes_) out.push_back(to_string(c));
        out.push_back("not looked at");
        return out;
    }

  private:
    std::vector<FaceClass> classes_;  // ascending
};

Json face_numbers(ChunkWriter& chunk, const SurfaceComparison& c, const FaceClasses& classes) {
    if (c.faces.empty()) return nullptr;
    const double unit = error_unit(c.largest_coordinate, core::Precision::Double, core::Precision::Double);
    std::vector<float> position, bound, normal;
    std::vector<std::uint32_t> face_class;
    for (const FaceNumbers& face : c.faces) {
        position.push_back(to_float(face.position / unit));
        bound.push_back(to_float(face.bound / unit));
        normal.push_back(to_float(face.normal));
        face_class.push_back(classes.index_of(face));
    }
    return {{"position", chunk.add(position)},
            {"bound", chunk.add(bound)},
            {"normal", chunk.add(normal)},
            {"face_class", chunk.add_indices(face_class, classes.count())}};
}

// Nothing where the mesh could not be refined.
std::optional<std::string> surface_chunk(const SurfaceReport& report, const core::TriangleMesh& mesh,
                                         const core::SchemeOptions& options, int shown) {
    const int last = std::max(0, shown - 1);
    const auto witness = make_witness(mesh, options, last);
    const auto ours = core::refine<double>(mesh, options, last);
    if (!witness || !ours) return std::nullopt;
    ChunkWriter chunk;
    LevelWriter writer(chunk, *witness, shown);
    const FaceClasses classes(report.comparisons);
    Json levels = Json::array();
    for (int l = 0; l < shown; ++l) {
        Json level = writer.add(l);
        const ArrayRef positions =
            chunk.add(ours->levels[static_cast<std::size_t>(l)].positions, level["exact"].get<ArrayRef>());
        level["positions"] = Json::array({{{"subject", "ours"}, {"positions", positions}}});
        level["comparisons"] = Json::array();
        if (l == 0) {
            level["surfaces"] = Json::array();
            for (const SurfaceComparison& c : report.comparisons)
                level["surfaces"].push_back(face_numbers(chunk, c, classes));
        }
        levels.push_back(std::move(level));
    }
    Json header{{"kind", "mesh"}, {"comparisons", Json::array()}, {"surfaces", Json::array()}};
    for (const SurfaceComparison& c : report.comparisons) header["surfaces"].push_back(json_of(c));
    std::move(writer).finish(header);
    header["deviations"] = Json::array();
    header["face_classes"] = classes.names();
    header["levels"] = std::move(levels);
    return std::move(chunk).text(std::move(header));
}

CaseSummary::Result result_of(const SurfaceComparison& c) {
    CaseSummary::Result out{"opensubdiv", "exact", std::string(c.check.way.name), c.verdict, {}, {}, 1,
                            c.notes};
    out.unit = error_unit(c.largest_coordinate, core::Precision::Double, core::Precision::Double);
    for (int i = 0; i < kSurfaceDeviations; ++i)
        if (c.deviations[i].shown > 0) out.deviations.emplace_back(name(static_cast<SurfaceDeviationId>(i)));
    if (c.overweight) out.deviations.emplace_back("chaikin-overweight");
    std::vector<double> differences;
    for (const auto& [face_class, stats] : c.classes) differences.push_back(stats.position);
    out.largest = largest_of(differences);
    return out;
}

}  // namespace

std::string surface_as_html(const SurfaceReport& report, const core::TriangleMesh& mesh,
                            const core::SchemeOptions& options, std::size_t most_vertices,
                            std::span<const Subject> subjects) {
    const int shown = shown_levels(mesh, kSurfaceLevels, most_vertices);
    CaseSummary summary{make_case(report.model, mesh, options), {}};
    summary.of.chunk = surface_chunk(report, mesh, options, shown);
    for (const SurfaceComparison& c : report.comparisons) summary.results.push_back(result_of(c));
    const auto count = [&](Verdict verdict) {
        return static_cast<std::size_t>(
            std::count_if(report.comparisons.begin(), report.comparisons.end(),
                          [&](const SurfaceComparison& c) { return c.verdict == verdict; }));
    };
    const int code = report.exit_code();
    return report_page({"limit", code,
                        fmt::format("{}: the surface of 1 model by {}: {}", code == 0 ? "agree" : "FAIL",
                                    counted(report.comparisons.size(), "way"), verdicts_in_words(count)),
                        std::max(0, shown - 1), subjects},
                       {std::move(summary)});
}

}  // namespace loopcheck::compare
