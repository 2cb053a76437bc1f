#include "core/world/world_habitat.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Fungi of a block depend on the light of places this far beyond it, metres.
constexpr double light_margin = 32.0;

/// Squares of 32 m in which light is computed together, beyond that.
constexpr std::int32_t square_bits = 21;

/// Returns the number of the years that a moment belongs to.
int step_of(WorldTime time) {
    return static_cast<int>(std::floor(years_between(0, time) / light_years));
}

}  // namespace

Crown crown_of(const World& world, const StandTree& tree, WorldTime time) {
    const TreeEcology& ecology = world.stand.kinds[tree.kind].ecology;
    const double height = height_at(tree, time), ground = world.place_at(tree.at).height;
    return {.x = metres(tree.at.x),
            .y = metres(tree.at.y),
            .base = ground + ecology.crown_base * height,
            .top = ground + height,
            .radius = ecology.crown * crown_radius(height),
            .density = ecology.leaf_density / leaf_area_density};
}

WorldHabitat::WorldHabitat(const World& world, const Region& region, TreesIn trees)
    : world_(world), region_(region), trees_(std::move(trees)) {}

WorldHabitat::WorldHabitat(const World& world, CellIndex block, std::span<const StandTree> trees)
    : WorldHabitat(world, Region(block).grown(light_margin),
                   [trees](const Region&) { return std::vector{trees}; }) {}

std::vector<Crown> WorldHabitat::crowns_over(const Region& region, WorldTime time) const {
    const Region wide = region.grown(shade_reach);
    std::vector<const StandTree*> trees;
    for (const std::span<const StandTree> list : trees_(wide))
        for (const StandTree& tree : list)
            if (tree.born < time && time < tree.died && wide.contains(tree.at))
                trees.push_back(&tree);
    std::sort(trees.begin(), trees.end(),
              [](const StandTree* a, const StandTree* b) { return a->id < b->id; });
    std::vector<Crown> crowns;
    crowns.reserve(trees.size());
    for (const StandTree* tree : trees) crowns.push_back(crown_of(world_, *tree, time));
    return crowns;
}

const CanopyLight& WorldHabitat::canopy_at(WorldPoint place, WorldTime time) const {
    const int step = step_of(time);
    const WorldTime middle = step * light_years * ticks_of_year + light_years * ticks_of_year / 2;
    if (region_.contains(place)) {
        const auto found = canopies_.find(step);
        if (found != canopies_.end()) return found->second;
        return canopies_.emplace(step, CanopyLight(crowns_over(region_, middle))).first->second;
    }
    const std::int32_t column = place.x >> square_bits, row = place.y >> square_bits;
    const std::array<std::int32_t, 3> key{column, row, step};
    const auto found = farther_.find(key);
    if (found != farther_.end()) return found->second;
    constexpr std::int32_t side = 1 << square_bits;
    const Region square(column * side, row * side, (column + 1) * side, (row + 1) * side);
    return farther_.emplace(key, CanopyLight(crowns_over(square, middle))).first->second;
}

Site WorldHabitat::site_at(WorldPoint place, WorldTime time) const {
    Site site = world_.site_at(place);
    site.light *= canopy_at(place, time)
                      .at(metres(place.x), metres(place.y), world_.place_at(place).height, 1.0);
    return site;
}

double WorldHabitat::establishment(std::size_t species, WorldPoint place, WorldTime time) const {
    const double year = std::clamp(years_between(0, time), 0.0, static_cast<double>(last_year));
    return establishment_at(world_.establishment[species], metres(place.x), metres(place.y), year);
}

double WorldHabitat::share(std::size_t species, WorldPoint place) const {
    return world_.share_at(species, place);
}

double WorldHabitat::wetness_on(const Site& site, double soil_water) const {
    return sporeprint::wetness_on(*world_.ground, site.index, soil_water);
}

}  // namespace sporeprint
