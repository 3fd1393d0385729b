// Two subjects on one mesh: the difference, vertex by vertex, and the verdict.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/matching.h"
#include "compare/statistics.h"
#include "compare/subject.h"
#include "compare/witness.h"

namespace loopcheck::compare {

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
