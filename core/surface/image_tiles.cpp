#include "core/surface/image_tiles.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "core/problems.h"
#include "core/surface/canvas.h"

namespace sporeprint {

TiledImages::TiledImages(TileGrid grid, int side)
    : grid_(grid), side_(static_cast<std::size_t>(side)), is_painted_(grid.size(), false) {
    if (!proper_side(side) || std::max(grid.columns, grid.rows) * side > largest_tiled_side)
        throw InvalidInput("/side", std::to_string(grid.columns) + " x " +
                                        std::to_string(grid.rows) + " tiles of " +
                                        std::to_string(side) + " texels; a side is at most " +
                                        std::to_string(largest_tiled_side));
    for (Bytes& image : rgb_) image.resize(3 * grid_.size() * side_ * side_);
}

void TiledImages::place(std::size_t tile, const RawImages& images) {
    if (static_cast<std::size_t>(images.side) != side_)
        throw InvalidInput("/side", "a painting of " + std::to_string(images.side) +
                                        " texels; the side of a tile is " + std::to_string(side_));
    const std::size_t row_bytes = 3 * side_,
                      atlas_row_bytes = row_bytes * static_cast<std::size_t>(grid_.columns),
                      left = row_bytes * static_cast<std::size_t>(grid_.column_of(tile)),
                      top = side_ * static_cast<std::size_t>(grid_.row_of(tile));
    for (std::size_t image = 0; image < rgb_.size(); ++image) {
        const Bytes& from = images.rgb[image];
        for (std::size_t y = 0; y < side_; ++y)
            std::memcpy(&rgb_[image][(top + y) * atlas_row_bytes + left], &from[y * row_bytes],
                        row_bytes);
        for (std::size_t at = 0; at < from.size(); at += 3)
            for (std::size_t c = 0; c < 3; ++c) sums_[image][c] += from[at + c];
    }
    is_painted_[tile] = true;
}

void TiledImages::fill(std::size_t tile, std::size_t image,
                       const std::array<std::uint8_t, 3>& colour) {
    const std::size_t columns = static_cast<std::size_t>(grid_.columns),
                      left = side_ * static_cast<std::size_t>(grid_.column_of(tile)),
                      top = side_ * static_cast<std::size_t>(grid_.row_of(tile));
    for (std::size_t y = top; y < top + side_; ++y)
        for (std::size_t x = left; x < left + side_; ++x)
            std::memcpy(&rgb_[image][3 * (y * columns * side_ + x)], colour.data(), 3);
}

ImageSet TiledImages::encoded(ImageFormat format, const Parallel& parallel) {
    const auto painted =
        static_cast<std::uint64_t>(std::count(is_painted_.begin(), is_painted_.end(), true));
    for (std::size_t image = 0; painted > 0 && image < rgb_.size(); ++image) {
        const std::uint64_t texels = painted * side_ * side_;
        std::array<std::uint8_t, 3> mean{};
        for (std::size_t c = 0; c < 3; ++c)
            mean[c] = static_cast<std::uint8_t>((sums_[image][c] + texels / 2) / texels);
        for (std::size_t tile = 0; tile < is_painted_.size(); ++tile)
            if (!is_painted_[tile]) fill(tile, image, mean);
    }
    const int side = static_cast<int>(side_);
    return sporeprint::encoded({rgb_[0], rgb_[1], rgb_[2]}, grid_.columns * side, grid_.rows * side,
                               format, parallel);
}

}  // namespace sporeprint
