#include "core/world/terrain_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/math/random.h"
#include "core/world/ground.h"
#include "core/world/height_field.h"
#include "core/world/terrain_params.h"
#include "tests/support/refusals.h"

namespace sporeprint::terrain_map_test {
namespace {

/// Returns a terrain whose heights are a function of x and y in metres, and of that what fits into its scale.
template <class Height>
TerrainMap terrain(const TerrainScale& scale, int side, const Height& height) {
    TerrainMap map{scale, side, {}};
    const double cell = scale.metres / (side - 1), half = 0.5 * scale.metres;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const double metres = height(column * cell - half, half - row * cell);
            const double share = (metres - scale.min) / (scale.max - scale.min);
            map.samples.push_back(
                static_cast<std::uint16_t>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0))));
        }
    return map;
}

/// The height of a node of the grid of a world, metres.
double at(const std::vector<std::int32_t>& heights, const Grid& grid, double x, double y) {
    const auto node = [&](double place) {
        return static_cast<int>(std::lround((place - grid.origin) / grid.cell));
    };
    return heights[grid.index(node(x), node(y))] / static_cast<double>(height_units);
}

constexpr double bit = 1.0 / height_units;

TEST(TerrainMap, HasItsSamplesWhereTheyLieOnNodes) {
    const Grid grid = world_grid(256);
    const TerrainScale scale{512 * grid.cell, -20.0, 43.0};
    Random random(3, 0);
    const TerrainMap map =
        terrain(scale, 513, [&](double, double) { return random.uniform(-20.0, 43.0); });
    const std::vector<std::int32_t> heights = heights_of(map, 256);
    ASSERT_EQ(heights.size(), grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const std::size_t from_north = static_cast<std::size_t>(512 - row) * 513;
            const double wanted =
                map.height(map.samples[from_north + static_cast<std::size_t>(column)]);
            ASSERT_NEAR(heights[grid.index(column, row)], wanted * height_units, 0.501);
        }
}

TEST(TerrainMap, OfASlopeIsThatSlopeHoweverFineItsSamplesAre) {
    const auto slope = [](double x, double y) { return 50.0 + 0.1 * x - 0.05 * y; };
    for (const int extent : {256, 1024, 4096}) {
        const Grid grid = world_grid(extent);
        for (const int side : {33, 257, 1025, 2049}) {
            const TerrainMap map = terrain({extent * 1.5, -1000.0, 1000.0}, side, slope);
            const std::vector<std::int32_t> heights = heights_of(map, extent);
            // A step of the samples is 3 cm; a kernel between them is out of balance by a part of a cell.
            const double tolerance = 0.06 + 0.02 * std::max(grid.cell, extent * 1.5 / (side - 1));
            for (const int column : {60, 256, 400})
                for (const int row : {70, 200, 450})
                    EXPECT_NEAR(heights[grid.index(column, row)] / double{height_units},
                                slope(grid.place(column), grid.place(row)), tolerance)
                        << extent << " m, " << side << " samples";
        }
    }
}

TEST(TerrainMap, IsMirroredAtItsRim) {
    const Grid grid = world_grid(256);
    const TerrainMap map = terrain({100.0, 0.0, 100.0}, 41, [](double x, double y) {
        return 50.0 + 0.3 * x + 5.0 * std::sin(0.2 * y);
    });
    const std::vector<std::int32_t> heights = heights_of(map, 256);
    for (const double beyond : {2.5, 10.0, 40.0, 100.0})
        for (const double y : {-30.0, 0.0, 20.0}) {
            EXPECT_NEAR(at(heights, grid, 50.0 + beyond, y), at(heights, grid, 50.0 - beyond, y),
                        2 * bit);
            EXPECT_NEAR(at(heights, grid, y, -50.0 - beyond), at(heights, grid, y, -50.0 + beyond),
                        2 * bit);
        }
}

TEST(TerrainMap, DoesNotMakeHillsOfDetailsThatTheGridCannotShow) {
    // Bumps of 2 m on a grid of 10 m.
    const TerrainMap map = terrain({2048.0, 0.0, 10.0}, 2049, [](double x, double y) {
        return 5.0 + 2.0 * std::sin(3.14159 * x + 0.4) * std::sin(3.14159 * y + 0.7);
    });
    const Grid grid = world_grid(4096);
    const std::vector<std::int32_t> heights = heights_of(map, 4096);
    double most = 0.0;
    for (const std::int32_t height : heights)
        most = std::max(most, std::abs(height / static_cast<double>(height_units) - 5.0));
    EXPECT_LT(most, 0.15);
    EXPECT_NEAR(at(heights, grid, 0.0, 0.0), 5.0, 0.1);
}

