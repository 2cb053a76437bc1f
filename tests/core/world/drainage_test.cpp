#include "core/world/drainage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <vector>

#include "core/math/elementary.h"
#include "core/problems.h"

namespace sporeprint::world_drainage_test {
namespace {

Grid grid_of(int side, double cell) { return {side, cell, 0.0}; }

/// Returns heights of a function of column and row, metres.
std::vector<std::int32_t> ground(const Grid& grid,
                                 const std::function<double(int column, int row)>& height) {
    std::vector<std::int32_t> heights(grid.nodes());
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            heights[grid.index(column, row)] = quantised_height(height(column, row));
    return heights;
}

/// Returns rough ground with many depressions.
std::vector<std::int32_t> rough_world(std::uint32_t seed) {
    return heights_of({.relief = 100.0, .feature = 150.0, .roughness = 0.6}, seed, 1024);
}

bool is_border(const Grid& grid, int column, int row) {
    return column == 0 || row == 0 || column == grid.side - 1 || row == grid.side - 1;
}

TEST(Flood, LeadsEveryNodeDownToTheBorder) {
    const Grid grid = world_grid(1024);
    const std::vector<std::int32_t> before = rough_world(1);
    const FloodedGround after = flooded(grid, before);
    std::size_t raised = 0;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column) {
            const std::size_t i = grid.index(column, row);
            ASSERT_GE(after.heights[i], before[i]);
            raised += after.heights[i] > before[i] ? 1U : 0U;
            if (is_border(grid, column, row)) {
                ASSERT_EQ(after.heights[i], before[i]);
                continue;
            }
            // A lower neighbour at every node is a descending path from every node, as there is no
            // end to it but the border.
            bool descends = false;
            for (int north = -1; north <= 1; ++north)
                for (int east = -1; east <= 1; ++east)
                    descends = descends || after.heights[grid.index(column + east, row + north)] <
                                               after.heights[i];
            ASSERT_TRUE(descends) << column << ", " << row;
        }
    EXPECT_GT(raised, 1000U) << "the ground had depressions";
    EXPECT_LT(raised, grid.nodes() / 2);
}

TEST(Flood, OrdersNodesByHeightAndIndex) {
    const FloodedGround after = flooded(world_grid(1024), rough_world(2));
    ASSERT_EQ(after.order.size(), after.heights.size());
    for (std::size_t rank = 1; rank < after.order.size(); ++rank) {
        const std::uint32_t a = after.order[rank - 1], b = after.order[rank];
        ASSERT_TRUE(after.heights[a] < after.heights[b] ||
                    (after.heights[a] == after.heights[b] && a < b));
    }
}

TEST(Flood, ChangesNothingThatDrains) {
    const Grid grid = world_grid(1024);
    const FloodedGround once = flooded(grid, rough_world(3));
    const FloodedGround again = flooded(grid, once.heights);
    EXPECT_EQ(again.heights, once.heights);
    EXPECT_EQ(again.order, once.order);
    const std::vector<std::int32_t> cone = ground(
        grid_of(65, 2.0), [](int x, int y) { return 50.0 - std::hypot(x - 32.0, y - 32.0); });
    EXPECT_EQ(flooded(grid_of(65, 2.0), cone).heights, cone);
}

// Level ground with a wall round it, and a gap in the wall: water rises to the gap, and 1 to 6 units
// more for each node on the way to it.
TEST(Flood, FillsADepressionToItsOutletPlusTheGradient) {
    const Grid grid = grid_of(21, 1.0);
    const auto heights = ground(grid, [](int x, int y) {
        const int ring = std::min({x, y, 20 - x, 20 - y});
        if (ring == 0) return 0.0;
        if (ring == 1) return x == 1 && y == 10 ? 3.0 : 8.0;
        return 1.0;
    });
    const FloodedGround after = flooded(grid, heights);
    for (int y = 2; y <= 18; ++y)
        for (int x = 2; x <= 18; ++x) {
            // Steps to the gap at (1, 10), diagonal ones included.
            const int distance = std::max(x - 1, std::abs(y - 10));
            const int rise = after.heights[grid.index(x, y)] - 3 * height_units;
            EXPECT_GE(rise, distance);
            EXPECT_LE(rise, 6 * distance);
        }
    EXPECT_EQ(after.heights[grid.index(1, 10)], 3 * height_units);
    EXPECT_EQ(after.heights[grid.index(1, 9)], 8 * height_units);
}

TEST(Flood, LevelGroundRisesFromTheBorder) {
    const Grid grid = grid_of(9, 1.0);
    const FloodedGround after = flooded(grid, std::vector<std::int32_t>(grid.nodes(), -5));
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) {
            const int distance = std::min({x, y, 8 - x, 8 - y});
            EXPECT_GE(after.heights[grid.index(x, y)], -5 + distance);
            EXPECT_LE(after.heights[grid.index(x, y)], -5 + 6 * distance);
        }
}

TEST(Catchments, WhatRainsRunsOffAtTheBorder) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const Grid grid = world_grid(1024);
        const std::vector<double> areas = catchments(grid, flooded(grid, rough_world(seed)));
        double leaves = 0.0;
        for (int row = 0; row < grid.side; ++row)
            for (int column = 0; column < grid.side; ++column) {
                ASSERT_GE(areas[grid.index(column, row)], grid.cell * grid.cell);
                if (is_border(grid, column, row)) leaves += areas[grid.index(column, row)];
            }
        const double whole = static_cast<double>(grid.nodes()) * grid.cell * grid.cell;
        EXPECT_NEAR(leaves / whole, 1.0, 1e-9);
    }
}

