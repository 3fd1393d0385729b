// Time of refine() in double, ours beside every peer that was built, in one run on one core.
//
//     build/release/bench/loopcheck_bench
//
// Read it as a ratio between the lines of one model and level: "cow/4/opensubdiv" over "cow/4/ours" says how
// many times as long OpenSubdiv takes here and now.  The times themselves belong to a machine and its mood;
// for a ratio worth keeping add --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true and
// compare medians. A peer's time includes its adapter: building its mesh from ours and handing back every
// level with its ancestry.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "compare/loading.h"
#include "compare/subject.h"

namespace {

using namespace loopcheck;

constexpr int kLowestLevel = 3;
constexpr int kHighestLevel = 5;

core::TriangleMesh mesh_of(const std::string& name) {
    auto model = compare::load_model(LOOPCHECK_MODELS_DIR "/" + name + ".obj", false);
    if (model) return std::move(model->mesh);
    std::fprintf(stderr, "%s: %s\n", name.c_str(), core::to_string(model.error()).c_str());
    std::exit(EXIT_FAILURE);
}

void refine(benchmark::State& state, const compare::Subject& subject, const core::TriangleMesh& mesh,
            int levels) {
    std::size_t vertices = 0;
    for ([[maybe_unused]] auto _ : state) {
        auto refined = subject.refine(mesh, {.boundary = core::BoundaryRule::EdgeOnly}, levels);
        if (!refined) return state.SkipWithError(core::to_string(refined.error()).c_str());
        vertices = refined->levels.back().positions.size();
        benchmark::DoNotOptimize(refined);
    }
    state.counters["vertices"] = static_cast<double>(vertices);
    state.counters["vertices/s"] =
        benchmark::Counter(static_cast<double>(vertices), benchmark::Counter::kIsIterationInvariantRate);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return EXIT_FAILURE;
    for (const std::string name : {"icosahedron", "cow"}) {
        const core::TriangleMesh mesh = mesh_of(name);
        for (int levels = kLowestLevel; levels <= kHighestLevel; ++levels)
            for (const compare::Subject& subject : compare::built_in_subjects()) {
                if (subject.precision != core::Precision::Double) continue;
                benchmark::RegisterBenchmark(
                    (name + "/" + std::to_string(levels) + "/" + subject.name).c_str(),
                    [=](benchmark::State& state) { refine(state, subject, mesh, levels); })
                    ->Unit(benchmark::kMillisecond);
            }
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
