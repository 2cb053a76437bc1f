#include "core/grow/world_limits.h"

#include <algorithm>
#include <functional>

#include "core/grow/world_parts.h"
#include "core/world/weather.h"
#include "core/world/world_habitat.h"

namespace sporeprint {

namespace {

/// Computes the mycelia of a block and of its neighbours, in parallel.
std::vector<Genet> genets_round(const World& world, CellIndex block, int epoch,
                                const ExecutionContext& execution) {
    std::vector<std::shared_ptr<const BlockMycelia>> parts(9);
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < parts.size(); ++i)
        tasks.emplace_back([&, i] {
            const auto column = static_cast<std::int32_t>(i % 3),
                       row = static_cast<std::int32_t>(i / 3);
            parts[i] = mycelia_of_world(world, {block.x + column - 1, block.y + row - 1}, epoch,
                                        execution);
        });
    execution.parallel(tasks);
    std::vector<Genet> genets;
    for (const auto& part : parts)
        genets.insert(genets.end(), part->genets.begin(), part->genets.end());
    return genets;
}

}  // namespace

PlaceLimits limits_in(const World& world, WorldPoint place, int year, int day,
                      const ExecutionContext& execution) {
    const CellIndex block = block_at(place);
    const double west = block.x * block_side, south = block.y * block_side;
    const Block around =
        blocks_round(world, {west, south, west + block_side, south + block_side}, execution);
    const std::vector<Genet> genets = genets_round(world, block, epoch_of(year), execution);
    const WorldHabitat habitat(world, block, around.trees);
    const Fungi fungi{world.params.seed, world.species, habitat};
    const WeatherYear before = weather_of(world.params.climate, world.params.seed,
                                          std::max(year - 1, 0)),
                      now = weather_of(world.params.climate, world.params.seed, year);
    const SeasonConditions conditions = conditions_of(fungi.species, before, now);
    const BlockYear input{block, year, genets, {around.trees, around.dead}};
    PlaceLimits out;
    out.site = habitat.site_at(place, time_of(year, day));
    out.wetness =
        habitat.wetness_on(out.site, conditions.soil_water[static_cast<std::size_t>(day - 1)]);
    for (std::size_t i = 0; i < world.species.size(); ++i)
        out.species.push_back(limits_at(fungi, input, conditions, i, place, day));
    return out;
}

}  // namespace sporeprint
