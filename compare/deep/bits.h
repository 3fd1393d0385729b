// The last level of ours against OpenSubdiv's, bit for bit, in blocks of faces: for levels and meshes that do
// not fit into memory at once.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compare/deep/neighbourhood.h"
#include "compare/statistics.h"
#include "core/loop/lattice/address.h"
#include "core/mesh/point.h"

namespace loopcheck::compare {

/// Peak memory of OpenSubdiv's refinement of a block, in bytes per vertex of the last level, and of the
/// program. A test measures them.
inline constexpr double kBlockBytesPerVertex = 290;
inline constexpr double kProgramBytes = 1e7;

/// A vertex whose bits differ.
struct BitDifference {
    core::Index face = 0;          ///< of the control mesh, the first that has the vertex
    core::LatticeAddress address;  ///< of the control mesh
    std::int64_t vertex = 0;       ///< OpenSubdiv's number in the whole level
    double error = 0;              ///< largest coordinate of |a - b|; infinite where one is not finite
    glm::dvec3 ours{}, theirs{};
};

struct BitComparison {
    core::SchemeOptions options;  ///< ours; OpenSubdiv has Loop's weights always
    core::Precision precision = core::Precision::Double;
    int level = 0;
    double largest_coordinate = 0;  ///< M, of the control mesh
    std::int64_t vertices = 0;      ///< each once, with the first face that has it; isolated ones have none
    std::int64_t identical = 0;     ///< with the same bits in all coordinates
    core::Index faces_that_differ = 0;   ///< of the control mesh, each with the vertices counted with it
    std::optional<BitDifference> worst;  ///< the first of those with the largest error
    std::size_t blocks = 0;
    core::Index largest_block = 0;   ///< faces
    std::int64_t faces_refined = 0;  ///< control faces that OpenSubdiv refined, in all blocks

    /// Identical or Differs.
    Verdict verdict() const { return identical == vertices ? Verdict::Identical : Verdict::Differs; }
    double unit() const { return error_unit(largest_coordinate, precision, precision); }
};

struct BlockLimits {
    double memory = 0;                                                 ///< bytes, for all
    int jobs = 1;                                                      ///< blocks at the same time
    core::Index most_faces = std::numeric_limits<core::Index>::max();  ///< of a block
};

/// Divides the faces into blocks that OpenSubdiv can refine to this level within the limits.
/// Errors   OutOfMemory and TooLarge where a single face with those around it cannot.
core::Result<std::vector<FaceBlock>> divide_into_blocks(const core::TriangleMesh& mesh,
                                                        core::Creasing creasing, core::Precision precision,
                                                        int level, const BlockLimits& limits);

/// What is compared with OpenSubdiv: calls the visitor with every face in turn and its closed lattice, by
/// `lattice_place`.
template <class Real>
using VisitLattice = std::function<void(core::Index, std::span<const core::Point<Real>>)>;
template <class Real>
using LatticesByFace = std::function<void(const VisitLattice<Real>&)>;

/// Blocks done, of how many.
using BlockProgress = std::function<void(std::size_t, std::size_t)>;

/// Compares the lattices with OpenSubdiv's refinement of the blocks, which are ascending; faces of none are
/// left out.
/// Errors   Unsupported and SubjectFailed, of OpenSubdiv.
template <class Real>
core::Result<BitComparison> compare_bits(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                         int level, std::span<const FaceBlock> blocks, int jobs,
                                         const LatticesByFace<Real>& ours,
                                         const BlockProgress& progress = {});

/// The same of our refinement straight to the level, in blocks within the limits.
/// Errors   NotFinite where coordinates are beyond the precision; those of the above.
core::Result<BitComparison> compare_bits(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                         core::Precision precision, int level, const BlockLimits& limits,
                                         const BlockProgress& progress = {});

}  // namespace loopcheck::compare
