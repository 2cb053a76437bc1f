#include "core/grow/world_parts.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "core/world/weather.h"
#include "core/world/world_habitat.h"

namespace sporeprint {

namespace {

/// Calls a function with a block and its eight neighbours, from south-west to north-east.
void for_neighbours(CellIndex block, const std::function<void(CellIndex)>& call) {
    for (std::int32_t y = -1; y <= 1; ++y)
        for (std::int32_t x = -1; x <= 1; ++x) call({block.x + x, block.y + y});
}

void append(Block& out, const Block& block) {
    out.trees.insert(out.trees.end(), block.trees.begin(), block.trees.end());
    out.dead.insert(out.dead.end(), block.dead.begin(), block.dead.end());
}

/// Returns what stands and lies in a block and in its eight neighbours.
Block neighbourhood_of(const World& world, CellIndex block, const ExecutionContext& execution) {
    Block out;
    for_neighbours(block,
                   [&](CellIndex one) { append(out, *block_of_world(world, one, execution)); });
    return out;
}

template <class Record>
void sort_by_id(std::vector<Record>& records) {
    std::sort(records.begin(), records.end(),
              [](const Record& a, const Record& b) { return a.id < b.id; });
}

std::string key_of(const char* part, const World& world, CellIndex block, int time) {
    return std::string(part) + std::to_string(block.x) + ' ' + std::to_string(block.y) + ' ' +
           std::to_string(time) + ' ' + world.key;
}

/// Returns the weather of a year; that of year 0 also stands for the year before it.
WeatherYear weather_in(const World& world, int year) {
    return weather_of(world.params.climate, world.params.seed, std::max(year, 0));
}

/// Returns the bodies that emerge in a block in one year.
std::vector<FruitBody> emerging(const Fungi& fungi, const World& world, const BlockYear& input) {
    const SeasonConditions conditions = conditions_of(
        fungi.species, weather_in(world, input.year - 1), weather_in(world, input.year));
    return season_of(fungi, input, conditions, world.params.fungi.abundance);
}

/// Computes the blocks that fruit bodies in a rectangle depend on: those that it is part of, with their neighbours and
/// the neighbours of these.
void compute_blocks(const World& world, const WorldBox& box, const ExecutionContext& execution) {
    constexpr double rim = 2.0 * block_side;
    std::vector<std::function<void()>> tasks;
    for (const CellIndex block :
         blocks_of({box.west - rim, box.south - rim, box.east + rim, box.north + rim}))
        tasks.emplace_back([&world, &execution, block] {
            static_cast<void>(block_of_world(world, block, execution));
        });
    execution.parallel(tasks);
}

/// Computes the mycelia that fruit bodies in a rectangle in a year depend on, whose blocks are computed.
void compute_mycelia(const World& world, const WorldBox& box, int year,
                     const ExecutionContext& execution) {
    std::vector<std::function<void()>> tasks;
    const int last = epoch_of(year), first = epoch_of(std::max(year - 1, 0));
    for (const CellIndex block : blocks_of({box.west - block_side, box.south - block_side,
                                            box.east + block_side, box.north + block_side}))
        for (int epoch = first; epoch <= last; ++epoch)
            tasks.emplace_back([&world, &execution, block, epoch] {
                static_cast<void>(mycelia_of_world(world, block, epoch, execution));
            });
    execution.parallel(tasks);
}

BlockSeason season_in(const World& world, CellIndex block, int year,
                      const ExecutionContext& execution) {
    const Block around = neighbourhood_of(world, block, execution);
    const WorldHabitat habitat(world, block, around.trees);
    const Fungi fungi{world.params.seed, world.species, habitat};
    BlockSeason out;
    // What stands from the year before stays, as long as it lives. Brackets are among the bodies of both years.
    for (const int one : {year - 1, year}) {
        if (one < 0) continue;
        std::vector<Genet> genets;
        for_neighbours(block, [&](CellIndex neighbour) {
            const auto part = mycelia_of_world(world, neighbour, epoch_of(one), execution);
            genets.insert(genets.end(), part->genets.begin(), part->genets.end());
        });
        const BlockYear input{block, one, genets, {around.trees, around.dead}};
        for (FruitBody& body : emerging(fungi, world, input))
            if (body.gone > time_of(year)) out.bodies.push_back(body);
    }
    sort_by_id(out.bodies);
    const auto same = [](const FruitBody& a, const FruitBody& b) { return a.id == b.id; };
    out.bodies.erase(std::unique(out.bodies.begin(), out.bodies.end(), same), out.bodies.end());
    return out;
}

}  // namespace

WorldLookup lookup_in(const Atlas& atlas) {
    const auto tree = [&atlas](std::string_view id) -> const TreeEcology* {
        const TreePreset* const preset = atlas.find_tree(id);
        return preset ? &preset->ecology : nullptr;
    };
    const auto species = [&atlas](std::string_view id) -> std::optional<SpeciesRecord> {
        const AtlasEntry* const entry = atlas.find(id);
        if (!entry) return std::nullopt;
        const Facts& facts = entry->species.facts;
        SpeciesRecord record;
        record.ecology = entry->species.ecology;
        for (const int month : facts.season)
            record.months = static_cast<std::uint16_t>(record.months | 1U << (month - 1));
        if (facts.season.empty()) record.months = 0xFFF;
        const Range width = facts.cap_diameter_m.value_or(
            Range{0.5 * facts.height_m.from, 0.5 * facts.height_m.to});
        record.cap_radius = 0.25 * (width.from + width.to);
        return record;
    };
    return {tree, species};
}

std::string block_key(const World& world, CellIndex block) {
    return key_of("block ", world, block, 0);
}

std::shared_ptr<const Block> block_of_world(const World& world, CellIndex block,
                                            const ExecutionContext& execution) {
    return execution.caches.blocks(block_key(world, block), [&] {
        throw_if_cancelled(execution);
        return std::make_shared<const Block>(block_of(world, block));
    });
}

std::shared_ptr<const BlockMycelia> mycelia_of_world(const World& world, CellIndex block, int epoch,
                                                     const ExecutionContext& execution) {
    return execution.caches.mycelia(key_of("mycelia ", world, block, epoch), [&] {
        throw_if_cancelled(execution);
        const Block around = neighbourhood_of(world, block, execution);
        const WorldHabitat habitat(world, block, around.trees);
        const Fungi fungi{world.params.seed, world.species, habitat};
        return std::make_shared<const BlockMycelia>(
            BlockMycelia{genets_of(fungi, block, epoch, {around.trees, around.dead})});
    });
}

std::shared_ptr<const BlockSeason> season_of_world(const World& world, CellIndex block, int year,
                                                   const ExecutionContext& execution) {
    return execution.caches.seasons(key_of("season ", world, block, year), [&] {
        throw_if_cancelled(execution);
        return std::make_shared<const BlockSeason>(season_in(world, block, year, execution));
    });
}

Block blocks_round(const World& world, const WorldBox& box, const ExecutionContext& execution) {
    const WorldBox wide{box.west - block_side, box.south - block_side, box.east + block_side,
                        box.north + block_side};
    Block out;
    for (const CellIndex block : blocks_of(wide))
        append(out, *block_of_world(world, block, execution));
    sort_by_id(out.trees);
    sort_by_id(out.dead);
    return out;
}

std::vector<FruitBody> bodies_of_year(const World& world, const WorldBox& box, int year,
                                      const ExecutionContext& execution) {
    compute_blocks(world, box, execution);
    compute_mycelia(world, box, year, execution);
    std::vector<FruitBody> out;
    for (const CellIndex block : blocks_of(box)) {
        const std::shared_ptr<const BlockSeason> season =
            season_of_world(world, block, year, execution);
        for (const FruitBody& body : season->bodies)
            if (contains(box, body.at)) out.push_back(body);
    }
    sort_by_id(out);
    return out;
}

std::vector<FruitBody> bodies_in(const World& world, const WorldBox& box, WorldTime time,
                                 const ExecutionContext& execution) {
    std::vector<FruitBody> out = bodies_of_year(world, box, time / ticks_of_year, execution);
    std::erase_if(out, [&](const FruitBody& body) { return !body.stands_at(time); });
    return out;
}

}  // namespace sporeprint
