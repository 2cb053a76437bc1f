#include "core/grow/world/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/world/fruiting_weather.h"
#include "core/world/influence.h"
#include "core/world/weather.h"
#include "core/world/world_habitat.h"

namespace sporeprint {

namespace {

template <class Record>
void sort_by_id(std::vector<Record>& records) {
    std::sort(records.begin(), records.end(),
              [](const Record& a, const Record& b) { return a.id < b.id; });
}

/// Returns the key of a part of a world for caches.
template <std::size_t N>
std::string key_of(const char* part, const World& world, const std::array<int, N>& numbers) {
    std::string key = part;
    for (const int number : numbers) (key += std::to_string(number)) += ' ';
    return key += world.key;
}

/// Returns the weather of a year; that of year 0 also stands for the year before it.
WeatherYear weather_in(const World& world, int year) {
    return weather_of(world.params.climate, world.params.seed, std::max(year, 0));
}

/// Returns what trunks may fall on in a block, cached or computed now.
///
/// trees  whether its trees are needed besides: then they are cached too. Most blocks at the rim need nothing else
std::shared_ptr<const Block> falls_of_world(const World& world, CellIndex block, bool trees,
                                            const ExecutionContext& execution) {
    return execution.caches.blocks(
        key_of("falls ", world, std::array<int, 2>{block.x, block.y}), [&] {
            throw_if_cancelled(execution);
            Block out;
            out.falls = trees
                            ? falls_of_block(world, trees_of_world(world, block, execution)->trees)
                            : falls_of_block(world, trees_of_block(world, block));
            return std::make_shared<const Block>(std::move(out));
        });
}

/// Computes the trees of the blocks that a rectangle is part of, and the dead wood of those of another one.
void compute_blocks(const World& world, const WorldBox& of_trees,
                    const std::optional<WorldBox>& of_wood, const ExecutionContext& execution) {
    std::set<CellIndex, CellOrder> trees, falls;
    for (const CellIndex block : blocks_of(of_trees)) trees.insert(block);
    const std::vector<CellIndex> wood = of_wood ? blocks_of(*of_wood) : std::vector<CellIndex>();
    for (const CellIndex block : wood) {
        trees.insert(block);
        for (const CellIndex near : blocks_about(block)) falls.insert(near);
    }
    std::set<CellIndex, CellOrder> all = trees;
    all.insert(falls.begin(), falls.end());
    std::vector<std::function<void()>> tasks;
    tasks.reserve(all.size());
    for (const CellIndex block : all)
        tasks.emplace_back([&, block] {
            if (trees.contains(block)) static_cast<void>(trees_of_world(world, block, execution));
            if (falls.contains(block))
                static_cast<void>(falls_of_world(world, block, trees.contains(block), execution));
        });
    execution.parallel(tasks);
    tasks.clear();
    for (const CellIndex block : wood)
        tasks.emplace_back([&world, &execution, block] {
            static_cast<void>(wood_of_world(world, block, execution));
        });
    execution.parallel(tasks);
}

/// Returns the rectangle of whose blocks trees may shade a rectangle, or trunks may lie in it.
WorldBox about(const World& world, const WorldBox& box) {
    // Crowns shade places near a plot from shade_reach, and litter comes from there too.
    constexpr double shading = 42.0, beside = 2.0;
    return grown(box, std::max(shading, longest_trunk(world.stand) + beside));
}

/// Returns the chosen trees of the blocks of a rectangle, by ascending ids.
template <class IsTree>
std::vector<StandTree> chosen_trees(const World& world, const WorldBox& wide,
                                    const ExecutionContext& execution, const IsTree& is_tree) {
    std::vector<StandTree> out;
    for (const CellIndex at : blocks_of(wide))
        std::ranges::copy_if(trees_of_world(world, at, execution)->trees, std::back_inserter(out),
                             is_tree);
    sort_by_id(out);
    return out;
}

/// Returns the chosen trees and trunks of the blocks round a rectangle, by ascending ids.
template <class IsTree, class IsWood>
Block chosen_round(const World& world, const WorldBox& box, const ExecutionContext& execution,
                   const IsTree& is_tree, const IsWood& is_wood) {
    const WorldBox wide = about(world, box);
    compute_blocks(world, wide, wide, execution);
    Block out;
    out.trees = chosen_trees(world, wide, execution, is_tree);
    for (const CellIndex at : blocks_of(wide))
        std::ranges::copy_if(wood_of_world(world, at, execution)->dead,
                             std::back_inserter(out.dead), is_wood);
    sort_by_id(out.dead);
    return out;
}

/// Returns the chosen trees alone.
template <class IsTree>
std::vector<StandTree> chosen_trees_round(const World& world, const WorldBox& box,
                                          const ExecutionContext& execution,
                                          const IsTree& is_tree) {
    const WorldBox wide = about(world, box);
    compute_blocks(world, wide, std::nullopt, execution);
    return chosen_trees(world, wide, execution, is_tree);
}

/// Returns how far away trees decide on the fruit bodies of a rectangle, metres.
double trees_within(const Influence& influence) {
    return std::max(influence.trees, influence.light + shade_reach);
}

/// What stands and lies round a rectangle, as far as its fungi depend on it. Not for use by several threads.
class Environs {
  public:
    Environs(const World& world, const Region& region, const Influence& influence,
             const ExecutionContext& execution)
        : world_(world),
          execution_(execution),
          habitat_(world, region.grown(influence.light),
                   [this](const Region& wide) { return trees_in(wide); }) {
        const Region of_trees = region.grown(influence.trees),
                     of_wood = region.grown(influence.wood);
        for (const CellIndex at : blocks_of(box_of(of_trees)))
            for (const StandTree& tree : trees_at(at))
                if (of_trees.contains(tree.at)) trees_.push_back(tree);
        for (const CellIndex at : blocks_of(box_of(of_wood))) {
            const std::shared_ptr<const Block> block = wood_of_world(world, at, execution);
            for (const DeadWood& wood : block->dead)
                if (of_wood.contains(wood.at)) wood_.push_back(wood);
        }
    }
    Environs(const Environs&) = delete;
    Environs& operator=(const Environs&) = delete;
    ~Environs() = default;

