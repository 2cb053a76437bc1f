// Grounds of worlds that are planes, for tests.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/world/ground.h"

namespace sporeprint {

/// Returns a ground that rises by so many metres per metre to the east and to the north.
inline Ground sloping_ground(double east, double north) {
    Ground ground;
    ground.grid = world_grid(256);
    ground.heights.reserve(ground.grid.nodes());
    for (int row = 0; row < ground.grid.side; ++row)
        for (int column = 0; column < ground.grid.side; ++column)
            ground.heights.push_back(quantised_height(east * ground.grid.place(column) +
                                                      north * ground.grid.place(row)));
    ground.wetness.assign(ground.grid.nodes(), 2000);
    ground.streams.assign(ground.grid.nodes(), 0);
    ground.lowest = -400.0;
    ground.highest = 400.0;
    return ground;
}

}  // namespace sporeprint
