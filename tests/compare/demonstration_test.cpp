// Every known deviation, on its smallest mesh, is what the list says it is.
#include "compare/demonstration.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "compare/demonstration_meshes.h"
#include "core/mesh/triangle_mesh.h"

namespace loopcheck::compare {
namespace {

class EveryDeviation : public testing::TestWithParam<std::string> {
  protected:
    Demonstration shown() const {
        return demonstrate(*find_deviation(known_deviations(), GetParam())).value();
    }
};

TEST_P(EveryDeviation, ShowsAsPredicted) {
    const Demonstration d = shown();
    fmt::print("[ OBSERVED ] {}: predicted {}{:.6g}, observed {:.6g}, rounding {:.2g}\n", GetParam(),
               d.predicted.empty() ? "at most " : "", d.predicted_amount, d.observed_amount, d.allowed);
    EXPECT_EQ(d.status, DeviationStatus::AsPredicted);
    EXPECT_GT(d.observed_amount, d.allowed);
}

// A version in which it is mended, and one in which it is something else, are told apart.
TEST_P(EveryDeviation, WouldBeSeenFixedOrNew) {
    Demonstration d = shown();
    const auto observed = d.observed;
    d.observed = d.exact;
    EXPECT_EQ(status_of(d), DeviationStatus::Fixed);
    d.observed = observed;
    d.observed.front() += std::max(4 * d.allowed, 2 * d.predicted_amount);
    EXPECT_EQ(status_of(d), DeviationStatus::New);
    d.observed.front() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(status_of(d), DeviationStatus::New);
}

TEST_P(EveryDeviation, HasAPageAndAPicture) {
    const std::filesystem::path root(LOOPCHECK_SOURCE_DIR);
    const KnownDeviation& deviation = *find_deviation(known_deviations(), GetParam());
    EXPECT_TRUE(std::filesystem::exists(root / page_of(deviation))) << page_of(deviation);
    EXPECT_TRUE(std::filesystem::exists(root / fmt::format("docs/figures/{}.png", deviation.name)));
    EXPECT_FALSE(deviation.versions.empty());
    EXPECT_TRUE(deviation.what.ends_with('.'));
}

std::vector<std::string> deviation_names() {
    std::vector<std::string> out;
    for (const KnownDeviation& deviation : known_deviations()) out.emplace_back(deviation.name);
    return out;
}

std::string with_underscores(const testing::TestParamInfo<std::string>& of) {
    std::string name = of.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(List, EveryDeviation, testing::ValuesIn(deviation_names()), with_underscores);

TEST(KnownDeviations, HaveDifferentNames) {
    const auto names = deviation_names();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    EXPECT_EQ(find_deviation(known_deviations(), "no-such-thing"), nullptr);
}

TEST(Demonstration, OfWhatIsNotOnTheListIsRefused) {
    KnownDeviation stranger = known_deviations().front();
    stranger.name = "stranger";
    EXPECT_EQ(demonstrate(stranger).error().code, core::ErrorCode::Unsupported);
}

TEST(DemonstrationMesh, IsWellFormedAndAsLargeAsItSays) {
    for (int n = 3; n <= 9; ++n) {
        const auto disc = core::TriangleMesh::make(flat_disc(n, 3));
        ASSERT_TRUE(disc) << core::to_string(disc.error());
        EXPECT_EQ(disc->face_count(), 9 * n);
        EXPECT_EQ(disc->topology().face_count_at(0), n);
        for (core::Index v = 1; v <= 3 * n; ++v)
            EXPECT_EQ(disc->topology().face_count_at(v), 6) << n << " " << v;
        EXPECT_TRUE(core::TriangleMesh::make(flat_wheel(n)));
        EXPECT_TRUE(core::TriangleMesh::make(flat_fan(n)));
    }
    const auto octahedron = core::TriangleMesh::make(flat_octahedron()).value();
    for (core::Index v = 0; v < 6; ++v) EXPECT_EQ(octahedron.topology().face_count_at(v), 4);
    EXPECT_EQ(core::TriangleMesh::make(flat_pillow()).value().topology().face_count_at(0), 2);
}

TEST(DemonstrationMesh, HasAStraightLineThroughItsMiddle) {
    const auto disc = flat_disc(6, 3);
    for (int step = -3; step <= 3; ++step) {
        EXPECT_NEAR(disc.positions[on_line(step)].x, step, 1e-14);
        EXPECT_NEAR(disc.positions[on_line(step)].y, 0, 1e-14);
    }
}

}  // namespace
}  // namespace loopcheck::compare
