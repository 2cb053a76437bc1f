#include "core/scene/surface_water.h"

#include <algorithm>

#include "core/world/soil_water.h"

namespace sporeprint {

namespace {

/// The greatest supply of rain that is computed. Supplies are closer together where there is little.
constexpr double most_rain = 4.0;

double rain_of(std::size_t step, std::size_t steps) {
    const double share = static_cast<double>(step) / static_cast<double>(steps - 1);
    return most_rain * share * share;
}

}  // namespace

/// Between which computed supplies one lies.
struct SurfaceWater::Place {
    std::array<std::size_t, 4> buckets{};
    std::array<double, 4> weights{};
};

SurfaceWater::SurfaceWater(const WeatherYear& before, const WeatherYear& year) {
    days_.resize(rains * dryings);
    sums_.resize(rains * dryings);
    for (std::size_t r = 0; r < rains; ++r)
        for (std::size_t l = 0; l < dryings; ++l) {
            const double rain = rain_of(r, rains), drying = static_cast<double>(l) / (dryings - 1);
            double water = 0.5 * most_soil_water;
            const auto pass = [&](const WeatherDay& day) {
                water = soil_water_after(water, rain * day.rain, drying * day.evaporation);
            };
            for (const WeatherDay& day : before) pass(day);
            const std::size_t bucket = r * dryings + l;
            for (std::size_t day = 0; day < year.size(); ++day) {
                pass(year[day]);
                days_[bucket][day] = static_cast<float>(water);
                sums_[bucket][day + 1] = sums_[bucket][day] + water;
            }
        }
}

SurfaceWater::Place SurfaceWater::place_of(const WaterSupply& supply) {
    const double rain = std::clamp(supply.rain, 0.0, most_rain),
                 light = std::clamp(supply.drying, 0.0, 1.0) * (dryings - 1);
    std::size_t r = 0;
    while (r + 2 < rains && rain_of(r + 1, rains) <= rain) ++r;
    const double low = rain_of(r, rains), high = rain_of(r + 1, rains);
    const auto l = std::min(static_cast<std::size_t>(light), dryings - 2);
    const double t = (rain - low) / (high - low), u = light - static_cast<double>(l);
    const std::size_t first = r * dryings + l;
    return {{first, first + 1, first + dryings, first + dryings + 1},
            {(1.0 - t) * (1.0 - u), (1.0 - t) * u, t * (1.0 - u), t * u}};
}

double SurfaceWater::on(const WaterSupply& supply, std::size_t day) const {
    const Place place = place_of(supply);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
        sum += place.weights[k] * static_cast<double>(days_[place.buckets[k]][day]);
    return sum;
}

double SurfaceWater::mean(const WaterSupply& supply, std::size_t first, std::size_t last) const {
    const Place place = place_of(supply);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
        sum +=
            place.weights[k] * (sums_[place.buckets[k]][last + 1] - sums_[place.buckets[k]][first]);
    return sum / static_cast<double>(last - first + 1);
}

}  // namespace sporeprint
