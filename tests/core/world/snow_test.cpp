#include "core/world/snow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/world/weather.h"

namespace sporeprint::world_snow_test {
namespace {

ClimateParams climate_of(double temperature) {
    ClimateParams climate;
    climate.temperature = temperature;
    return climate;
}

TEST(Snow, LiesInColdWintersAndNeverInWarmOnes) {
    double cold = 0.0, warm = 0.0;
    for (int year = 0; year < 12; ++year)
        for (const int day : {10, 30, 50, 350}) {
            cold += snow_on(climate_of(2.0), 7, year, day);
            warm += snow_on(climate_of(24.0), 7, year, day);
        }
    EXPECT_GT(cold, 100.0);
    EXPECT_EQ(warm, 0.0);
    for (int year = 0; year < 12; ++year) EXPECT_EQ(snow_on(climate_of(8.0), 7, year, 200), 0.0);
}

TEST(Snow, LiesInJulyInTheSouth) {
    ClimateParams climate = climate_of(2.0);
    climate.latitude_deg = -climate.latitude_deg;
    double july = 0.0, january = 0.0;
    for (int year = 0; year < 12; ++year) {
        july += snow_on(climate, 7, year, 200);
        january += snow_on(climate, 7, year, 20);
    }
    EXPECT_GT(july, 50.0);
    EXPECT_LT(january, 0.2 * july);
}

TEST(Snow, GrowsByTheRainOfADayAtMostAndGoesOnOverNewYear) {
    const ClimateParams climate = climate_of(1.0);
    for (int year = 1; year < 5; ++year) {
        const WeatherYear weather = weather_of(climate, 3, year);
        double before = snow_on(climate, 3, year - 1, days_of_year);
        for (int day = 1; day <= 60; ++day) {
            const double now = snow_on(climate, 3, year, day);
            EXPECT_LE(now, before + weather[static_cast<std::size_t>(day - 1)].rain + 1e-9);
            before = now;
        }
    }
}

TEST(Snow, CoversMoreTheMoreOfItThereIs) {
    EXPECT_EQ(snow_cover(0.0), 0.0);
    EXPECT_EQ(snow_cover(50.0), 1.0);
    for (double water = 0.0; water < 8.0; water += 0.5)
        EXPECT_LE(snow_cover(water), snow_cover(water + 0.5));
}

RawImages brown_floor(int side) {
    RawImages images{side, {}, {}};
    for (Bytes& image : images.rgb)
        image.assign(3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 60);
    return images;
}

TEST(Snow, WhitensTheFloorAsFarAsItCoversIt) {
    const WorldBox box{0.0, 0.0, 4.0, 4.0};
    const auto white_share = [&](double cover) {
        RawImages images = brown_floor(64);
        add_snow(images, box, cover, 5, {});
        const auto white = std::ranges::count_if(images.rgb[0], [](int v) { return v > 150; });
        return static_cast<double>(white) / static_cast<double>(images.rgb[0].size());
    };
    EXPECT_EQ(white_share(0.0), 0.0);
    EXPECT_GT(white_share(0.5), 0.1);
    EXPECT_LT(white_share(0.5), 0.9);
    EXPECT_GT(white_share(1.0), 0.98);
    RawImages bare = brown_floor(64);
    add_snow(bare, box, 0.0, 5, {});
    EXPECT_EQ(bare.rgb, brown_floor(64).rgb);
}

TEST(Snow, IsNotThereAtTheFeetOfTrees) {
    const TreeFoot foot{2.0, 2.0, 0.4};
    RawImages images = brown_floor(65);
    add_snow(images, {0.0, 0.0, 4.0, 4.0}, 1.0, 5, {&foot, 1});
    const auto at = [&](std::size_t column) { return images.rgb[0][3 * (32 * 65 + column)]; };
    EXPECT_EQ(at(32), 60) << "in the trunk";
    EXPECT_EQ(at(33), 60) << "0.06 m from its middle";
    EXPECT_GT(at(0), 150);
    EXPECT_GT(at(64), 150);
}

TEST(Snow, IsTheSameInNeighbouringImages) {
    // The last column of the western one is the first column of the other.
    const TreeFoot foot{1.9, 1.0, 0.5};
    RawImages west = brown_floor(33), east = brown_floor(33);
    add_snow(west, {0.0, 0.0, 2.0, 2.0}, 0.5, 5, {&foot, 1});
    add_snow(east, {2.0, 0.0, 4.0, 2.0}, 0.5, 5, {&foot, 1});
    for (std::size_t row = 0; row < 33; ++row)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_EQ(west.rgb[0][3 * (33 * row + 32) + c], east.rgb[0][3 * 33 * row + c]);
}

}  // namespace
}  // namespace sporeprint::world_snow_test
