// What a point of a cubic curve costs, by every way there is to it and by Boost.Math, in one run on one core.
//
//     build/release/bench/loopcheck_curve_bench             two minutes, about 2 GB
//     build/release/bench/loopcheck_curve_bench --quick     under a minute: planar points, 3 repetitions
//     build/release/bench/loopcheck_curve_bench --smoke     checks that all agree; its times mean nothing
//
// Any option of Google Benchmark may follow, such as --benchmark_out=FILE for every time in JSON.
//
// The curve has natural ends and N pseudo-random control points, and is sampled at 16 points in each interval
// of knots:
//
//     all-points    the sum over all control points, at a few parameters only where N is large
//     local         the sum over those whose basis function reaches t
//     de-boor       de Boor's algorithm
//     table         `sample_by_table`
//     differences   `sample_by_differences`
//     subdivision   `subdivide_cubic` to level 4: as many points, near the curve and not on it
//     boost         the sum over those that reach t, with boost::math::cardinal_b_spline<3>
//
// First it compares every point with that of `local`, and stops with exit code 1 where they are further apart
// than the bounds of both allow.  Then it runs each benchmark several times, all of them interleaved at
// random, and at the end prints one table of the medians.  Read a number as: at this N, a sample costs so
// many times what it costs with Boost, here and now; below 1 is faster.  The last column is the cost per
// sample at the largest N over that at the smallest: about 1 for all but all-points, and more for the methods
// that are as fast as memory, once the points no longer fit into the caches.  The times themselves belong to
// a machine and its mood.
//
// Every method makes its vector of points in the time that is measured.  `table`, `differences` and
// `subdivision` also find the phantoms, which the others are given.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "core/bspline/limit.h"
#include "core/bspline/sample.h"
#include "core/bspline/subdivide.h"
#include "core/mesh/rounding.h"
#include "reference/boost_math/cardinal.h"

namespace {

using namespace loopcheck;

constexpr int kLevels = 4;
constexpr int kPerInterval = 1 << kLevels;

// The basis functions that `all-points` may evaluate in one go.
constexpr std::int64_t kMostTerms = 1 << 22;

template <class P>
std::vector<P> pseudo_random_points(std::int64_t count) {
    std::mt19937_64 random(static_cast<std::uint64_t>(count));
    std::vector<P> out(static_cast<std::size_t>(count));
    for (P& p : out)
        for (int d = 0; d < P::length(); ++d) p[d] = std::ldexp(static_cast<double>(random() >> 11), -52) - 1;
    return out;
}

// A curve, and what a method may have been given before the time is taken.
template <class P>
struct Case {
    explicit Case(std::int64_t count)
        : curve(core::Curve<P>::make(pseudo_random_points<P>(count), {}).value()),
          spline(core::spline_of(curve)) {
        const std::int64_t samples = (count - 1) * kPerInterval + 1;
        for (std::int64_t j = 0; j < samples; ++j)
            parameters.push_back(core::sample_parameter(curve, kPerInterval, j));
        const std::int64_t sparse = std::clamp<std::int64_t>(kMostTerms / count, 2, samples);
        sparse_step = static_cast<std::size_t>((samples - 1) / (sparse - 1));
    }

