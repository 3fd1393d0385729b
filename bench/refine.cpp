// What a vertex of a refined mesh costs: ours, OpenSubdiv, OpenMesh and CGAL in one run.  README.md says how
// to read it.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <utility>

#include "bench/support/agreement.h"
#include "bench/support/buffer.h"
#include "bench/support/meshes.h"
#include "bench/support/program.h"
#include "core/loop/lattice/evaluator.h"
#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_order.h"
#include "reference/opensubdiv/last_level.h"
#include "reference/opensubdiv/opensubdiv.h"
#include "reference/opensubdiv/stencil_table.h"
#ifdef LOOPCHECK_HAS_OPENMESH
#include "reference/openmesh/last_level.h"
#include "reference/openmesh/openmesh.h"
#endif
#ifdef LOOPCHECK_HAS_CGAL
#include "reference/cgal/last_level.h"
#endif

namespace {

using namespace loopcheck;
using bench::Buffer;
using bench::Case;
using bench::kPrecisionOf;
using bench::Run;
using bench::Subject;
using core::Index;
using core::TriangleMesh;

// ---- Ours

// All that is asked of our refinement is asked here.
template <class Real>
class Ours {
  public:
    Ours(const TriangleMesh& mesh, int level, int threads)
        : mesh_(mesh),
          control_(core::convert_points<Real>(mesh.positions())),
          level_(level),
          threads_(threads) {}

    void refine_mesh() {
        refiner_ = core::LatticeRefiner::make(mesh_, {}, level_).value();
        refiner_->refine<Real>(control_, room_for_positions(refiner_->order()), threads_);
        faces_ = face_buffer_.room_for(static_cast<std::size_t>(refiner_->order().face_count()));
        refiner_->triangles(faces_, threads_);
    }
    void clear() { refiner_.reset(); }

    void prepare() { evaluator_ = core::LatticeEvaluator<Real>::make(mesh_, {}, level_).value(); }
    void refine_positions() {
        evaluator_->refine(control_, room_for_positions(evaluator_->order()), threads_);
    }

    std::span<const core::Point<Real>> positions() const { return positions_; }
    std::span<const core::Triangle> faces() const { return faces_; }  // none of `refine_positions`

  private:
    std::span<core::Point<Real>> room_for_positions(const core::LatticeOrder& order) {
        return positions_ = position_buffer_.room_for(static_cast<std::size_t>(order.vertex_count()));
    }

    const TriangleMesh& mesh_;
    core::Points<Real> control_;
    int level_, threads_;
    std::optional<core::LatticeRefiner> refiner_;
    std::optional<core::LatticeEvaluator<Real>> evaluator_;
    Buffer<core::Point<Real>> position_buffer_;
    Buffer<core::Triangle> face_buffer_;
    std::span<core::Point<Real>> positions_;
    std::span<core::Triangle> faces_;
};

// ---- What is right

// What OpenSubdiv's Far makes of a mesh; made when it is first asked for.
template <class Real>
class Expected {
  public:
    explicit Expected(int level) : level_(level) {}

    struct Level {
        std::vector<glm::dvec3> positions;
        std::vector<core::Triangle> faces;
    };
    const Level& of(const TriangleMesh& mesh) {
        if (!made_) {
            auto far = reference::OpensubdivLastLevel<Real>::make(mesh, {}).value();
            far.refine_topology(level_, reference::LastTopology::Least);
            far.interpolate();
            made_ = {far.positions(), far.faces()};
        }
        return *made_;
    }
    int level() const { return level_; }

