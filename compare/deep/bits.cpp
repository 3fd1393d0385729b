#include "compare/deep/bits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <future>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "compare/memory.h"
#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_numbers.h"
#include "core/loop/lattice/split_order.h"
#include "reference/opensubdiv/last_level.h"

namespace loopcheck::compare {
namespace {

using core::Index;

template <class Real>
constexpr core::Precision kPrecision =
    std::is_same_v<Real, float> ? core::Precision::Float : core::Precision::Double;

std::size_t closed_size(Index segments) {
    return static_cast<std::size_t>(core::lattice_place(segments, 0, segments)) + 1;
}

// What was found in one block.
struct BlockFindings {
    std::int64_t vertices = 0, identical = 0, faces_refined = 0;
    Index faces_that_differ = 0;
    std::optional<BitDifference> worst;

    void add(const BlockFindings& later) {
        vertices += later.vertices;
        identical += later.identical;
        faces_refined += later.faces_refined;
        faces_that_differ += later.faces_that_differ;
        if (later.worst && (!worst || later.worst->error > worst->error)) worst = later.worst;
    }
};

// What all blocks have in common.
struct Task {
    const core::TriangleMesh& mesh;
    core::SchemeOptions options;
    core::NumberPattern pattern;
    std::vector<Index> first_face;  // of every control vertex

    Task(const core::TriangleMesh& of, const core::SchemeOptions& rules, int level)
        : mesh(of),
          options(rules),
          pattern(level),
          first_face(static_cast<std::size_t>(of.vertex_count()), core::kNone) {
        options.weights = core::Weights::Loop;
        const auto& faces = mesh.topology().triangles;
        for (std::size_t f = faces.size(); f-- > 0;)
            for (const Index v : faces[f]) first_face[v] = static_cast<Index>(f);
    }
    Index segments() const { return Index{1} << pattern.level(); }
};

// Compares the points of one face that no earlier face has.
template <class Real>
class FaceComparison {
  public:
    FaceComparison(const Task& task, std::span<const reference::internal::Value<Real>> theirs)
        : task_(task), theirs_(theirs) {}

    // `numbers` and `ours` by `lattice_place`.
    void run(Index f, std::span<const Index> numbers, std::span<const core::Point<Real>> ours) {
        numbers_ = numbers;
        ours_ = ours;
        face_ = f;
        const std::int64_t identical_before = found.identical, vertices_before = found.vertices;
        const Index n = task_.segments();
        for (Index j = 1; j + 1 < n; ++j) compare_run(1, j, n - j);
        const core::Topology& t = task_.mesh.topology();
        for (int c = 0; c < 3; ++c) {
            const Index v = t.triangles[f][c];
            if (task_.first_face[v] == f) compare_point(core::on_face_edge(n, c, 0));
            if (t.edge_faces[t.face_edges[f][c]][0] != f) continue;
            for (Index k = 1; k < n; ++k) compare_point(core::on_face_edge(n, c, k));
        }
        if (found.identical - identical_before != found.vertices - vertices_before) ++found.faces_that_differ;
    }

    BlockFindings found;

  private:
    // The points (i, j), (i + 1, j), ..., before column `end`.
    void compare_run(Index i, Index j, Index end) {
        const auto row = static_cast<std::size_t>(core::lattice_place(task_.segments(), 0, j));
        Index same = 0;
        for (Index column = i; column < end; ++column) {
            const std::size_t at = row + static_cast<std::size_t>(column);
            if (is_same(at))
                ++same;
            else
                note(at, column, j);
        }
        found.identical += same;
        found.vertices += end - i;
    }
    void compare_point(std::array<Index, 2> at) { compare_run(at[0], at[1], at[0] + 1); }

    bool is_same(std::size_t at) const {
        static_assert(sizeof(core::Point<Real>) == sizeof(reference::internal::Value<Real>));
        return std::memcmp(&ours_[at], &theirs_[static_cast<std::size_t>(numbers_[at])],
                           sizeof(core::Point<Real>)) == 0;
    }

    void note(std::size_t at, Index i, Index j) {
        const auto& b = theirs_[static_cast<std::size_t>(numbers_[at])];
        const glm::dvec3 ours(ours_[at]), theirs(b.x, b.y, b.z);
        const double error = largest(glm::abs(ours - theirs));
        if (found.worst && !(error > found.worst->error)) return;
        const core::Topology& t = task_.mesh.topology();
        const core::LatticeOrder order(t, task_.pattern.level());
        const core::LatticeAddress address = order.address_of(order.vertex_at(t, face_, i, j));
        const std::int64_t vertex = core::SplitOrder(t, task_.pattern.level()).vertex(address);
        found.worst = BitDifference{face_, address, vertex, error, ours, theirs};
    }

