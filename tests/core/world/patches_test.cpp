#include "core/world/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/world/tree_growth.h"
#include "tests/support/worlds.h"

namespace sporeprint::world_patches_test {
namespace {

Stand stand_of_preset(const char* preset) {
    return stand_of(small_world(preset), lookup_in(atlas()));
}

WorldPoint place(double x, double y) {
    return {static_cast<std::int32_t>(x * units_of_metre),
            static_cast<std::int32_t>(y * units_of_metre)};
}

TEST(Patches, HaveOneSeedInEachSquareAndStormsInOrder) {
    const Stand stand = stand_of_preset("beech");
    for (int x = -4; x < 4; ++x) {
        const StandPatch patch = patch_of(stand, {x, 3});
        EXPECT_GE(patch.seed.x, x * patch_units);
        EXPECT_LT(patch.seed.x, (x + 1) * patch_units);
        EXPECT_GE(patch.seed.y, 3 * patch_units);
        EXPECT_LT(patch.seed.y, 4 * patch_units);
        EXPECT_TRUE(std::is_sorted(patch.storms.begin(), patch.storms.end()));
        EXPECT_LT(patch.storms.front(), begin_of_trees);
        EXPECT_GE(patch.storms.back(), end_of_trees);
    }
}

TEST(Patches, StormsComeAsOftenAsTheStandSays) {
    Stand stand = stand_of_preset("beech");
    stand.params.patch_years = 60.0;
    double storms = 0.0, years = 0.0;
    for (int x = 0; x < 200; ++x) {
        const StandPatch patch = patch_of(stand, {x, 0});
        storms += static_cast<double>(patch.storms.size() - 1);
        years += years_between(patch.storms.front(), patch.storms.back());
    }
    EXPECT_NEAR(years / storms, 60.0, 3.0);
}

TEST(Patches, FromAfarCrownsAreAboutAsHighAsTheTallestTreesAreThere) {
    const World world = world_over_its_ground(small_world("beech"));
    const WorldTime time = time_of(80);
    PatchCanopy canopy(world.stand, time);
    // The tallest trees of squares of 16 m, and the crowns from afar at their middles.
    double of_trees = 0.0, from_afar = 0.0;
    const Block block = block_of(world, {0, 0});
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            double tallest = 0.0;
            for (const StandTree& tree : block.trees) {
                const double x = metres(tree.at.x), y = metres(tree.at.y);
                if (tree.lives_at(time) && x >= 16.0 * column && x < 16.0 * (column + 1) &&
                    y >= 16.0 * row && y < 16.0 * (row + 1))
                    tallest = std::max(tallest, height_at(tree, time));
            }
            of_trees += tallest;
            from_afar += canopy.at(place(16.0 * column + 8.0, 16.0 * row + 8.0));
        }
    EXPECT_GT(of_trees, 16 * 10.0);
    EXPECT_NEAR(from_afar / of_trees, 1.0, 0.3);
}

TEST(Patches, NoCrownsStandWhereNoTreesGrow) {
    PatchCanopy meadow(stand_of_preset("meadow"), time_of(50));
    Stand with_glade = stand_of_preset("beech");
    with_glade.params.glade = 40.0;
    PatchCanopy glade(with_glade, time_of(50));
    double beyond = 0.0;
    for (int i = 0; i < 20; ++i) {
        const double r = 2.0 * i;
        if (stand_of_preset("meadow").params.density <= 0.0) {
            EXPECT_EQ(meadow.at(place(r, -r)), 0.0);
        }
        EXPECT_EQ(glade.at(place(0.9 * r, 0.0)), 0.0);
        beyond += glade.at(place(60.0 + r, 10.0));
    }
    EXPECT_GT(beyond, 0.0);
}

}  // namespace
}  // namespace sporeprint::world_patches_test
