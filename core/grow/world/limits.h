// What keeps each species of a world from fruiting at a place on a day.
#pragma once

#include <vector>

#include "core/grow/execution_context.h"
#include "core/world/fruiting_limits.h"
#include "core/world/world.h"

namespace sporeprint {

/// The conditions of a place on a day, and how far each of them allows each species to fruit.
struct PlaceLimits {
    Site site;
    double wetness = 0.0;         ///< of its ground on the day, 0..1
    std::vector<Limits> species;  ///< in the order of the world
};

/// Returns what limits the species of a world at a place.
///
/// year, day  0 to last_year, 1 to 365
/// cost       0.1 s where nothing is known of the surroundings, 2 ms where the trees are
[[nodiscard]] PlaceLimits limits_in(const World& world, WorldPoint place, int year, int day,
                                    const ExecutionContext& execution);

}  // namespace sporeprint
