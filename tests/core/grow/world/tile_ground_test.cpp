#include "core/grow/world/tile_ground.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "core/grow/world/plot_of_world.h"
#include "core/grow/world/tiling.h"
#include "core/surface/codecs.h"
#include "tests/support/meshes.h"
#include "tests/support/worlds.h"

namespace sporeprint::grow_world_tile_ground_test {
namespace {

const World& land(const char* preset) {
    static std::map<std::string, World> worlds;
    const auto found = worlds.find(preset);
    if (found != worlds.end()) return found->second;
    return worlds.emplace(preset, world_over_its_ground(small_world(preset))).first->second;
}

PlotContent content(const World& world, double size) {
    return content_of(world, {0.5 * size, -0.5 * size, size}, time_of(80, 190));
}

std::array<double, 3> mean_colour(const RawImages& images) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < images.rgb[0].size(); ++i) sum[i % 3] += images.rgb[0][i];
    for (double& value : sum) value /= static_cast<double>(images.side) * images.side;
    return sum;
}

TEST(TileGround, IsAClosedSlabOfTheSameNumberOfVertices) {
    const World& world = land("mixed");
    std::size_t vertices = 0;
    for (const double size : {8.0, 64.0, 256.0}) {
        PlotContent of = content(world, size);
        of.centre = {};
        const FloorHeights floor(*world.ground, of.seed, of.micro, {});
        const Mesh slab = TileGround(world, of).slab(floor, 0.0);
        expect_valid(slab);
        if (vertices == 0) vertices = slab.positions.size();
        EXPECT_EQ(slab.positions.size(), vertices);
    }
}

TEST(TileGround, OfTheWholeWorldHasCrownsWhereTreesAre) {
    const auto top = [](const char* preset) {
        const World& world = land(preset);
        PlotContent of = content(world, 256.0);
        of.centre = {};
        const FloorHeights floor(*world.ground, of.seed, of.micro, {});
        const Mesh slab = TileGround(world, of).slab(floor, 0.0);
        double above = 0.0;
        const auto nodes = static_cast<std::size_t>(tile_nodes);
        for (std::size_t i = 0; i < nodes * nodes; ++i) {
            const glm::vec3 at = slab.positions[i];
            above += static_cast<double>(at.y) -
                     floor.at(static_cast<double>(at.x), -static_cast<double>(at.z));
        }
        return above / static_cast<double>(nodes * nodes);
    };
    EXPECT_GT(top("beech"), 10.0);
    EXPECT_NEAR(top("meadow"), 0.0, 1.0);
}

TEST(TileGround, FromAfarWoodsAreGreenInSummerAndBrownInWinter) {
    const World& world = land("beech");
    PlotContent summer = content(world, 256.0);
    summer.centre = {};
    PlotContent winter = summer;
    winter.time = time_of(80, 15);
    const std::array<double, 3> green = mean_colour(TileGround(world, summer).images(atlas())),
                                brown = mean_colour(TileGround(world, winter).images(atlas()));
    EXPECT_GT(green[1], 1.1 * green[0]);
    EXPECT_GT(brown[0], brown[1]);
    EXPECT_GT(brown[1], brown[2]);
}

TEST(TileGround, FromAfarSnowMakesNeedlesPaler) {
    const World& world = land("spruce");
    PlotContent of = content(world, 256.0);
    of.centre = {};
    double last = 0.0;
    for (const double snow : {0.0, 0.5, 1.0}) {
        of.snow = snow;
        const double blue = mean_colour(TileGround(world, of).images(atlas()))[2];
        EXPECT_GT(blue, last + 10.0) << snow;
        last = blue;
    }
    // Even a wood that is snowed in is darker than open snow.
    EXPECT_LT(last, 220.0);
}

TEST(TileGround, HasSmallerImagesOfReliefAndGlossAndNoneFromAfar) {
    const World& world = land("mixed");
    for (const double size : {8.0, 16.0, 64.0, 128.0}) {
        PlotContent of = content(world, size);
        of.centre = {};
        TileGround ground(world, of);
        const TileTexels texels = texels_of_tile(size);
        const ImageSet files = ground.files(atlas());
        const std::array sides{texels.colour, texels.normal, texels.orm};
        for (std::size_t i = 0; i < sides.size(); ++i) {
            if (sides[i] == 0) {
                EXPECT_EQ(files.files[i].size, 0U);
                continue;
            }
            const Slice& file = files.files[i];
            const Picture picture = decoded_picture({file.data(), file.size}, "");
            EXPECT_EQ(picture.width, sides[i]);
            EXPECT_EQ(picture.height, sides[i]);
        }
        EXPECT_EQ(texels.normal > 0, size <= 64.0);
        // Relief is a mean of four texels, so that it leans as the one that was painted.
        if (texels.normal == 0) continue;
        const RawImages painted = ground.images(atlas());
        const Picture normals = decoded_picture({files.files[1].data(), files.files[1].size}, "");
        double difference = 0.0;
        for (int row = 0; row < normals.height; ++row)
            for (int column = 0; column < normals.width; ++column)
                for (int k = 0; k < 2; ++k) {
                    const auto texel = [&](int x, int y) {
                        return static_cast<double>(
                            painted
                                .rgb[1][static_cast<std::size_t>(3 * (y * painted.side + x) + k)]);
                    };
                    const int x = 2 * column, y = 2 * row;
                    const double mean = 0.25 * (texel(x, y) + texel(x + 1, y) + texel(x, y + 1) +
                                                texel(x + 1, y + 1));
                    difference += std::abs(mean - normals.rgb[static_cast<std::size_t>(
                                                      3 * (row * normals.width + column) + k)]);
                }
        EXPECT_LT(difference / (2.0 * normals.width * normals.height), 6.5) << size;
    }
}

TEST(TileGround, HasHeightsOnALatticeThatFitsInto16Bits) {
    const World& world = land("mixed");
    for (const double size : {8.0, 32.0, 256.0}) {
        PlotContent of = content(world, size);
        of.centre = {};
        const FloorHeights floor(*world.ground, of.seed, of.micro, {});
        const double step = step_of_tile(size);
        const Mesh slab = TileGround(world, of).slab(floor, 3.0);
        for (std::size_t i = 0; i < 33 * 33; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const double number = static_cast<double>(slab.positions[i][axis]) / step;
                EXPECT_EQ(number, std::floor(number));
            }
        EXPECT_GE(32767.0 * step, 0.99 * size) << "as high as it is wide";
    }
}

TEST(TileGround, LooksAlikeFromNearAndFromAfar) {
    const World& world = land("meadow");
    const std::array<double, 3> near = mean_colour(
                                    TileGround(world, content(world, 8.0)).images(atlas())),
                                far = mean_colour(
                                    TileGround(world, content(world, 16.0)).images(atlas()));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(near[k], far[k], 30.0) << k;
}

}  // namespace
}  // namespace sporeprint::grow_world_tile_ground_test
