// The weather of a world: rain, temperature, evaporation and the water in its soil, day by day. A year is a pure
// function of the world and its number.
#pragma once

#include <array>
#include <cstdint>

#include "core/world/world_params.h"

namespace sporeprint {

inline constexpr int days_of_year = 365;
inline constexpr std::array<int, 12> days_of_months = {31, 28, 31, 30, 31, 30,
                                                       31, 31, 30, 31, 30, 31};

/// The weather of one day.
struct WeatherDay {
    double rain = 0.0;         ///< mm
    double temperature = 0.0;  ///< mean of the air, degrees Celsius
    double evaporation =
        0.0;  ///< what sun and air could take from wet ground (potential evapotranspiration), mm
    double soil_water = 0.0;  ///< in the soil at the end of the day, mm, 0 to `most_soil_water`
};

/// What the soil can hold: the depth at which plants no longer wilt and more would run off, mm.
inline constexpr double most_soil_water = 100.0;

/// A year without leap day; the first day is the 1st of January.
using WeatherYear = std::array<WeatherDay, days_of_year>;

/// Returns the weather of one year.
///
/// seed    of the world
/// year    0 to last_year
/// throws  InvalidInput (path "year") for any other year
/// source  rain by [Richardson1981], its days as a Markov chain with persistence 0.3 and its amounts from a Weibull
///         distribution of shape 0.8; temperature as a cosine and an autoregressive deviation; evaporation by
///         [Oudin2005], sun above the air by [Allen1998]
[[nodiscard]] WeatherYear weather_of(const ClimateParams& climate, std::uint32_t seed, int year);

/// Returns the angle of the sun from the plane of the equator on a day, 1 to 365: radians, positive in the northern
/// summer.
///
/// source  [Allen1998] eq. 24
[[nodiscard]] double sun_declination(int day);

/// Returns the hour angle of sunset, radians: half the length of the day, which is pi where the sun never sets.
///
/// latitude     radians, less than 67 degrees from the equator
/// declination  of the sun, radians
/// source       [Allen1998] eq. 25
[[nodiscard]] double sunset_hour_angle(double latitude, double declination);

/// Returns the sun's energy that reaches a level square metre above the air on a day, MJ.
///
/// latitude  radians, less than 67 degrees from the equator
/// day       1 to 365
/// source    [Allen1998] eq. 21 to 25
[[nodiscard]] double sun_above_air(double latitude, int day);

}  // namespace sporeprint
