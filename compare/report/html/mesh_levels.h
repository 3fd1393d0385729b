// The levels of a mesh as an HTML report shows them: what is true of each vertex, whoever refined it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "compare/referee.h"
#include "compare/report/html/chunk.h"
#include "compare/witness.h"

namespace loopcheck::compare {

/// Levels of a mesh, from 0 on, that have at most so many vertices each; at most `levels` + 1.
int shown_levels(const core::TriangleMesh& mesh, int levels, std::size_t most_vertices);

/// Peak memory of what is gathered of a case with so many comparisons and of making its chunk, in bytes.
double shown_bytes(const core::TriangleMesh& mesh, int levels, std::size_t most_vertices,
                   std::size_t comparisons, Scope scope);

/// That of the case, of each comparison, and of its limits, in bytes per vertex of the last level shown.  A
/// test measures them.
inline constexpr double kShownBytesPerVertex = 200;
inline constexpr double kComparedBytesPerVertex = 200;
inline constexpr double kComparedLimitsBytesPerVertex = 500;

/// Puts levels into a chunk, and what they share into its header.
class LevelWriter {
  public:
    /// The first `shown` levels.  Holds on to all three.
    LevelWriter(ChunkWriter& chunk, const Witness& witness, int shown);

    /// Level `level` without what subjects made of it.  Each once, in order.
    nlohmann::ordered_json add(int level);

    /// The members `classes`, `rules`, `masks`, `left_out`, `convergence` and `largest_coordinate` of the
    /// header.
    void finish(nlohmann::ordered_json& header) &&;

  private:
    struct Less {
        bool operator()(const core::Mask& a, const core::Mask& b) const;
    };

    void add_rows(nlohmann::ordered_json& out, int level);
    std::uint32_t index_of_mask(const core::Mask& mask);

    ChunkWriter& chunk_;
    const Witness& witness_;
    int shown_;
    std::vector<core::VertexClass> classes_;  // ascending
    std::vector<std::string> rules_;
    std::map<core::Mask, std::uint32_t, Less> masks_;
    nlohmann::ordered_json weights_;  // of the masks
};

/// Not-a-number and infinity as such, and infinite what is beyond the range of float.
float to_float(double x);

}  // namespace loopcheck::compare