    const Task& task_;
    std::span<const reference::internal::Value<Real>> theirs_;
    std::span<const Index> numbers_;
    std::span<const core::Point<Real>> ours_;
    Index face_ = 0;
};

// `lattices` has the closed lattices of the block's faces, one after the other.
template <class Real>
core::Result<BlockFindings> compare_block(const Task& task, FaceBlock block,
                                          const core::Points<Real>& lattices) {
    const Neighbourhood around = neighbourhood_of(task.mesh, task.options.creasing, block);
    auto peer = reference::OpensubdivLastLevel<Real>::make(around.mesh, task.options);
    if (!peer) return tl::unexpected(peer.error());
    if (auto error = peer->refine(task.pattern.level())) return tl::unexpected(std::move(*error));
    const auto theirs = peer->values();
    const core::LatticeOrder order(around.mesh.topology(), task.pattern.level());
    if (static_cast<std::int64_t>(theirs.size()) != order.vertex_count())
        return core::fail(core::ErrorCode::SubjectFailed,
                          fmt::format("OpenSubdiv made {} vertices where there are {}.", theirs.size(),
                                      order.vertex_count()));
    const core::SplitNumbers split(task.pattern, around.mesh.topology());
    const std::size_t size = closed_size(task.segments());
    std::vector<Index> numbers(size);
    FaceComparison<Real> comparison(task, theirs);
    for (Index k = 0; k < block.size(); ++k) {
        split.of_face(around.first + k, numbers);
        comparison.run(block.first + k, numbers,
                       std::span(lattices).subspan(static_cast<std::size_t>(k) * size, size));
    }
    comparison.found.faces_refined = around.mesh.face_count();
    return comparison.found;
}

// Gathers lattices until a block is complete, and has it compared beside the others.
template <class Real>
class BlockQueue {
  public:
    BlockQueue(const Task& task, std::span<const FaceBlock> blocks, int jobs, const BlockProgress& progress)
        : task_(task), blocks_(blocks), jobs_(static_cast<std::size_t>(jobs)), progress_(progress) {}

    void add(Index f, std::span<const core::Point<Real>> lattice) {
        if (next_ == blocks_.size() || f < blocks_[next_].first) return;
        const FaceBlock block = blocks_[next_];
        if (f == block.first) gathered_.reserve(static_cast<std::size_t>(block.size()) * lattice.size());
        gathered_.insert(gathered_.end(), lattice.begin(), lattice.end());
        if (f + 1 < block.last) return;
        ++next_;
        if (!total_) {
            gathered_.clear();
            return;
        }
        if (running_.size() == jobs_) finish_first();
        running_.push_back(std::async(jobs_ == 1 ? std::launch::deferred : std::launch::async,
                                      [this, block, lattices = std::exchange(gathered_, {})] {
                                          return compare_block<Real>(task_, block, lattices);
                                      }));
        if (jobs_ == 1) finish_first();
    }

    core::Result<BlockFindings> finish() {
        while (!running_.empty()) finish_first();
        return total_;
    }

  private:
    void finish_first() {
        auto found = running_.front().get();
        running_.pop_front();
        if (!total_) return;
        if (!found) {
            total_ = std::move(found);
            return;
        }
        total_->add(*found);
        if (progress_) progress_(++done_, blocks_.size());
    }

