// Subjects measured in turn.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/bandwidth.h"
#include "bench/support/case.h"
#include "bench/support/fresh.h"

namespace loopcheck::bench {

/// How long to measure.
struct Plan {
    int least_rounds, most_rounds;
    double seconds;       ///< that the rounds of a case should take
    int fresh;            ///< processes of their own, a subject
    std::size_t written;  ///< bytes of the buffer that shows how fast memory is written
};

struct Measured {
    std::string name;
    int threads = 1;
    std::string left_out{};                ///< why it was not measured; empty where it was
    bool differs = false, failed = false;  ///< and so was left out
    double seconds = std::numeric_limits<double>::quiet_NaN();  ///< median on a warm heap
    double ratio = std::numeric_limits<double>::quiet_NaN();    ///< median of its time over that of the first
                                                                ///< subject, by round
    std::optional<Fresh> fresh{};                               ///< medians
};

struct CaseResult {
    const Case& measured;
    int rounds = 0;
    std::vector<double> write_seconds;  ///< a byte, with one thread, two, ...
    std::vector<Measured> subjects;

    /// Median time over that of writing the bytes of the case with as many threads.
    double times_writing(const Measured& m) const;
};

/// Keeps what was freed for the whole process: new pages from the system would cost more than the work.
void keep_memory();

/// Each subject does its work once and is asked for disagreement; then all work in turn, round by round,
/// each round beginning with another one.  `fresh` are the arguments for a process that measures one subject.
CaseResult measure(const Case& c, const Plan& plan, const std::vector<std::string>& fresh);

}  // namespace loopcheck::bench