    [[nodiscard]] Fungi fungi() const { return {world_.params.seed, world_.species, habitat_}; }
    [[nodiscard]] Surroundings around() const { return {trees_, wood_}; }

  private:
    const std::vector<StandTree>& trees_at(CellIndex at) {
        std::shared_ptr<const Block>& block = blocks_[at];
        if (!block) block = trees_of_world(world_, at, execution_);
        return block->trees;
    }

    std::vector<std::span<const StandTree>> trees_in(const Region& region) {
        std::vector<std::span<const StandTree>> lists;
        for (const CellIndex at : blocks_of(box_of(region))) lists.emplace_back(trees_at(at));
        return lists;
    }

    const World& world_;
    const ExecutionContext& execution_;
    std::map<CellIndex, std::shared_ptr<const Block>, CellOrder> blocks_;
    std::vector<StandTree> trees_;
    std::vector<DeadWood> wood_;
    WorldHabitat habitat_;
};

/// The fungi of a rectangle. Not for use by several threads.
class RegionParts {
  public:
    RegionParts(const World& world, const Region& region, const ExecutionContext& execution)
        : world_(world),
          region_(region),
          influence_(influence_on(world.species, world.stand)),
          execution_(execution) {}

    /// Returns the fruit bodies that stand at some time of a year.
    std::shared_ptr<const BlockSeason> standing(int year) {
        std::shared_ptr<const BlockSeason> now = emerging(year);
        // What stands from the year before stays, as long as it lives. Brackets are among the bodies of both years.
        if (year == 0) return now;
        const std::shared_ptr<const BlockSeason> before = emerging(year - 1);
        BlockSeason out;
        for (const FruitBody& body : before->bodies)
            if (body.gone > time_of(year)) out.bodies.push_back(body);
        for (const FruitBody& body : now->bodies)
            if (body.gone > time_of(year)) out.bodies.push_back(body);
        sort_by_id(out.bodies);
        const auto same = [](const FruitBody& a, const FruitBody& b) { return a.id == b.id; };
        out.bodies.erase(std::unique(out.bodies.begin(), out.bodies.end(), same), out.bodies.end());
        return std::make_shared<const BlockSeason>(std::move(out));
    }

