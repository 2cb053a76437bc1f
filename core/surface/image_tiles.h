// Atlases of tiles: the images of several paintings side by side in one set of images.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/images.h"

namespace sporeprint {

/// Largest number of tiles of an atlas, and its largest side in texels, which every graphics card
/// of the last decade supports.
inline constexpr std::size_t most_tiles = 16;
inline constexpr int largest_tiled_side = 4096;

/// A grid of square tiles, filled row by row. Both sides are powers of two, so that no level of
/// mipmaps down to one texel for each tile mixes two of them.
struct TileGrid {
    int columns = 1, rows = 1;

    [[nodiscard]] constexpr std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    [[nodiscard]] constexpr int column_of(std::size_t tile) const {
        return static_cast<int>(tile) % columns;
    }
    [[nodiscard]] constexpr int row_of(std::size_t tile) const {
        return static_cast<int>(tile) / columns;
    }
    bool operator==(const TileGrid&) const = default;
};

/// Returns the smallest grid for a number of tiles: 1 x 1, 2 x 1, 2 x 2, 4 x 2 or 4 x 4.
///
/// tiles  1..most_tiles
[[nodiscard]] constexpr TileGrid grid_of(std::size_t tiles) {
    TileGrid grid;
    while (grid.size() < tiles) (grid.columns == grid.rows ? grid.columns : grid.rows) *= 2;
    return grid;
}

/// The three images of an atlas of tiles before encoding.
class TiledImages {
  public:
    /// side    of a tile, texels
    /// throws  InvalidInput (path "/side") unless the side is one of paint() and no side of the
    ///         atlas exceeds largest_tiled_side
    TiledImages(TileGrid grid, int side);

    /// Copies a painting onto a tile.
    ///
    /// tile    below grid.size(), each at most once
    /// throws  InvalidInput (path "/side") if its images have another size than a tile
    void place(std::size_t tile, const RawImages& images);

    /// Encodes the images as paint() does, after it has given all free tiles the mean colour of
    /// the others, so that the smallest mipmaps do not change towards a colour of nothing.
    [[nodiscard]] ImageSet encoded(ImageFormat format, const Parallel& parallel = in_turn);

  private:
    void fill(std::size_t tile, std::size_t image, const std::array<std::uint8_t, 3>& colour);

    TileGrid grid_;
    std::size_t side_;
    std::array<Bytes, 3> rgb_;
    std::vector<bool> is_painted_;
    std::array<std::array<std::uint64_t, 3>, 3> sums_{};  ///< of all painted texels, by image
};

}  // namespace sporeprint
