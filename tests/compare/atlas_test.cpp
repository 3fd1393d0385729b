// The atlas: the rows that are known, and that nothing else around the vertex has a say.
#include "compare/surface/atlas.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/observed.h"

namespace loopcheck::compare {
namespace {

using Kind = CornerClass::Kind;

AtlasError bfr_error(CornerClass c, int level) {
    return atlas_error(c, {reference::SurfaceMethod::Bfr, level, level, reference::PatchSharpness::Exact},
                       reference::opensubdiv_surface)
        .value();
}

// A row: the largest error at the levels 2, 6 and 10, as seen with other samples to two digits, and its rate.
struct KnownRow {
    CornerClass corner;
    std::array<double, 3> error;
    double rate;
};
const std::array kKnownRows{KnownRow{{Kind::Interior, 3}, {6.4e-3, 2.4e-5, 9.4e-8}, .250},
                            KnownRow{{Kind::Interior, 4}, {8.7e-3, 1.6e-4, 3.1e-6}, .375},
                            KnownRow{{Kind::Interior, 5}, {7.5e-3, 3.0e-4, 1.25e-5}, .452},
                            KnownRow{{Kind::Interior, 7}, {9.1e-3, 6.2e-4, 4.9e-5}, .530},
                            KnownRow{{Kind::Interior, 8}, {1.8e-2, 1.35e-3, 1.2e-4}, .548},
                            KnownRow{{Kind::Interior, 12}, {5.4e-2, 4.6e-3, 5.2e-4}, .581},
                            KnownRow{{Kind::Interior, 20}, {1.0e-1, 1.1e-2, 1.3e-3}, .587},
                            KnownRow{{Kind::Boundary, 2}, {1.1e-2, 3.7e-4, 1.7e-5}, .462},
                            KnownRow{{Kind::Boundary, 4}, {9.85e-2, 9.1e-3, 8.4e-4}, .5518},
                            KnownRow{{Kind::Corner, 2}, {5.3e-2, 1.7e-3, 8.1e-5}, .469},
                            KnownRow{{Kind::Dart, 6}, {3.6e-2, 4.9e-4, 6.4e-6}, .339}};

TEST(Atlas, HasTheKnownErrorsAndRates) {
    constexpr std::array levels{2, 6, 10};
    for (const KnownRow& row : kKnownRows) {
        std::array<double, 3> seen;
        tests::Observed off(to_string(row.corner) + ": |error / known - 1|", "level", 0.05);
        for (int i = 0; i < 3; ++i) {
            seen[i] = bfr_error(row.corner, levels[i]).largest[0];
            off.add(std::abs(seen[i] / row.error[i] - 1), levels[i], seen[i], row.error[i]);
        }
        off.check();
        const double rate = std::pow(seen[2] / seen[1], 1. / 4);
        tests::Observed rates(to_string(row.corner) + ": |rate / known - 1|", "level", 0.02);
        rates.add(std::abs(rate / row.rate - 1), 10, rate, row.rate);
        rates.check();
    }
}

TEST(Atlas, IsExactWhereThePatchesAre) {
    for (const CornerClass c :
         {CornerClass{}, {Kind::Interior, 6}, {Kind::Boundary, 1}, {Kind::Boundary, 3}, {Kind::Corner, 1}}) {
        tests::Observed off(to_string(c) + ": sum |w - exact w|", "level", 1e-14);
        for (const int level : {2, 6, 10}) off.add(bfr_error(c, level).largest[0], level);
        off.check();
    }
}

// The error falls as lambda^level: at level L it is that of level 1, applied to a ring that has shrunk.
TEST(Atlas, IsPredictedByLevelOne) {
    for (const KnownRow& row : kKnownRows) {
        const AtlasError one = bfr_error(row.corner, 1), six = bfr_error(row.corner, 6);
        EXPECT_LT(six.largest[0], one.largest[0]) << to_string(row.corner);
        const double growth = std::pow(six.largest[0] / one.largest[0], 1. / 5);
        EXPECT_LT(growth, 1.02 * *eigenvalue(row.corner)) << to_string(row.corner);
    }
}

TEST(Atlas, SeesTheSixDigitsOfTheBoxEndCap) {
    const auto error = atlas_error(
        {Kind::Interior, 5}, {reference::SurfaceMethod::PatchBox, 4, 4, reference::PatchSharpness::Exact},
        reference::opensubdiv_surface);
    ASSERT_TRUE(error);
    EXPECT_GT(error->unbalance[0], 1e-8);
    EXPECT_LT(error->unbalance[0], 5e-6);
    EXPECT_LT(bfr_error({Kind::Interior, 5}, 4).unbalance[0], 1e-14);
}

TEST(Atlas, DoesNotHideNotANumber) {
    const SurfaceEvaluator broken = [](const auto& mesh, const auto& options, const auto& settings,
                                       auto locations) {
        auto rows = reference::opensubdiv_surface(mesh, options, settings, locations);
        (*rows)[5]->weights[0][0] = std::nan("");
        return rows;
    };
    const auto error = atlas_error({Kind::Interior, 6}, {reference::SurfaceMethod::Bfr, 2, 2}, broken);
    ASSERT_TRUE(error);
    EXPECT_TRUE(std::isnan(error->largest[0]));
    EXPECT_FALSE(error->is_rounding());
}

TEST(LocalMesh, HasOnlyOneIrregularVertex) {
    for (const CornerClass c : atlas_classes()) {
        const auto mesh = local_mesh(c);
        ASSERT_TRUE(mesh) << to_string(c);
        const auto level = core::control_level(*mesh, core::BoundaryRule::EdgeOnly);
        for (core::Index f = 0; f < c.faces; ++f) {
            EXPECT_EQ(mesh->topology().triangles[f][0], 0) << to_string(c);
            const CornerClass seen = class_of(core::view_from(level, f, 0));
            const bool regular = seen == CornerClass{};
            EXPECT_TRUE(seen == c || regular) << to_string(c) << " is " << to_string(seen);
            for (const int i : {1, 2})
                EXPECT_EQ(class_of(core::view_from(level, f, i)), CornerClass{}) << to_string(c);
        }
    }
    EXPECT_FALSE(local_mesh({Kind::Interior, 2}));
    EXPECT_FALSE(local_mesh({Kind::SemiSharp, 0}));
}

}  // namespace
}  // namespace loopcheck::compare
