// The water in the soil from one day to the next: a bucket that rain fills, and sun and air empty.
#pragma once

#include <algorithm>

#include "core/world/weather.h"

namespace sporeprint {

/// Soil with less water than this, in mm, holds it back from roots and sun.
inline constexpr double readily_lost = 60.0;

/// Returns the water in the soil at the end of a day, mm.
///
/// water        at its beginning, mm
/// rain         that reaches the soil, mm
/// evaporation  what sun and air could take from wet ground, mm
[[nodiscard]] inline double soil_water_after(double water, double rain, double evaporation) {
    water += rain - evaporation * std::min(1.0, water / readily_lost);
    return std::clamp(water, 0.0, most_soil_water);
}

}  // namespace sporeprint
