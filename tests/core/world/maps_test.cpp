#include "core/world/maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "core/world/drainage.h"

namespace sporeprint::world_maps_test {
namespace {

Place place_at(const Ground& ground, double x, double y) {
    return sporeprint::place_at(ground, coordinate_at(ground.grid, x),
                                coordinate_at(ground.grid, y));
}

const WorldParams& params() {
    static const WorldParams made = [] {
        WorldParams p;
        p.seed = 3;
        p.extent.value = 256;
        return p;
    }();
    return made;
}

const Ground& ground() {
    static const Ground made = ground_of(params());
    return made;
}

constexpr WorldMap all_maps[] = {WorldMap::height, WorldMap::slope,   WorldMap::aspect,
                                 WorldMap::twi,    WorldMap::wetness, WorldMap::streams};

TEST(MapFrame, HasItsOutermostNodesOnTheEdges) {
    const MapFrame frame = frame_of({-100.0, -30.0, 60.0, 10.0}, 161);
    EXPECT_EQ(frame.width, 161);
    EXPECT_EQ(frame.height, 41);
    EXPECT_EQ(frame.x(0), -100.0);
    EXPECT_EQ(frame.x(160), 60.0);
    EXPECT_EQ(frame.y(0), 10.0) << "rows begin in the north";
    EXPECT_EQ(frame.y(40), -30.0);
    EXPECT_DOUBLE_EQ(frame.x(1) - frame.x(0), 1.0);
    EXPECT_DOUBLE_EQ(frame.y(0) - frame.y(1), 1.0);
    const MapFrame strip = frame_of({0.0, 0.0, 1.0, 200.0}, 64);
    EXPECT_EQ(strip.width, 2);
    EXPECT_EQ(strip.height, 64);
}

TEST(WorldMap, OfHeightsIsThatOfThePlaces) {
    const MapFrame frame = frame_of(extent_of(params()), 65);
    const auto map = map_of(WorldMap::height, ground(), frame, 0.0);
    const auto [from, to, unit] = range_of(WorldMap::height, ground());
    EXPECT_STREQ(unit, "m");
    for (int row = 0; row < frame.height; row += 7)
        for (int column = 0; column < frame.width; column += 5) {
            const double stored =
                from +
                (to - from) / 65535.0 * map[static_cast<std::size_t>(row * frame.width + column)];
            EXPECT_NEAR(stored, place_at(ground(), frame.x(column), frame.y(row)).height,
                        (to - from) / 131000.0);
        }
}

TEST(WorldMap, SideBySideSharesItsEdge) {
    for (const WorldMap map : all_maps) {
        const auto west = map_of(map, ground(), frame_of({-64.0, -32.0, 0.0, 32.0}, 65), 70.0);
        const auto east = map_of(map, ground(), frame_of({0.0, -32.0, 64.0, 32.0}, 65), 70.0);
        const auto finer = map_of(map, ground(), frame_of({0.0, -32.0, 64.0, 32.0}, 129), 70.0);
        for (std::size_t row = 0; row < 65; ++row) {
            EXPECT_EQ(west[row * 65 + 64], east[row * 65]) << name(map);
            for (std::size_t column = 0; column < 65; ++column)
                ASSERT_EQ(east[row * 65 + column], finer[2 * row * 129 + 2 * column])
                    << name(map) << ": a place has one value at every resolution";
        }
    }
}

TEST(WorldMap, IsTheSameOnSeveralThreads) {
    const Parallel threads = [](std::span<const std::function<void()>> tasks) {
        std::vector<std::jthread> running;
        running.reserve(tasks.size());
        for (const auto& task : tasks) running.emplace_back(task);
    };
    const MapFrame frame = frame_of(extent_of(params()), 200);
    for (const WorldMap map : all_maps)
        EXPECT_EQ(map_of(map, ground(), frame, 50.0), map_of(map, ground(), frame, 50.0, threads));
    EXPECT_EQ(terrarium_of(ground(), frame), terrarium_of(ground(), frame, threads));
}

TEST(WorldMap, OfAspectsPointsDownhill) {
    const MapFrame frame = frame_of({-100.0, -100.0, 100.0, 100.0}, 101);
    const auto map = map_of(WorldMap::aspect, ground(), frame, 0.0);
    int downhill = 0, places = 0;
    for (int row = 1; row < frame.height - 1; ++row)
        for (int column = 1; column < frame.width - 1; ++column) {
            const double angle = map[static_cast<std::size_t>(row * frame.width + column)] /
                                 65535.0 * 6.283185307179586;
            const double x = frame.x(column), y = frame.y(row);
            const double here = place_at(ground(), x, y).height;
            const double there =
                place_at(ground(), x + 0.05 * std::sin(angle), y + 0.05 * std::cos(angle)).height;
            downhill += there < here ? 1 : 0;
            ++places;
        }
    EXPECT_GT(downhill, places * 99 / 100);
}

TEST(WorldMap, OfWetnessGrowsWithTheWaterInTheSoil) {
    const MapFrame frame = frame_of(extent_of(params()), 100);
    const auto dry = map_of(WorldMap::wetness, ground(), frame, 20.0),
               wet = map_of(WorldMap::wetness, ground(), frame, 90.0),
               index = map_of(WorldMap::twi, ground(), frame, 0.0);
    std::size_t wetter = 0;
    for (std::size_t i = 0; i < dry.size(); ++i) {
        ASSERT_LE(dry[i], wet[i]);
        wetter += dry[i] < wet[i] ? 1 : 0;
        if (i > 0 && index[i] > index[i - 1]) {
            ASSERT_GE(wet[i], wet[i - 1]) << "no place is drier for a higher index";
        }
    }
    EXPECT_GT(wetter, dry.size() / 2);
}

TEST(Terrarium, HasHeightsToAQuarterOfACentimetre) {
    const MapFrame frame = frame_of(extent_of(params()), 64);
    const auto rgb = terrarium_of(ground(), frame);
    for (int row = 0; row < frame.height; ++row)
        for (int column = 0; column < frame.width; ++column) {
            const std::uint8_t* const colour =
                &rgb[3 * static_cast<std::size_t>(row * frame.width + column)];
            const double height = 256.0 * colour[0] + colour[1] + colour[2] / 256.0 - 32768.0;
            ASSERT_NEAR(height, place_at(ground(), frame.x(column), frame.y(row)).height,
                        0.5 / 256.0 + 1e-9);
        }
}

TEST(WorldMap, HasADescriptionAndARangeForEachName) {
    for (const WorldMap map : all_maps) {
        EXPECT_GT(std::string_view(doc_of(map)).size(), 20U);
        const MapRange range = range_of(map, ground());
        EXPECT_LT(range.from, range.to);
    }
    EXPECT_EQ(name(static_cast<WorldMap>(std::size(all_maps))), nullptr);
}

}  // namespace
}  // namespace sporeprint::world_maps_test
