#include "core/grow/world/tile_grass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/meshes.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_world_tile_grass_test {
namespace {

CoverField covered_with_grass(const WorldBox& box, double share) {
    return cover_field(box, 1.0, [share](double, double) {
        Cover cover;
        cover.grass = share;
        cover.soil = 1.0 - share;
        return cover;
    });
}

std::size_t count(double share) {
    const SmallWood wood;
    const PlotContent content = wood.content(0.0, 0.0, 16.0);
    const FloorHeights floor(wood.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    std::size_t sum = 0;
    for (const auto& places : tufts_on(content, frame, covered_with_grass(box_of(content), share)))
        for (const GlbTransform& place : places) {
            EXPECT_LE(std::abs(place.translation.x), 8.0);
            EXPECT_LE(std::abs(place.translation.z), 8.0);
            ++sum;
        }
    return sum;
}

TEST(TileGrass, TuftsAreClosedShells) {
    for (std::size_t shape = 0; shape < tuft_shapes; ++shape) {
        const Mesh tuft = tuft_mesh(shape, grass_on(270));
        expect_valid(tuft);
        EXPECT_EQ(tuft.triangles(), 36U);
        EXPECT_EQ(tuft.tints.size(), tuft.positions.size());
    }
}

TEST(TileGrass, GrowsAsGrassCoversTheGround) {
    EXPECT_EQ(count(0.0), 0U);
    // Twelve on each square metre, and a quarter of them where grass covers half.
    EXPECT_EQ(count(1.0), 16U * 16U * 12U);
    EXPECT_NEAR(static_cast<double>(count(0.5)), 0.25 * 16 * 16 * 12, 100.0);
}

TEST(TileGrass, OfAPlotKeepsItsBudgetAndItsBorders) {
    const SmallWood wood;
    const PlotContent content = wood.content(0.0, 0.0, 4.0);
    const FloorHeights floor(wood.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    const CoverField cover = covered_with_grass(box_of(content), 1.0);
    const Mesh grass = grass_of(content, frame, cover, 60'000);
    expect_valid(grass);
    EXPECT_GT(grass.triangles(), 20'000U);
    EXPECT_LE(grass.triangles(), 60'000U);
    const Mesh less = grass_of(content, frame, cover, 5'000);
    EXPECT_LE(less.triangles(), 5'000U);
    EXPECT_FALSE(less.positions.empty());
    EXPECT_TRUE(grass_of(content, frame, covered_with_grass(box_of(content), 0.0), 60'000)
                    .positions.empty());
    for (const glm::vec3& at : grass.positions)
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.z)), 2.0 + rim_of_grass);
}

TEST(TileGrass, IsAsMuchLowerAsSnowIsDeepAndShortTuftsAreBelowIt) {
    const SmallWood wood;
    PlotContent content = wood.content(0.0, 0.0, 4.0);
    const FloorHeights floor(wood.ground, content.seed, content.micro, {});
    const CoverField cover = covered_with_grass(box_of(content), 0.8);
    const auto standing = [&](double depth) {
        content.snow = depth > 0.0 ? 1.0 : 0.0;
        content.snow_depth = depth;
        const PlotFrame frame(content, floor);
        std::size_t count = 0;
        for (const auto& places : tufts_on(content, frame, cover, 9))
            for (const GlbTransform& place : places) {
                const glm::dvec2 at = frame.below(place.translation);
                EXPECT_NEAR(place.translation.y, frame.on_floor(at.x, at.y).y - depth, 1e-9);
                ++count;
            }
        return count;
    };
    const std::size_t summer = standing(0.0), thin = standing(0.03), deep = standing(0.1);
    EXPECT_GT(summer, thin);
    EXPECT_GT(thin, deep);
    EXPECT_GT(deep, 0U);
    EXPECT_EQ(standing(0.3), 0U);
}

TEST(TileGrass, OfAnyDensityHasTheTuftsOfALesserOne) {
    const SmallWood wood;
    const PlotContent content = wood.content(0.0, 0.0, 4.0);
    const FloorHeights floor(wood.ground, content.seed, content.micro, {});
    const PlotFrame frame(content, floor);
    const CoverField cover = covered_with_grass(box_of(content), 0.8);
    const auto few = tufts_on(content, frame, cover, 3), many = tufts_on(content, frame, cover, 9);
    for (std::size_t shape = 0; shape < tuft_shapes; ++shape) {
        EXPECT_GT(many[shape].size(), 2 * few[shape].size());
        for (const GlbTransform& place : few[shape])
            EXPECT_TRUE(std::ranges::any_of(many[shape], [&](const GlbTransform& other) {
                return other.translation == place.translation;
            }));
    }
}

}  // namespace
}  // namespace sporeprint::grow_world_tile_grass_test
