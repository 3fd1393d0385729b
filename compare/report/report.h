// The reports: the same results as text, JSON, CSV, PLY and JUnit XML.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/comparison.h"
#include "compare/suite.h"

namespace loopcheck::compare {

/// A comparison with the mesh it was made on.
struct ModelReport {
    std::string model;  ///< as named on the command line
    std::size_t vertices = 0, faces = 0, boundary_edges = 0;
    Comparison comparison;
    std::optional<LimitComparison> limits;  ///< where they were asked for
    std::optional<CreaseTags> creases;      ///< where they were asked for
};

/// Name, counts and comparison in one.
ModelReport make_report(std::string model, const core::TriangleMesh& mesh, Comparison comparison,
                        std::optional<LimitComparison> limits = std::nullopt);

/// For a reader at a terminal: the rules, a line a level, the classes of the level that matters most, the
/// worst vertices of it, and the verdict in words; then the same of the limits, if they were compared.
std::string comparison_as_text(const ModelReport& report, std::span<const Subject> subjects);

/// The limits alone: lines for positions and for normals.
std::string limits_as_text(const LimitComparison& limits, const Comparison& comparison);

/// The failures with their reasons, then the known deviations, then a line a model with a column a peer and
/// one for its limits, then one line of summary.
std::string suite_as_text(const SuiteResult& suite, std::span<const Subject> subjects);
/// The part of it that says which known deviations of limits were seen, a line each; empty where none was.
std::string limit_deviations_as_text(const SuiteResult& suite);
/// The last line of it.
std::string suite_summary(const SuiteResult& suite);
/// The same of comparisons whose exit code is another: "agree: 3 comparisons and 2 of limits of 1 model,
/// levels 0 to 5: 0 failed, ...".
std::string summary_in_words(const SuiteResult& suite, int exit_code);

/// "0 failed, 0 differs, 2 known deviation, ...": how often each verdict was given.
std::string verdicts_in_words(const std::function<std::size_t(Verdict)>& count);
/// "1 model", "2 models".
std::string counted(std::size_t n, std::string_view noun);

/// The document of docs/report.schema.json.
std::string comparisons_as_json(std::span<const ModelReport> reports, std::span<const Subject> subjects,
                                int exit_code);
std::string suite_as_json(const SuiteResult& suite, std::span<const Subject> subjects);

/// JUnit XML: a test suite a model, a test case a comparison and one for its limits; what a subject does not
/// support is skipped.
std::string suite_as_junit(const SuiteResult& suite);

/// Peak memory of the two reports below, in bytes per vertex of the last level.  A test measures them.
inline constexpr double kCsvBytesPerVertex = 400;
inline constexpr double kPlyBytesPerVertex = 300;

/// One line a vertex: model, level, vertex, ancestry, class, rule, both positions, error.
class CsvReport {
  public:
    CsvReport();
    /// Makes room for so many vertices more.
    void reserve(std::size_t vertices);
    void add(std::string_view model, const VertexRecord& record, double unit);
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

/// The mesh of one level at the subject's positions, with the error as vertex property `quality` (model
/// units), which MeshLab, ParaView and Blender show as a scalar.  Records of other levels are ignored.
class PlyReport {
  public:
    PlyReport(int level, std::size_t vertices);
    void add(const VertexRecord& record);
    std::string text(std::span<const core::Triangle> triangles, std::string_view comment) const;

  private:
    int level_;
    std::size_t count_ = 0;
    std::string vertices_;
};

}  // namespace loopcheck::compare
