#include "core/world/canopy_light.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/elementary.h"
#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint::canopy_light_test {
namespace {

constexpr std::uint32_t test_purpose = 9997;

/// Returns crowns of a wood of 400 trees per hectare about the centre.
std::vector<Crown> wood(std::uint32_t seed, double half = 50.0) {
    Random random(seed, test_purpose);
    std::vector<Crown> out(static_cast<std::size_t>(4.0 * half * half * 0.04));
    for (Crown& crown : out) {
        crown.x = random.uniform(-half, half);
        crown.y = random.uniform(-half, half);
        crown.top = random.uniform(5.0, 32.0);
        crown.base = crown.top * random.uniform(0.3, 0.6);
        crown.radius = random.uniform(0.8, 5.0);
        crown.density = random.uniform(0.5, 1.5);
    }
    return out;
}

/// Returns the light of a place by marching along nine rays.
double marched(const std::vector<Crown>& crowns, double x, double y, double height, double leaves) {
    constexpr double step = 0.002;
    double light = 0.0;
    for (int k = 0; k < 9; ++k) {
        const double up = k == 0 ? 1.0 : std::sin(radians(55.0));
        const double across = k == 0 ? 0.0 : std::cos(radians(55.0));
        const double azimuth = radians(45.0 * (k - 1));
        double path = 0.0;
        for (const Crown& crown : crowns) {
            if (std::hypot(crown.x - x, crown.y - y) > shade_reach) continue;
            int inside = 0;
            for (double t = 0.5 * step; t < 45.0; t += step) {
                const double east = x + t * across * std::sin(azimuth) - crown.x;
                const double north = y + t * across * std::cos(azimuth) - crown.y;
                const double rise = height + t * up - 0.5 * (crown.base + crown.top);
                const double half = 0.5 * (crown.top - crown.base);
                if ((east * east + north * north) / (crown.radius * crown.radius) +
                        rise * rise / (half * half) <
                    1.0)
                    ++inside;
            }
            path += crown.density * inside * step;
        }
        light += std::exp(-0.25 * leaves * path) / 9.0;
    }
    return light;
}

TEST(CanopyLight, IsThatOfTheSkyWithoutCrowns) {
    EXPECT_EQ(CanopyLight({}).at(0, 0, 0, 1), 1.0);
    const std::vector<Crown> far{{30.0, 0.0, 3.0, 20.0, 4.0, 1.0}};
    EXPECT_EQ(CanopyLight(far).at(0, 0, 0, 1), 1.0);
    EXPECT_EQ(CanopyLight(far).at(1e6, -1e6, 0, 1), 1.0);
    const std::vector<Crown> flat{{0.0, 0.0, 3.0, 3.0, 4.0, 1.0}, {0.0, 0.0, 1.0, 2.0, 0.0, 1.0}};
    EXPECT_EQ(CanopyLight(flat).at(0, 0, 0, 1), 1.0);
}

TEST(CanopyLight, BelowOneCrownFollowsItsChord) {
    // A sphere of radius 3 with its middle 6 m above the place: rays at 55 degrees pass it by 6 cos 55 = 3.44 m.
    const std::vector<Crown> sphere{{2.0, 1.0, 3.0, 9.0, 3.0, 1.0}};
    const CanopyLight canopy(sphere);
    EXPECT_NEAR(canopy.at(2.0, 1.0, 0.0, 1.0), (8.0 + std::exp(-0.25 * 6.0)) / 9.0, 1e-12);
    EXPECT_NEAR(canopy.at(2.0, 1.0, 0.0, 0.5), (8.0 + std::exp(-0.125 * 6.0)) / 9.0, 1e-12);
    // In its middle, all rays have 3 m of it before them; above it none has any.
    EXPECT_NEAR(canopy.at(2.0, 1.0, 6.0, 1.0), std::exp(-0.25 * 3.0), 1e-12);
    EXPECT_EQ(canopy.at(2.0, 1.0, 9.5, 1.0), 1.0);
    // From a place where the middle is at 55 degrees in the west, one ray goes through it.
    const double distance = 6.0 / std::tan(radians(55.0));
    EXPECT_NEAR(canopy.at(2.0 + distance, 1.0, 0.0, 1.0), (8.0 + std::exp(-0.25 * 6.0)) / 9.0,
                0.03);
}

TEST(CanopyLight, AgreesWithMarchingAlongRays) {
    const std::vector<Crown> crowns = wood(5, 22.0);
    const CanopyLight canopy(crowns);
    Random random(6, test_purpose);
    for (int i = 0; i < 5; ++i) {
        const double x = random.uniform(-15, 15), y = random.uniform(-15, 15);
        const double height = random.uniform(0, 12);
        EXPECT_NEAR(canopy.at(x, y, height, 0.8), marched(crowns, x, y, height, 0.8), 2e-3);
    }
}

TEST(CanopyLight, OfAPlaceDoesNotDependOnCrownsBeyondItsReach) {
    const std::vector<Crown> all = wood(7);
    const CanopyLight canopy(all);
    Random random(8, test_purpose);
    for (int i = 0; i < 100; ++i) {
        const double x = random.uniform(-30, 30), y = random.uniform(-30, 30);
        std::vector<Crown> near;
        for (const Crown& crown : all) {
            const double east = crown.x - x, north = crown.y - y;
            if (east * east + north * north <= shade_reach * shade_reach) near.push_back(crown);
        }
        ASSERT_EQ(canopy.at(x, y, 1.0, 1.0), CanopyLight(near).at(x, y, 1.0, 1.0));
    }
}

TEST(CanopyLight, MovesWithItsCrowns) {
    std::vector<Crown> moved = wood(9);
    const CanopyLight before(moved);
    // By whole numbers of halves of a metre, so that differences have the same bits but for a few.
    for (Crown& crown : moved) {
        crown.x += 131.5;
        crown.y -= 77.0;
        crown.base += 12.0;
        crown.top += 12.0;
    }
    const CanopyLight after(moved);
    for (double x = -20.0; x < 20.0; x += 3.25)
        ASSERT_NEAR(before.at(x, 2.0, 0.5, 1.0), after.at(x + 131.5, -75.0, 12.5, 1.0), 1e-9);
}

TEST(CanopyLight, IsLessBelowMoreLeavesAndMoreCrowns) {
    const std::vector<Crown> crowns = wood(11);
    std::vector<Crown> more = crowns;
    const std::vector<Crown> others = wood(12);
    more.insert(more.end(), others.begin(), others.end());
    const CanopyLight canopy(crowns), denser(more);
    rc::check([&] {
        const double x = *rc::gen::inRange(-300, 300) / 10.0;
        const double y = *rc::gen::inRange(-300, 300) / 10.0;
        const double leaves = *rc::gen::inRange(0, 100) / 100.0;
        const double light = canopy.at(x, y, 0.0, leaves);
        RC_ASSERT(light > 0.0 && light <= 1.0);
        RC_ASSERT(canopy.at(x, y, 0.0, leaves + 0.01) <= light);
        RC_ASSERT(denser.at(x, y, 0.0, leaves) <= light);
        RC_ASSERT(canopy.at(x, y, 0.0, 0.0) == 1.0);
    });
}

TEST(CanopyLight, OfAClosedWoodIsAFewPercent) {
    const CanopyLight canopy(wood(13));
    double sum = 0.0;
    for (int i = 0; i < 400; ++i) sum += canopy.at(i % 20 - 10.0, i / 20 - 10.0, 0.0, 1.0);
    EXPECT_GT(sum / 400, 0.02);
    EXPECT_LT(sum / 400, 0.35);
}

TEST(CanopyLight, OfALatticeHasTheBitsOfItsPlaces) {
    const std::vector<Crown> crowns = wood(17);
    const CanopyLight canopy(crowns);
    Random random(18, test_purpose);
    for (const double slope : {0.0, 0.4}) {
        const PlaceLattice places{-61.5, -20.25, 0.75, 90, 50};
        std::vector<double> heights;
        heights.reserve(4500);
        for (int row = 0; row < places.rows; ++row)
            for (int column = 0; column < places.columns; ++column)
                heights.push_back(slope * column * places.step + random.uniform());
        const std::vector<double> light = canopy_light_on(places, heights, crowns, 0.9);
        for (int row = 0; row < places.rows; ++row)
            for (int column = 0; column < places.columns; ++column) {
                const auto i = static_cast<std::size_t>(row * places.columns + column);
                ASSERT_EQ(light[i], canopy.at(places.west + column * places.step,
                                              places.south + row * places.step, heights[i], 0.9));
            }
    }
    EXPECT_TRUE(canopy_light_on({}, {}, crowns, 1.0).empty());
    EXPECT_THROW(static_cast<void>(canopy_light_on({0, 0, 1, 2, 2}, {}, crowns, 1.0)),
                 InvalidInput);
}

}  // namespace
}  // namespace sporeprint::canopy_light_test
