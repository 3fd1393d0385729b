#include "core/mesh/error.h"

#include <gtest/gtest.h>

#include <set>

namespace loopcheck::core {
namespace {

struct Named {
    ErrorCode code;
    const char* name;
};

constexpr Named kNames[] = {
    {ErrorCode::CannotRead, "cannot-read"},
    {ErrorCode::CannotWrite, "cannot-write"},
    {ErrorCode::UnknownFormat, "unknown-format"},
    {ErrorCode::BadSyntax, "bad-syntax"},
    {ErrorCode::NotATriangle, "not-a-triangle"},
    {ErrorCode::IndexOutOfRange, "index-out-of-range"},
    {ErrorCode::RepeatedVertex, "repeated-vertex"},
    {ErrorCode::NotFinite, "not-finite"},
    {ErrorCode::BadSharpness, "bad-sharpness"},
    {ErrorCode::NoSuchEdge, "no-such-edge"},
    {ErrorCode::HoleOutOfRange, "hole-out-of-range"},
    {ErrorCode::EmptyMesh, "empty-mesh"},
    {ErrorCode::TooLarge, "too-large"},
    {ErrorCode::NonManifoldEdge, "non-manifold-edge"},
    {ErrorCode::NonManifoldVertex, "non-manifold-vertex"},
    {ErrorCode::InconsistentWinding, "inconsistent-winding"},
    {ErrorCode::DuplicateFace, "duplicate-face"},
    {ErrorCode::TooFewPoints, "too-few-points"},
    {ErrorCode::BadKnots, "bad-knots"},
    {ErrorCode::OutsideDomain, "outside-domain"},
    {ErrorCode::NoLimitSurface, "no-limit-surface"},
    {ErrorCode::Unsupported, "unsupported"},
    {ErrorCode::OutOfMemory, "out-of-memory"},
    {ErrorCode::SubjectFailed, "subject-failed"},
};

TEST(ErrorCode, NamesAreStable) {
    for (const auto& [code, name] : kNames) EXPECT_EQ(code_name(code), name);
}

TEST(ErrorCode, EveryCodeHasANameOfItsOwn) {
    std::set<std::string_view> names;
    for (int i = 0; i <= static_cast<int>(ErrorCode::SubjectFailed); ++i) {
        const auto name = code_name(static_cast<ErrorCode>(i));
        EXPECT_NE(name, "unknown") << i;
        EXPECT_TRUE(names.insert(name).second) << name;
    }
    EXPECT_EQ(names.size(), std::size(kNames));
}

TEST(Place, IsNamedByKindAndIndex) {
    EXPECT_EQ(to_string(Place{}), "");
    EXPECT_EQ(to_string(Place{Place::Kind::Line, 7}), "line 7");
    EXPECT_EQ(to_string(Place{Place::Kind::Vertex, 0}), "vertex 0");
    EXPECT_EQ(to_string(Place{Place::Kind::Face, 12}), "face 12");
}

TEST(Error, IsOneLineOfPlaceSentenceAndCode) {
    const Error placed{ErrorCode::RepeatedVertex, "Vertex 7 appears twice.", {Place::Kind::Face, 12}};
    EXPECT_EQ(to_string(placed), "face 12: Vertex 7 appears twice. [repeated-vertex]");
    const Error unplaced{ErrorCode::EmptyMesh, "The mesh has no faces."};
    EXPECT_EQ(to_string(unplaced), "The mesh has no faces. [empty-mesh]");
}

TEST(Error, IsAValueOfAResult) {
    const Result<int> result = fail(ErrorCode::TooLarge, "Too many.", {Place::Kind::Line, 3});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::TooLarge);
    EXPECT_EQ(result.error().sentence, "Too many.");
    EXPECT_EQ(result.error().place, (Place{Place::Kind::Line, 3}));
}

}  // namespace
}  // namespace loopcheck::core
