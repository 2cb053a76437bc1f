#include "core/surface/image_tiles.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/surface/codecs.h"
#include "tests/support/refusals.h"

namespace sporeprint::surface_image_tiles_test {
namespace {

/// Returns images of one colour each.
RawImages flat(int side, const std::array<std::uint8_t, 3>& base_color) {
    RawImages images;
    images.side = side;
    const std::array<std::array<std::uint8_t, 3>, 3> colours = {
        base_color, {128, 128, 255}, {255, 90, 0}};
    for (std::size_t image = 0; image < 3; ++image)
        for (int i = 0; i < side * side; ++i)
            images.rgb[image].insert(images.rgb[image].end(), colours[image].begin(),
                                     colours[image].end());
    return images;
}

TEST(ImageTiles, GridsAreTheSmallestWithPowersOfTwoAsSides) {
    const auto sides = [](std::size_t tiles) {
        const TileGrid grid = grid_of(tiles);
        return std::to_string(grid.columns) + 'x' + std::to_string(grid.rows);
    };
    std::vector<std::string> found;
    for (std::size_t tiles = 1; tiles <= most_tiles; ++tiles) found.push_back(sides(tiles));
    EXPECT_EQ(found,
              (std::vector<std::string>{"1x1", "2x1", "2x2", "2x2", "4x2", "4x2", "4x2", "4x2",
                                        "4x4", "4x4", "4x4", "4x4", "4x4", "4x4", "4x4", "4x4"}));
}

TEST(ImageTiles, EachPaintingIsWhereItsTileIsUpToTheBorder) {
    constexpr int side = 16;
    const std::array<std::array<std::uint8_t, 3>, 5> colours = {
        {{200, 40, 30}, {20, 180, 60}, {30, 60, 200}, {240, 240, 240}, {10, 10, 10}}};
    const TileGrid grid = grid_of(colours.size());
    TiledImages images(grid, side);
    for (std::size_t tile = 0; tile < colours.size(); ++tile)
        images.place(tile, flat(side, colours[tile]));
    for (const ImageFormat format : {ImageFormat::jpg, ImageFormat::webp}) {
        const ImageSet set = images.encoded(format);
        EXPECT_EQ(set.format, format);
        const Slice& file = set.files[0];
        const Picture picture = decoded_picture({file.data(), file.size}, "/image");
        ASSERT_EQ(picture.width, grid.columns * side);
        ASSERT_EQ(picture.height, grid.rows * side);
        // Blocks of JPEG end with tiles, but decoders interpolate chroma of half the resolution
        // across a texel of their borders; WebP smooths the edges of its blocks.
        const bool is_jpg = format == ImageFormat::jpg;
        const int inset = is_jpg ? 1 : 4, most_off = is_jpg ? 8 : 16;
        for (std::size_t tile = 0; tile < colours.size(); ++tile)
            for (int y = inset; y < side - inset; ++y)
                for (int x = inset; x < side - inset; ++x)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const int row = grid.row_of(tile) * side + y,
                                  column = grid.column_of(tile) * side + x;
                        const int found =
                            picture.rgb[3 * static_cast<std::size_t>(row * picture.width + column) +
                                        c];
                        ASSERT_LE(std::abs(found - colours[tile][c]), most_off)
                            << name(format) << " tile " << tile << " at " << x << ", " << y;
                    }
        // Free tiles have the mean colour.
        const std::size_t last =
            3 * static_cast<std::size_t>((grid.rows * side - side / 2) * picture.width - side / 2);
        EXPECT_NEAR(picture.rgb[last], (200 + 20 + 30 + 240 + 10) / 5, most_off);
        EXPECT_NEAR(picture.rgb[last + 1], (40 + 180 + 60 + 240 + 10) / 5, most_off);
    }
}

TEST(ImageTiles, SidesThatDoNotFitAreRefused) {
    EXPECT_TRUE(names(refusal([] { TiledImages(grid_of(16), 2048); }), "/side", "4096"));
    EXPECT_TRUE(names(refusal([] { TiledImages(grid_of(4), 100); }), "/side", "100"));
    TiledImages images(grid_of(2), 32);
    EXPECT_TRUE(names(refusal([&] { images.place(1, flat(16, {1, 2, 3})); }), "/side", "32"));
}

}  // namespace
}  // namespace sporeprint::surface_image_tiles_test
