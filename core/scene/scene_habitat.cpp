#include "core/scene/scene_habitat.h"

#include <algorithm>
#include <utility>

#include "core/math/elementary.h"
#include "core/world/wind.h"

namespace sporeprint {

namespace {

/// Surfels and their rays do not depend on a world, so that all of its seeds have the same ones.
constexpr std::uint32_t seed_of_shapes = 1;

/// Years whose autumns make the wetness of a place, and their days, 0 to 364: September and October.
constexpr int years_of_mean = 4;
constexpr std::size_t first_autumn_day = 243, last_autumn_day = 303, half_a_year = 182;

/// The longest day of the north; in the south it is half a year later.
constexpr int midsummer = 172;

/// Share of its water that wood conducts to all of a piece, and how slowly it dries, compared with soil.
constexpr double conducted_share = 0.5, drying_of_wood = 0.4;

/// Returns the water of surfels after wood has conducted it.
std::vector<float> conducted(const Surfels& surfels, const SurfelSubstrates& substrates,
                             const std::vector<float>& water) {
    std::vector<double> sums(substrates.wood.size(), 0.0);
    const auto is_wood = [&](std::size_t i) { return substrates.soils[i] == Soil::wood; };
    for (std::size_t i = 0; i < water.size(); ++i)
        if (is_wood(i))
            sums[substrates.pieces[i]] +=
                static_cast<double>(water[i]) * static_cast<double>(surfels[i].area);
    std::vector<float> out = water;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!is_wood(i)) continue;
        const SceneWood& wood = substrates.wood[substrates.pieces[i]];
        const double mean = wood.area > 0.0 ? sums[substrates.pieces[i]] / wood.area : 0.0;
        out[i] = static_cast<float>((1.0 - conducted_share) * static_cast<double>(water[i]) +
                                    conducted_share * mean);
    }
    return out;
}

}  // namespace

WaterSupply SceneHabitat::supply(std::size_t surfel) const {
    const double drying = drying_of(sites[surfel].light);
    return {static_cast<double>(water[surfel]),
            substrates.soils[surfel] == Soil::wood ? drying_of_wood * drying : drying};
}

std::size_t SceneShape::bytes() const {
    return sizeof(*this) + scene->bytes() + surfels.bytes() + graph.bytes() +
           sky.size() * sizeof(float) + buried.size() + tree.bytes();
}

SceneShape shape_of_scene(std::shared_ptr<const Scene> scene, const Parallel& parallel) {
    TriangleTree tree(*scene);
    Surfels surfels = surfels_of(*scene, seed_of_shapes);
    SurfelGraph graph = graph_of(surfels, tree, parallel);
    std::vector<float> sky = sky_of(surfels, tree, seed_of_shapes, parallel);
    std::vector<std::uint8_t> buried = buried_of(surfels, tree, *scene, sky, parallel);
    return {std::move(scene), std::move(tree), std::move(surfels),
            std::move(graph), std::move(sky),  std::move(buried)};
}

double SceneHabitat::suitability(const FungusSpecies& species, std::size_t surfel) const {
    if (!substrates.suits(species, surfel, conditions.decay)) return 0.0;
    return sporeprint::suitability(species.ecology, sites[surfel]);
}

std::size_t SceneHabitat::bytes() const {
    return sizeof(*this) + substrates.bytes() + (rain.size() + water.size()) * sizeof(float) +
           run_off.bytes() + sites.size() * sizeof(Site) +
           conditions.soils.size() * sizeof(MaterialSoil);
}

SurfaceWater water_of(const SceneConditions& conditions, int year) {
    const int before = std::max(year - 1, 0);
    return {weather_of(conditions.climate, conditions.seed, before),
            weather_of(conditions.climate, conditions.seed, year)};
}

SceneHabitat habitat_of(std::shared_ptr<const SceneShape> shape, SceneConditions conditions,
                        const Parallel& parallel) {
    SceneHabitat out;
    out.shape = std::move(shape);
    out.conditions = std::move(conditions);
    const Surfels& surfels = out.shape->surfels;
    const ClimateParams& climate = out.conditions.climate;
    const bool is_southern = climate.latitude_deg < 0.0;
    out.substrates = substrates_of(surfels, out.shape->graph, out.conditions.soils);
    out.rain = rain_on(surfels, out.shape->tree, wind_rose(climate), out.conditions.seed, parallel);
    out.run_off = run_off_of(surfels, out.shape->graph, out.shape->tree, out.substrates, out.rain);
    out.water = conducted(surfels, out.substrates, out.run_off.water);
    const SunDay sun = sun_of(radians(climate.latitude_deg),
                              is_southern ? midsummer + static_cast<int>(half_a_year) : midsummer);
    const std::vector<float> direct = sun_on(surfels, out.shape->tree, sun, parallel);
    out.sites.resize(surfels.size());
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        out.sites[i].light =
            light_of(static_cast<double>(out.shape->sky[i]), static_cast<double>(direct[i]));
        out.sites[i].acidity = out.conditions.acidity;
        out.sites[i].wetness = 0.0;
    }
    for (int year = 0; year < years_of_mean; ++year) {
        const SurfaceWater water = water_of(out.conditions, year);
        for (std::size_t i = 0; i < surfels.size(); ++i) {
            const WaterSupply supply = out.supply(i);
            // Autumn of the south is in April and May, before the middle of its year.
            const double mean = is_southern ? water.mean(supply, first_autumn_day - half_a_year,
                                                         last_autumn_day - half_a_year)
                                            : water.mean(supply, first_autumn_day, last_autumn_day);
            out.sites[i].wetness += mean / (most_soil_water * years_of_mean);
        }
    }
    return out;
}

}  // namespace sporeprint
