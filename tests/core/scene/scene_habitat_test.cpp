#include "core/scene/scene_habitat.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

#include "tests/support/scenes.h"

namespace sporeprint::scene_habitat_test {
namespace {

constexpr glm::dvec3 up(0.0, 1.0, 0.0);

/// Open ground beside ground below a table.
std::shared_ptr<const SceneShape> table() {
    return std::make_shared<const SceneShape>(
        shape_of_scene(scenes::Made()
                           .floor(-2, -2, 2, 2, 0, "soil")
                           .box({-1, 0.4F, -1}, {1, 0.45F, 1}, "oak wood")
                           .shared()));
}

TEST(SceneHabitat, IsLightAndWetInTheOpenAndDarkAndDryBelowARoof) {
    const auto shape = table();
    const SceneHabitat habitat = scenes::habitat_in(shape);
    const auto at = [&](double x, double y, double z) {
        return shape->surfels.nearest({x, y, z}, up, 0.3).value();
    };
    const Site& open = habitat.sites[at(1.9, 0.0, 1.9)];
    const Site& below = habitat.sites[at(0.0, 0.0, 0.0)];
    const Site& above = habitat.sites[at(0.0, 0.45, 0.0)];
    EXPECT_GT(open.light, 0.9);
    EXPECT_LT(below.light, 0.3);
    EXPECT_DOUBLE_EQ(above.light, 1.0);
    EXPECT_GT(open.wetness, 0.5);
    EXPECT_LT(below.wetness, 0.3);
    EXPECT_DOUBLE_EQ(open.acidity, habitat.conditions.acidity);
    FungusSpecies species = scenes::wood_species();
    species.ecology.wetness = {{0.4, 1.0}, {0.6, 1.0}};
    EXPECT_GT(habitat.suitability(species, at(0.0, 0.45, 0.0)), 0.3);
    EXPECT_EQ(habitat.suitability(species, at(1.9, 0.0, 1.9)), 0.0) << "soil is no wood";
}

TEST(SceneHabitat, IsWetterWhereMoreRainFalls) {
    const auto shape = table();
    SceneConditions conditions = scenes::conditions_for(*shape->scene);
    double before = -1.0;
    for (const double rain : {0.0, 300.0, 600.0, 1200.0}) {
        conditions.climate.rain = rain;
        const SceneHabitat habitat = habitat_of(shape, conditions);
        double sum = 0.0;
        for (const Site& site : habitat.sites) sum += site.wetness;
        EXPECT_GT(sum, before);
        before = sum;
    }
}

TEST(SceneHabitat, OfTheSouthHasItsAutumnHalfAYearLater) {
    const auto shape = table();
    SceneConditions conditions = scenes::conditions_for(*shape->scene);
    conditions.climate.latitude_deg = -51.0;
    const SceneHabitat habitat = habitat_of(shape, conditions);
    const std::uint32_t open = shape->surfels.nearest({1.9, 0.0, 1.9}, up, 0.3).value();
    EXPECT_GT(habitat.sites[open].wetness, 0.5);
    EXPECT_LE(habitat.sites[open].wetness, 1.0);
}

TEST(SceneHabitat, IsTheSameWithSeveralThreads) {
    const auto scene = scenes::Made()
                           .floor(-1, -1, 1, 1, 0, "soil")
                           .box({-0.3F, 0.2F, -0.3F}, {0.3F, 0.6F, 0.3F}, "log")
                           .shared();
    const auto one = std::make_shared<const SceneShape>(shape_of_scene(scene));
    const auto four = std::make_shared<const SceneShape>(shape_of_scene(scene, scenes::by_threads));
    EXPECT_EQ(one->sky, four->sky);
    const SceneHabitat a = scenes::habitat_in(one),
                       b = habitat_of(four, scenes::conditions_for(*scene), scenes::by_threads);
    EXPECT_EQ(a.rain, b.rain);
    EXPECT_TRUE(a.run_off == b.run_off);
    for (std::size_t i = 0; i < a.sites.size(); ++i) {
        EXPECT_EQ(a.sites[i].light, b.sites[i].light);
        EXPECT_EQ(a.sites[i].wetness, b.sites[i].wetness);
    }
}

}  // namespace
}  // namespace sporeprint::scene_habitat_test
