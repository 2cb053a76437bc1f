#include "core/world/world_habitat.h"

#include <algorithm>
#include <cmath>

#include "core/world/tree_growth.h"

namespace sporeprint {

namespace {

/// Fungi of a block depend on the light of places this far beyond it, which crowns within shade_reach take, metres.
constexpr double light_margin = 32.0 + shade_reach;

bool is_near(WorldPoint at, CellIndex block) {
    const double x = metres(at.x) - block.x * block_side, y = metres(at.y) - block.y * block_side;
    return x >= -light_margin && x < block_side + light_margin && y >= -light_margin &&
           y < block_side + light_margin;
}

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

WorldHabitat::WorldHabitat(const World& world, CellIndex block, std::span<const StandTree> trees)
    : world_(world) {
    for (const StandTree& tree : trees)
        if (is_near(tree.at, block)) trees_.push_back(&tree);
    std::sort(trees_.begin(), trees_.end(),
              [](const StandTree* a, const StandTree* b) { return a->id < b->id; });
}

const CanopyLight& WorldHabitat::canopy_at(WorldTime time) const {
    const int step = step_of(time);
    const auto found = canopies_.find(step);
    if (found != canopies_.end()) return found->second;
    const WorldTime middle = step * light_years * ticks_of_year + light_years * ticks_of_year / 2;
    std::vector<Crown> crowns;
    crowns.reserve(trees_.size());
    for (const StandTree* tree : trees_)
        if (tree->lives_at(middle) && middle > tree->born)
            crowns.push_back(crown_of(world_, *tree, middle));
    return canopies_.emplace(step, CanopyLight(crowns)).first->second;
}

Site WorldHabitat::site_at(WorldPoint place, WorldTime time) const {
    Site site = world_.site_at(place);
    site.light *=
        canopy_at(time).at(metres(place.x), metres(place.y), world_.place_at(place).height, 1.0);
    return site;
}

double WorldHabitat::establishment(std::size_t species, WorldPoint place, WorldTime time) const {
    const double year = std::clamp(years_between(0, time), 0.0, static_cast<double>(last_year));
    return establishment_at(world_.establishment[species], metres(place.x), metres(place.y), year);
}

double WorldHabitat::wetness_on(const Site& site, double soil_water) const {
    return sporeprint::wetness_on(*world_.ground, site.index, soil_water);
}

}  // namespace sporeprint
