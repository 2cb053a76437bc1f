#include "core/grow/world/tiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "core/params/value.h"
#include "tests/support/worlds.h"

namespace sporeprint::grow_world_tiling_test {
namespace {

constexpr std::array layers = {PlotLayer::ground, PlotLayer::trees, PlotLayer::floor,
                               PlotLayer::fungi};

/// A world's ground and stand.
struct Land {
    WorldParams params = small_world("mixed");
    Ground ground = ground_of(params);
    TileReach reach = reach_of(ground, params, stand_of(params, lookup_in(atlas())));
};

const Land& land() {
    static const Land own;
    return own;
}

/// A subtree file, taken apart.
struct Subtree {
    Value json;
    std::vector<std::uint8_t> binary;

    explicit Subtree(const std::vector<std::uint8_t>& file) {
        std::uint32_t magic = 0, version = 0;
        std::uint64_t of_json = 0, of_binary = 0;
        std::memcpy(&magic, file.data(), 4);
        std::memcpy(&version, file.data() + 4, 4);
        std::memcpy(&of_json, file.data() + 8, 8);
        std::memcpy(&of_binary, file.data() + 16, 8);
        EXPECT_EQ(magic, 0x74627573U);
        EXPECT_EQ(version, 1U);
        EXPECT_EQ(of_json % 8, 0U);
        EXPECT_EQ(of_binary % 8, 0U);
        EXPECT_EQ(file.size(), 24 + of_json + of_binary);
        std::vector<Problem> problems;
        json = parse(std::string(file.begin() + 24,
                                 file.begin() + 24 + static_cast<std::ptrdiff_t>(of_json)),
                     problems);
        EXPECT_TRUE(problems.empty());
        binary.assign(file.end() - static_cast<std::ptrdiff_t>(of_binary), file.end());
    }
};

TEST(Tiling, WorldsHaveTilesOf8mAtTheirLastLevel) {
    for (const auto& [extent, levels] : {std::pair{256, 6}, {1024, 8}, {4096, 10}}) {
        const Tiling tiling{extent};
        EXPECT_EQ(tiling.levels(), levels);
        EXPECT_EQ(tiling.levels_of_subtree() * 2, levels);
        EXPECT_EQ(tiling.side(levels - 1), finest_tile);
        EXPECT_TRUE(tiling.has({levels - 1, (1 << (levels - 1)) - 1, 0}));
        EXPECT_FALSE(tiling.has({levels, 0, 0}));
        EXPECT_FALSE(tiling.has({1, 2, 0}));
        EXPECT_FALSE(tiling.has({1, 0, -1}));
        EXPECT_EQ(tiling.box({}),
                  (WorldBox{-0.5 * extent, -0.5 * extent, 0.5 * extent, 0.5 * extent}));
    }
}

TEST(Tiling, FourChildrenFillTheirParent) {
    const Tiling tiling{1024};
    const TileIndex parent{3, 5, 2};
    const WorldBox all = tiling.box(parent), south_west = tiling.box({4, 10, 4}),
                   north_east = tiling.box({4, 11, 5});
    EXPECT_EQ(south_west.west, all.west);
    EXPECT_EQ(south_west.south, all.south);
    EXPECT_EQ(north_east.east, all.east);
    EXPECT_EQ(north_east.north, all.north);
    EXPECT_EQ(south_west.east, north_east.west);
    EXPECT_EQ(south_west.north, north_east.south);
}

TEST(Tiling, BoxesContainTheGround) {
    const Tiling tiling{256};
    for (const TileIndex tile : {TileIndex{0, 0, 0}, {2, 3, 1}, {5, 7, 30}}) {
        const WorldBox square = tiling.box(tile);
        const TileBox box = box_of(tiling, tile, PlotLayer::ground, land().reach);
        for (int i = 0; i <= 40; ++i)
            for (int j = 0; j <= 40; ++j) {
                const double x = square.west + i / 40.0 * (square.east - square.west),
                             y = square.south + j / 40.0 * (square.north - square.south);
                const Grid& grid = land().ground.grid;
                const double height =
                    place_at(land().ground, coordinate_at(grid, x), coordinate_at(grid, y)).height;
                EXPECT_GT(height, box.low);
                EXPECT_LT(height, box.high);
            }
    }
}

TEST(Tiling, SubtreesSayWhichTilesHaveContent) {
    const Tiling tiling{256};
    for (const PlotLayer layer : layers) {
        for (const int level : {0, 3}) {
            const Subtree subtree(subtree_of(tiling, {level, 0, 0}, layer, land().reach));
            EXPECT_EQ(subtree.json.find("tileAvailability")->find("constant")->as_number(), 1.0);
            EXPECT_EQ(subtree.json.find("childSubtreeAvailability")->find("constant")->as_number(),
                      level == 0 ? 1.0 : 0.0);
            std::size_t expected = 0, tiles = 0;
            for (int l = 0; l < 3; ++l) {
                const std::size_t of_level = std::size_t{1} << (2 * l);
                tiles += of_level;
                if (has_content(layer, tiling.side(level + l))) expected += of_level;
            }
            const Value& content = subtree.json.find("contentAvailability")->items().front();
            if (const Value* const constant = content.find("constant")) {
                EXPECT_EQ(expected, constant->as_number() > 0.0 ? tiles : 0U) << name(layer);
                continue;
            }
            EXPECT_EQ(content.find("availableCount")->as_number(), expected);
            const Value& view = subtree.json.find("bufferViews")->items()[1];
            const auto at = static_cast<std::size_t>(view.find("byteOffset")->as_number());
            std::size_t bits = 0;
            for (std::size_t i = 0; i < tiles; ++i)
                bits += subtree.binary[at + i / 8] >> (i % 8) & 1U;
            EXPECT_EQ(bits, expected);
        }
    }
}

TEST(Tiling, SubtreesHaveTheBoxOfEachTileInTheOrderOfMorton) {
    const Tiling tiling{256};
    const Subtree subtree(subtree_of(tiling, {3, 2, 5}, PlotLayer::trees, land().reach));
    const auto number = [&](std::size_t tile, std::size_t which) {
        double value = 0.0;
        std::memcpy(&value, subtree.binary.data() + 8 * (12 * tile + which), 8);
        return value;
    };
    // Tile 2 of level 1 is its north-western child.
    const TileBox box = box_of(tiling, {4, 4, 11}, PlotLayer::trees, land().reach);
    const std::size_t child = 1 + 2;
    EXPECT_DOUBLE_EQ(number(child, 0), 0.5 * (box.west + box.east));
    EXPECT_DOUBLE_EQ(number(child, 1), 0.5 * (box.south + box.north));
    EXPECT_DOUBLE_EQ(number(child, 2), 0.5 * (box.low + box.high));
    EXPECT_DOUBLE_EQ(number(child, 3), 0.5 * (box.east - box.west));
    EXPECT_DOUBLE_EQ(number(child, 7), 0.5 * (box.north - box.south));
    EXPECT_DOUBLE_EQ(number(child, 11), 0.5 * (box.high - box.low));
    EXPECT_EQ(number(child, 4), 0.0);
}

}  // namespace
}  // namespace sporeprint::grow_world_tiling_test