    /// Calls a function with what the fruit bodies of a year depend on.
    void use(int year, const std::function<void(const Fungi&, const RegionYear&)>& call) {
        const std::shared_ptr<const BlockMycelia> mycelia = mycelia_in(epoch_of(year));
        call(environs().fungi(), {region_, year, mycelia->genets, environs().around()});
    }

  private:
    [[nodiscard]] std::array<int, 5> place_and(int time) const {
        return {region_.west, region_.south, region_.east, region_.north, time};
    }

    /// Returns the fruit bodies that emerge in a year, and all brackets that stand at some time of it.
    std::shared_ptr<const BlockSeason> emerging(int year) {
        return execution_.caches.seasons(key_of("season ", world_, place_and(year)), [&] {
            throw_if_cancelled(execution_);
            BlockSeason season;
            use(year, [&](const Fungi& fungi, const RegionYear& input) {
                season.bodies = season_of(fungi, input, conditions_in(world_, year),
                                          world_.params.fungi.abundance);
            });
            return std::make_shared<const BlockSeason>(std::move(season));
        });
    }

    /// Returns the mycelia on which the bodies of an epoch depend.
    std::shared_ptr<const BlockMycelia> mycelia_in(int epoch) {
        return execution_.caches.mycelia(key_of("mycelia round ", world_, place_and(epoch)), [&] {
            throw_if_cancelled(execution_);
            return std::make_shared<const BlockMycelia>(BlockMycelia{
                genets_round(environs().fungi(), region_, epoch, environs().around())});
        });
    }

    const Environs& environs() {
        if (!environs_) environs_.emplace(world_, region_, influence_, execution_);
        return *environs_;
    }

    const World& world_;
    Region region_;
    Influence influence_;
    const ExecutionContext& execution_;
    std::optional<Environs> environs_;
};

/// Returns the whole metres round a rectangle.
Region region_round(const WorldBox& box) {
    const auto below = [](double metres) {
        return static_cast<std::int32_t>(std::floor(metres)) * units_of_metre;
    };
    const auto above = [](double metres) {
        return static_cast<std::int32_t>(std::ceil(metres)) * units_of_metre;
    };
    return {below(box.west), below(box.south), above(box.east), above(box.north)};
}

/// Returns the rectangles that the fruit bodies of one are computed by: itself if it is small, otherwise blocks, which
/// others share with it.
std::vector<Region> regions_of(const WorldBox& box) {
    if (box.east - box.west <= block_side && box.north - box.south <= block_side)
        return {region_round(box)};
    std::vector<Region> regions;
    for (const CellIndex block : blocks_of(box)) regions.emplace_back(block);
    return regions;
}

}  // namespace

WorldBox box_of(const Region& region) {
    return {metres(region.west), metres(region.south), metres(region.east), metres(region.north)};
}

SeasonConditions conditions_in(const World& world, int year) {
    return conditions_of(world.species, weather_in(world, year - 1), weather_in(world, year));
}

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
        record.months = bits_of_months(facts.season);
        const Range width = facts.cap_diameter_m.value_or(
            Range{0.5 * facts.height_m.from, 0.5 * facts.height_m.to});
        record.cap_radius = 0.25 * (width.from + width.to);
        return record;
    };
    return {tree, species};
}

std::shared_ptr<const Block> trees_of_world(const World& world, CellIndex block,
                                            const ExecutionContext& execution) {
    return execution.caches.blocks(key_of("trees ", world, std::array<int, 2>{block.x, block.y}),
                                   [&] {
                                       throw_if_cancelled(execution);
                                       Block out;
                                       out.trees = trees_of_block(world, block);
                                       return std::make_shared<const Block>(std::move(out));
                                   });
}

