#include "core/plant/needle_shoot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sporeprint::plant_needle_shoot_test {
namespace {

const ShootPainter::Colours green{{{0.02, 0.06, 0.02}, {0.05, 0.09, 0.05}},
                                  {{0.05, 0.10, 0.03}, {0.06, 0.11, 0.05}},
                                  {0.10, 0.06, 0.03}};

/// What the picture of a shoot or a spray shows on the whole.
struct Seen {
    double drawn = 0.0;               ///< share of the places
    double white = 0.0;               ///< share of the places whose upper face is snow
    double of_middle = 0.0;           ///< the same of those near the twig
    double upper = 0.0, lower = 0.0;  ///< means of what is drawn, green
};

Seen seen(const ShootPainter& painter, bool of_spray) {
    Seen out;
    double middle = 0.0;
    constexpr int steps = 120;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double along = (i + 0.5) / steps, across = 2.0 * (k + 0.5) / steps - 1.0;
            const PanelPoint point =
                of_spray ? painter.spray_at(along, across) : painter.shoot_at(along, across);
            const bool is_middle = std::abs(across) < 0.2;
            middle += is_middle ? 1.0 : 0.0;
            if (!point.is_drawn) continue;
            out.drawn += 1.0;
            out.upper += point.upper.g;
            out.lower += point.lower.g;
            if (point.upper.b > 0.3) {
                out.white += 1.0;
                out.of_middle += is_middle ? 1.0 : 0.0;
            }
        }
    out.upper /= out.drawn;
    out.lower /= out.drawn;
    out.drawn /= steps * steps;
    out.white /= steps * steps;
    out.of_middle /= middle;
    return out;
}

TEST(NeedleShoot, SnowCoversUpperFacesTheMoreTheMoreThereIs) {
    for (const bool of_spray : {false, true})
        for (const std::uint32_t seed : {1U, 2U, 3U}) {
            const Seen bare = seen(ShootPainter(green, 0.0, seed), of_spray);
            EXPECT_EQ(bare.white, 0.0);
            Seen before = bare;
            for (const double snow : {0.25, 0.5, 0.75, 1.0}) {
                const Seen now = seen(ShootPainter(green, snow, seed), of_spray);
                EXPECT_GT(now.white, before.white + 0.005) << snow << ' ' << seed;
                EXPECT_GE(now.drawn, before.drawn) << snow << ' ' << seed;
                EXPECT_GT(now.upper, before.upper) << snow << ' ' << seed;
                before = now;
            }
            EXPECT_GT(before.white, 0.4 * before.drawn) << seed;
            // From below a snowy shoot is as dark as any.
            EXPECT_NEAR(before.lower, bare.lower, 0.5 * bare.lower) << seed;
        }
}

TEST(NeedleShoot, SnowLiesNearTheTwigFirst) {
    for (const double snow : {0.25, 0.5}) {
        const Seen now = seen(ShootPainter(green, snow, 1), false);
        EXPECT_GT(now.of_middle, 1.3 * now.white) << snow;
    }
}

TEST(NeedleShoot, TinySnowChangesNothing) {
    const ShootPainter bare(green, 0.0, 1), nearly(green, 1e-6, 1);
    for (int i = 0; i < 60; ++i)
        for (int k = 0; k < 60; ++k) {
            const double along = (i + 0.5) / 60.0, across = (k - 29.5) / 30.0;
            const PanelPoint a = bare.spray_at(along, across), b = nearly.spray_at(along, across);
            EXPECT_EQ(a.is_drawn, b.is_drawn);
            EXPECT_EQ(a.upper, b.upper);
        }
}

TEST(NeedleShoot, NothingIsDrawnBesideIt) {
    for (const double snow : {0.0, 1.0}) {
        const ShootPainter painter(green, snow, 1);
        for (const double across : {-1.01, 1.01})
            for (double along = -0.1; along < 1.1; along += 0.01) {
                EXPECT_FALSE(painter.shoot_at(along, across).is_drawn) << along;
                EXPECT_FALSE(painter.spray_at(along, across * 1.3).is_drawn) << along;
            }
        for (double across = -1.0; across < 1.0; across += 0.05)
            for (const double along : {-0.05, 1.05}) {
                EXPECT_FALSE(painter.shoot_at(along, across).is_drawn) << across;
                EXPECT_FALSE(painter.spray_at(along, across).is_drawn) << across;
            }
    }
}

TEST(NeedleShoot, SeedsMakeOtherLumps) {
    const ShootPainter one(green, 0.4, 1), other(green, 0.4, 2);
    int differ = 0;
    for (int i = 0; i < 60; ++i) {
        const double along = (i + 0.5) / 60.0;
        differ += one.shoot_at(along, 0.1).upper != other.shoot_at(along, 0.1).upper ? 1 : 0;
    }
    EXPECT_GT(differ, 30);
}

}  // namespace
}  // namespace sporeprint::plant_needle_shoot_test
