#include "core/scene/surface_water.h"

#include <gtest/gtest.h>

#include "core/world/weather.h"

namespace sporeprint::surface_water_test {
namespace {

SurfaceWater water(const ClimateParams& climate = {}) {
    return {weather_of(climate, 3, 4), weather_of(climate, 3, 5)};
}

TEST(SurfaceWater, IsThatOfTheSoilOfWorldsWhereAsMuchRainArrives) {
    const WeatherYear year = weather_of({}, 3, 5);
    const SurfaceWater surface = water();
    // Worlds give the soil 0.8 of the rain. The supplies are not those that are computed, hence the tolerance.
    double off = 0.0;
    for (std::size_t day = 0; day < year.size(); ++day)
        off += surface.on({0.8, 1.0}, day) - year[day].soil_water;
    EXPECT_NEAR(off / days_of_year, 0.0, 3.0);
}

TEST(SurfaceWater, GrowsWithTheRainAndShrinksWithWhatDriesIt) {
    const SurfaceWater surface = water();
    for (const std::size_t day : {20U, 150U, 200U, 280U}) {
        double before = -1.0;
        for (const double rain : {0.0, 0.1, 0.4, 1.0, 2.0, 4.0, 9.0}) {
            const double now = surface.on({rain, 0.6}, day);
            EXPECT_GE(now, before - 1e-6);
            EXPECT_LE(now, most_soil_water);
            before = now;
        }
        EXPECT_GE(surface.on({0.7, 0.1}, day), surface.on({0.7, 0.9}, day));
    }
    EXPECT_LT(surface.on({0.0, 1.0}, 300), 1.0) << "where no rain falls it dries";
    EXPECT_GT(surface.mean({1.0, 0.3}, 243, 303), surface.mean({0.2, 0.9}, 243, 303));
}

TEST(SurfaceWater, HasTheMeanOfItsDays) {
    const SurfaceWater surface = water();
    double sum = 0.0;
    for (std::size_t day = 100; day <= 120; ++day) sum += surface.on({0.9, 0.5}, day);
    EXPECT_NEAR(surface.mean({0.9, 0.5}, 100, 120), sum / 21.0, 1e-3);
}

}  // namespace
}  // namespace sporeprint::surface_water_test
