// Every model under every boundary option, by every pair of subjects.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/fingerprint.h"
#include "compare/loading.h"
#include "compare/referee.h"

namespace loopcheck::compare {

/// The boundary options of every model: a case each, in this order.
inline constexpr std::array kSuiteBoundaries{core::BoundaryRule::EdgeAndCorner, core::BoundaryRule::EdgeOnly,
                                             core::BoundaryRule::None};

/// A part of a suite.  Cases are numbered through all models and boundary options, whether the model can be
/// read or not; as in GoogleTest, shard i of n has those whose number is i modulo n.
struct Shard {
    int index = 0, of = 1;

    /// The shard of this case.
    static std::size_t index_of(std::size_t model, std::size_t boundary, int of) {
        return (kSuiteBoundaries.size() * model + boundary) % static_cast<std::size_t>(of);
    }
    bool has(std::size_t model, std::size_t boundary) const {
        return index_of(model, boundary, of) == static_cast<std::size_t>(index);
    }
};

/// A model of a corpus, in whichever shard its cases are.
struct CorpusModel {
    std::string name;  ///< as in rows
    /// Nothing where the file cannot be read.
    std::optional<Fingerprint> fingerprint;
};

/// What a shard says of the whole.
struct ShardOfSuite {
    Shard shard;
    std::size_t cases = 0;  ///< of this shard
    Scope scope = Scope::Limits;
    bool triangulate = false;
    std::vector<CorpusModel> corpus;  ///< all models, in the order of the cases
};

/// One comparison of a suite.
struct SuiteRow {
    std::string model;  ///< file name; the path where two models have the same
    Comparison comparison;
    std::optional<LimitComparison> limits;  ///< where both subjects have limits

    /// The verdict on the limits where there is one, else `Identical`.
    Verdict limit_verdict() const { return limits ? limits->verdict : Verdict::Identical; }
};

/// A model under one choice of rules.
struct SuiteCase {
    std::string model;  ///< as in its rows
    core::SchemeOptions options;
    std::size_t vertices = 0, faces = 0, boundary_edges = 0;  ///< of the control mesh
    std::size_t rows = 0;                                     ///< how many of the rows are of it
    /// Of the HTML report, where it was asked for and something was compared.
    std::optional<std::string> chunk = {};
};
/// Without rows.
SuiteCase make_case(std::string model, const core::TriangleMesh& mesh, const core::SchemeOptions& options);

/// A model that could not be read.
struct UnreadableModel {
    std::string model;
    core::Error error;
};

struct SuiteResult {
    std::vector<SuiteRow> rows;  ///< by model name, boundary option and subject, whatever the number of jobs
    std::vector<SuiteCase> cases;  ///< in the order of the rows
    std::vector<UnreadableModel> unreadable;
    std::size_t models = 0;  ///< of which there is a case
    int levels = 0;
    std::optional<ShardOfSuite> shard = {};  ///< where this is a part

    /// Rows whose limits were compared.
    std::size_t limit_rows() const;
    /// Verdicts on refinement and on limits together.
    std::size_t count(Verdict verdict) const;
    /// 2 where a model is unreadable, else 3 where a subject failed, else 1 where subjects differ, else 0.  A
    /// subject that says it cannot do a model is no failure here.
    int exit_code() const;
};

/// The model files (by extension) in a folder, sorted by name; subfolders are not searched.
/// Errors: CannotRead.
core::Result<std::vector<std::filesystem::path>> find_models(const std::filesystem::path& folder);

struct SuiteOptions {
    int levels = 5;
    int jobs = 1;
    bool triangulate = false;
    Scope scope = Scope::Limits;
    double memory_limit = 0;  ///< bytes, for all jobs together
    /// Make chunks of the HTML report, with levels of at most so many vertices; 0: none.
    std::size_t shown_vertices = 0;
    std::optional<Shard> shard = {};  ///< compare a part only
};

/// Called after each case (a model under one boundary option) with the number done, of how many, and its
/// name.
using SuiteProgress = std::function<void(std::size_t done, std::size_t of, const std::string& model)>;

/// Compares ours with every peer of the same precision on every model, under every boundary option and the
/// creasing that the model declares: the refinement, and the limits of peers that have them.
///
/// Of several shards the one with the first case of a model reports that it cannot be read.  Where that may
/// be for a reason of the machine (CannotRead, OutOfMemory), every shard with a case of it does.
SuiteResult run_suite(std::span<const std::filesystem::path> paths, std::span<const Subject> subjects,
                      const SuiteOptions& options, const SuiteProgress& progress);

}  // namespace loopcheck::compare
