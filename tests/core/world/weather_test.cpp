#include "core/world/weather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::weather_test {
namespace {

constexpr ClimateParams beech{
    .latitude_deg = 51, .temperature = 8.5, .swing = 9, .rain = 850, .rain_days = 0.44};

/// Returns all days of all years of some worlds.
std::vector<WeatherDay> days_of(const ClimateParams& climate, std::uint32_t seeds, int years) {
    std::vector<WeatherDay> days;
    days.reserve(static_cast<std::size_t>(seeds) * static_cast<std::size_t>(years * days_of_year));
    for (std::uint32_t seed = 0; seed < seeds; ++seed)
        for (int year = 0; year < years; ++year) {
            const WeatherYear weather = weather_of(climate, seed, year);
            days.insert(days.end(), weather.begin(), weather.end());
        }
    return days;
}

double mean_of(const std::vector<WeatherDay>& days, double WeatherDay::*member) {
    return std::accumulate(days.begin(), days.end(), 0.0,
                           [&](double sum, const WeatherDay& day) { return sum + day.*member; }) /
           static_cast<double>(days.size());
}

TEST(Weather, HasTheRainAndTheWarmthOfItsClimate) {
    const std::vector<WeatherDay> days = days_of(beech, 4, 100);
    EXPECT_NEAR(mean_of(days, &WeatherDay::rain) * days_of_year / beech.rain, 1.0, 0.02);
    EXPECT_NEAR(mean_of(days, &WeatherDay::temperature), beech.temperature, 0.05);
    const auto is_wet = [](const WeatherDay& day) { return day.rain > 0.0; };
    const auto wet = static_cast<double>(std::ranges::count_if(days, is_wet));
    EXPECT_NEAR(wet / static_cast<double>(days.size()), beech.rain_days, 0.005);
}

TEST(Weather, RainsOnMoreThanOneDayInARow) {
    const std::vector<WeatherDay> days = days_of(beech, 4, 100);
    double after_wet = 0, wet_after_wet = 0, after_dry = 0, wet_after_dry = 0;
    for (std::size_t i = 1; i < days.size(); ++i) {
        const double wet = days[i].rain > 0.0 ? 1.0 : 0.0;
        (days[i - 1].rain > 0.0 ? after_wet : after_dry) += 1.0;
        (days[i - 1].rain > 0.0 ? wet_after_wet : wet_after_dry) += wet;
    }
    // A chain of this share and persistence: share + persistence (1 - share), share (1 - persistence).
    EXPECT_NEAR(wet_after_wet / after_wet, 0.44 + 0.3 * 0.56, 0.01);
    EXPECT_NEAR(wet_after_dry / after_dry, 0.44 * 0.7, 0.01);
}

TEST(Weather, IsWarmestInJulyInTheNorthAndInJanuaryInTheSouth) {
    const auto mean_of_days = [](const ClimateParams& climate, int first, int last) {
        double sum = 0.0;
        for (int year = 0; year < 60; ++year) {
            const WeatherYear weather = weather_of(climate, 3, year);
            for (int day = first; day <= last; ++day)
                sum += weather[static_cast<std::size_t>(day - 1)].temperature;
        }
        return sum / (60.0 * (last - first + 1));
    };
    ClimateParams south = beech;
    south.latitude_deg = -beech.latitude_deg;
    // The mean of a month about the peak of a cosine is 1.1 % below the peak.
    EXPECT_NEAR(mean_of_days(beech, 182, 212), beech.temperature + beech.swing, 0.5);
    EXPECT_NEAR(mean_of_days(beech, 1, 31), beech.temperature - beech.swing, 0.6);
    EXPECT_NEAR(mean_of_days(south, 1, 31), beech.temperature + beech.swing, 0.6);
}

TEST(Weather, DeviatesByThreeDegreesFromTheCosineAndFollowsTheDayBefore) {
    ClimateParams even = beech;
    even.swing = 0.0;
    const std::vector<WeatherDay> days = days_of(even, 2, 100);
    double square = 0.0, product = 0.0;
    for (std::size_t i = 1; i < days.size(); ++i) {
        const double today = days[i].temperature - even.temperature,
                     yesterday = days[i - 1].temperature - even.temperature;
        square += today * today;
        product += today * yesterday;
    }
    EXPECT_NEAR(std::sqrt(square / static_cast<double>(days.size())), 3.0, 0.05);
    EXPECT_NEAR(product / square, 0.7, 0.01);
}

TEST(Weather, WithoutRainTheSoilDriesAndWithMuchItIsFull) {
    ClimateParams desert = beech, swamp = beech;
    desert.rain = 0.0;
    swamp.rain = 3000.0;
    swamp.rain_days = 0.8;
    const WeatherYear dry = weather_of(desert, 1, 5), wet = weather_of(swamp, 1, 5);
    for (std::size_t i = 1; i < dry.size(); ++i) {
        EXPECT_EQ(dry[i].rain, 0.0);
        EXPECT_LE(dry[i].soil_water, dry[i - 1].soil_water);
        EXPECT_GT(dry[i].soil_water, 0.0);
    }
    EXPECT_LT(dry.back().soil_water, 2.0);
    const auto is_full = [](const WeatherDay& day) {
        return day.soil_water > 0.7 * most_soil_water;
    };
    EXPECT_GT(std::ranges::count_if(wet, is_full), 330);
}

TEST(Weather, BalancesTheWaterOfTheSoil) {
    const WeatherYear year = weather_of(beech, 9, 17);
    for (std::size_t i = 1; i < year.size(); ++i) {
        const WeatherDay &day = year[i], &before = year[i - 1];
        EXPECT_GE(day.soil_water, 0.0);
        EXPECT_LE(day.soil_water, most_soil_water);
        const double lost = day.evaporation * std::min(1.0, before.soil_water / 60.0);
        EXPECT_DOUBLE_EQ(day.soil_water,
                         std::min(most_soil_water, before.soil_water + 0.8 * day.rain - lost));
    }
}

TEST(Weather, GoesOnFromOneYearToTheNext) {
    for (const double rain : {300.0, 850.0, 2000.0}) {
        ClimateParams climate = beech;
        climate.rain = rain;
        for (int year = 0; year < 40; ++year) {
            const WeatherDay last = weather_of(climate, 5, year).back(),
                             first = weather_of(climate, 5, year + 1).front();
            // One day of sun and rain lies between them.
            const double filled = std::min(most_soil_water, last.soil_water + 0.8 * first.rain);
            EXPECT_NEAR(first.soil_water, filled, 1.0) << rain << " mm, year " << year;
        }
    }
}

TEST(Weather, IsAFunctionOfSeedAndYear) {
    const auto rain_of = [](std::uint32_t seed, int year) {
        std::vector<double> rain;
        for (const WeatherDay& day : weather_of(beech, seed, year)) rain.push_back(day.rain);
        return rain;
    };
    EXPECT_EQ(rain_of(7, 80), rain_of(7, 80));
    EXPECT_NE(rain_of(7, 80), rain_of(8, 80));
    EXPECT_NE(rain_of(7, 80), rain_of(7, 81));
}

TEST(Weather, TheSameDaysAreWetWhenTheYearIsWarmer) {
    ClimateParams warm = beech;
    warm.temperature += 4.0;
    const WeatherYear a = weather_of(beech, 2, 30), b = weather_of(warm, 2, 30);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].rain, b[i].rain);
        EXPECT_NEAR(b[i].temperature - a[i].temperature, 4.0, 1e-12);
        EXPECT_GE(b[i].evaporation, a[i].evaporation);
    }
}

