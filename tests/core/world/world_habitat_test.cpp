#include "core/world/world_habitat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace sporeprint::world_habitat_test {
namespace {

World wood() {
    static const TreeEcology birch;
    WorldParams params;
    params.seed = 5;
    params.extent.value = 256;
    params.stand.kinds = Text<256>("birch");
    params.fungi.species = Text<620>("ring");
    WorldLookup lookup;
    lookup.tree = [](std::string_view) { return &birch; };
    lookup.species = [](std::string_view) { return std::optional(SpeciesRecord{}); };
    return world_of(params, lookup, std::make_shared<const Ground>(ground_of(params)));
}

StandTree tree_at(std::uint64_t id, double x, double y) {
    StandTree tree;
    tree.id = id;
    tree.at = {static_cast<std::int32_t>(x * units_of_metre),
               static_cast<std::int32_t>(y * units_of_metre)};
    tree.born = time_of(0);
    tree.died = time_of(100);
    tree.height = 25.0;
    return tree;
}

constexpr WorldPoint middle{32 * units_of_metre, 32 * units_of_metre};

TEST(WorldHabitat, IsDarkerBelowTreesThatLive) {
    const World world = wood();
    const std::vector<StandTree> trees = {tree_at(1, 32, 32), tree_at(2, 34, 30)};
    const WorldHabitat open(world, {0, 0}, {}), shaded(world, {0, 0}, trees);
    const double light = open.site_at(middle, time_of(60)).light;
    EXPECT_EQ(light, world.site_at(middle).light);
    EXPECT_LT(shaded.site_at(middle, time_of(60)).light, 0.95 * light);
    EXPECT_EQ(shaded.site_at(middle, time_of(130)).light, light);
    EXPECT_EQ(shaded.site_at(middle, time_of(-50)).light, light);
}

TEST(WorldHabitat, DependsNeitherOnTheOrderOfTreesNorOnThoseFarAway) {
    const World world = wood();
    std::vector<StandTree> trees;
    for (std::uint64_t i = 0; i < 200; ++i)
        trees.push_back(tree_at(i * 7919 % 211, static_cast<double>(i * 37 % 180) - 60.0,
                                static_cast<double>(i * 53 % 170) - 55.0));
    const WorldHabitat first(world, {0, 0}, trees);
    std::vector<StandTree> others(trees.rbegin(), trees.rend());
    others.push_back(tree_at(500, 32 + 120, 32));
    const WorldHabitat second(world, {0, 0}, others);
    for (std::int32_t i = -30; i < 94; i += 7) {
        const WorldPoint at{i * units_of_metre, (64 - i) * units_of_metre};
        EXPECT_EQ(first.site_at(at, time_of(60)).light, second.site_at(at, time_of(60)).light);
    }
}

TEST(WorldHabitat, HasTheSpreadAndTheWaterOfItsWorld) {
    const World world = wood();
    const WorldHabitat habitat(world, {0, 0}, {});
    for (const int year : {-100, 0, 100, 300}) {
        const double share = habitat.establishment(0, middle, time_of(year));
        EXPECT_GE(share, 0.0);
        EXPECT_LE(share, 1.0);
        EXPECT_EQ(share, establishment_at(world.establishment[0], 32.0, 32.0,
                                          std::clamp(year, 0, last_year)));
    }
    const Site site = habitat.site_at(middle, time_of(50));
    EXPECT_LE(habitat.wetness_on(site, 10.0), habitat.wetness_on(site, 90.0));
    EXPECT_EQ(habitat.wetness_on(site, world.autumn_water), site.wetness);
}

}  // namespace
}  // namespace sporeprint::world_habitat_test
