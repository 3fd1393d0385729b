#include "bench/support/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "bench/support/report.h"
#include "core/mesh/io/atomic_file.h"

namespace loopcheck::bench {
namespace {

constexpr int kExitDiffer = 1, kExitUsage = 2, kExitFailed = 3;

Plan plan_of(Extent extent) {
    switch (extent) {
        case Extent::Smoke:
            return {.least_rounds = 1, .most_rounds = 1, .seconds = 0, .fresh = 1, .written = 1 << 16};
        case Extent::Quick:
            return {.least_rounds = 3, .most_rounds = 9, .seconds = 1, .fresh = 1, .written = 1 << 27};
        case Extent::Full:
            break;
    }
    return {.least_rounds = 5, .most_rounds = 51, .seconds = 20, .fresh = 3, .written = 1 << 28};
}

std::string_view flag_of(Extent extent) {
    return extent == Extent::Smoke ? "--smoke" : extent == Extent::Quick ? "--quick" : "";
}

}  // namespace

Program::Program(std::string name, std::string description, std::string item)
    : name_(std::move(name)), description_(std::move(description)), item_(std::move(item)) {}

std::optional<int> Program::parse(int argc, char** argv) {
    CLI::App app(description_, name_);
    bool quick = false, smoke = false;
    auto* quick_flag = app.add_flag("--quick", quick, "Less than a minute: fewer cases and repetitions");
    app.add_flag("--smoke", smoke, "Seconds: whether all agree; its times mean nothing")
        ->excludes(quick_flag);
    app.add_option("--levels", levels_, "Only these levels, as in 4,5")->delimiter(',');
    app.add_option("--json", json_, "Write the report to this file");
    app.add_option("--one", one_, "")->group("");  // what `run_fresh` asks for
    app.footer(
        "Exit codes: 0 all agree, 1 results differ, 2 bad usage or unwritable report, 3 a subject failed.");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kExitUsage;
    }
    if (smoke)
        extent_ = Extent::Smoke;
    else if (quick)
        extent_ = Extent::Quick;
    if (one_.empty()) keep_memory();
    return std::nullopt;
}

bool Program::wants_level(int level) const {
    return levels_.empty() || std::find(levels_.begin(), levels_.end(), level) != levels_.end();
}

std::vector<std::pair<int, int>> Program::sizes_and_levels() const {
    std::vector<std::pair<int, int>> out;
    switch (extent_) {
        case Extent::Smoke:
            out = {{1, 1}, {2, 3}};
            break;
        case Extent::Quick:
            out = {{5, 1}, {5, 2}, {5, 3}, {5, 4}};
            break;
        case Extent::Full:
            out = {{5, 1}, {5, 2}, {5, 3}, {5, 4}, {5, 5}, {4, 6}};
    }
    std::erase_if(out, [&](const auto& one) { return !wants_level(one.second); });
    return out;
}

void Program::measure_one(const Case& c) {
    for (const Subject& subject : c.subjects) {
        if (name_of(c, subject) != one_) continue;
        const auto fresh = measure_here(subject, mesh_of(c));
        if (fresh)
            fmt::print("{}", to_line(*fresh));
        else
            code_ = kExitFailed;
    }
}

void Program::announce() {
    fmt::print("{}", as_text(this_machine()));
    for (const auto& [name, version] : peers_) fmt::print("{:<10} {}\n", name, version);
    std::fflush(stdout);
}

void Program::measure(const Case& c) {
    if (!one_.empty()) return measure_one(c);
    if (cases_.empty()) announce();
    std::vector<std::string> fresh;
    if (extent_ != Extent::Full) fresh.emplace_back(flag_of(extent_));
    fresh.emplace_back("--one");
    const CaseResult result = bench::measure(c, plan_of(extent_), fresh);
    fmt::print("{}", as_text(result, item_));
    std::fflush(stdout);
    cases_.push_back(as_json(result));
    for (const Measured& m : result.subjects) {
        if (m.differs)
            code_ = kExitDiffer;
        else if (m.failed && code_ == 0)
            code_ = kExitFailed;
    }
    write_report();
}

void Program::write_report() {
    if (json_.empty()) return;
    nlohmann::ordered_json peers;
    for (const auto& [name, version] : peers_) peers[name] = version;
    const nlohmann::ordered_json report{
        {"program", name_},          {"item", item_},      {"machine", as_json(this_machine())},
        {"peers", std::move(peers)}, {"exit_code", code_}, {"cases", cases_}};
    const auto written = core::write_file(json_, report.dump(1) + "\n");
    if (written) return;
    fmt::print(stderr, "{}: {}\n", json_, core::to_string(written.error()));
    json_.clear();
    code_ = kExitUsage;
}

int Program::finish() const {
    if (!one_.empty() || !cases_.empty()) return code_;
    fmt::print(stderr, "None of these levels is measured here.\n");
    return kExitUsage;
}

}  // namespace loopcheck::bench
