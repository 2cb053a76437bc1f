#include "core/grow/world/limits.h"

#include <cmath>

#include "core/grow/world/parts.h"

namespace sporeprint {

namespace {

/// Returns the square metre round a place, which all places in it share.
Region square_of(WorldPoint place) {
    const auto below = [](std::int32_t units) {
        return static_cast<std::int32_t>(std::floor(metres(units))) * units_of_metre;
    };
    const std::int32_t west = below(place.x), south = below(place.y);
    return {west, south, west + units_of_metre, south + units_of_metre};
}

}  // namespace

PlaceLimits limits_in(const World& world, WorldPoint place, int year, int day,
                      const ExecutionContext& execution) {
    const double x = metres(place.x), y = metres(place.y);
    compute_surroundings(world, {x - 1.0, y - 1.0, x + 1.0, y + 1.0}, execution);
    const SeasonConditions conditions = conditions_in(world, year);
    PlaceLimits out;
    with_surroundings(
        world, square_of(place), year, execution, [&](const Fungi& fungi, const RegionYear& input) {
            out.site = fungi.habitat.site_at(place, time_of(year, day));
            out.wetness = fungi.habitat.wetness_on(
                out.site, conditions.soil_water[static_cast<std::size_t>(day - 1)]);
            for (std::size_t i = 0; i < world.species.size(); ++i)
                out.species.push_back(limits_at(fungi, input, conditions, i, place, day));
        });
    return out;
}

}  // namespace sporeprint
