#include "reference/opensubdiv/face_varying.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/meshes.h"

namespace loopcheck::reference {
namespace {

using core::Index;
using namespace tests;

// Six faces around vertex 0, cut along 1 - 0 - 4: there are two values at each of these three.
const Triangles kSeam{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {7, 8, 5}, {7, 5, 6}, {7, 6, 9}};

core::Result<UnwrittenValues> unwritten(const Triangles& values, int count, int levels) {
    return opensubdiv_unwritten_limit_values(mesh_of(wheel(6)), {}, values, count, levels);
}

TEST(OpensubdivFaceVarying, LimitLeavesAValueUnwrittenAtASeamOfTheControlMesh) {
    const auto found = unwritten(kSeam, 10, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->values, 10);
    EXPECT_EQ(found->unwritten, (std::vector<Index>{4}));
}

TEST(OpensubdivFaceVarying, LimitWritesEveryValueOnceRefined) {
    for (const int levels : {1, 2}) {
        const auto found = unwritten(kSeam, 10, levels);
        ASSERT_TRUE(found);
        EXPECT_GT(found->values, 10);
        EXPECT_TRUE(found->unwritten.empty());
    }
}

TEST(OpensubdivFaceVarying, LimitWritesEveryValueWithoutSeams) {
    const auto found = unwritten(mesh_of(wheel(6)).topology().triangles, 7, 0);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->unwritten.empty());
}

TEST(OpensubdivFaceVarying, RefusesValuesThatAreNotOfTheMesh) {
    const auto code = [](const core::Result<UnwrittenValues>& made) { return made.error().code; };
    Triangles shared = kSeam, outside = kSeam, few = kSeam;
    shared[3] = {7, 2, 5};
    outside[5][2] = 10;
    few.pop_back();
    EXPECT_EQ(code(unwritten(shared, 10, 0)), core::ErrorCode::RepeatedVertex);
    EXPECT_EQ(code(unwritten(outside, 10, 0)), core::ErrorCode::IndexOutOfRange);
    EXPECT_EQ(code(unwritten(few, 10, 0)), core::ErrorCode::IndexOutOfRange);
    EXPECT_EQ(code(unwritten(kSeam, 11, 0)), core::ErrorCode::IndexOutOfRange);
    EXPECT_EQ(code(unwritten(kSeam, 10, 16)), core::ErrorCode::Unsupported);
}

}  // namespace
}  // namespace loopcheck::reference