    core::Curve<P> curve;
    core::Spline<P> spline;
    std::vector<double> parameters;
    std::size_t sparse_step;  // of `all-points`, through the parameters
};

template <class P>
std::vector<P> evaluate(const Case<P>& c, core::Evaluation method, std::size_t step = 1) {
    std::vector<P> out;
    out.reserve(c.parameters.size() / step + 1);
    for (std::size_t j = 0; j < c.parameters.size(); j += step)
        out.push_back(core::evaluate(c.spline, c.parameters[j], {.method = method}));
    return out;
}

template <class P>
std::vector<P> subdivide(const Case<P>& c) {
    std::vector<P> points = core::subdivide_cubic(c.curve.points(), false);
    for (int level = 1; level < kLevels; ++level) points = core::subdivide_cubic(points, false);
    return points;
}

template <class P>
struct Method {
    std::string_view name;
    std::vector<P> (*run)(const Case<P>&);
    int roundings;        // by which it can be off
    bool sparse = false;  // at every parameter, or one of `sparse_step`
    bool near = false;    // on the curve, or within `polygon_distance`
};

constexpr std::string_view kPeer = "boost";

template <class P>
const std::vector<Method<P>>& methods() {
    using core::Evaluation;
    static constexpr int kEvaluation = core::evaluation_roundings(3);
    static const std::vector<Method<P>> all{
        {"all-points", [](const Case<P>& c) { return evaluate(c, Evaluation::AllPoints, c.sparse_step); },
         kEvaluation, true},
        {"local", [](const Case<P>& c) { return evaluate(c, Evaluation::Local); }, kEvaluation},
        {"de-boor", [](const Case<P>& c) { return evaluate(c, Evaluation::DeBoor); }, kEvaluation},
        {"table", [](const Case<P>& c) { return core::sample_by_table(c.curve, kPerInterval); },
         core::kTableSampleRoundings},
        {"differences", [](const Case<P>& c) { return core::sample_by_differences(c.curve, kPerInterval); },
         core::difference_sample_roundings(kPerInterval)},
        {"subdivision", subdivide<P>, 4 * kLevels, false, true},
        {kPeer,
         [](const Case<P>& c) {
             return reference::boost_curve_points<P>(3, c.spline.points, -1, c.parameters).value();
         },
         reference::boost_curve_roundings(3) + 1}};
    return all;
}

// Where a method and `local` disagree; empty where they do not.
template <class P>
std::string disagreement(const Case<P>& c, const Method<P>& method, const std::vector<P>& local) {
    double largest = 0;
    for (const P& p : c.spline.points) largest = std::max(largest, core::magnitude(p));
    const double bound = largest * core::rounding_of(method.roundings + core::evaluation_roundings(3),
                                                     core::Precision::Double) +
                         (method.near ? core::polygon_distance(c.curve, kLevels) : 0);
    const std::vector<P> points = method.run(c);
    const std::size_t step = method.sparse ? c.sparse_step : 1;
    if (points.size() != (local.size() - 1) / step + 1)
        return fmt::format("{} has {} points", method.name, points.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
        const double difference = core::magnitude(points[j] - local[j * step]);
        if (!(difference <= bound))
            return fmt::format("{} at t = {}: {:.3g} from local, {:.3g} allowed", method.name,
                               c.parameters[j * step], difference, bound);
    }
    return {};
}

template <class P>
bool all_agree(const Case<P>& c) {
    const std::vector<P> local = evaluate(c, core::Evaluation::Local);
    bool agree = true;
    for (const Method<P>& method : methods<P>()) {
        const std::string text = disagreement(c, method, local);
        if (text.empty()) continue;
        fmt::print(stderr, "N = {}: {}\n", c.curve.size(), text);
        agree = false;
    }
    return agree;
}

std::string name_of(std::string_view type, std::int64_t count, std::string_view method) {
    return fmt::format("{}/{}/{}", type, count, method);
}

constexpr const char* kSamples = "samples";

// Registers every method for curves of `count` points; false where they disagree.
template <class P>
bool add_case(std::string_view type, std::int64_t count) {
    const auto shared = std::make_shared<const Case<P>>(count);
    for (const Method<P>& method : methods<P>())
        benchmark::RegisterBenchmark(name_of(type, count, method.name).c_str(),
                                     [shared, &method](benchmark::State& state) {
                                         std::size_t samples = 0;
                                         for ([[maybe_unused]] auto _ : state) {
                                             auto points = method.run(*shared);
                                             samples = points.size();
                                             benchmark::DoNotOptimize(points.data());
                                             benchmark::ClobberMemory();
                                         }
                                         state.counters[kSamples] = static_cast<double>(samples);
                                     });
    return all_agree(*shared);
}

// Google Benchmark hands its results to a class derived from one of its own.  Costs are CPU time per sample;
// of several repetitions only the medians are printed.
class Costs : public benchmark::ConsoleReporter {
  public:
    Costs() : ConsoleReporter(OO_None) {}

