// What the limit of a refined vertex costs, position and normal: ours beside OpenSubdiv.  README.md says how
// to read it.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "bench/support/agreement.h"
#include "bench/support/meshes.h"
#include "bench/support/program.h"
#include "core/loop/limit.h"
#include "reference/opensubdiv/last_level.h"
#include "reference/opensubdiv/opensubdiv.h"

namespace {

using namespace loopcheck;
using bench::Case;
using bench::kPrecisionOf;
using bench::Run;
using bench::Subject;
using core::TriangleMesh;

struct Level {
    std::vector<glm::dvec3> positions, normals;
};

// All that is asked of our limits is asked here: they come with those of every level on the way.
template <class Real>
Level our_limits(const TriangleMesh& mesh, int level) {
    core::LimitLevel last = std::move(core::limits<Real>(mesh, {}, level).value().levels.back());
    std::vector<glm::dvec3> normals = std::move(last.tangent1);
    for (std::size_t v = 0; v < normals.size(); ++v)
        normals[v] = glm::normalize(glm::cross(normals[v], last.tangent2[v]));
    return {std::move(last.positions), std::move(normals)};
}

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

template <class Real>
Subject ours(int level) {
    const auto expected = std::make_shared<Expected<Real>>(level);
    return {"ours", 1, 1500, [=](const TriangleMesh& mesh) -> core::Result<Run> {
                const auto last = std::make_shared<Level>();
                return Run{[=, &mesh] { *last = our_limits<Real>(mesh, level); }, [=] { *last = {}; },
                           [=, &mesh] { return expected->disagreement(mesh, *last); }};
            }};
}

template <class Real>
Subject far(int level) {
    using Far = reference::OpensubdivLastLevel<Real>;
    const auto run_of = [=](const std::shared_ptr<Far>& far) {
        return Run{[=] {
                       far->refine_topology(level, reference::LastTopology::Full);
                       far->interpolate();
                       far->limit();
                   },
                   [=] { far->clear(); }, [] { return std::string(); }};
    };
    return {"opensubdiv-far", 1, 700, [=](const TriangleMesh& mesh) {
                return Far::make(mesh, {}).map(bench::shared<Far>).map(run_of);
            }};
}

// From a mesh that was taken over to the limit positions and normals of every vertex of the level.
template <class Real>
Case limits(int size, int level) {
    return {.task = "limits",
            .precision = kPrecisionOf<Real>,
            .mesh = bench::varied_sphere,
            .size = size,
            .level = level,
            .items = bench::sphere_vertices(size, level),
            .written = 6 * sizeof(Real),
            .subjects = {ours<Real>(level), far<Real>(level)}};
}

}  // namespace

int main(int argc, char** argv) {
    bench::Program program("loopcheck_bench_limit",
                           "Times the limit of refined vertices: ours beside OpenSubdiv.", "vertex");
    program.add_peer("opensubdiv", reference::opensubdiv_version());
    if (const auto code = program.parse(argc, argv)) return *code;
    const bool smoke = program.extent() == bench::Extent::Smoke;
    const int most_levels = smoke ? 2 : program.extent() == bench::Extent::Quick ? 3 : 4;
    for (int level = 1; level <= most_levels; ++level) {
        if (!program.wants_level(level)) continue;
        program.measure(limits<double>(smoke ? 2 : 5, level));
        program.measure(limits<float>(smoke ? 2 : 5, level));
    }
    return program.finish();
}
