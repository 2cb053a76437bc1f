// Maps of a world: one value for each of many places in a rectangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/images.h"
#include "core/world/canopy_light.h"
#include "core/world/cover.h"
#include "core/world/ground.h"
#include "core/world/world.h"

namespace sporeprint {

enum class WorldMap {
    height,
    slope,
    aspect,
    twi,
    wetness,
    streams,
    sky,
    light,
    canopy,
    spores,
    litter,
    moss,
    grass,
    wind,
    probability,
    species
};

constexpr const char* name(WorldMap map) {
    switch (map) {
        case WorldMap::height:
            return "height";
        case WorldMap::slope:
            return "slope";
        case WorldMap::aspect:
            return "aspect";
        case WorldMap::twi:
            return "twi";
        case WorldMap::wetness:
            return "wetness";
        case WorldMap::streams:
            return "streams";
        case WorldMap::sky:
            return "sky";
        case WorldMap::light:
            return "light";
        case WorldMap::canopy:
            return "canopy";
        case WorldMap::spores:
            return "spores";
        case WorldMap::litter:
            return "litter";
        case WorldMap::moss:
            return "moss";
        case WorldMap::grass:
            return "grass";
        case WorldMap::wind:
            return "wind";
        case WorldMap::probability:
            return "probability";
        case WorldMap::species:
            return "species";
    }
    return nullptr;
}

/// What a map shows, for lists.
[[nodiscard]] const char* doc_of(WorldMap map);

/// Returns true if a map shows what covers the ground.
[[nodiscard]] constexpr bool is_of_cover(WorldMap map) {
    return map == WorldMap::litter || map == WorldMap::moss || map == WorldMap::grass;
}

/// Returns true if a map changes from day to day.
[[nodiscard]] constexpr bool has_days(WorldMap map) {
    return map == WorldMap::wetness || is_of_cover(map);
}

/// Returns true if a map depends on the crowns of trees.
[[nodiscard]] constexpr bool has_crowns(WorldMap map) {
    return map == WorldMap::light || map == WorldMap::canopy || map == WorldMap::probability ||
           map == WorldMap::species || is_of_cover(map);
}

/// Returns true if a map is one of one species.
[[nodiscard]] constexpr bool has_species(WorldMap map) {
    return map == WorldMap::spores || map == WorldMap::probability;
}

/// Returns true if a map changes from year to year.
[[nodiscard]] constexpr bool has_years(WorldMap map) {
    return has_days(map) || has_crowns(map) || map == WorldMap::spores;
}

/// Returns true if a map needs more of a world than its ground.
[[nodiscard]] constexpr bool needs_world(WorldMap map) {
    return has_crowns(map) || map == WorldMap::spores || map == WorldMap::sky;
}

/// What the values of a map are computed from.
struct MapInputs {
    const Ground& ground;
    double soil_water = 0.0;  ///< of the day (WeatherDay), mm; of maps that change from day to day
    const World* world = nullptr;                ///< of maps that need one, over the same ground
    int year = 0;                                ///< of maps that change from year to year
    int day = 1;                                 ///< of the year, of maps of the cover
    std::size_t species = 0;                     ///< of maps of one species: which of the world's
    ClimateParams climate{};                     ///< of the map of wind
    std::array<bool, most_kinds> has_needles{};  ///< by kind of tree, of maps of the cover
    /// Returns the crowns of the trees of a block and of its neighbours by their ids, for maps of crowns; may be called
    /// by several threads.
    std::function<std::vector<Crown>(CellIndex)> crowns{};
    /// Returns from where litter falls in a block, likewise, for maps of the cover.
    std::function<std::vector<LitterSource>(CellIndex)> litter{};
};

/// Colours of the map of species: for none, then for the species of a world in their order.
inline constexpr std::array<std::array<std::uint8_t, 3>, 13> colours_of_species = {
    {{48, 48, 48},
     {200, 60, 50},
     {240, 150, 40},
     {250, 220, 90},
     {150, 190, 60},
     {50, 130, 70},
     {60, 180, 170},
     {90, 160, 230},
     {40, 80, 170},
     {120, 90, 190},
     {210, 120, 200},
     {140, 80, 50},
     {220, 220, 220}}};

/// The values that the least and the greatest number of a map stand for.
struct MapRange {
    double from = 0.0, to = 0.0;
    const char* unit = "";  ///< empty for a pure number
};

/// How far litter is blown from a trunk at most, metres.
inline constexpr double most_litter_reach = most_litter_drift + crown_filling * 6.0;

/// Returns how likely a species is at a place, 0..1: the least of its responses to the light, the wetness and the
/// acidity there, its establishment and its masks, multiplied. Whether what it lives on is there is not considered.
///
/// light  share of the light of an open sky, below crowns
[[nodiscard]] double probability_at(const World& world, std::size_t species, WorldPoint place,
                                    double light, int year);

/// Returns the range of a map, which is that of the whole world: maps of neighbouring rectangles fit together.
[[nodiscard]] MapRange range_of(WorldMap map, const Ground& ground);

/// The places of a map: nodes of a lattice, those of the edges on the edges of its rectangle.
struct MapFrame {
    WorldBox box;
    int width = 0, height = 0;

    /// Returns x of a column from west to east.
    [[nodiscard]] double x(int column) const {
        return column == width - 1 ? box.east
                                   : box.west + (box.east - box.west) * column / (width - 1);
    }
    /// Returns y of a row from north to south.
    [[nodiscard]] double y(int row) const {
        return row == height - 1 ? box.south
                                 : box.north + (box.south - box.north) * row / (height - 1);
    }
};

/// Returns the frame of a rectangle.
///
/// side  number of nodes along the longer side, at least 2; along the other as many as its length is of the longer one,
///       rounded, and at least 2
[[nodiscard]] MapFrame frame_of(const WorldBox& box, int side);

/// Computes a map.
///
/// parallel  runs stripes of rows, or blocks
/// returns   width * height values, rows from north to south, each from west to east: 0..65535 for the range of the map,
///           rounded to the nearest; of the map of species 0 for none and otherwise one more than the number of the
///           species in the world
[[nodiscard]] std::vector<std::uint16_t> map_of(WorldMap map, const MapInputs& inputs,
                                                const MapFrame& frame,
                                                const Parallel& parallel = in_turn);

/// Returns heights in the colours of Terrarium: metres + 32768 = 256 R + G + B / 256, rounded to the nearest.
///
/// returns  3 * width * height bytes in the order of map_of()
[[nodiscard]] std::vector<std::uint8_t> terrarium_of(const Ground& ground, const MapFrame& frame,
                                                     const Parallel& parallel = in_turn);

}  // namespace sporeprint