  private:
    int level_;
    std::optional<Level> made_;
};

bool same_bits(const glm::dvec3& a, const glm::dvec3& b) {
    for (int d = 0; d < 3; ++d)
        if (std::bit_cast<std::uint64_t>(a[d]) != std::bit_cast<std::uint64_t>(b[d])) return false;
    return true;
}

// Whether our positions, and the faces where there are any, are OpenSubdiv's, bit for bit.
template <class Real>
std::string bits_that_differ(const TriangleMesh& mesh, const Ours<Real>& ours, Expected<Real>& expected) {
    const auto& [positions, faces] = expected.of(mesh);
    if (ours.positions().size() != positions.size())
        return fmt::format("{} vertices, {} expected", ours.positions().size(), positions.size());
    const auto number_of = bench::split_numbers(mesh, expected.level());
    for (std::size_t v = 0; v < positions.size(); ++v)
        if (!same_bits(ours.positions()[v], positions[number_of[v]]))
            return fmt::format("vertex {} has other bits than OpenSubdiv's {}", v, number_of[v]);
    const core::SplitOrder split(mesh.topology(), expected.level());
    const Index segments = 1 << expected.level();
    const std::int64_t per_face = std::int64_t{segments} * segments;
    for (std::size_t t = 0; t < ours.faces().size(); ++t) {
        const auto triangle = static_cast<std::int64_t>(t);
        const auto number = split.face(static_cast<Index>(triangle / per_face),
                                       core::triangle_at(segments, triangle % per_face));
        core::Triangle renamed = ours.faces()[t];
        for (Index& v : renamed) v = number_of[v];
        if (renamed != faces[number]) return fmt::format("face {} is not OpenSubdiv's {}", t, number);
    }
    return {};
}

// How far positions in any order are from OpenSubdiv's: where a pairing within a distance exists, the sorted
// values of each coordinate are pairwise within it too.
template <class Real>
std::string distances_in_any_order(const TriangleMesh& mesh, std::vector<glm::dvec3> positions,
                                   Expected<Real>& expected) {
    std::vector<glm::dvec3> theirs = expected.of(mesh).positions;
    constexpr std::size_t kMostSorted = 1 << 20;
    if (positions.size() == theirs.size() && positions.size() > kMostSorted)
        return {};  // the same code as at the levels before
    for (auto* points : {&positions, &theirs})
        for (int d = 0; d < 3; ++d) {
            std::vector<double> sorted;
            for (const glm::dvec3& p : *points) sorted.push_back(p[d]);
            std::sort(sorted.begin(), sorted.end());
            for (std::size_t i = 0; i < sorted.size(); ++i) (*points)[i][d] = sorted[i];
        }
    return bench::distances("sorted coordinates", positions, theirs,
                            bench::allowed_distance(mesh, expected.level(), kPrecisionOf<Real>));
}

// ---- Subjects

template <class Real>
using ExpectedPtr = std::shared_ptr<Expected<Real>>;

// From a mesh that was taken over to positions and faces; or from new control positions to positions, all
// else having been prepared.
enum class Task : std::uint8_t { Total, Positions };

template <class Real>
Subject ours_by(Task task, int threads, int level, const ExpectedPtr<Real>& expected) {
    return {"ours", threads, 100, [=](const TriangleMesh& mesh) -> core::Result<Run> {
                const auto ours = std::make_shared<Ours<Real>>(mesh, level, threads);
                const auto disagreement = [=, &mesh] { return bits_that_differ(mesh, *ours, *expected); };
                if (task == Task::Total)
                    return Run{[=] { ours->refine_mesh(); }, [=] { ours->clear(); }, disagreement};
                ours->prepare();
                return Run{[=] { ours->refine_positions(); }, [] {}, disagreement};
            }};
}

template <class Real>
Subject far_by(Task task, int level) {
    using Far = reference::OpensubdivLastLevel<Real>;
    const auto run_of = [=](const std::shared_ptr<Far>& far) {
        const auto refine_topology = [=] { far->refine_topology(level, reference::LastTopology::Least); };
        const auto none = [] { return std::string(); };  // the others are compared with this
        if (task == Task::Total)
            return Run{[=] {
                           refine_topology();
                           far->interpolate();
                       },
                       [=] { far->clear(); }, none};
        refine_topology();
        return Run{[=] { far->interpolate(); }, [] {}, none};
    };
    return {"opensubdiv-far", 1, 350, [=](const TriangleMesh& mesh) {
                return Far::make(mesh, {}).map(bench::shared<Far>).map(run_of);
            }};
}

template <class Real>
Subject by_stencils(int level, const ExpectedPtr<Real>& expected) {
    using Table = reference::OpensubdivStencilTable<Real>;
    return {"opensubdiv-stencils", 1, 900, [=](const TriangleMesh& mesh) {
                const auto run_of = [&](const std::shared_ptr<Table>& table) {
                    const auto disagreement = [=, &mesh] {
                        return bench::distances("positions", table->positions(), expected->of(mesh).positions,
                                                bench::allowed_distance(mesh, level, kPrecisionOf<Real>));
                    };
                    return Run{[=] { table->update(); }, [] {}, disagreement};
                };
                return Table::make(mesh, {}, level).map(bench::shared<Table>).map(run_of);
            }};
}

// A peer that refines in place.
template <class Real, class Peer>
Subject in_place(std::string name, double bytes, int level, const ExpectedPtr<Real>& expected,
                 core::Result<Peer> (*make)(const TriangleMesh&)) {
    return {std::move(name), 1, bytes, [=](const TriangleMesh& mesh) {
                const auto run_of = [&](const std::shared_ptr<Peer>& peer) {
                    const auto disagreement = [=, &mesh] {
                        return distances_in_any_order(mesh, peer->positions(), *expected);
                    };
                    return Run{[=] { peer->refine(level); }, [=] { peer->clear(); }, disagreement};
                };
                return make(mesh).map(bench::shared<Peer>).map(run_of);
            }};
}

// ---- Cases

constexpr double kFaceBytes = 2 * sizeof(core::Triangle);  // a vertex has two faces

template <class Real>
Case refinement(Task task, int size, int level) {
    const auto expected = std::make_shared<Expected<Real>>(level);
    const bool is_total = task == Task::Total;
    Case out{.task = is_total ? "total" : "positions",
             .precision = kPrecisionOf<Real>,
             .mesh = bench::varied_sphere,
             .size = size,
             .level = level,
             .items = bench::sphere_vertices(size, level),
             .written = 3 * sizeof(Real) + (is_total ? kFaceBytes : 0),
             .subjects = {}};
    for (const int threads : {1, 2}) out.subjects.push_back(ours_by<Real>(task, threads, level, expected));
    out.subjects.push_back(far_by<Real>(task, level));
    if (!is_total) {
        out.subjects.push_back(by_stencils<Real>(level, expected));
        return out;
    }
#ifdef LOOPCHECK_HAS_OPENMESH
    using OpenMesh = reference::OpenmeshLastLevel<Real>;
    out.subjects.push_back(in_place<Real, OpenMesh>(
        "openmesh", 400, level, expected, [](const TriangleMesh& mesh) { return OpenMesh::make(mesh, {}); }));
#endif
#ifdef LOOPCHECK_HAS_CGAL
    out.subjects.push_back(in_place<Real, reference::CgalLastLevel<Real>>(
        "cgal", 300, level, expected, &reference::CgalLastLevel<Real>::make));
#endif
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    bench::Program program("loopcheck_bench_refine", "Times uniform refinement: ours beside every peer.",
                           "vertex");
    program.add_peer("opensubdiv", reference::opensubdiv_version());
#ifdef LOOPCHECK_HAS_OPENMESH
    program.add_peer("openmesh", reference::openmesh_version());
#endif
#ifdef LOOPCHECK_HAS_CGAL
    program.add_peer("cgal", reference::cgal_version());
#endif
    if (const auto code = program.parse(argc, argv)) return *code;
    for (const auto& [size, level] : program.sizes_and_levels())
        for (const Task task : {Task::Total, Task::Positions}) {
            program.measure(refinement<double>(task, size, level));
            if (program.extent() != bench::Extent::Quick)
                program.measure(refinement<float>(task, size, level));
        }
    return program.finish();
}
