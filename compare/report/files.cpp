// The reports with one line a vertex, and the one for continuous integration.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "compare/report/report.h"
#include "compare/words.h"
#include "core/mesh/io/number.h"

namespace loopcheck::compare {
namespace {

// Room for a line: few are longer, and then the text grows once.
constexpr std::size_t kCsvLine = 260;
constexpr std::size_t kPlyLine = 90;

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

// Escapes for XML.  Characters that XML 1.0 cannot hold become '?', bytes that are not UTF-8 the replacement
// character.
std::string xml(const std::string& text) {
    using nlohmann::json;
    const auto utf8 =
        json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
    std::string out;
    for (const char c : utf8) switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
        }
    return out;
}

std::string test_case(const SuiteRow& row, std::string_view what, Verdict verdict,
                      const std::vector<std::string>& all_notes) {
    const Comparison& c = row.comparison;
    std::string out = fmt::format("    <testcase classname=\"{}\" name=\"{}{} against {}, {}, {}\"",
                                  xml(row.model), what, xml(c.subject), xml(c.reference),
                                  core::name(c.options.boundary), core::name(c.options.creasing));
    const std::string notes = xml(fmt::format("{}", fmt::join(all_notes, "\n")));
    switch (verdict) {
        case Verdict::Differs:
            return out + fmt::format("><failure message=\"differs\">{}</failure></testcase>\n", notes);
        case Verdict::Failed:
            return out + fmt::format("><error message=\"failed\">{}</error></testcase>\n", notes);
        case Verdict::NotSupported:
            return out + fmt::format("><skipped message=\"{}\"/></testcase>\n", notes);
        default:
            return out + fmt::format("><system-out>{}: {}</system-out></testcase>\n", name(verdict), notes);
    }
}

std::string test_cases(const SuiteRow& row) {
    std::string out = test_case(row, "", row.comparison.verdict, row.comparison.notes);
    if (row.limits) out += test_case(row, "limits of ", row.limits->verdict, row.limits->notes);
    return out;
}

}  // namespace

std::string suite_as_junit(const SuiteResult& suite) {
    std::map<std::string, std::vector<const SuiteRow*>> by_model;
    for (const SuiteRow& row : suite.rows) by_model[row.model].push_back(&row);
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\" errors=\"{}\" "
        "skipped=\"{}\">\n",
        suite.rows.size() + suite.limit_rows() + suite.unreadable.size(), suite.count(Verdict::Differs),
        suite.count(Verdict::Failed) + suite.unreadable.size(), suite.count(Verdict::NotSupported));
    for (const UnreadableModel& bad : suite.unreadable)
        out += fmt::format(
            "  <testsuite name=\"{0}\" tests=\"1\" errors=\"1\">\n    <testcase classname=\"{0}\" "
            "name=\"read\"><error "
            "message=\"not compared\">{1}</error></testcase>\n  </testsuite>\n",
            xml(bad.model), xml(core::to_string(bad.error)));
    for (const auto& [model, rows] : by_model) {
        const auto limits =
            std::count_if(rows.begin(), rows.end(), [](const SuiteRow* row) { return bool(row->limits); });
        out += fmt::format("  <testsuite name=\"{}\" tests=\"{}\">\n", xml(model),
                           rows.size() + static_cast<std::size_t>(limits));
        for (const SuiteRow* row : rows) out += test_cases(*row);
        out += "  </testsuite>\n";
    }
    return out + "</testsuites>\n";
}

CsvReport::CsvReport()
    : text_(
          "model,level,vertex,ancestry,class,rule,a_x,a_y,a_z,b_x,b_y,b_z,error,error_in_uM,bound_use,"
          "identical\n") {}

void CsvReport::reserve(std::size_t vertices) {
    text_.reserve(text_.size() + vertices * kCsvLine);
}

void CsvReport::add(std::string_view model, const VertexRecord& r, double unit) {
    text_ += fmt::format("{},{},{},{},{},{}", csv_field(model), r.level, r.vertex, ancestry_in_words(r),
                         core::to_string(r.vertex_class), csv_field(rule_in_words(r)));
    for (const glm::dvec3& p : {r.subject, r.reference})
        for (int i = 0; i < 3; ++i) text_ += "," + core::shortest(p[i]);
    text_ += fmt::format(",{},{},{},{}\n", core::shortest(r.error), core::shortest(r.error / unit),
                         core::shortest(r.bound_use), r.identical ? 1 : 0);
}

PlyReport::PlyReport(int level, std::size_t vertices) : level_(level) {
    vertices_.reserve(vertices * kPlyLine);
}

void PlyReport::add(const VertexRecord& r) {
    if (r.level != level_) return;
    ++count_;
    vertices_ += fmt::format("{} {} {} {}\n", core::shortest(r.subject.x), core::shortest(r.subject.y),
                             core::shortest(r.subject.z), core::shortest(r.error));
}

std::string PlyReport::text(std::span<const core::Triangle> triangles, std::string_view comment) const {
    std::string out = fmt::format(
        "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double "
        "y\nproperty double "
        "z\nproperty double quality\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        comment, count_, triangles.size());
    constexpr std::size_t kFaceLine = 28;
    out.reserve(out.size() + vertices_.size() + triangles.size() * kFaceLine);
    out += vertices_;
    for (const auto& [a, b, c] : triangles) fmt::format_to(std::back_inserter(out), "3 {} {} {}\n", a, b, c);
    return out;
}

}  // namespace loopcheck::compare