std::shared_ptr<const Block> wood_of_world(const World& world, CellIndex block,
                                           const ExecutionContext& execution) {
    return execution.caches.blocks(
        key_of("wood ", world, std::array<int, 2>{block.x, block.y}), [&] {
            std::array<std::shared_ptr<const Block>, 9> about;
            std::array<const Falls*, 9> near{};
            const std::array<CellIndex, 9> blocks = blocks_about(block);
            for (std::size_t i = 0; i < blocks.size(); ++i) {
                about[i] = falls_of_world(world, blocks[i], blocks[i] == block, execution);
                near[i] = &about[i]->falls;
            }
            throw_if_cancelled(execution);
            Block out;
            out.dead = wood_of_block(world, trees_of_world(world, block, execution)->trees, near);
            return std::make_shared<const Block>(std::move(out));
        });
}

std::shared_ptr<const BlockMycelia> mycelia_of_world(const World& world, CellIndex block, int epoch,
                                                     const ExecutionContext& execution) {
    return execution.caches.mycelia(
        key_of("mycelia ", world, std::array<int, 3>{block.x, block.y, epoch}), [&] {
            throw_if_cancelled(execution);
            const Environs environs(world, block, influence_on(world.species, world.stand),
                                    execution);
            return std::make_shared<const BlockMycelia>(
                BlockMycelia{genets_of(environs.fungi(), block, epoch, environs.around())});
        });
}

std::shared_ptr<const BlockSeason> season_of_world(const World& world, CellIndex block, int year,
                                                   const ExecutionContext& execution) {
    return RegionParts(world, block, execution).standing(year);
}

Block blocks_round(const World& world, const WorldBox& box, const ExecutionContext& execution) {
    const auto all = [](const auto&) { return true; };
    return chosen_round(world, box, execution, all, all);
}

std::vector<StandTree> trees_round(const World& world, const WorldBox& box,
                                   const ExecutionContext& execution) {
    return chosen_trees_round(world, box, execution, [](const StandTree&) { return true; });
}

std::vector<StandTree> living_round(const World& world, const WorldBox& box, WorldTime time,
                                    const ExecutionContext& execution) {
    return chosen_trees_round(world, box, execution,
                              [time](const StandTree& tree) { return tree.lives_at(time); });
}

Block present_round(const World& world, const WorldBox& box, WorldTime time,
                    const ExecutionContext& execution) {
    return chosen_round(
        world, box, execution, [time](const StandTree& tree) { return tree.lives_at(time); },
        [time](const DeadWood& wood) { return wood.stands_at(time) || wood.lies_at(time); });
}

void compute_surroundings(const World& world, const WorldBox& box,
                          const ExecutionContext& execution) {
    const Influence influence = influence_on(world.species, world.stand);
    compute_blocks(world, grown(box, trees_within(influence)), grown(box, influence.wood),
                   execution);
}

void with_surroundings(const World& world, const Region& region, int year,
                       const ExecutionContext& execution,
                       const std::function<void(const Fungi&, const RegionYear&)>& use) {
    RegionParts(world, region, execution).use(year, use);
}

std::vector<FruitBody> bodies_of_year(const World& world, const WorldBox& box, int year,
                                      const ExecutionContext& execution) {
    const std::vector<Region> regions = regions_of(box);
    WorldBox whole = box_of(regions.front());
    for (const Region& region : regions) {
        const WorldBox part = box_of(region);
        whole = {std::min(whole.west, part.west), std::min(whole.south, part.south),
                 std::max(whole.east, part.east), std::max(whole.north, part.north)};
    }
    compute_surroundings(world, whole, execution);
    std::vector<std::shared_ptr<const BlockSeason>> seasons(regions.size());
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < regions.size(); ++i)
        tasks.emplace_back(
            [&, i] { seasons[i] = RegionParts(world, regions[i], execution).standing(year); });
    execution.parallel(tasks);
    std::vector<FruitBody> out;
    for (const std::shared_ptr<const BlockSeason>& season : seasons)
        for (const FruitBody& body : season->bodies)
            if (contains(box, body.at)) out.push_back(body);
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
