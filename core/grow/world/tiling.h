// The tree of the tiles of a world: squares, each divided into four, as 3D Tiles with implicit tiling name them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grow/world/plot.h"
#include "core/world/world.h"

namespace sporeprint {

/// A tile: its level, 0 for the whole world, and its column from west and row from south.
struct TileIndex {
    int level = 0, x = 0, y = 0;
    bool operator==(const TileIndex&) const = default;
};

/// Sides of the finest tiles, metres, and of the coarsest ones that show trees one by one.
inline constexpr double finest_tile = 8.0, coarsest_of_trees = 128.0;

/// The world that tiles divide.
struct Tiling {
    int extent = 1024;  ///< length of its sides, metres: 256, 1024 or 4096

    /// Returns the number of levels, the last of which has the finest tiles.
    [[nodiscard]] int levels() const;
    /// Returns the number of levels of a subtree: half of all.
    [[nodiscard]] int levels_of_subtree() const { return levels() / 2; }
    /// Returns the length of the sides of the tiles of a level, metres.
    [[nodiscard]] double side(int level) const {
        return static_cast<double>(extent) / static_cast<double>(1 << level);
    }
    [[nodiscard]] bool has(const TileIndex& tile) const;
    [[nodiscard]] WorldBox box(const TileIndex& tile) const;
};

/// Returns the geometric error of a tile, metres: at 16 pixels of 1080, 60 degrees high, its children appear within 58
/// times as much.
[[nodiscard]] constexpr double geometric_error(double side) { return side / 32.0; }

/// Returns whether tiles of a size have content of a layer. That of the floor adds to the content of the tiles above,
/// that of all others replaces it.
[[nodiscard]] bool has_content(PlotLayer layer, double side);

/// A box about axes east, north and up, metres.
struct TileBox {
    double west = 0.0, south = 0.0, low = 0.0, east = 0.0, north = 0.0, high = 0.0;

    /// Returns it as 3D Tiles has it: its middle, and half of its axes.
    [[nodiscard]] std::array<double, 12> numbers() const;
};

/// How far what stands on the ground of a world reaches.
struct TileReach {
    const Ground* ground = nullptr;
    double micro = 0.06;   ///< amplitude of the finest relief, metres
    double tallest = 0.0;  ///< height that no tree exceeds, metres
    double longest = 0.0;  ///< length that no trunk exceeds, metres
};
[[nodiscard]] TileReach reach_of(const Ground& ground, const WorldParams& params,
                                 const Stand& stand);

/// Returns a box that contains what a tile shows of a layer: crowns and trunks reach beyond its square.
[[nodiscard]] TileBox box_of(const Tiling& tiling, const TileIndex& tile, PlotLayer layer,
                             const TileReach& reach);

/// Returns the subtree of a tile as a file of 3D Tiles 1.1: all its tiles are there, those have content whose size has
/// some, and each has its box as metadata (semantic TILE_BOUNDING_BOX), tighter in height than what a reader divides.
///
/// root  of the subtree: its level is a multiple of levels_of_subtree()
[[nodiscard]] std::vector<std::uint8_t> subtree_of(const Tiling& tiling, const TileIndex& root,
                                                   PlotLayer layer, const TileReach& reach);

}  // namespace sporeprint
