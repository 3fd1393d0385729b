#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bspline/curve.h"

namespace loopcheck::tests {
namespace {

// Every knot and the numbers beside it, halves of intervals, and places far beyond.
template <class Real>
std::vector<Real> parameters_of(const core::Spline<Real>& spline) {
    const Real infinity = std::numeric_limits<Real>::infinity();
    std::vector<Real> out{-infinity, infinity, Real(1e30), Real(-1e30), Real(0x1p-100), Real(-0x1p-100)};
    for (const Real knot : spline.knots)
        for (const Real t :
             {std::nextafter(knot, -infinity), knot, std::nextafter(knot, infinity), knot + Real(1) / 2})
            out.push_back(t);
    return out;
}

template <class Real>
void expect_same_spans(int degree, core::Ends ends, int count) {
    const auto curve = core::Curve<Real>::make(std::vector<Real>(count, Real(1)), {degree, ends}).value();
    const auto spline = core::spline_of(curve);
    ASSERT_TRUE(spline.one_apart);
    auto searched = spline;
    searched.one_apart = false;
    for (const Real t : parameters_of(spline))
        EXPECT_EQ(core::span_of(spline, t), core::span_of(searched, t))
            << "degree " << degree << ", " << core::name(ends) << ", " << count << " points, t = " << t;
}

TEST(SpanOf, IsTheSameWithoutASearchWhereKnotsAreOneApart) {
    for (int degree = 1; degree <= core::kMaxDegree; ++degree)
        for (const core::Ends ends : {core::Ends::Natural, core::Ends::Closed, core::Ends::Open}) {
            if (ends == core::Ends::Natural && degree % 2 == 0) continue;
            for (const int count : {degree + 1, degree + 2, 40}) {
                expect_same_spans<double>(degree, ends, std::max(count, 3));
                expect_same_spans<float>(degree, ends, std::max(count, 3));
            }
        }
}

TEST(SpanOf, IsInsideForANan) {
    const auto curve = core::Curve<double>::make({1, 2, 3, 4, 5}, {}).value();
    const auto spline = core::spline_of(curve);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_LT(core::span_of(spline, nan), spline.points.size());
    EXPECT_TRUE(std::isnan(core::evaluate(spline, nan)));
}

}  // namespace
}  // namespace loopcheck::tests
