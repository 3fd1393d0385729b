// What the limit of a refined vertex costs, position and normal: ours beside OpenSubdiv.  README.md says how
// to read it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "bench/support/agreement.h"
#include "bench/support/buffer.h"
#include "bench/support/meshes.h"
#include "bench/support/program.h"
#include "core/loop/lattice/limits.h"
#include "reference/opensubdiv/last_level.h"
#include "reference/opensubdiv/opensubdiv.h"

namespace {

using namespace loopcheck;
using bench::Buffer;
using bench::Case;
using bench::kPrecisionOf;
using bench::Run;
using bench::Subject;
using core::TriangleMesh;

struct Level {
    std::vector<glm::dvec3> positions, normals;
};

// All that is asked of our limits is asked here.
template <class Real>
class Ours {
  public:
    Ours(const TriangleMesh& mesh, int level, int threads)
        : mesh_(mesh),
          control_(core::convert_points<Real>(mesh.positions())),
          level_(level),
          threads_(threads) {}

    void prepare() { limits_ = core::LatticeLimits<Real>::make(mesh_, {}, level_).value(); }
    void evaluate() {
        const auto count = static_cast<std::size_t>(limits_->order().vertex_count());
        positions_ = position_buffer_.room_for(count);
        normals_ = normal_buffer_.room_for(count);
        limits_->evaluate(control_, positions_, normals_, threads_);
    }
    void clear() { limits_.reset(); }

    // In the order of `split`.
    Level result() const {
        const auto number_of = bench::split_numbers(mesh_, level_);
        Level out{std::vector<glm::dvec3>(number_of.size()), std::vector<glm::dvec3>(number_of.size())};
        for (std::size_t v = 0; v < number_of.size(); ++v) {
            out.positions[number_of[v]] = positions_[v];
            out.normals[number_of[v]] = normals_[v];
        }
        return out;
    }

  private:
    const TriangleMesh& mesh_;
    core::Points<Real> control_;
    int level_, threads_;
    std::optional<core::LatticeLimits<Real>> limits_;
    Buffer<core::Point<Real>> position_buffer_, normal_buffer_;
    std::span<core::Point<Real>> positions_, normals_;
};

// What OpenSubdiv says; made when it is first asked for.
template <class Real>
class Expected {
  public:
    explicit Expected(int level) : level_(level) {}

    std::string disagreement(const TriangleMesh& mesh, const Level& ours) {
        if (!made_) make(mesh);
        std::string why = bench::distances("positions", ours.positions, made_->positions, allowed_);
        if (why.empty())
            why = bench::distances("normals", ours.normals, made_->normals, allowed_ / least_height_);
        return why;
    }

  private:
    void make(const TriangleMesh& mesh) {
        auto far = reference::OpensubdivLastLevel<Real>::make(mesh, {}).value();
        far.refine_topology(level_, reference::LastTopology::Full);
        far.interpolate();
        far.limit();
        made_ = {far.limit_positions(), far.limit_normals()};
        allowed_ = bench::allowed_distance(mesh, level_, kPrecisionOf<Real>);
        for (const auto& [a, b, c] : far.faces()) {
            const auto& p = made_->positions;
            const glm::dvec3 ab = p[b] - p[a], bc = p[c] - p[b], ca = p[a] - p[c];
            least_height_ =
                std::min(least_height_, glm::length(glm::cross(ab, bc)) /
                                            std::max({glm::length(ab), glm::length(bc), glm::length(ca)}));
        }
    }

    int level_;
    std::optional<Level> made_;
    double allowed_ = 0;
    // Of the triangles of the level: points that are off by a distance turn a plane by its share of this.
    double least_height_ = std::numeric_limits<double>::infinity();
};

// From a mesh that was taken over; or from new control positions, all else having been prepared.
enum class Task : std::uint8_t { Total, Limits };

template <class Real>
Subject ours_by(Task task, int threads, int level, const std::shared_ptr<Expected<Real>>& expected) {
    return {"ours", threads, 150, [=](const TriangleMesh& mesh) -> core::Result<Run> {
                const auto ours = std::make_shared<Ours<Real>>(mesh, level, threads);
                const auto disagreement = [=, &mesh] { return expected->disagreement(mesh, ours->result()); };
                if (task == Task::Total)
                    return Run{[=] {
                                   ours->prepare();
                                   ours->evaluate();
                               },
                               [=] { ours->clear(); }, disagreement};
                ours->prepare();
                return Run{[=] { ours->evaluate(); }, [] {}, disagreement};
            }};
}

template <class Real>
Subject far_by(Task task, int level) {
    using Far = reference::OpensubdivLastLevel<Real>;
    const auto run_of = [=](const std::shared_ptr<Far>& far) {
        const auto refine_topology = [=] { far->refine_topology(level, reference::LastTopology::Full); };
        const auto evaluate = [=] {
            far->interpolate();
            far->limit();
        };
        const auto none = [] { return std::string(); };  // the others are compared with this
        if (task == Task::Total)
            return Run{[=] {
                           refine_topology();
                           evaluate();
                       },
                       [=] { far->clear(); }, none};
        refine_topology();
        return Run{evaluate, [] {}, none};
    };
    return {"opensubdiv-far", 1, 700, [=](const TriangleMesh& mesh) {
                return Far::make(mesh, {}).map(bench::shared<Far>).map(run_of);
            }};
}

template <class Real>
Case limits(Task task, int size, int level) {
    const auto expected = std::make_shared<Expected<Real>>(level);
    return {.task = task == Task::Total ? "total" : "limits",
            .precision = kPrecisionOf<Real>,
            .mesh = bench::varied_sphere,
            .size = size,
            .level = level,
            .items = bench::sphere_vertices(size, level),
            .written = 6 * sizeof(Real),
            .subjects = {ours_by<Real>(task, 1, level, expected), ours_by<Real>(task, 2, level, expected),
                         far_by<Real>(task, level)}};
}

}  // namespace

int main(int argc, char** argv) {
    bench::Program program("loopcheck_bench_limit",
                           "Times the limit of refined vertices: ours beside OpenSubdiv.", "vertex");
    program.add_peer("opensubdiv", reference::opensubdiv_version());
    if (const auto code = program.parse(argc, argv)) return *code;
    for (const auto& [size, level] : program.sizes_and_levels())
        for (const Task task : {Task::Total, Task::Limits}) {
            program.measure(limits<double>(task, size, level));
            if (program.extent() != bench::Extent::Quick) program.measure(limits<float>(task, size, level));
        }
    return program.finish();
}