TEST(Weather, KnowsTheYearsOfAWorld) {
    EXPECT_NO_THROW((void)weather_of(beech, 1, 0));
    EXPECT_NO_THROW((void)weather_of(beech, 1, last_year));
    EXPECT_THROW((void)weather_of(beech, 1, -1), InvalidInput);
    EXPECT_THROW((void)weather_of(beech, 1, last_year + 1), InvalidInput);
}

TEST(SunAboveAir, HasTheValueOfThePublishedExample) {
    // FAO Irrigation and Drainage Paper 56, example 8: 20 degrees south, 3rd of September.
    EXPECT_NEAR(sun_above_air(radians(-20.0), 246), 32.2, 0.1);
}

TEST(SunAboveAir, IsThatOfALevelSurfaceAtTheEquinox) {
    // The sun goes half a circle, so its mean height is that of noon over pi.
    for (const double latitude : {0.0, 30.0, -30.0, 60.0, -60.0})
        EXPECT_NEAR(sun_above_air(radians(latitude), 81),
                    24.0 * 60.0 * 0.0820 * cosine(radians(latitude)) / pi, 0.45)
            << latitude;
}

TEST(SunAboveAir, IsMoreInTheSouthWhereSummerIsNearTheSun) {
    for (const double latitude : {10.0, 40.0, 66.0}) {
        double north = 0.0, south = 0.0, highest = 0.0, highest_south = 0.0;
        for (int day = 1; day <= days_of_year; ++day) {
            const double energy = sun_above_air(radians(latitude), day),
                         energy_south = sun_above_air(radians(-latitude), day);
            EXPECT_GT(energy, 0.0) << latitude << " degrees, day " << day;
            north += energy;
            south += energy_south;
            highest = std::max(highest, energy);
            highest_south = std::max(highest_south, energy_south);
        }
        EXPECT_GT(south, north);
        EXPECT_NEAR(south / north, 1.0, 0.05) << latitude;
        // Squares of the distances at the solstices differ by 6.6 %; near the equator no day is its longest.
        if (latitude > 30.0) {
            EXPECT_NEAR(highest_south / highest, 1.066, 0.01) << latitude;
        }
    }
}

}  // namespace
}  // namespace sporeprint::weather_test
