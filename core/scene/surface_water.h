// How wet surfels are from day to day: the bucket of the soil of worlds, filled and emptied as fast as each of them is.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/world/weather.h"

namespace sporeprint {

/// What makes a surfel wet and dry.
struct WaterSupply {
    double rain = 1.0;    ///< what reaches it, as a multiple of the rain on open level ground
    double drying = 1.0;  ///< share of what sun and air could take that dries it (drying_of())
};

/// The wetness of surfaces in a year, for all supplies.
class SurfaceWater {
  public:
    /// before  the weather of the year before, with which the bucket begins
    /// cost    3 ms
    SurfaceWater(const WeatherYear& before, const WeatherYear& year);

    /// Returns the water of a surface at the end of a day, mm: 0 to most_soil_water. Linear between supplies that are
    /// computed; more than four times the rain makes nothing wetter.
    ///
    /// day  0 to 364
    [[nodiscard]] double on(const WaterSupply& supply, std::size_t day) const;

    /// Returns its mean over some days, all of them or the days of autumn.
    [[nodiscard]] double mean(const WaterSupply& supply, std::size_t first, std::size_t last) const;

  private:
    static constexpr std::size_t rains = 17, dryings = 9;
    struct Place;
    [[nodiscard]] static Place place_of(const WaterSupply& supply);

    std::vector<std::array<float, days_of_year>> days_;  ///< [rain][drying]
    std::vector<std::array<double, days_of_year + 1>> sums_;
};

/// Returns which share of what sun and air could take dries a surface that has a share of the light.
[[nodiscard]] constexpr double drying_of(double light) {
    // In deep shade the air still dries.
    constexpr double by_air = 0.15;
    return by_air + (1.0 - by_air) * (light < 1.0 ? light : 1.0);
}

}  // namespace sporeprint
