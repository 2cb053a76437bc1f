// The ground of a tile: a slab and its images. From far away crowns are part of both.
#pragma once

#include "core/atlas/atlas.h"
#include "core/grow/world/plot.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/world/world.h"

namespace sporeprint {

/// Vertices along each side of the ground of a tile, and texels along each side of its images: of the finest tiles, and
/// of all others.
inline constexpr int tile_nodes = 33, finest_tile_texels = 512, tile_texels = 256;

/// Returns the number of texels along each side of the images of a tile.
[[nodiscard]] int texels_of_tile(double side);

/// Returns the slab of a tile. Vertices at one place of the world are equal bit for bit in all tiles of a size.
///
/// content  the tile as a plot; its trees raise the ground of small tiles
/// floor    heights of the ground with the feet of these trees
/// height   in the world of what is at y = 0
[[nodiscard]] Mesh tile_slab(const World& world, const PlotContent& content,
                             const FloorHeights& floor, double height);

/// Paints the images of the ground of a tile.
///
/// content  the tile as a plot, with its light and the trees that drop leaves on it; without trees if it is larger than
///          coarsest_of_trees
[[nodiscard]] RawImages tile_images(const World& world, const PlotContent& content,
                                    const Atlas& atlas, const Parallel& parallel = in_turn);

}  // namespace sporeprint
