#include "core/grow/scene/scene_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/scene_parts.h"

namespace sporeprint::grow_scene_maps_test {
namespace {

std::vector<float> map_of(SceneMap map, int day = 172, std::size_t species = 0) {
    return scene_map(scenes::garden_fungi(), {map, species, scenes::garden_year, day});
}

TEST(SceneMaps, HaveOneValueForEachSurfel) {
    for (std::size_t i = 0; i < scene_map_count; ++i) {
        const auto map = static_cast<SceneMap>(i);
        const std::vector<float> values = map_of(map);
        ASSERT_EQ(values.size(), scenes::garden_fungi().habitat->surfels().size()) << name(map);
        EXPECT_GE(*std::ranges::min_element(values), 0.0F) << name(map);
        if (map != SceneMap::rain && map != SceneMap::water) {
            EXPECT_LE(*std::ranges::max_element(values), 1.0F) << name(map);
        }
        EXPECT_GT(*std::ranges::max_element(values), 0.05F) << name(map);
    }
    EXPECT_EQ(name(static_cast<SceneMap>(scene_map_count)), nullptr);
}

TEST(SceneMaps, OfLightFollowTheMonth) {
    EXPECT_EQ(map_of(SceneMap::light, 3), map_of(SceneMap::light, 28));
    EXPECT_NE(map_of(SceneMap::light, 3), map_of(SceneMap::light, 172));
    EXPECT_NE(map_of(SceneMap::wetness, 3), map_of(SceneMap::wetness, 28));
    EXPECT_EQ(map_of(SceneMap::sky, 3), map_of(SceneMap::sky, 300));
}

TEST(SceneMaps, OfAProbabilityAreWhereTheSpeciesLives) {
    const SceneFungi& fungi = scenes::garden_fungi();
    const std::vector<float> grass = map_of(SceneMap::probability, 1, 2);
    for (std::size_t i = 0; i < grass.size(); ++i)
        if (fungi.habitat->substrates.soils[i] != Soil::grass) {
            EXPECT_EQ(grass[i], 0.0F);
        }
    EXPECT_TRUE(is_of_species(SceneMap::probability));
    EXPECT_FALSE(is_of_species(SceneMap::light));
}

TEST(SceneMaps, OnVerticesAreMeansOfTheSurfelsAround) {
    const SceneShape& shape = *scenes::garden_fungi().habitat->shape;
    const std::vector<float> ones(shape.surfels.size(), 1.0F);
    for (const float value : on_vertices(shape, ones)) EXPECT_NEAR(value, 1.0F, 1e-5F);
    std::vector<float> heights(shape.surfels.size());
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = shape.surfels[i].at.y;
    const std::vector<float> read = on_vertices(shape, heights);
    ASSERT_EQ(read.size(), shape.scene->positions.size());
    for (std::size_t i = 0; i < read.size(); ++i)
        EXPECT_NEAR(read[i], shape.scene->positions[i].y, 0.05F);
}

}  // namespace
}  // namespace sporeprint::grow_scene_maps_test
