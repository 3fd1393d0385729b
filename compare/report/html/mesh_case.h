// What an HTML report shows of one mesh under one choice of rules, gathered while it is compared.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/limit/comparison.h"
#include "compare/report/html/mesh_levels.h"
#include "compare/subject.h"

namespace loopcheck::compare {

/// Worst vertices of a level that a report lists, of each comparison; of a suite, which has many.
inline constexpr int kWorstListed = 20, kWorstListedInSuite = 5;

/// Gathers a case.  For each pair of subjects: `begin`, then `add` every vertex and limit, then `end`.
class MeshCase {
  public:
    /// Keeps what is said of the first `shown` levels.
    MeshCase(const core::TriangleMesh& mesh, int shown) : mesh_(mesh), shown_(shown) {}

    void begin(const Subject& subject, const Subject& reference);
    void add(const VertexRecord& record);
    void add(const LimitRecord& record);
    void end(const Comparison& comparison, const std::optional<LimitComparison>& limits);

    /// The chunk; nothing where nothing was compared.  `witness`, of the rules of the first subject, has all
    /// levels.
    std::optional<std::string> chunk(const Witness& witness) &&;

  private:
    // What a subject made of a level.
    struct MadeLevel {
        std::vector<glm::dvec3> positions, limits, normals;
        std::vector<std::uint32_t> order;
    };
    struct Made {
        std::string subject;
        std::optional<std::size_t> compared_with;  // in `made_`: what it is likely to be near to
        std::vector<MadeLevel> levels;
    };
    // What the referee said of a level, in units.
    struct Numbers {
        std::vector<float> subject_error, reference_error, bound, bound_use;

        void add(const VertexRecord& record, double unit);
        /// Combined with arrays of the same names of `base`, where it has them.
        nlohmann::ordered_json put_into(ChunkWriter& chunk, const nlohmann::ordered_json& base) const;
    };
    struct LevelNumbers {
        Numbers refinement, limits;
        std::vector<float> normal, normal_bound;
        std::vector<std::uint8_t> deviation;
    };
    struct Pair {
        double unit = 0;
        std::size_t subject = 0, reference = 0;  // in `made_`
        std::vector<LevelNumbers> levels;
        std::uint8_t deviation = 0;  // that all of its refinement shows
        nlohmann::ordered_json comparison;
    };
    // Exact limits of a level.
    struct ExactLevel {
        std::vector<glm::dvec3> limits, normals;
    };

    std::size_t index_of(const std::string& subject, std::optional<std::size_t> compared_with);
    std::uint8_t index_of_deviation(std::string_view name);
    nlohmann::ordered_json positions(ChunkWriter& chunk, std::size_t level, ArrayRef exact) const;
    nlohmann::ordered_json limits(ChunkWriter& chunk, std::size_t level, ArrayRef exact_positions) const;
    nlohmann::ordered_json numbers(ChunkWriter& chunk, std::size_t level) const;

    const core::TriangleMesh& mesh_;
    int shown_;
    std::vector<Made> made_;
    std::vector<Pair> pairs_;
    std::vector<ExactLevel> exact_;
    std::vector<std::string> deviations_;
};

}  // namespace loopcheck::compare
