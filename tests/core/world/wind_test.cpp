#include "core/world/wind.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::wind_test {
namespace {

ClimateParams climate_of(double from_deg, double focus, double speed = 3.0) {
    ClimateParams climate;
    climate.wind_from_deg = from_deg;
    climate.wind_focus = focus;
    climate.wind_speed = speed;
    return climate;
}

/// Returns heights given as a function of x and y, metres.
std::vector<std::int32_t> heights_from(const Grid& grid, auto height) {
    std::vector<std::int32_t> out;
    out.reserve(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            out.push_back(quantised_height(height(grid.place(column), grid.place(row))));
    return out;
}

const Grid grid = world_grid(1024);

/// A round hill in the middle, 60 m high.
const WindRelief& hill() {
    static const WindRelief made =
        wind_relief(grid, heights_from(grid, [](double x, double y) {
                        return 60.0 * exponential(-(x * x + y * y) / (2.0 * 100.0 * 100.0));
                    }));
    return made;
}

TEST(WindRose, SharesAddUpToOneAndFavourTheMainDirection) {
    rc::check([] {
        const double from = *rc::gen::inRange(0, 361), focus = *rc::gen::inRange(0, 51) / 10.0;
        const WindRose rose = wind_rose(climate_of(from, focus));
        double sum = 0.0;
        for (const WindSector& sector : rose) {
            sum += sector.share;
            RC_ASSERT(sector.share >= 0.0);
            RC_ASSERT(std::abs(sector.east * sector.east + sector.north * sector.north - 1.0) <
                      1e-12);
        }
        RC_ASSERT(std::abs(sum - 1.0) < 1e-12);
        const auto main = static_cast<std::size_t>(from / 45.0 + 0.5) % wind_sectors;
        for (std::size_t k = 0; k < wind_sectors; ++k)
            RC_ASSERT(rose[k].share <= rose[main].share + 1e-12);
    });
}

TEST(WindRose, WithoutFocusBlowsFromEverywhereAlike) {
    for (const WindSector& sector : wind_rose(climate_of(250, 0.0)))
        EXPECT_NEAR(sector.share, 0.125, 1e-12);
}

TEST(WindRose, TurnsWithItsMainDirection) {
    const WindRose west = wind_rose(climate_of(270, 1.2)), south = wind_rose(climate_of(180, 1.2));
    for (std::size_t k = 0; k < wind_sectors; ++k)
        EXPECT_NEAR(west[(k + 2) % wind_sectors].share, south[k].share, 1e-12);
}

TEST(WindRose, OfTheGreatestFocusHasNineTenthsWithin45Degrees) {
    // The sector of the main direction is 22.5 degrees to either side, so half of its neighbours is beyond 45.
    const WindRose rose = wind_rose(climate_of(90, 5.0));
    EXPECT_GT(rose[2].share + rose[1].share + rose[3].share, 0.9);
    EXPECT_LT(rose[2].share, 0.9);
}

TEST(WindRose, MovesAirAwayFromWhereItComes) {
    const WindRose rose = wind_rose(climate_of(270, 2.0));
    EXPECT_NEAR(rose[6].east, 1.0, 1e-12);
    EXPECT_NEAR(rose[6].north, 0.0, 1e-12);
    EXPECT_NEAR(rose[0].north, -1.0, 1e-12);
}

TEST(WindRelief, OfLevelGroundChangesNothing) {
    const WindRelief level =
        wind_relief(grid, heights_from(grid, [](double, double) { return 7.0; }));
    for (const WindSector& sector : wind_rose(climate_of(250, 1.2))) {
        const LocalWind wind = wind_at(level, 12.3, -200.0, sector);
        EXPECT_EQ(wind.factor, 1.0);
        EXPECT_EQ(wind.east, sector.east);
        EXPECT_EQ(wind.north, sector.north);
    }
}

TEST(WindRelief, IsGentleWhereTheGroundIs) {
    const WindRelief gentle =
        wind_relief(grid, heights_from(grid, [](double x, double) { return 0.015 * x; }));
    const WindSector to_east{1.0, 3.0, 1.0, 0.0};
    // A tenth of the slope that would be scaled to 0.5, times its weight.
    EXPECT_NEAR(wind_at(gentle, 0, 0, to_east).factor, 1.0 + 0.5 * 0.05, 0.003);
}

TEST(WindRelief, IsFastOnTheTopAndOnTheWindwardSideAndSlowInTheLee) {
    const WindSector to_east{1.0, 3.0, 1.0, 0.0};
    const double top = wind_at(hill(), 0, 0, to_east).factor;
    const double windward = wind_at(hill(), -100, 0, to_east).factor;
    const double lee = wind_at(hill(), 100, 0, to_east).factor;
    EXPECT_NEAR(top, 1.25, 0.02);
    EXPECT_GT(windward, 1.15);
    EXPECT_LT(lee, 0.85);
    EXPECT_NEAR(wind_at(hill(), 0, 600, to_east).factor, 1.0, 0.01);
}

TEST(WindRelief, TurnsTheWindRoundAHill) {
    const WindSector to_east{1.0, 3.0, 1.0, 0.0};
    // South-west of the top the slope rises to the north-east; its contour leads to the south-east.
    const LocalWind south_west = wind_at(hill(), -70, -70, to_east);
    const LocalWind north_west = wind_at(hill(), -70, 70, to_east);
    EXPECT_LT(south_west.north, -0.1);
    EXPECT_NEAR(north_west.north, -south_west.north, 1e-9);
    EXPECT_NEAR(wind_at(hill(), 70, -70, to_east).north, 0.0, 1e-12);
    EXPECT_NEAR(wind_at(hill(), -100, 0, to_east).north, 0.0, 0.01);
    EXPECT_NEAR(south_west.east * south_west.east + south_west.north * south_west.north, 1.0,
                1e-12);
}

TEST(WindRelief, StaysWithinHalfAndThreeHalves) {
    rc::check([] {
        const double x = *rc::gen::inRange(-900, 900), y = *rc::gen::inRange(-900, 900);
        for (const WindSector& sector : wind_rose(climate_of(10, 1.0))) {
            const double factor = wind_at(hill(), x, y, sector).factor;
            RC_ASSERT(factor >= 0.5 && factor <= 1.5);
        }
    });
}

TEST(WindRelief, RefusesGridsWithoutAMiddleNode) {
    const std::vector<std::int32_t> heights(36);
    EXPECT_THROW(static_cast<void>(wind_relief({6, 1.0, 0.0}, heights)), InvalidInput);
    EXPECT_THROW(static_cast<void>(wind_relief({5, 1.0, 0.0}, heights)), InvalidInput);
}

TEST(WindNearGround, AgreesWithTheNumbersOfTheReference) {
    // mycology.md 2.5: a wood of 20 m, 3 m/s above it; a meadow of 30 cm would have a roughness of 3 cm.
    EXPECT_NEAR(wind_below_crowns(3.0, 0.10, 20.0), 0.15, 0.01);
    EXPECT_NEAR(wind_below_crowns(3.0, 0.02, 20.0), 0.08, 0.01);
    const double above = wind_above_grass(3.0, 2.0, 0.3);
    EXPECT_NEAR(above, 3.0 * std::log((2.0 - 0.195) / 0.03) / std::log((10.3 - 0.195) / 0.03),
                1e-12);
}

TEST(WindNearGround, RisesWithHeightWithoutJumps) {
    for (const WindCover& cover : {WindCover{0.15, 0.0, 0.0}, WindCover{0.15, 1.0, 25.0},
                                   WindCover{0.4, 0.6, 12.0}, WindCover{0.02, 0.3, 4.0}}) {
        double before = wind_near_ground(4.0, 0.0, cover);
        EXPECT_GE(before, 0.0);
        for (double height = 0.002; height < 3.0; height += 0.002) {
            const double here = wind_near_ground(4.0, height, cover);
            EXPECT_GE(here, before - 1e-12);
            EXPECT_LT(here - before, 0.25) << height;
            before = here;
        }
    }
}

TEST(WindNearGround, IsProportionalToTheWindAndSlowerBelowCrowns) {
    const WindCover open{0.15, 0.0, 20.0}, half{0.15, 0.5, 20.0}, closed{0.15, 1.0, 20.0};
    for (const double height : {0.25, 0.5, 1.5}) {
        EXPECT_GT(wind_near_ground(3.0, height, open), wind_near_ground(3.0, height, half));
        EXPECT_GT(wind_near_ground(3.0, height, half), wind_near_ground(3.0, height, closed));
        EXPECT_NEAR(wind_near_ground(6.0, height, half), 2.0 * wind_near_ground(3.0, height, half),
                    1e-12);
    }
    EXPECT_EQ(wind_near_ground(0.0, 0.5, half), 0.0);
}

}  // namespace
}  // namespace sporeprint::wind_test
