#include "core/world/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/world/drainage.h"
#include "core/world/weather.h"

namespace sporeprint::world_ground_test {
namespace {

Place place_at(const Ground& ground, double x, double y) {
    return sporeprint::place_at(ground, coordinate_at(ground.grid, x),
                                coordinate_at(ground.grid, y));
}

double wetness_index_at(const Ground& ground, double x, double y) {
    return sporeprint::wetness_index_at(ground, coordinate_at(ground.grid, x),
                                        coordinate_at(ground.grid, y));
}

double stream_at(const Ground& ground, double x, double y) {
    return sporeprint::stream_at(ground, coordinate_at(ground.grid, x),
                                 coordinate_at(ground.grid, y));
}

/// Returns ground on a plane, as if it were that of a world of 256 m.
Ground plane(double rise_east, double rise_north) {
    Ground ground;
    ground.grid = world_grid(256);
    for (int row = 0; row < ground.grid.side; ++row)
        for (int column = 0; column < ground.grid.side; ++column)
            ground.heights.push_back(quantised_height(rise_east * ground.grid.place(column) +
                                                      rise_north * ground.grid.place(row)));
    return ground;
}

const Ground& hills() {
    static const Ground made = [] {
        WorldParams params;
        params.seed = 7;
        return ground_of(params);
    }();
    return made;
}

TEST(Ground, OfAPlaneHasItsHeightAndRiseEverywhere) {
    const Ground ground = plane(0.25, -0.5);
    for (const double x : {-128.0, -100.3, 0.0, 17.77, 128.0})
        for (const double y : {-128.0, -3.1, 64.0, 128.0}) {
            const Place place = place_at(ground, x, y);
            // Heights are rounded to 1/1024 m, five eighths of a metre apart.
            EXPECT_NEAR(place.height, 0.25 * x - 0.5 * y, 1.5 / height_units);
            EXPECT_NEAR(place.east, 0.25, 0.005);
            EXPECT_NEAR(place.north, -0.5, 0.005);
        }
}

TEST(Ground, HasTheHeightsOfItsNodes) {
    const Grid& grid = hills().grid;
    for (int row = 60; row < grid.side - 60; row += 37)
        for (int column = 60; column < grid.side - 60; column += 41)
            EXPECT_EQ(place_at(hills(), grid.place(column), grid.place(row)).height,
                      static_cast<double>(hills().heights[grid.index(column, row)]) / height_units);
}

TEST(Ground, RisesAsItsHeightsDo) {
    constexpr double step = 1e-4;
    for (double x = -500.0; x < 500.0; x += 61.7)
        for (double y = -500.0; y < 500.0; y += 83.3) {
            const Place place = place_at(hills(), x, y);
            EXPECT_NEAR(
                (place_at(hills(), x + step, y).height - place_at(hills(), x - step, y).height) /
                    (2.0 * step),
                place.east, 1e-4);
            EXPECT_NEAR(
                (place_at(hills(), x, y + step).height - place_at(hills(), x, y - step).height) /
                    (2.0 * step),
                place.north, 1e-4);
        }
}

TEST(Ground, LiesWithinItsBounds) {
    WorldParams steep;
    steep.terrain.relief = 600.0;
    steep.terrain.feature = 60.0;
    steep.terrain.roughness = 0.7;
    const Ground wild = ground_of(steep);
    for (const Ground* ground : {&hills(), &wild})
        for (double x = -512.0; x <= 512.0; x += 3.7)
            for (double y = -512.0; y <= 512.0; y += 5.3) {
                const double height = place_at(*ground, x, y).height;
                ASSERT_GE(height, ground->lowest);
                ASSERT_LE(height, ground->highest);
            }
    WorldParams level;
    level.terrain.relief = 0.0;
    const Ground flat = ground_of(level);
    EXPECT_EQ(place_at(flat, 12.0, -3.0).height, 0.0);
    EXPECT_LT(flat.lowest, flat.highest);
}

TEST(Ground, IsWetterWhereMoreWaterDrainsThrough) {
    const double wet = hills().mean_wetness + 2.0, dry = hills().mean_wetness - 2.0;
    EXPECT_GT(wetness_on(hills(), wet, 60.0), wetness_on(hills(), dry, 60.0));
    EXPECT_DOUBLE_EQ(wetness_on(hills(), hills().mean_wetness, 60.0), 0.6);
    EXPECT_EQ(wetness_on(hills(), wet, most_soil_water), 1.0) << "water stands at the surface";
    EXPECT_EQ(wetness_on(hills(), hills().mean_wetness - 9.0, 0.0), 0.0);
    EXPECT_EQ(wetness_on(hills(), hills().mean_wetness + 9.0, 0.0), 0.0) << "there is no water";
    // The mean index is that of the nodes within the world.
    double sum = 0.0;
    int count = 0;
    const Grid& grid = hills().grid;
    for (int row = 0; row < grid.side; ++row)
        for (int column = 0; column < grid.side; ++column)
            if (std::abs(grid.place(column)) <= 512.0 && std::abs(grid.place(row)) <= 512.0) {
                sum += wetness_index_at(hills(), grid.place(column), grid.place(row));
                ++count;
            }
    EXPECT_NEAR(hills().mean_wetness, sum / count, 1e-9);
}

TEST(Ground, HasStreamsWhereTheIndexIsHigh) {
    double on_streams = 0.0, elsewhere = 0.0;
    int streams = 0, others = 0;
    for (double x = -500.0; x < 500.0; x += 2.5)
        for (double y = -500.0; y < 500.0; y += 2.5) {
            const bool is_stream = stream_at(hills(), x, y) > 0.5;
            (is_stream ? on_streams : elsewhere) += wetness_index_at(hills(), x, y);
            ++(is_stream ? streams : others);
        }
    ASSERT_GT(streams, 100);
    EXPECT_GT(on_streams / streams, elsewhere / others + 2.0);
}

TEST(GroundKey, NamesWhatTheGroundDependsOnAlone) {
    WorldParams params;
    std::set<std::string> keys = {ground_key(params)};
    params.climate.rain = 100.0;
    EXPECT_TRUE(keys.contains(ground_key(params))) << "the weather makes no other ground";
    params.seed = 2;
    EXPECT_TRUE(keys.insert(ground_key(params)).second);
    params.extent.value = 256;
    EXPECT_TRUE(keys.insert(ground_key(params)).second);
    params.terrain.erosion = 0.1;
    EXPECT_TRUE(keys.insert(ground_key(params)).second);
}

}  // namespace
}  // namespace sporeprint::world_ground_test
