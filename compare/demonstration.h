// Every known deviation on the smallest mesh that shows it: the right mask, the one predicted, the one
// observed.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/deviations.h"
#include "compare/subject.h"
#include "core/mesh/mesh_data.h"

namespace loopcheck::compare {

/// What became of a deviation in the version that is linked.
enum class DeviationStatus : std::uint8_t {
    AsPredicted,
    Fixed,  ///< the right value is there instead: it must leave the list
    New,    ///< neither the right value nor the predicted one
};
std::string_view name(DeviationStatus status);

/// One quantity of one mesh, as weights over its control vertices; flat, so that it can be drawn.
struct Demonstration {
    const KnownDeviation* deviation = nullptr;
    core::MeshData mesh;
    std::string mesh_in_words;
    std::string quantity;       ///< "limit position of vertex 0"
    std::vector<double> exact;  ///< weights a vertex; directions are scaled to sum |w| = 1
    std::vector<double> observed;
    /// The weights that the deviation predicts; empty where only a bound of the amount is known.
    std::vector<double> predicted;
    double predicted_amount = 0;  ///< sum_j |predicted_j - exact_j|, or the bound of it
    double observed_amount = 0;   ///< sum_j |observed_j - exact_j|
    double allowed = 0;           ///< what rounding explains of either sum
    DeviationStatus status = DeviationStatus::AsPredicted;
    std::string columns[2] = {"exact", "observed"};  ///< what the two rows are
};

/// Right, as predicted or neither, from the rows: equal up to `allowed`; where there is no predicted row, at
/// most the predicted amount apart.
DeviationStatus status_of(const Demonstration& demonstration);

/// Runs OpenSubdiv on the mesh of a deviation of the list.
/// Errors  SubjectFailed, Unsupported: those of the adapters.
core::Result<Demonstration> demonstrate(const KnownDeviation& deviation);

/// The page of a deviation in short: what it is, the mesh, the masks, predicted and observed amount.
std::string demonstration_as_text(const Demonstration& demonstration, std::string_view version);

/// All of them, as the document of docs/report.schema.json.
std::string demonstrations_as_json(std::span<const Demonstration> demonstrations,
                                   std::span<const Subject> subjects, int exit_code);

}  // namespace loopcheck::compare
