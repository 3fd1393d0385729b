// Two subjects on one mesh: the difference, vertex by vertex, and the verdict.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/matching.h"
#include "compare/subject.h"
#include "compare/witness.h"

namespace loopcheck::compare {

/// How two results agree, best first.
enum class Verdict : std::uint8_t {
    Identical,       ///< every coordinate has the same bits
    WithinRounding,  ///< |a - b| <= E_a + E_b in every coordinate: no difference between the masks is shown
    KnownDeviation,  ///< differs, in a way that is on the list of known deviations and by the predicted
                     ///< amount
    NotSupported,    ///< a subject says that it cannot do this; nothing was compared
    Differs,         ///< the masks, the rules or the topology differ
    Failed,          ///< a subject gave an error or broke its promise
};
std::string_view name(Verdict verdict);

/// The process exit code for a verdict: 0 agree, 1 differ, 3 a subject failed or was asked for what it cannot
/// do.
int exit_code(Verdict verdict);

/// The exit code of several runs: 2 before 3 before 1 before 0.
int worse_exit_code(int a, int b);

/// The unit in which errors are given: u M, with the larger u of the two precisions, and at least its
/// smallest subnormal number.
double error_unit(double largest_coordinate, core::Precision a, core::Precision b);

/// Errors of many vertices.  An error is the largest coordinate of |a - b|, in model units.
struct ErrorStats {
    std::size_t count = 0;
    std::size_t identical = 0;  ///< vertices with the same bits in all coordinates
    std::size_t not_finite =
        0;  ///< vertices where an error is NaN or infinite: in `count`, not in what follows
    double max = 0;
    double sum = 0;
    double norm = 0;  ///< square root of the sum of squares

    void add(double error, bool same_bits);
    void add(const ErrorStats& other);
    double mean() const;
    double rms() const;
};

/// Statistics of one vertex class.
struct ClassStats {
    ErrorStats difference;         ///< subject against reference
    ErrorStats subject_error;      ///< subject against the exact rules
    ErrorStats reference_error;    ///< reference against the exact rules
    double largest_bound_use = 0;  ///< max of |a - b| / (E_a + E_b): above 1 the masks differ
    double predicted = 0;  ///< largest difference between the exact results of the two subjects' rules
    std::size_t beyond_bound = 0;   ///< vertices that violate the bound
    std::size_t unexplained = 0;    ///< vertices whose difference is not the predicted one, within the bound
    std::size_t subject_wrong = 0;  ///< vertices where the subject is farther from the exact rules than E_a
    std::size_t reference_wrong = 0;  ///< and the reference than E_b
    std::size_t rule_mismatches =
        0;  ///< vertices for which a subject reports another rule or boundary tag than ours
};

/// Everything known of one vertex.
struct VertexRecord {
    int level = 0;
    core::Index vertex = 0;            ///< in our order
    core::Index subject_vertex = 0;    ///< in the subject's own order
    core::Index reference_vertex = 0;  ///< in the reference's own order
    core::Ancestor ancestor;           ///< meaningless at level 0
    core::VertexClass vertex_class;
    std::optional<core::Mask> mask;  ///< the rule that made it; nothing at level 0
    glm::dvec3 subject{0}, reference{0}, exact{0};
    bool identical = false;  ///< subject and reference have the same bits
    double error = 0;  ///< largest coordinate of |subject - reference|; infinite where one is not finite
    double subject_error = 0;    ///< of the subject against the exact rules
    double reference_error = 0;  ///< of the reference against the exact rules
    double bound = 0;            ///< E_a + E_b in the coordinate that uses most of it
    double bound_use = 0;        ///< largest |a - b| / (E_a + E_b); infinite where an error is not finite
};

/// One level of a comparison.
struct LevelResult {
    int level = 0;
    Verdict verdict = Verdict::Identical;
    std::size_t faces = 0;
    std::map<core::VertexClass, ClassStats> classes;
    std::vector<VertexRecord> worst;  ///< largest error first, then largest bound use
};

/// The outcome.
struct Comparison {
    std::string subject, reference;  ///< names
    core::Precision subject_precision = core::Precision::Double;
    core::Precision reference_precision = core::Precision::Double;
    core::SchemeOptions options;
    double largest_coordinate = 0;  ///< M
    double diagonal = 0;
    Verdict verdict = Verdict::Identical;
    std::string deviation;           ///< name of the known deviation, where the verdict is that
    std::vector<std::string> notes;  ///< the verdict in words, a sentence each
    std::vector<LevelResult> levels;

    double unit() const { return error_unit(largest_coordinate, subject_precision, reference_precision); }
};

/// The statistics of a level, all classes together.
ClassStats total(const LevelResult& level);

/// A subject with what it made and what is true of it.
struct Side {
    const Subject* subject = nullptr;
    const core::Refinement* refinement = nullptr;
    const Match* match = nullptr;
    const Witness* witness = nullptr;
};

using VertexVisitor = std::function<void(const VertexRecord&)>;

/// Compares two matched results.  Where the witnesses are of different rules, their difference is the
/// prediction. `top` is the number of worst vertices kept a level; `visit` is called for every vertex in
/// order, if given.
Comparison compare(const Side& subject, const Side& reference, int top, const VertexVisitor& visit = {});

}  // namespace loopcheck::compare
