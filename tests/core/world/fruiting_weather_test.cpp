#include "core/world/fruiting_weather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/support/forest.h"
#include "tests/support/fungi.h"

namespace sporeprint::fruiting_weather_test {
namespace {

using namespace fungi;

TEST(Conditions, OpenInTheMonthsAndTenDaysBeforeAndAfter) {
    std::vector<FungusSpecies> species{boletus(), boletus("b")};
    species[0].months = 0b000011000000;  // July, August
    species[1].months = 0b100000000001;  // December, January
    const SeasonConditions conditions = conditions_in(species, beech, 1, 50);
    const auto month = [&](std::size_t which, int day) {
        return conditions.species[which][static_cast<std::size_t>(day - 1)].month;
    };
    EXPECT_EQ(month(0, 182), 1.0);
    EXPECT_EQ(month(0, 243), 1.0);
    EXPECT_DOUBLE_EQ(month(0, 181), 0.9);
    EXPECT_DOUBLE_EQ(month(0, 248), 0.5);
    EXPECT_EQ(month(0, 172), 0.0);
    EXPECT_EQ(month(0, 253), 0.0);
    EXPECT_EQ(month(1, 1), 1.0);
    EXPECT_EQ(month(1, 365), 1.0);
    EXPECT_DOUBLE_EQ(month(1, 36), 0.5);
}

/// Returns weather that is the same on all days.
WeatherYear even_weather(double temperature, double rain) {
    WeatherYear year;
    year.fill({.rain = rain, .temperature = temperature, .evaporation = 1.0, .soil_water = 80.0});
    return year;
}

TEST(Conditions, AreThoseOfEvenWeather) {
    const std::vector<FungusSpecies> species{boletus()};
    const auto at = [&](double temperature, double rain) {
        const WeatherYear year = even_weather(temperature, rain);
        return conditions_of(species, year, year).species[0][200];
    };
    // Half of them open at 20 mm in twelve days.
    EXPECT_NEAR(at(14.0, 20.0 / 12.0).rain, 0.5, 1e-9);
    EXPECT_GT(at(14.0, 3.0).rain, 0.95);
    EXPECT_LT(at(14.0, 0.0).rain, 0.02);
    EXPECT_EQ(at(14.0, 2.0).temperature, 1.0);
    EXPECT_DOUBLE_EQ(at(23.0, 2.0).temperature, 0.5);
    EXPECT_EQ(at(29.0, 2.0).temperature, 0.0);
    EXPECT_EQ(at(9.6, 2.0).cold, 1.0);
    EXPECT_EQ(at(9.4, 2.0).cold, 0.0);
    EXPECT_DOUBLE_EQ(moisture_gate(0.5), 0.5);
    EXPECT_LT(moisture_gate(0.3), 0.06);
}

TEST(Conditions, FollowRainAsLateAsBodiesNeed) {
    std::vector<FungusSpecies> species{boletus(), boletus("jelly")};
    species[1].ecology.fruit.rain_memory = 2;
    const WeatherYear dry = even_weather(14.0, 0.0);
    WeatherYear once = dry;
    once[100].rain = 60.0;
    const SeasonConditions conditions = conditions_of(species, dry, once);
    const auto peak = [&](std::size_t which) {
        const auto& days = conditions.species[which];
        return std::ranges::max_element(days, {}, &FruitingDay::rain) - days.begin() - 100;
    };
    // The mode of a gamma distribution of shape 3 is two thirds of its mean.
    EXPECT_NEAR(static_cast<double>(peak(0)), 8.0, 1.0);
    EXPECT_NEAR(static_cast<double>(peak(1)), 1.0, 1.0);
    // The rain of the last days of a year counts in the next one.
    EXPECT_GT(conditions_of(species, even_weather(14.0, 3.0), dry).species[0][0].rain, 0.9);
}

}  // namespace
}  // namespace sporeprint::fruiting_weather_test
