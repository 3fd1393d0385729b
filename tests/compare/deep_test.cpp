// Comparison of bits in blocks of faces.
#include "compare/deep/bits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "compare/memory.h"
#include "core/loop/lattice/refiner.h"
#include "core/loop/lattice/split_numbers.h"
#include "core/loop/lattice/split_order.h"
#include "core/mesh/io/atomic_file.h"
#include "reference/opensubdiv/last_level.h"
#include "tests/compare/support.h"
#include "tests/support/models.h"
#include "tests/support/results.h"

namespace loopcheck::compare {
namespace {

using core::BoundaryRule;
using core::Creasing;
using core::Index;
using core::LatticeAddress;
using reference::OpensubdivLastLevel;
using test::model_mesh;
using test::model_path;
using tests::contains;

template <class Real>
constexpr core::Precision kPrecision =
    std::is_same_v<Real, float> ? core::Precision::Float : core::Precision::Double;

// What OpenSubdiv makes of the whole mesh, face by face.
template <class Real>
LatticesByFace<Real> whole_mesh(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                int level) {
    auto peer = OpensubdivLastLevel<Real>::make(mesh, options).value();
    if (const auto error = peer.refine(level)) throw std::runtime_error(core::to_string(*error));
    return [&mesh, level, peer = std::make_shared<OpensubdivLastLevel<Real>>(std::move(peer))](
               const VisitLattice<Real>& visit) {
        const core::NumberPattern pattern(level);
        const core::SplitNumbers split(pattern, mesh.topology());
        const Index n = Index{1} << level;
        std::vector<Index> numbers(static_cast<std::size_t>(core::lattice_place(n, 0, n)) + 1);
        core::Points<Real> lattice;
        const auto values = peer->values();
        for (Index f = 0; f < mesh.face_count(); ++f) {
            split.of_face(f, numbers);
            lattice.clear();
            for (const Index v : numbers) lattice.push_back({values[v].x, values[v].y, values[v].z});
            visit(f, lattice);
        }
    };
}

// Our refinement, with one point of one face changed afterwards.
LatticesByFace<double> spoiled(const core::TriangleMesh& mesh, int level, Index face, std::size_t place,
                               std::function<void(glm::dvec3&)> spoil) {
    return [=, &mesh](const VisitLattice<double>& visit) {
        const auto refiner = core::LatticeRefiner::make(mesh, {}, level).value();
        refiner.refine_by_face<double>(mesh.positions(), [&](Index f, std::span<const glm::dvec3> points) {
            core::Points<double> copy(points.begin(), points.end());
            if (f == face) spoil(copy[place]);
            visit(f, copy);
        });
    };
}

// Blocks of `size` faces, of which there may be gaps between: a few in all.
std::vector<FaceBlock> blocks_of(const core::TriangleMesh& mesh, Index size, Index most) {
    const Index step = std::max(size, mesh.face_count() / most);
    std::vector<FaceBlock> out;
    for (Index f = 0; f < mesh.face_count(); f += step)
        out.push_back({f, std::min(f + size, mesh.face_count())});
    return out;
}

std::int64_t vertices_with_faces(const core::TriangleMesh& mesh, int level) {
    auto vertices = static_cast<std::int64_t>(level_size(mesh, level).vertices);
    for (Index v = 0; v < mesh.vertex_count(); ++v) vertices -= mesh.topology().is_isolated(v) ? 1 : 0;
    return vertices;
}

template <class Real>
void expect_bits_of_the_whole_mesh(const core::TriangleMesh& mesh, const core::SchemeOptions& options,
                                   int level) {
    const auto whole = whole_mesh<Real>(mesh, options, level);
    for (const Index size : {1, 3}) {
        const auto found = compare_bits<Real>(mesh, options, level, blocks_of(mesh, size, 8), 1, whole);
        ASSERT_TRUE(found) << core::to_string(found.error());
        ASSERT_GT(found->vertices, 0);
        ASSERT_EQ(found->identical, found->vertices) << "blocks of " << size << ", level " << level;
    }
    const std::vector<FaceBlock> all{{0, mesh.face_count()}};
    const auto found = compare_bits<Real>(mesh, options, level, all, 1, whole);
    ASSERT_TRUE(found) << core::to_string(found.error());
    ASSERT_EQ(found->identical, found->vertices);
    ASSERT_EQ(found->vertices, vertices_with_faces(mesh, level));
}

class BlocksOfEveryModel : public testing::TestWithParam<std::string> {};

// The claim of Neighbourhood, tested against OpenSubdiv itself.
TEST_P(BlocksOfEveryModel, HaveTheBitsOfTheWholeMesh) {
    const auto mesh = tests::load_model(GetParam()).mesh;
    for (const BoundaryRule boundary :
         {BoundaryRule::EdgeAndCorner, BoundaryRule::EdgeOnly, BoundaryRule::None})
        for (const Creasing creasing : {Creasing::Uniform, Creasing::Chaikin})
            for (int level = 1; level <= tests::levels_up_to(3); ++level) {
                const core::SchemeOptions options{.boundary = boundary, .creasing = creasing};
                ASSERT_NO_FATAL_FAILURE(expect_bits_of_the_whole_mesh<double>(mesh, options, level));
            }
    ASSERT_NO_FATAL_FAILURE(expect_bits_of_the_whole_mesh<float>(mesh, {}, 2));
}

INSTANTIATE_TEST_SUITE_P(Models, BlocksOfEveryModel, testing::ValuesIn(tests::model_files()),
                         tests::model_test_name);

// Under Chaikin's rule a crease is as sharp at level 1 as the edges around its other end say: the vertices of
// the block alone are not enough.
TEST(Neighbourhood, KeepsTheOtherEndsOfSemiSharpEdgesUnderChaikinsRule) {
    const auto mesh = model_mesh("semi-sharp-three-ends");
    Index larger = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const FaceBlock block{f, f + 1};
        const auto uniform = neighbourhood_of(mesh, Creasing::Uniform, block);
        const auto chaikin = neighbourhood_of(mesh, Creasing::Chaikin, block);
        EXPECT_LE(uniform.mesh.face_count(), chaikin.mesh.face_count());
        larger += uniform.mesh.face_count() < chaikin.mesh.face_count() ? 1 : 0;
    }
    EXPECT_GT(larger, 0);
}

TEST(Neighbourhood, CutsOuterVerticesWhereItsFacesFormSeveralFans) {
    std::size_t copies = 0;
    for (const char* name : {"cow", "cow-creased", "genus-2"}) {
        const auto mesh = model_mesh(name);
        for (const FaceBlock block : blocks_of(mesh, 3, 1000)) {
            const auto around = neighbourhood_of(mesh, Creasing::Uniform, block);
            const auto positions = around.mesh.positions();
            for (std::size_t v = 1; v < positions.size(); ++v)
                copies += positions[v] == positions[v - 1] ? 1 : 0;
        }
    }
    EXPECT_GT(copies, 0u);
}

TEST(Neighbourhood, IsTheMeshItselfForAllFaces) {
    for (const char* name : {"cow-creased", "crease-on-boundary", "hole-open"}) {
        const auto mesh = model_mesh(name);
        const auto all = neighbourhood_of(mesh, Creasing::Chaikin, {0, mesh.face_count()});
        EXPECT_EQ(all.first, 0);
        EXPECT_EQ(all.mesh.topology().triangles, mesh.topology().triangles);
        EXPECT_TRUE(std::ranges::equal(all.mesh.positions(), mesh.positions()));
        EXPECT_TRUE(std::ranges::equal(all.mesh.edge_sharpness(), mesh.edge_sharpness()));
        EXPECT_TRUE(std::ranges::equal(all.mesh.vertex_sharpness(), mesh.vertex_sharpness()));
        EXPECT_TRUE(std::ranges::equal(all.mesh.holes(), mesh.holes()));
    }
}

TEST(GrowingBlock, CountsTheNeighbourhood) {
    const auto mesh = model_mesh("semi-sharp-three-ends");
    for (const Creasing creasing : {Creasing::Uniform, Creasing::Chaikin}) {
        GrowingBlock growing(mesh, creasing);
        for (const FaceBlock block : {FaceBlock{0, 5}, FaceBlock{5, 6}, FaceBlock{6, mesh.face_count()}}) {
            growing.restart();
            for (Index f = block.first; f < block.last; ++f) growing.add(f);
            const auto around = neighbourhood_of(mesh, creasing, block);
            EXPECT_EQ(growing.size(), block.size());
            EXPECT_EQ(growing.faces(), around.mesh.face_count());
            EXPECT_EQ(growing.edges(), around.mesh.topology().edge_count());
        }
    }
}

TEST(Blocks, CoverAllFacesWithinTheLimits) {
    const auto mesh = model_mesh("cow");
    std::size_t before = 0;
    for (const double memory : {1e8, 2.5e7, 1.6e7}) {
        const auto blocks =
            divide_into_blocks(mesh, Creasing::Uniform, core::Precision::Double, 4, {memory, 2, 300});
        ASSERT_TRUE(blocks) << core::to_string(blocks.error());
        Index next = 0;
        for (const FaceBlock& block : *blocks) {
            EXPECT_EQ(block.first, next);
            EXPECT_GT(block.size(), 0);
            EXPECT_LE(block.size(), 300);
            next = block.last;
        }
        EXPECT_EQ(next, mesh.face_count());
        EXPECT_GT(blocks->size(), before);
        before = blocks->size();
    }
}

TEST(Blocks, RefuseWhatNoBlockCanHold) {
    const auto mesh = model_mesh("bipyramid-360");
    const auto refused = [&](int level, double memory) {
        return tests::error_of(
            divide_into_blocks(mesh, Creasing::Uniform, core::Precision::Double, level, {memory}));
    };
    EXPECT_EQ(refused(5, 1e6).code, core::ErrorCode::OutOfMemory);
    EXPECT_PRED2(contains, refused(5, 1e6).sentence, "face 0 with the 362 faces around it");
    EXPECT_EQ(refused(11, 1e300).code, core::ErrorCode::TooLarge);
    EXPECT_EQ(refused(30, 1e9).code, core::ErrorCode::OutOfMemory);
}

TEST(BitComparison, IsTheSameInAnyBlocksAndJobs) {
    const auto mesh = model_mesh("isolated-vertex-middle");
    constexpr int kLevel = 3;
    core::SchemeOptions options{.weights = core::Weights::Warren};
    const auto whole = compare_bits(mesh, options, core::Precision::Double, kLevel, {1e9}).value();
    EXPECT_EQ(whole.blocks, 1u);
    EXPECT_EQ(whole.vertices, vertices_with_faces(mesh, kLevel));
    EXPECT_LT(whole.identical, whole.vertices);
    for (const int jobs : {1, 3}) {
        const auto parts =
            compare_bits(mesh, options, core::Precision::Double, kLevel, {1e9, jobs, 2}).value();
        EXPECT_GT(parts.blocks, 1u);
        EXPECT_EQ(parts.largest_block, 2);
        EXPECT_GT(parts.faces_refined, mesh.face_count());
        EXPECT_EQ(parts.vertices, whole.vertices);
        EXPECT_EQ(parts.identical, whole.identical);
        EXPECT_EQ(parts.faces_that_differ, whole.faces_that_differ);
        EXPECT_EQ(parts.worst->vertex, whole.worst->vertex);
        EXPECT_EQ(parts.worst->error, whole.worst->error);
    }
}

// Every kind of point, in a face that counts it.
TEST(BitComparison, FindsTheLastBitOfOneCoordinate) {
    const auto mesh = model_mesh("cow-creased");
    constexpr int kLevel = 3;
    constexpr Index kSegments = 1 << kLevel;
    auto peer = OpensubdivLastLevel<double>::make(mesh, {}).value();
    ASSERT_FALSE(peer.refine(kLevel));
    const auto numbered = peer.positions();
    const core::Topology& t = mesh.topology();
    const core::LatticeOrder order(t, kLevel);
    constexpr Index kFace = 0;  // all of its corners and edges are first its own
    for (const auto& [i, j] :
         std::vector<std::pair<Index, Index>>{{0, 0}, {0, 8}, {3, 0}, {0, 1}, {2, 6}, {2, 3}}) {
        const auto place = static_cast<std::size_t>(core::lattice_place(kSegments, i, j));
        glm::dvec3 right;
        const auto ours = spoiled(mesh, kLevel, kFace, place, [&](glm::dvec3& p) {
            right = p;
            p.y = std::nextafter(p.y, 10);
        });
        const std::vector<FaceBlock> blocks{{0, 7}, {7, mesh.face_count()}};
        const auto found = compare_bits<double>(mesh, {}, kLevel, blocks, 1, ours).value();
        EXPECT_EQ(found.verdict(), Verdict::Differs);
        EXPECT_EQ(found.identical, found.vertices - 1);
        EXPECT_EQ(found.faces_that_differ, 1);
        ASSERT_TRUE(found.worst);
        EXPECT_EQ(found.worst->face, kFace);
        EXPECT_EQ(found.worst->address, order.address_of(order.vertex_at(t, kFace, i, j)));
        EXPECT_EQ(found.worst->theirs, numbered.at(static_cast<std::size_t>(found.worst->vertex)));
        EXPECT_EQ(found.worst->theirs, right);
        EXPECT_EQ(found.worst->error, std::abs(std::nextafter(right.y, 10) - right.y));
    }
}

TEST(BitComparison, TakesNothingForEqualThatIsNotANumber) {
    const auto mesh = model_mesh("icosahedron");
    const std::vector<FaceBlock> all{{0, mesh.face_count()}};
    const auto nan = spoiled(mesh, 2, 0, 6, [](glm::dvec3& p) { p.z = std::nan(""); });
    const auto found = compare_bits<double>(mesh, {}, 2, all, 1, nan).value();
    EXPECT_EQ(found.verdict(), Verdict::Differs);
    EXPECT_TRUE(std::isinf(found.worst->error));
}

// Warren's weights at level 1 move the vertex points of the icosahedron and nothing else.
TEST(BitComparison, NamesWhereAMaskIsAnother) {
    const auto mesh = model_mesh("icosahedron");
    const core::SchemeOptions warren{.weights = core::Weights::Warren};
    const auto found = compare_bits(mesh, warren, core::Precision::Double, 1, {1e9, 1, 3}).value();
    EXPECT_EQ(found.vertices - found.identical, mesh.vertex_count());
    EXPECT_EQ(found.worst->address.kind, LatticeAddress::Kind::Vertex);
    EXPECT_EQ(found.worst->vertex, found.worst->address.index);
}

TEST(BitComparison, RefusesCoordinatesAndLevelsThatAreTooLarge) {
    const auto huge = tests::mesh_of(tests::data_of({{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
    const auto refused = compare_bits(huge, {}, core::Precision::Float, 1, {1e9});
    EXPECT_EQ(tests::error_of(refused).code, core::ErrorCode::NotFinite);
    EXPECT_EQ(
        tests::error_of(compare_bits(model_mesh("icosahedron"), {}, core::Precision::Double, 16, {1e300}))
            .code,
        core::ErrorCode::TooLarge);
}

TEST(CompareBits, SaysWhatAgrees) {
    const std::string json = testing::TempDir() + "bits.json";
    const auto r = test::loopcheck({"compare", model_path("cow"), model_path("fan-3"), "--bits", "--levels",
                                    "4", "--jobs", "2", "--precision", "float", "--json", json});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_PRED2(contains, r.out, "verdict: identical");
    EXPECT_PRED2(contains, r.out, "b = opensubdiv-float");
    const auto report = nlohmann::json::parse(core::read_file(json).value());
    ASSERT_EQ(report["bits"].size(), 2u);
    EXPECT_EQ(report["bits"][0]["vertices"], level_size(model_mesh("cow"), 4).vertices);
    EXPECT_EQ(report["bits"][0]["blocks"], 2);
    EXPECT_EQ(report["exit_code"], 0);
}

TEST(CompareBits, SaysWhereTheyDifferAndWhatTellsWhy) {
    const auto r = test::loopcheck({"compare", model_path("icosahedron"), "--bits", "--levels", "1",
                                    "--weights", "warren", "--crease-angle", "170"});
    EXPECT_EQ(r.code, 1) << r.err;
    EXPECT_PRED2(contains, r.out, "of the model): |a-b| = 0.0434319");
    EXPECT_PRED2(contains, r.out, "verdict: differs");
    EXPECT_PRED2(contains, r.out,
                 "This can: loopcheck compare " + model_path("icosahedron") +
                     " --subject ours --with opensubdiv --levels 1 --weights warren "
                     "--crease-angle 170");
}

TEST(CompareBits, RefusesWhatItCannotDo) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--with", "openmesh"},
                                                 {"--subject", "opensubdiv"},
                                                 {"--limit"},
                                                 {"--with", "opensubdiv-float"},
                                                 {"--csv", "x.csv"},
                                                 {"--adaptive"},
                                                 {"--jobs", "0"},
                                                 {"--levels", "9", "--memory", "0.001"},
                                                 {"--levels", "16"}}) {
        std::vector<std::string> arguments{"compare", model_path("icosahedron"), "--bits"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto r = test::loopcheck(arguments);
        EXPECT_EQ(r.code, 2) << testing::PrintToString(more);
        EXPECT_NE(r.err, "") << testing::PrintToString(more);
    }
    EXPECT_EQ(test::loopcheck({"compare", model_path("icosahedron"), "--jobs", "2"}).code, 2);
}

}  // namespace
}  // namespace loopcheck::compare