    void ReportRuns(const std::vector<Run>& runs) override {
        std::vector<Run> printed;
        for (const Run& run : runs) {
            const bool single = run.run_type == Run::RT_Iteration;
            if (single && !run.error_occurred)
                costs_[run.run_name.function_name].push_back(run.GetAdjustedCPUTime() /
                                                             run.counters.at(kSamples).value);
            if (single ? run.repetitions == 1 : run.aggregate_name == "median") printed.push_back(run);
        }
        ConsoleReporter::ReportRuns(printed);
    }

    // NaN where a filter has left it out.
    double median(const std::string& name) const {
        const auto found = costs_.find(name);
        if (found == costs_.end()) return std::numeric_limits<double>::quiet_NaN();
        std::vector<double> sorted = found->second;
        std::sort(sorted.begin(), sorted.end());
        return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
    }

  private:
    std::map<std::string, std::vector<double>> costs_;
};

// Keeps what was freed: new pages from the system would cost more than the fast methods.
void keep_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

struct Plan {
    std::vector<std::string_view> types;
    std::vector<std::int64_t> counts;
    std::vector<std::string> options;  // of Google Benchmark, before those of the command line
};

Plan plan_of(std::string_view option) {
    const auto options = [](int repetitions, double seconds) {
        return std::vector<std::string>{fmt::format("--benchmark_repetitions={}", repetitions),
                                        fmt::format("--benchmark_min_time={}", seconds),
                                        "--benchmark_enable_random_interleaving=true"};
    };
    const std::vector<std::int64_t> counts{16, 256, 4096, 65536, 1048576};
    if (option == "--smoke") return {{"dvec2", "dvec3"}, {16, 256}, options(1, 0.0001)};
    if (option == "--quick") return {{"dvec2"}, counts, options(3, 0.01)};
    return {{"dvec2", "dvec3"}, counts, options(9, 0.05)};
}

void print_ratios(const Plan& plan, const Costs& costs) {
    const auto cell = [](double ratio) {
        return std::isnan(ratio) ? std::string("-") : fmt::format("{:.3g}", ratio);
    };
    fmt::print("\nCost per sample over that of {}, medians; growth from N = {} to {}\n{:<20}", kPeer,
               plan.counts.front(), plan.counts.back(), "");
    for (const std::int64_t count : plan.counts) fmt::print(" {:>9}", count);
    fmt::print(" {:>9}\n", "growth");
    for (const std::string_view type : plan.types)
        for (const auto& method : methods<glm::dvec2>()) {
            const auto cost = [&](std::int64_t count, std::string_view name) {
                return costs.median(name_of(type, count, name));
            };
            fmt::print("{:<20}", fmt::format("{}/{}", type, method.name));
            for (const std::int64_t count : plan.counts)
                fmt::print(" {:>9}", cell(cost(count, method.name) / cost(count, kPeer)));
            fmt::print(" {:>9}\n",
                       cell(cost(plan.counts.back(), method.name) / cost(plan.counts.front(), method.name)));
        }
}

}  // namespace

int main(int argc, char** argv) {
    keep_memory();
    const std::string_view first = argc > 1 ? argv[1] : "";
    const bool planned = first == "--smoke" || first == "--quick";
    Plan plan = plan_of(first);
    std::vector<char*> arguments{argv[0]};
    for (std::string& option : plan.options) arguments.push_back(option.data());
    arguments.insert(arguments.end(), argv + (planned ? 2 : 1), argv + argc);
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return EXIT_FAILURE;

    bool agree = true;
    for (const std::string_view type : plan.types)
        for (const std::int64_t n : plan.counts)
            agree &= type == "dvec2" ? add_case<glm::dvec2>(type, n) : add_case<glm::dvec3>(type, n);
    if (!agree) return EXIT_FAILURE;
    benchmark::AddCustomContext("boost", reference::boost_version());
    Costs costs;
    benchmark::RunSpecifiedBenchmarks(&costs);
    print_ratios(plan, costs);
    benchmark::Shutdown();
}