TEST(TerrainMap, ComesBackFromItsFile) {
    const TerrainMap map =
        terrain({300.0, -4.5, 61.25}, 17, [](double x, double y) { return 0.1 * x + 0.02 * y; });
    const Bytes file = file_of(map);
    EXPECT_EQ(terrain_in(file), map);
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{20}, std::size_t{40}, file.size() - 1})
        EXPECT_FALSE(terrain_in({file.data(), length})) << length;
    Bytes longer = file, other = file, wide = file;
    longer.push_back(0);
    other[0] ^= 1U;
    wide[file.size() - 2 * 17 * 17 - 4] = 18;
    EXPECT_FALSE(terrain_in(longer));
    EXPECT_FALSE(terrain_in(other));
    EXPECT_FALSE(terrain_in(wide));
}

TEST(TerrainMap, HasAnIdOfItsContent) {
    const auto some = [](double x, double) { return 0.1 * x; };
    const TerrainMap map = terrain({300.0, -40.0, 61.0}, 17, some);
    const std::string id = id_of(map);
    EXPECT_TRUE(is_terrain_id(id)) << id;
    EXPECT_EQ(id_of(terrain({300.0, -40.0, 61.0}, 17, some)), id);
    TerrainMap other = map;
    other.samples[100] ^= 1U;
    EXPECT_NE(id_of(other), id);
    for (double TerrainScale::*member :
         {&TerrainScale::metres, &TerrainScale::min, &TerrainScale::max}) {
        other = map;
        other.scale.*member += 1.0;
        EXPECT_NE(id_of(other), id);
    }
    TerrainMap zero = map, minus_zero = map;
    zero.scale.min = 0.0;
    minus_zero.scale.min = -0.0;
    EXPECT_EQ(id_of(zero), id_of(minus_zero));
}

TEST(TerrainMap, IdsHaveOneForm) {
    const std::string good = "t-0123456789abcdef0123456789abcdef";
    EXPECT_TRUE(is_terrain_id(good));
    for (const std::string& bad :
         {std::string(), std::string("t-"), good + "0", 's' + good.substr(1),
          good.substr(0, 33) + 'g', good.substr(0, 33) + 'A'})
        EXPECT_FALSE(is_terrain_id(bad)) << bad;
}

TEST(TerrainMap, MayBeFlat) {
    const TerrainMap map = terrain({256.0, 0.0, 1.0}, 33, [](double, double) { return 0.0; });
    EXPECT_TRUE(refusal([&] { check(map); }).empty());
    for (const std::int32_t height : heights_of(map, 256)) EXPECT_EQ(height, 0);
}

TEST(TerrainMap, IsRefusedIfItsWhiteIsNotAboveItsBlack) {
    TerrainMap map = terrain({256.0, 0.0, 1.0}, 33, [](double, double) { return 0.0; });
    map.scale.max = 0.0;
    EXPECT_TRUE(names(refusal([&] { check(map); }), "max", "not above min"));
}

TEST(TerrainMap, IsRefusedIfATwentiethOfItIsNearlyVertical) {
    // Walls of 100 m, a cell of a metre wide: 2 of 256 cells in the first, 16 in the second.
    const auto walls = [](int period) {
        return terrain({256.0, 0.0, 100.0}, 257, [=](double x, double) {
            return static_cast<int>(std::floor(x)) % period == 0 ? 100.0 : 0.0;
        });
    };
    EXPECT_TRUE(refusal([&] { check(walls(1000)); }).empty());
    EXPECT_TRUE(names(refusal([&] { check(walls(16)); }), "metres", "steeper than 80 degrees"));
    TerrainMap wider = walls(16);
    wider.scale.metres = 20'000.0;
    EXPECT_TRUE(refusal([&] { check(wider); }).empty());
}

TEST(TerrainMap, IsTheGroundOfAWorldThatNamesIt) {
    const auto hill = [](double x, double y) { return 40.0 * std::exp(-(x * x + y * y) / 4000.0); };
    const TerrainMap map = terrain({320.0, 0.0, 50.0}, 513, hill);
    WorldParams params;
    params.extent.value = 256;
    params.terrain.id = Text<34>(id_of(map));
    EXPECT_TRUE(names(refusal([&] { static_cast<void>(ground_of(params)); }), "terrain.id",
                      "upload it again"));
    const Ground ground = ground_of(params, &map);
    for (const double x : {-100.0, -20.0, 0.0, 33.3})
        for (const double y : {-64.0, 5.0, 90.0})
            EXPECT_NEAR(
                place_at(ground, coordinate_at(ground.grid, x), coordinate_at(ground.grid, y))
                    .height,
                hill(x, y), 0.02);
    // Its height is in it, the seed is not.
    WorldParams other = params;
    other.seed = 99;
    EXPECT_EQ(ground_key(other), ground_key(params));
    EXPECT_EQ(ground_of(other, &map).heights, ground.heights);
    other.extent.value = 1024;
    EXPECT_NE(ground_key(other), ground_key(params));
    other = params;
    other.terrain.id = {};
    EXPECT_NE(ground_key(other), ground_key(params));
}

}  // namespace
}  // namespace sporeprint::terrain_map_test
