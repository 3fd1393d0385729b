// A benchmark program: its flags, its cases, its report.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/support/case.h"
#include "bench/support/measure.h"

namespace loopcheck::bench {

/// How much is measured: all of it, under a minute, or next to nothing, for agreement alone.
enum class Extent : std::uint8_t { Full, Quick, Smoke };

class Program {
  public:
    /// `item` is what costs are per.
    Program(std::string name, std::string description, std::string item);

    /// The exit code where there is nothing to measure.
    std::optional<int> parse(int argc, char** argv);

    Extent extent() const { return extent_; }
    bool wants_level(int level) const;

    /// Sizes of the control sphere, and the levels it is refined to.
    std::vector<std::pair<int, int>> sizes_and_levels() const;

    /// Names a peer and its version in the report.
    void add_peer(std::string name, std::string version) {
        peers_.emplace_back(std::move(name), std::move(version));
    }

    /// Measures and prints the case; in a process for one subject, only that.
    void measure(const Case& c);

    /// 0 where all went well, 1 where results differ, 2 where nothing was measured or the report could not be
    /// written, 3 where a subject failed.
    int finish() const;

  private:
    void measure_one(const Case& c);
    void announce();
    // What was measured so far: a long run that is stopped leaves its report.
    void write_report();

    std::string name_, description_, item_, json_, one_;
    Extent extent_ = Extent::Full;
    std::vector<int> levels_;
    std::vector<std::pair<std::string, std::string>> peers_;
    nlohmann::ordered_json cases_ = nlohmann::ordered_json::array();
    int code_ = 0;
};

}  // namespace loopcheck::bench
