// The conditions of a place of a world that do not change with the day.
#pragma once

#include "core/world/records.h"

namespace sporeprint {

/// What a place has to give to what grows there.
struct Site {
    double light = 1.0;    ///< share of the light of an open, level sky
    double wetness = 0.5;  ///< of the ground on the mean of autumn days: 1 where water stands
    double acidity = 0.5;  ///< of the soil, 0..1
    double index = 0.0;    ///< topographic wetness index, which wetness_on() takes
};

}  // namespace sporeprint
