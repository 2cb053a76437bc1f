#include "core/grow/world/plot_of_world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/world/leaf_stamp.h"
#include "core/world/snow.h"
#include "core/world/tree_growth.h"
#include "core/world/world_habitat.h"

namespace sporeprint {

namespace {

double soil_water_at(const WorldParams& params, WorldTime time) {
    const WeatherYear weather =
        weather_of(params.climate, params.seed, static_cast<int>(time / ticks_of_year));
    return weather[static_cast<std::size_t>(day_of_year(time) - 1)].soil_water;
}

}  // namespace

std::vector<Crown> crowns_in(const World& world, std::span<const StandTree> trees,
                             const WorldBox& box, WorldTime time) {
    std::vector<Crown> crowns;
    for (const StandTree& tree : trees)
        if (tree.lives_at(time) && tree.born < time && contains(box, tree.at))
            crowns.push_back(crown_of(world, tree, time));
    return crowns;
}

std::vector<LitterSource> litter_in(std::span<const StandTree> trees, const WorldBox& box,
                                    WorldTime time) {
    std::vector<LitterSource> sources;
    for (const StandTree& tree : trees)
        if (tree.lives_at(time) && tree.kind < most_kinds && contains(box, tree.at))
            sources.push_back({metres(tree.at.x), metres(tree.at.y),
                               crown_radius(height_at(tree, time)), tree.kind});
    return sources;
}

std::array<bool, most_kinds> needles_of(const World& world, const Atlas& atlas) {
    std::array<bool, most_kinds> out{};
    for (std::size_t i = 0; i < std::min(most_kinds, world.stand.kinds.size()); ++i) {
        const TreePreset* const tree = atlas.find_tree(world.stand.kinds[i].id);
        const LeafPreset* const leaf =
            tree ? atlas.find_leaf(params_of(*tree).look.leaf.id.string()) : nullptr;
        out[i] = leaf && has_needles({leaf->shape, leaf->palette});
    }
    return out;
}

std::function<double(double, double)> light_below(const World& world, const CanopyLight& canopy) {
    return [&world, &canopy](double x, double y) {
        const WorldPoint at = point_at(x, y);
        return world.site_at(at).light * canopy.at(x, y, world.place_at(at).height, 1.0);
    };
}

PlotContent content_of(const World& world, const PlotPlace& place, WorldTime time) {
    PlotContent content;
    content.ground = world.ground.get();
    content.seed = world.params.seed;
    content.centre = point_at(place.x, place.y);
    content.size = place.size;
    content.time = time;
    for (const StandKind& kind : world.stand.kinds) content.kinds.push_back(kind.id);
    content.species = world.species_ids;
    content.soil_water = soil_water_at(world.params, time);
    content.lasting_water = world.autumn_water;
    const double snow = snow_on(world.params.climate, world.params.seed,
                                static_cast<int>(time / ticks_of_year), day_of_year(time));
    content.snow = snow_cover(snow);
    content.snow_depth = snow_depth(snow);
    content.acidity = world.params.soil.acidity;
    content.micro = world.params.terrain.micro;
    content.wind_to = world.downwind();
    content.is_southern = world.params.climate.latitude_deg < 0.0;
    return content;
}

std::unique_ptr<const WorldPlot> plot_of_world(std::shared_ptr<const World> world,
                                               const PlotPlace& place, WorldTime time,
                                               const ExecutionContext& execution) {
    auto plot = std::make_unique<WorldPlot>();
    plot->world = std::move(world);
    const World& of = *plot->world;
    const double half = 0.5 * place.size;
    const WorldBox box{place.x - half, place.y - half, place.x + half, place.y + half};
    plot->around = blocks_round(of, box, execution);
    plot->bodies = bodies_in(of, box, time, execution);
    plot->canopy.emplace(
        crowns_in(of, plot->around.trees, grown(box, plot_margin + shade_reach), time));
    PlotContent& content = plot->content;
    content = content_of(of, place, time);
    content.trees = plot->around.trees;
    content.dead_wood = plot->around.dead;
    content.bodies = plot->bodies;
    content.light = light_below(of, *plot->canopy);
    return plot;
}

}  // namespace sporeprint
