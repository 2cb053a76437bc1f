// How the weather of a year allows fungi to fruit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/world/mycelia.h"
#include "core/world/weather.h"

namespace sporeprint {

/// How far the weather of a day allows a species to fruit, each 0..1.
struct FruitingDay {
    double temperature = 0.0;  ///< the mean of five days
    double rain = 0.0;   ///< of the days before, weighted by how long bodies take from rain on
    double month = 0.0;  ///< 1 in the months in which it fruits, 0 ten days before and after
    double cold = 0.0;   ///< 0 when the last three nights were cold
    [[nodiscard]] double all() const { return temperature * rain * month * cold; }
};

/// What the weather of a year means for all species, wherever they are.
struct SeasonConditions {
    std::vector<std::array<FruitingDay, days_of_year>> species;
    std::array<double, days_of_year> soil_water{};  ///< mean of the world, mm
};

/// Returns how the weather of a year allows species to fruit. Its constants were chosen by hand.
///
/// before  the weather of the year before, whose rain counts in January
/// cost    about 0.4 ms for 12 species
[[nodiscard]] SeasonConditions conditions_of(std::span<const FungusSpecies> species,
                                             const WeatherYear& before, const WeatherYear& year);

/// Returns how far the wetness of the ground, 0..1, allows fungi to fruit, 0..1: half at 0.5.
[[nodiscard]] double moisture_gate(double wetness);

}  // namespace sporeprint
