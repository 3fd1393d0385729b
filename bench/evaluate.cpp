// What a point of the limit surface costs, with its first derivatives: ours beside OpenSubdiv's Bfr.
// README.md says how to read it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/support/agreement.h"
#include "bench/support/meshes.h"
#include "bench/support/program.h"
#include "core/loop/evaluate.h"
#include "core/loop/lattice/address.h"
#include "reference/opensubdiv/opensubdiv.h"
#include "reference/opensubdiv/prepared_surface.h"

namespace {

using namespace loopcheck;
using bench::Case;
using bench::Run;
using bench::Subject;
using core::Index;
using core::TriangleMesh;
using reference::SurfaceSample;
using Surface = reference::OpensubdivPreparedSurface;

// The centres of the 4^level triangles that a face is split into.
std::vector<glm::dvec2> parameters(int level) {
    const Index segments = 1 << level;
    std::vector<glm::dvec2> out;
    for (std::int64_t t = 0; t < std::int64_t{segments} * segments; ++t) {
        glm::dvec2 sum(0);
        for (const auto& [i, j] : core::corners_of(core::triangle_at(segments, t))) sum += glm::dvec2(i, j);
        out.push_back(sum / (3.0 * segments));
    }
    return out;
}

// Every face at these parameters, by face, into samples that were there before.
struct Task {
    explicit Task(const TriangleMesh& control, int level)
        : mesh(control),
          uv(parameters(level)),
          samples(uv.size() * static_cast<std::size_t>(mesh.face_count())) {}

    std::span<SurfaceSample> of(Index face) {
        return std::span(samples).subspan(static_cast<std::size_t>(face) * uv.size(), uv.size());
    }

    const TriangleMesh& mesh;
    std::vector<glm::dvec2> uv;
    std::vector<SurfaceSample> samples;
};

// All that is asked of our evaluator is asked here.
void evaluate_ours(Task& task, core::LimitSurface<double>& surface) {
    for (Index f = 0; f < task.mesh.face_count(); ++f)
        for (std::size_t i = 0; i < task.uv.size(); ++i) {
            const auto stencil = surface.stencil(f, task.uv[i].x, task.uv[i].y).value();
            const auto point = core::apply<double>(stencil, task.mesh.positions());
            task.of(f)[i] = {point.at(core::Derivative::Position), point.at(core::Derivative::Du),
                             point.at(core::Derivative::Dv)};
        }
}

void evaluate_bfr(Task& task, const Surface& surface) {
    for (Index f = 0; f < task.mesh.face_count(); ++f) surface.evaluate(f, task.uv, task.of(f));
}

// Where Bfr's patch is exact, both are the same but for rounding.  Elsewhere Bfr approximates, and this only
// sees mistakes: docs/deviations/bfr-approximation.md has the amounts.
std::string disagreement(Task& ours) {
    const Surface surface = Surface::make(ours.mesh, {}).value();
    Task theirs = ours;
    evaluate_bfr(theirs, surface);
    constexpr double kApproximation = 0.01;
    const double size = ours.mesh.largest_coordinate();
    for (Index f = 0; f < ours.mesh.face_count(); ++f) {
        const double allowed = surface.is_regular(f)
                                   ? bench::allowed_distance(ours.mesh, 0, core::Precision::Double)
                                   : kApproximation * size;
        std::array<std::vector<glm::dvec3>, 2> positions, derivatives;
        for (std::size_t i = 0; i < ours.uv.size(); ++i)
            for (int side = 0; side < 2; ++side) {
                const SurfaceSample& sample = (side == 0 ? ours : theirs).of(f)[i];
                positions[side].push_back(sample.position);
                derivatives[side].push_back(sample.du);
                derivatives[side].push_back(sample.dv);
            }
        std::string why =
            bench::distances(fmt::format("face {}, positions", f), positions[0], positions[1], allowed);
        if (why.empty() && surface.is_regular(f))
            why = bench::distances(fmt::format("face {}, derivatives", f), derivatives[0], derivatives[1],
                                   allowed);
        if (!why.empty()) return why;
    }
    return {};
}

Subject ours(int level) {
    return {
        "ours", 1, 0, [=](const TriangleMesh& mesh) -> core::Result<Run> {
            const auto task = std::make_shared<Task>(mesh, level);
            const auto surface = std::make_shared<core::LimitSurface<double>>(mesh, core::SchemeOptions{});
            return Run{[=] { evaluate_ours(*task, *surface); }, [] {}, [=] { return disagreement(*task); }};
        }};
}

Subject bfr(int level) {
    return {"opensubdiv-bfr", 1, 0, [=](const TriangleMesh& mesh) {
                const auto run_of = [&](const std::shared_ptr<Surface>& surface) {
                    const auto task = std::make_shared<Task>(mesh, level);
                    return Run{[=] { evaluate_bfr(*task, *surface); }, [] {}, [] { return std::string(); }};
                };
                return Surface::make(mesh, {}).map(bench::shared<Surface>).map(run_of);
            }};
}

Case samples(std::string task, const TriangleMesh& (*mesh)(int), int size, int level) {
    return {.task = std::move(task),
            .precision = core::Precision::Double,
            .mesh = mesh,
            .size = size,
            .level = level,
            .items = static_cast<double>(bench::sphere_faces(size + level)),
            .written = sizeof(SurfaceSample),
            .subjects = {ours(level), bfr(level)}};
}

}  // namespace

int main(int argc, char** argv) {
    bench::Program program("loopcheck_bench_evaluate",
                           "Times points of the limit surface: ours beside OpenSubdiv's Bfr.", "sample");
    program.add_peer("opensubdiv", reference::opensubdiv_version());
    if (const auto code = program.parse(argc, argv)) return *code;
    const bool smoke = program.extent() == bench::Extent::Smoke;
    const int size = smoke ? 1 : 4, most_levels = smoke                                      ? 1
                                                  : program.extent() == bench::Extent::Quick ? 2
                                                                                             : 4;
    for (int level = 1; level <= most_levels; ++level) {
        if (!program.wants_level(level)) continue;
        program.measure(samples("regular", bench::plain_sphere, size, level));
        program.measure(samples("irregular", bench::varied_sphere, size, level));
    }
    return program.finish();
}
