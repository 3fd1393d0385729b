#include "core/bspline/running_error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "core/bspline/subdivide.h"
#include "core/mesh/high_precision.h"
#include "core/mesh/point.h"
#include "tests/support/curves.h"
#include "tests/support/observed.h"

namespace loopcheck::core {
namespace {

using tests::Observed;

// Points of very different sizes, with full last bits.
std::vector<glm::dvec3> points_of(int count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    std::vector<glm::dvec3> out;
    for (int i = 0; i < count; ++i) out.push_back({any(random), 1e6 * any(random), 1e-6 * any(random)});
    return out;
}

template <class P, class Convert>
Curve<P> curve_of(const CurveShape& shape, Convert convert) {
    std::vector<P> points;
    for (const glm::dvec3& p : points_of(9)) points.push_back(convert(p));
    return Curve<P>::make(std::move(points), shape).value();
}

// Every level of every shape: |computed - exact| against the bound that the same code gives of itself.
template <class P, Precision precision>
void observe(Observed& use) {
    for (const CurveShape& shape : tests::shapes(1, 6)) {
        using HighPoint = Point<HighPrecision>;
        const auto computed = curve_levels(curve_of<P>(shape, [](const auto& p) { return P(p); }), 5);
        const auto exact = curve_levels(curve_of<HighPoint>(shape,
                                                            [](const auto& p) {
                                                                return HighPoint{p.x, p.y, p.z};
                                                            }),
                                        5);
        const auto bounds =
            curve_levels(curve_of<RunningError<precision>>(shape, with_running_error<precision>), 5);
        for (std::size_t l = 0; l < exact.size(); ++l)
            for (std::size_t i = 0; i < exact[l].points.size(); ++i) {
                const auto& e = exact[l].points[i];
                const auto& b = bounds[l].points[i];
                const std::array<HighPrecision, 3> wanted{e.x, e.y, e.z};
                for (int k = 0; k < 3; ++k) {
                    const double got = static_cast<double>(computed[l].points[i][k]);
                    use.add(tests::share_of(tests::error_of_value(got, wanted[k]), b.error[k]),
                            static_cast<std::int64_t>(l), got, static_cast<double>(wanted[k]));
                    EXPECT_LE(abs(wanted[k]), HighPrecision(b.magnitude[k]));
                }
            }
    }
}

TEST(RunningError, CoversEverySubdivisionInDouble) {
    Observed use("double: error over bound", "level", 1);
    observe<glm::dvec3, Precision::Double>(use);
    use.check();
}

TEST(RunningError, CoversEverySubdivisionInFloat) {
    Observed use("float: error over bound", "level", 1);
    observe<glm::vec3, Precision::Float>(use);
    use.check();
    EXPECT_GT(use.largest(), 0.5) << "rounding to float alone takes all of the bound at level 0";
}

// Law 1: sum w_i x_i from zero, every term with 5 roundings or more.
TEST(RunningError, AllowsAnyOrderOfSummation) {
    constexpr double kU = unit_roundoff(Precision::Double);
    for (int terms = 2; terms <= 8; ++terms) {
        RunningError<Precision::Double> sum{};
        for (int i = 0; i < terms; ++i)
            sum = sum + 0.25 * with_running_error<Precision::Double>(glm::dvec3(1));
        EXPECT_GE(sum.error.x,
                  (terms + 3) * kU * 0.25 * 2);  // products and weights 3, sums terms - 1, of two terms
        EXPECT_GE(sum.error.x, 5 * kU * 0.25 * terms);
    }
}

TEST(RunningError, OfADoubleIsNothing) {
    EXPECT_EQ(with_running_error<Precision::Double>(glm::dvec3(0.1)).error, glm::dvec3(0));
    EXPECT_EQ(with_running_error<Precision::Float>(glm::dvec3(0.1)).error,
              glm::abs(glm::dvec3(0.1) - glm::dvec3(static_cast<double>(0.1f))));
}

}  // namespace
}  // namespace loopcheck::core
