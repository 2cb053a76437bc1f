// The ground of a tile: a slab and its images. From far away crowns are part of both.
#pragma once

#include "core/atlas/atlas.h"
#include "core/grow/world/plot.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/world/patches.h"
#include "core/world/plot_ground.h"
#include "core/world/world.h"

namespace sporeprint {

/// Vertices along each side of the ground of a tile, and texels along each side of its images: of the finest tiles, and
/// of all others.
inline constexpr int tile_nodes = 33, finest_tile_texels = 512, tile_texels = 256;

/// Returns the number of texels along each side of the images of a tile.
[[nodiscard]] int texels_of_tile(double side);

/// The ground of a tile. What is known of the crowns of its patches serves its slab and its images.
class TileGround {
  public:
    /// content  the tile as a plot, with its light and the trees that raise its ground and drop leaves on it; without
    ///          trees if it is larger than coarsest_of_trees. It must outlive the ground, as the world must
    TileGround(const World& world, const PlotContent& content);

    /// Returns the slab. Vertices at one place of the world are equal bit for bit in all tiles of a size.
    ///
    /// floor   heights of the ground with the feet of trees
    /// height  in the world of what is at y = 0
    [[nodiscard]] Mesh slab(const FloorHeights& floor, double height);

    /// Paints the images.
    ///
    /// throws  InvalidInput (path "/kinds") for an unknown tree; what `parallel` throws
    [[nodiscard]] RawImages images(const Atlas& atlas, const Parallel& parallel = in_turn);

  private:
    const World& world_;
    const PlotContent& content_;
    PatchCanopy canopy_;
};

}  // namespace sporeprint