// Downhill is to the west. Water of the rows near the sides also leaves there, so that the middle one
// is looked at.
TEST(Catchments, GrowLinearlyDownAPlane) {
    const Grid grid = grid_of(257, 4.0);
    const FloodedGround plane = flooded(grid, ground(grid, [](int x, int) { return 0.5 * x; }));
    const std::vector<double> areas = catchments(grid, plane);
    for (const int distance : {1, 2, 5, 20, 60})
        EXPECT_NEAR(areas[grid.index(256 - distance, 128)], distance * 16.0, 1e-9);
}

// Nearly all water of both slopes passes the end of a valley; the rest leaves beside it.
TEST(Catchments, OfAValleyAreItsSlopes) {
    const Grid grid = grid_of(101, 1.0);
    const FloodedGround valley =
        flooded(grid, ground(grid, [](int x, int y) { return 2.0 * std::abs(x - 50) + 0.01 * y; }));
    const std::vector<double> areas = catchments(grid, valley);
    EXPECT_GT(areas[grid.index(50, 0)], 0.9 * 101.0 * 101.0);
    EXPECT_LT(areas[grid.index(45, 50)], 60.0);
}

// [ln(x / tan(beta))] of the distance x to the upper border, within a hundredth (world.md 9.7).
TEST(Wetness, OfAPlaneIsThatOfTheFormula) {
    for (const double slope : {0.02, 0.1, 0.5})
        for (const double cell : {0.625, 2.5, 10.0}) {
            const Grid grid = grid_of(513, cell);
            const FloodedGround plane =
                flooded(grid, ground(grid, [&](int x, int) { return slope * cell * (x - 256); }));
            const std::vector<std::uint16_t> index =
                wetness_index(grid, plane, catchments(grid, plane));
            // The roundings of small drops are not what is tested.
            for (int distance = 8; distance <= 128; distance += 8) {
                const double expected = std::log(distance * cell / slope);
                EXPECT_NEAR(wetness_of(index[grid.index(512 - distance, 256)]), expected,
                            0.01 * expected + (slope * cell < 0.05 ? 0.02 : 0.0))
                    << slope << " " << cell << " " << distance;
            }
        }
}

TEST(Wetness, HasALeastSlope) {
    const Grid grid = grid_of(65, 10.0);
    const FloodedGround level = flooded(grid, std::vector<std::int32_t>(grid.nodes(), 0));
    const std::vector<double> areas = catchments(grid, level);
    const std::vector<std::uint16_t> index = wetness_index(grid, level, areas);
    // The outermost node of the middle row: one cell of contour and the least slope.
    const std::size_t middle = grid.index(0, 32);
    EXPECT_NEAR(wetness_of(index[middle]), std::log(areas[middle] / 10.0 / least_slope), 1e-3);
}

TEST(Wetness, IsHigherInValleysThanOnRidges) {
    const Grid grid = world_grid(1024);
    const FloodedGround after = flooded(grid, rough_world(5));
    const std::vector<double> areas = catchments(grid, after);
    const std::vector<std::uint16_t> index = wetness_index(grid, after, areas);
    double valleys = 0.0, ridges = 0.0;
    std::size_t in_valleys = 0, on_ridges = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        const double twi = wetness_of(index[i]);
        ASSERT_GT(twi, -4.0);
        ASSERT_LT(twi, 22.0) << "fits the fixed point with room on both sides";
        if (areas[i] > stream_catchment) {
            valleys += twi;
            ++in_valleys;
        } else if (areas[i] < 10.0) {
            ridges += twi;
            ++on_ridges;
        }
    }
    ASSERT_GT(in_valleys, 100U);
    ASSERT_GT(on_ridges, 100U);
    EXPECT_GT(valleys / static_cast<double>(in_valleys),
              ridges / static_cast<double>(on_ridges) + 4.0);
}

TEST(Streams, BeginAtTwoHectares) {
    const std::vector<double> areas = {19999.0, 20000.0, 20001.0};
    EXPECT_EQ(streams(areas), (std::vector<std::uint8_t>{0, 0, 1}));
}

TEST(Streams, ReachTheBorder) {
    const Grid grid = world_grid(1024);
    const FloodedGround after = flooded(grid, rough_world(6));
    const std::vector<std::uint8_t> found = streams(catchments(grid, after));
    std::size_t count = 0, at_border = 0;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            if (found[grid.index(column, row)] != 0) {
                ++count;
                at_border += is_border(grid, column, row) ? 1U : 0U;
            }
    EXPECT_GT(at_border, 3U);
    EXPECT_GT(count, 10 * at_border);
    EXPECT_LT(count, grid.nodes() / 10);
}

TEST(Drainage, RefusesValuesThatDoNotFitTheGrid) {
    const std::vector<std::int32_t> nine(9);
    EXPECT_THROW(static_cast<void>(flooded(grid_of(4, 1.0), nine)), InvalidInput);
    EXPECT_THROW(static_cast<void>(flooded(grid_of(2, 1.0), std::vector<std::int32_t>(4))),
                 InvalidInput);
    const FloodedGround small = flooded(grid_of(3, 1.0), nine);
    EXPECT_THROW(static_cast<void>(catchments(grid_of(4, 1.0), small)), InvalidInput);
    EXPECT_THROW(static_cast<void>(wetness_index(grid_of(3, 1.0), small, std::vector<double>(8))),
                 InvalidInput);
}

}  // namespace
}  // namespace sporeprint::world_drainage_test
