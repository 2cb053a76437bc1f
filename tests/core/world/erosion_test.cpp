#include "core/world/erosion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/problems.h"
#include "core/world/drainage.h"

namespace sporeprint::world_erosion_test {
namespace {

double range_of(const std::vector<std::int32_t>& heights) {
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    return (*high - *low) / static_cast<double>(height_units);
}

TEST(Erosion, OfStrengthZeroChangesNoBit) {
    const std::vector<std::int32_t> before = heights_of({}, 1, 256);
    EXPECT_EQ(eroded(world_grid(256), before, 0.0), before);
}

TEST(Erosion, LeavesLevelGroundLevel) {
    const std::vector<std::int32_t> before(world_grid(256).nodes(), -3);
    EXPECT_EQ(eroded(world_grid(256), before, 1.0), before);
}

TEST(Erosion, IsTheSameTwice) {
    const std::vector<std::int32_t> before = heights_of({}, 2, 1024);
    EXPECT_EQ(eroded(world_grid(1024), before, 0.2), eroded(world_grid(1024), before, 0.2));
}

// Sediment only fills what was under water.
TEST(Erosion, RaisesNothingButDepressions) {
    const Grid grid{129, 2.0, 0.0};
    const Grid coarse = erosion_grid(grid);
    std::vector<std::int32_t> cone(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            cone[grid.index(column, row)] =
                quantised_height(60.0 - 0.5 * std::hypot(column - 64.0, row - 64.0));
    for (const double change : erosion_change(grid, cone, 0.3)) ASSERT_LE(change, 0.0);
    // A pit in the top of the cone.
    for (int row = 60; row <= 68; ++row)
        for (int column = 60; column <= 68; ++column)
            cone[grid.index(column, row)] -= 10 * height_units;
    const std::vector<double> change = erosion_change(grid, cone, 0.3);
    EXPECT_GT(change[coarse.index(32, 32)], 1.0);
    EXPECT_LT(change[coarse.index(20, 32)], 0.0);
}

// A slope of one in five that falls to the west, with a shallow hollow along its middle: water
// gathers there, and cuts it deeper than the slope on both sides.
TEST(Erosion, CutsChannelsDeeperThanSlopes) {
    const Grid grid{257, 2.0, 0.0};
    const Grid coarse = erosion_grid(grid);
    std::vector<std::int32_t> hollow(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            hollow[grid.index(column, row)] =
                quantised_height(0.4 * column + 0.05 * std::abs(row - 128));
    for (const double strength : {0.1, 0.3}) {
        const std::vector<double> change = erosion_change(grid, hollow, strength);
        for (const int column : {20, 40, 60}) {
            const double channel = change[coarse.index(column, 64)];
            EXPECT_LT(channel, 1.5 * change[coarse.index(column, 44)]) << strength << " " << column;
            EXPECT_LT(channel, 1.5 * change[coarse.index(column, 84)]) << strength << " " << column;
            EXPECT_LT(channel, -0.5) << "metres";
        }
    }
}

// All rows of a plane are alike, but near the sides, where water leaves.
TEST(Erosion, OfAPlaneIsEvenAlongItsContour) {
    const Grid grid{257, 2.0, 0.0};
    std::vector<std::int32_t> plane(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            plane[grid.index(column, row)] = 300 * column;
    const Grid coarse = erosion_grid(grid);
    const std::vector<double> change = erosion_change(grid, plane, 0.1);
    for (int column = 1; column + 1 < coarse.side; ++column)
        for (int row = 50; row <= 78; ++row)
            ASSERT_NEAR(change[coarse.index(column, row)], change[coarse.index(column, 64)], 0.01)
                << column << " " << row;
    // At the foot water gathers, so that the ground is lowered more.
    EXPECT_LT(change[coarse.index(30, 64)], 1.02 * change[coarse.index(120, 64)]);
}

TEST(Erosion, OfGreaterStrengthMovesMore) {
    const Grid grid = world_grid(1024);
    const std::vector<std::int32_t> before = heights_of({}, 5, 1024);
    double moved = 0.0;
    for (const double strength : {0.02, 0.1, 0.3, 0.6}) {
        double sum = 0.0;
        for (const double change : erosion_change(grid, before, strength)) sum += std::abs(change);
        EXPECT_GT(sum, 1.05 * moved) << strength;
        moved = sum;
    }
}

TEST(Erosion, DrainsDepressions) {
    const Grid grid = world_grid(1024);
    const std::vector<std::int32_t> before = heights_of({}, 6, 1024);
    const auto volume_of_water = [&](const std::vector<std::int32_t>& heights) {
        const FloodedGround water = flooded(grid, heights);
        double sum = 0.0;
        for (std::size_t i = 0; i < heights.size(); ++i) sum += water.heights[i] - heights[i];
        return sum;
    };
    EXPECT_LT(volume_of_water(eroded(grid, before, 0.5)), 0.1 * volume_of_water(before));
}

TEST(Erosion, KeepsTheRangeOfHeights) {
    double before = 0.0, after = 0.0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const std::vector<std::int32_t> heights = heights_of({}, seed, 1024);
        before += range_of(heights);
        after += range_of(eroded(world_grid(1024), heights, 0.5));
    }
    EXPECT_GT(after / before, 0.75);
    EXPECT_LT(after / before, 1.1);
}

TEST(Interpolation, PassesThroughItsNodesAndKeepsPlanes) {
    const Grid grid{33, 1.0, 0.0};
    const Grid coarse = erosion_grid(grid);
    std::vector<double> plane(coarse.nodes()), rough(coarse.nodes());
    for (int row = 0; row < coarse.side; ++row)
        for (int column = 0; column < coarse.side; ++column) {
            plane[coarse.index(column, row)] = 3.0 * column - 2.0 * row + 1.0;
            rough[coarse.index(column, row)] = (column * 7 + row * 13) % 11;
        }
    const std::vector<double> fine = interpolated(grid, plane);
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            EXPECT_NEAR(fine[grid.index(column, row)], 1.5 * column - row + 1.0, 1e-12);
    const std::vector<double> other = interpolated(grid, rough);
    for (int row = 0; row < coarse.side; ++row)
        for (int column = 0; column < coarse.side; ++column)
            EXPECT_EQ(other[grid.index(2 * column, 2 * row)], rough[coarse.index(column, row)]);
}

// Halfway between nodes the spline is exact for cubics, but next to the border, where it continues
// linearly.
TEST(Interpolation, IsExactForCubics) {
    const Grid grid{33, 1.0, 0.0};
    const Grid coarse = erosion_grid(grid);
    const auto cubic = [](double x) { return x * x * x - 4.0 * x * x + 3.0 * x; };
    std::vector<double> values(coarse.nodes());
    for (int row = 0; row < coarse.side; ++row)
        for (int column = 0; column < coarse.side; ++column)
            values[coarse.index(column, row)] = cubic(column) + cubic(row);
    const std::vector<double> fine = interpolated(grid, values);
    for (int row = 2; row < grid.side - 2; ++row)
        for (int column = 2; column < grid.side - 2; ++column)
            EXPECT_NEAR(fine[grid.index(column, row)], cubic(0.5 * column) + cubic(0.5 * row),
                        1e-9);
}

TEST(Erosion, RefusesWhatItCannotErode) {
    const std::vector<std::int32_t> heights(36);
    EXPECT_THROW(static_cast<void>(eroded({6, 1.0, 0.0}, heights, 0.5)), InvalidInput);
    EXPECT_THROW(static_cast<void>(eroded({5, 1.0, 0.0}, heights, 0.5)), InvalidInput);
    const std::vector<std::int32_t> fitting(25);
    EXPECT_THROW(static_cast<void>(eroded({5, 1.0, 0.0}, fitting, 1.5)), InvalidInput);
    EXPECT_THROW(static_cast<void>(eroded({5, 1.0, 0.0}, fitting, std::nan(""))), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::world_erosion_test