    const Task& task_;
    std::span<const FaceBlock> blocks_;
    std::size_t jobs_;
    const BlockProgress& progress_;
    std::size_t next_ = 0, done_ = 0;
    core::Points<Real> gathered_;
    std::deque<std::future<core::Result<BlockFindings>>> running_;
    core::Result<BlockFindings> total_ = BlockFindings{};
};

// Our refinement straight to the level, face by face.
template <class Real>
core::Result<LatticesByFace<Real>> lattices_by_face(const core::TriangleMesh& mesh,
                                                    const core::SchemeOptions& options, int level) {
    auto refiner = core::LatticeRefiner::make(mesh, options, level);
    if (!refiner) return tl::unexpected(refiner.error());
    return [refiner = std::move(*refiner), control = core::convert_points<Real>(mesh.positions())](
               const VisitLattice<Real>& visit) { refiner.template refine_by_face<Real>(control, visit); };
}

template <class Real>
core::Result<BitComparison> compare_ours(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                         int level, const BlockLimits& limits,
                                         const BlockProgress& progress) {
    if (auto error = core::check_fits(mesh, kPrecision<Real>)) return tl::unexpected(std::move(*error));
    const auto blocks = divide_into_blocks(mesh, options.creasing, kPrecision<Real>, level, limits);
    if (!blocks) return tl::unexpected(blocks.error());
    const auto ours = lattices_by_face<Real>(mesh, options, level);
    if (!ours) return tl::unexpected(ours.error());
    return compare_bits<Real>(mesh, options, level, *blocks, limits.jobs, *ours, progress);
}

}  // namespace

core::Result<std::vector<FaceBlock>> divide_into_blocks(const core::TriangleMesh& mesh,
                                                        core::Creasing creasing, core::Precision precision,
                                                        int level, const BlockLimits& limits) {
    const double n = std::ldexp(1.0, level), in_lattice = (n + 1) * (n + 2) / 2;
    const double bytes_per_point =
        precision == core::Precision::Float ? sizeof(core::Point<float>) : sizeof(core::Point<double>);
    // Ours holds a face at all levels, padded to four coordinates, and packed; every job the numbers of one.
    const double fixed =
        kProgramBytes + mesh.face_count() * kControlBytesPerFace + core::NumberPattern::bytes(level) +
        in_lattice * (bytes_per_point + 4.0 / 3 * 4.0 / 3 * bytes_per_point + limits.jobs * sizeof(Index));
    const double available = (limits.memory - fixed) / limits.jobs;
    GrowingBlock growing(mesh, creasing);
    const double lattices = limits.jobs == 1 ? 1 : 1 + 1.0 / limits.jobs;  // one more is gathered
    const auto vertices = [&] {
        // But for V - E + F, which is small.
        return static_cast<double>(growing.edges()) * n +
               static_cast<double>(growing.faces()) * (n * n - 3 * n) / 2;
    };
    const auto bytes = [&] {
        return kBlockBytesPerVertex * vertices() + lattices * in_lattice * bytes_per_point * growing.size();
    };
    const auto fits = [&] {
        return growing.size() <= limits.most_faces && bytes() <= available &&
               3 * static_cast<double>(growing.faces()) * n * n <= std::numeric_limits<Index>::max();
    };
    std::vector<FaceBlock> blocks;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        growing.add(f);
        if (!blocks.empty() && fits()) {
            ++blocks.back().last;
            continue;
        }
        if (f > 0) {
            growing.restart();
            growing.add(f);
        }
        if (!fits()) {
            const std::string what = fmt::format(
                "Level {}: beside what is held of all faces, face {} with the {} faces around it has {:.3g} "
                "vertices",
                level, f, growing.faces() - 1, vertices());
            if (auto error = check_memory(what, fixed + limits.jobs * bytes(), limits.memory))
                return tl::unexpected(std::move(*error));
            return core::fail(core::ErrorCode::TooLarge, what + " and too many faces to be numbered.");
        }
        blocks.push_back({f, f + 1});
    }
    return blocks;
}

template <class Real>
core::Result<BitComparison> compare_bits(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                         int level, std::span<const FaceBlock> blocks, int jobs,
                                         const LatticesByFace<Real>& ours, const BlockProgress& progress) {
    const Task task(mesh, options, level);
    BlockQueue<Real> queue(task, blocks, jobs, progress);
    ours([&](Index f, std::span<const core::Point<Real>> lattice) { queue.add(f, lattice); });
    auto found = queue.finish();
    if (!found) return tl::unexpected(found.error());
    BitComparison out;
    out.options = options;
    out.precision = kPrecision<Real>;
    out.level = level;
    out.largest_coordinate = mesh.largest_coordinate();
    out.vertices = found->vertices;
    out.identical = found->identical;
    out.faces_that_differ = found->faces_that_differ;
    out.worst = found->worst;
    out.blocks = blocks.size();
    for (const FaceBlock& block : blocks) out.largest_block = std::max(out.largest_block, block.size());
    out.faces_refined = found->faces_refined;
    return out;
}

template core::Result<BitComparison> compare_bits<float>(const core::TriangleMesh&,
                                                         const core::SchemeOptions&, int,
                                                         std::span<const FaceBlock>, int,
                                                         const LatticesByFace<float>&, const BlockProgress&);
template core::Result<BitComparison> compare_bits<double>(const core::TriangleMesh&,
                                                          const core::SchemeOptions&, int,
                                                          std::span<const FaceBlock>, int,
                                                          const LatticesByFace<double>&,
                                                          const BlockProgress&);

core::Result<BitComparison> compare_bits(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                         core::Precision precision, int level, const BlockLimits& limits,
                                         const BlockProgress& progress) {
    return precision == core::Precision::Float ? compare_ours<float>(mesh, options, level, limits, progress)
                                               : compare_ours<double>(mesh, options, level, limits, progress);
}

}  // namespace loopcheck::compare
