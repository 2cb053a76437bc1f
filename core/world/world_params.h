// The parameters of a world, and the presets to start from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/params/describe.h"
#include "core/plant/leaf.h"
#include "core/world/fungi_params.h"
#include "core/world/soil_params.h"
#include "core/world/stand_params.h"
#include "core/world/terrain_params.h"

namespace sporeprint {

/// What the weather of a world is drawn from.
struct ClimateParams {
    double latitude_deg = 50.0;
    double temperature = 8.5;
    double swing = 9.5;
    double rain = 800.0;
    double rain_days = 0.42;
    double wind_from_deg = 250.0;
    double wind_speed = 3.0;
    double wind_focus = 1.2;

    static constexpr void fields(auto visit) {
        using C = ClimateParams;
        visit(&C::latitude_deg, Info{.name = "latitude_deg",
                                     .unit = "deg",
                                     .min = -66,
                                     .max = 66,
                                     .doc = "Latitude, which decides on the sun and with it on "
                                            "evaporation; south of the equator, below 0, July is "
                                            "in winter.",
                                     .step = 1});
        visit(&C::temperature, Info{.name = "temperature",
                                    .unit = "°C",
                                    .min = -5,
                                    .max = 25,
                                    .doc = "Mean temperature of the air over many years.",
                                    .step = 0.5});
        visit(&C::swing, Info{.name = "swing",
                              .unit = "K",
                              .min = 0,
                              .max = 20,
                              .doc = "How much warmer than that midsummer is, and how much colder "
                                     "midwinter.",
                              .step = 0.5});
        visit(&C::rain, Info{.name = "rain",
                             .unit = "mm",
                             .min = 0,
                             .max = 3000,
                             .doc = "Rain of a year, in the mean of many.",
                             .step = 10});
        visit(&C::rain_days, Info{.name = "rain_days",
                                  .min = 0.05,
                                  .max = 0.8,
                                  .doc = "Share of the days on which it rains: the fewer they are, "
                                         "the heavier is their rain.",
                                  .step = 0.01});
        visit(&C::wind_from_deg,
              Info{.name = "wind_from_deg",
                   .unit = "deg",
                   .min = 0,
                   .max = 360,
                   .doc = "Where most of the wind comes from, clockwise from north.",
                   .step = 5});
        visit(&C::wind_speed, Info{.name = "wind_speed",
                                   .unit = "m/s",
                                   .min = 0,
                                   .max = 10,
                                   .doc = "Mean speed of the wind 10 m above open ground.",
                                   .step = 0.1});
        visit(&C::wind_focus,
              Info{.name = "wind_focus",
                   .min = 0,
                   .max = 5,
                   .doc = "How much of the wind comes from there: at 0 all directions are alike; "
                          "if nearly all comes from within 45 degrees of it.",
                   .step = 0.1});
    }
    bool operator==(const ClimateParams&) const = default;
};
static_assert(well_described<ClimateParams>());

/// The parameters of a world. All but the seed default to those of its preset.
struct WorldParams {
    std::uint32_t seed = 1;
    Choice<256, 1024, 4096> extent{1024};
    TerrainParams terrain;
    ClimateParams climate;
    StandParams stand;
    SoilParams soil;
    FungiParams fungi;

    static constexpr void fields(auto visit) {
        using W = WorldParams;
        visit(&W::seed, Info{.name = "seed",
                             .min = 0,
                             .max = 4294967295.0,
                             .doc = "The world: same seed and parameters, same world, bit for "
                                    "bit."});
        visit(&W::extent, Info{.name = "extent",
                               .unit = "m",
                               .doc = "Length of each side; the world reaches half of it to the "
                                      "north, east, south and west of its centre."});
        visit(&W::terrain, Info{.name = "terrain", .doc = "The shape of the ground."});
        visit(&W::climate, Info{.name = "climate", .doc = "What the weather is drawn from."});
        visit(&W::stand, Info{.name = "stand", .doc = "Its trees, living and dead."});
        visit(&W::soil, Info{.name = "soil", .doc = "What the soil is like."});
        visit(&W::fungi, Info{.name = "fungi", .doc = "Its fungi."});
    }
    bool operator==(const WorldParams&) const = default;
};
static_assert(well_described<WorldParams>());

/// A preset: a world to start from. Each is one JSON file in core/atlas/worlds.
struct WorldPreset {
    Text<48> id;
    Text<48> name;
    int rank = 1000;
    TerrainParams terrain;
    ClimateParams climate;
    StandParams stand;
    SoilParams soil;
    FungiParams fungi;

    static constexpr void fields(auto visit) {
        using P = WorldPreset;
        visit(&P::id, info_of<LeafPreset>("id"));
        visit(&P::name, info_of<LeafPreset>("name"));
        visit(&P::rank, info_of<LeafPreset>("rank"));
        visit(&P::terrain, info_of<WorldParams>("terrain"));
        visit(&P::climate, info_of<WorldParams>("climate"));
        visit(&P::stand, info_of<WorldParams>("stand"));
        visit(&P::soil, info_of<WorldParams>("soil"));
        visit(&P::fungi, info_of<WorldParams>("fungi"));
    }
    void check(const std::string& path, std::vector<Problem>& problems) const {
        if (const std::string message = invalid_id_message(id); !message.empty())
            report(problems, path + "/id", message);
        if (name.empty()) report(problems, path + "/name", "is missing");
        if (!terrain.id.empty())
            report(problems, path + "/terrain/id", "is of an upload, which a preset cannot have");
    }
    bool operator==(const WorldPreset&) const = default;
};
static_assert(well_described<WorldPreset>());

/// A world: its parameters, and the preset that they began with, which names it.
struct WorldSpec {
    std::string preset;
    WorldParams params;
};

/// Returns the parameters of a preset without overrides.
[[nodiscard]] inline WorldParams params_of(const WorldPreset& preset) {
    WorldParams params;
    params.terrain = preset.terrain;
    params.climate = preset.climate;
    params.stand = preset.stand;
    params.stand.kinds = Text<256>(canonical_kinds(preset.stand.kinds));
    params.soil = preset.soil;
    params.fungi = preset.fungi;
    params.fungi.species = Text<620>(canonical_species(preset.fungi.species));
    return params;
}

/// The last year of a world; the first one is 0.
inline constexpr int last_year = 200;

}  // namespace sporeprint
