#include "compare/report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "compare/words.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {

std::string table(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> width;
    for (const auto& row : rows) {
        width.resize(std::max(width.size(), row.size()), 0);
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    std::string out;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += i == 0 ? fmt::format("  {:<{}}", row[i], width[i])
                           : fmt::format("  {:>{}}", row[i], width[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

std::string number_cell(double value) {
    return value == 0 ? std::string("0") : fmt::format("{:.3g}", value);
}

std::string largest_cell(const ErrorStats& errors, double per) {
    return errors.not_finite > 0 ? fmt::format("{} not finite", errors.not_finite)
                                 : number_cell(errors.max / per);
}

std::vector<std::string> position_header(const std::string& first, const Comparison& c) {
    return {first,         "vertices",           "identical",
            "max |a-b|",   "/ diagonal",         "/ (u M)",
            "rms / (u M)", c.subject + "-exact", c.reference + "-exact",
            "bound used"};
}

std::vector<std::string> position_row(const std::string& first, const ClassStats& stats,
                                      const Comparison& c) {
    const ErrorStats& d = stats.difference;
    const double diagonal = c.diagonal > 0 ? c.diagonal : 1;
    return {first,
            fmt::format("{}", d.count),
            fmt::format("{}", d.identical),
            largest_cell(d, 1),
            number_cell(d.max / diagonal),
            number_cell(d.max / c.unit()),
            number_cell(d.rms() / c.unit()),
            largest_cell(stats.subject_error, c.unit()),
            largest_cell(stats.reference_error, c.unit()),
            number_cell(stats.largest_bound_use)};
}

std::string vector_as_text(const std::string& who, const glm::dvec3& p) {
    std::vector<std::string> decimal, hex;
    for (int i = 0; i < 3; ++i) {
        decimal.push_back(core::shortest(p[i]));
        hex.push_back(core::hexfloat(p[i]));
    }
    return fmt::format("    {:<18} {}   [{}]\n", who, fmt::join(decimal, " "), fmt::join(hex, " "));
}

std::string vertex_in_words(const VertexRecord& r) {
    return fmt::format("vertex {} of level {} ({}; {}; rule: {})", r.vertex, r.level, ancestry_in_words(r),
                       core::to_string(r.vertex_class), rule_in_words(r));
}

std::string positions_as_text(const VertexRecord& r, const Comparison& c) {
    std::string out = vector_as_text(c.subject, r.subject) + vector_as_text(c.reference, r.reference) +
                      vector_as_text("exact", r.exact);
    if (r.subject_vertex != r.vertex)
        out += fmt::format("    {} calls it vertex {}\n", c.subject, r.subject_vertex);
    if (r.reference_vertex != r.vertex)
        out += fmt::format("    {} calls it vertex {}\n", c.reference, r.reference_vertex);
    return out;
}

}  // namespace loopcheck::compare
