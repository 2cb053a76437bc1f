// Maps of a world: one value for each of many places in a rectangle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/images.h"
#include "core/world/ground.h"

namespace sporeprint {

enum class WorldMap { height, slope, aspect, twi, wetness, streams };

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
    }
    return nullptr;
}

/// What a map shows, for lists.
[[nodiscard]] const char* doc_of(WorldMap map);

/// Returns true if a map changes from day to day.
[[nodiscard]] constexpr bool has_days(WorldMap map) { return map == WorldMap::wetness; }

/// The values that the least and the greatest number of a map stand for.
struct MapRange {
    double from = 0.0, to = 0.0;
    const char* unit = "";  ///< empty for a pure number
};

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
/// soil_water  of the day (WeatherDay), mm; used by maps that change from day to day
/// parallel    runs stripes of rows
/// returns     width * height values, rows from north to south, each from west to east: 0..65535 for the range of the
///             map, rounded to the nearest
[[nodiscard]] std::vector<std::uint16_t> map_of(WorldMap map, const Ground& ground,
                                                const MapFrame& frame, double soil_water,
                                                const Parallel& parallel = in_turn);

/// Returns heights in the colours of Terrarium: metres + 32768 = 256 R + G + B / 256, rounded to the nearest.
///
/// returns  3 * width * height bytes in the order of map_of()
[[nodiscard]] std::vector<std::uint8_t> terrarium_of(const Ground& ground, const MapFrame& frame,
                                                     const Parallel& parallel = in_turn);

}  // namespace sporeprint
