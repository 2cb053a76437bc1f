#include "core/world/tree_growth.h"

#include <gtest/gtest.h>

namespace sporeprint::tree_growth_test {
namespace {

constexpr StandTree grown() {
    StandTree tree;
    tree.born = time_of(-20);
    tree.died = time_of(300);
    tree.height = 30.0;
    return tree;
}
constexpr StandTree tree = grown();

TEST(TreeGrowth, RisesFromNothingToTheHeightOfOldAge) {
    EXPECT_EQ(height_at(tree, tree.born - 5), 0.0);
    EXPECT_EQ(height_at(tree, tree.born), 0.0);
    double before = 0.0;
    for (int year = -19; year < 300; ++year) {
        const double height = height_at(tree, time_of(year));
        EXPECT_GT(height, before);
        before = height;
    }
    EXPECT_NEAR(before, 30.0, 0.1);
}

TEST(TreeGrowth, AgesAndCrownsHaveInverses) {
    for (int year = -19; year < 250; ++year) {
        const double height = height_at(tree, time_of(year));
        EXPECT_NEAR(age_of_height(tree, height), year + 20.0, 0.05);
        EXPECT_NEAR(height_of_crown(crown_radius(height)), height, 1e-9);
    }
    EXPECT_EQ(age_of_height(tree, 0.0), 0.0);
    EXPECT_EQ(age_of_height(tree, -1.0), 0.0);
    EXPECT_GT(age_of_height(tree, 30.0), 1e8);
}

TEST(TreeGrowth, CrownsHaveAMostAndTrunksARadius) {
    EXPECT_EQ(crown_radius(100.0), 5.0);
    EXPECT_NEAR(trunk_diameter(28.0), 0.5, 0.01);
    EXPECT_LT(trunk_diameter(5.0), 0.12);
}

}  // namespace
}  // namespace sporeprint::tree_growth_test
