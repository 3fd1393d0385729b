// The first chunk of an HTML report: what was compared, and the verdicts; and the file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/report/html/page.h"
#include "compare/report/report.h"

namespace loopcheck::compare {

/// A model under one choice of rules, with the verdicts on it.
struct CaseSummary {
    SuiteCase of;
    struct Result {
        std::string subject, reference, what;
        Verdict verdict = Verdict::Identical;
        std::vector<std::string> deviations;  ///< names of those that were seen
        std::optional<double> largest =
            {};           ///< largest difference in model units; nothing where there is none
        double unit = 1;  ///< what it is counted in
        std::vector<std::string> notes;
    };
    std::vector<Result> results;
};

/// The largest of some differences; nothing where there is none, or one is not finite.
std::optional<double> largest_of(std::span<const double> differences);

/// What is said of the whole.
struct ReportHead {
    std::string_view command;
    int exit_code = 0;
    std::string sentence;
    int levels = 0;
    std::span<const Subject> subjects;
    std::span<const UnreadableModel> unreadable = {};
};

/// The HTML file.  Requires a build that has the page.
std::string report_page(const ReportHead& head, std::vector<CaseSummary> cases);

/// Every comparison of a suite, or of `compare`.
std::string suite_as_html(SuiteResult suite, std::string_view command, int exit_code,
                          std::span<const Subject> subjects);

}  // namespace loopcheck::compare
