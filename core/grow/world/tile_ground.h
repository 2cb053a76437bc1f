// The ground of a tile: a slab and its images. From far away crowns are part of both.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/atlas/atlas.h"
#include "core/grow/world/plot.h"
#include "core/images.h"
#include "core/mesh/mesh.h"
#include "core/world/patches.h"
#include "core/world/plot_ground.h"
#include "core/world/world.h"

namespace sporeprint {

/// Vertices along each side of the ground of a tile.
inline constexpr int tile_nodes = 33;

/// Texels along each side of the images of a tile. Relief and gloss need fewer than colours, and from afar none: 0.
struct TileTexels {
    int colour = 0, normal = 0, orm = 0;
    /// Returns the number of all of them.
    [[nodiscard]] std::uint64_t all() const;
    bool operator==(const TileTexels&) const = default;
};
[[nodiscard]] TileTexels texels_of_tile(double side);

/// Returns the step of the cover of a tile, metres: the finest for leaves, else a sixteenth of its side.
[[nodiscard]] double cover_step_of_tile(double side);

/// Returns the step of the heights of a tile, metres. All tiles of a size have one, so that their borders meet, and 16
/// bits reach as far up and down as the tile is wide.
[[nodiscard]] double step_of_tile(double side);

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

    /// Returns the heights of a grid of places, with the crowns where they are part of the ground.
    [[nodiscard]] std::vector<double> heights(const FloorHeights& floor, std::span<const double> x,
                                              std::span<const double> y);

    /// Paints the images, all with the texels of the colours.
    ///
    /// throws  InvalidInput (path "/kinds") for an unknown tree; what `parallel` throws
    [[nodiscard]] RawImages images(const Atlas& atlas, const Parallel& parallel = in_turn);

    /// Paints the images and encodes them as JPEG files of texels_of_tile().
    ///
    /// throws  as images()
    [[nodiscard]] ImageSet files(const Atlas& atlas, const Parallel& parallel = in_turn);

  private:
    const World& world_;
    const PlotContent& content_;
    PatchCanopy canopy_;
};

}  // namespace sporeprint
