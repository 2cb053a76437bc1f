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

/// Returns a trunk that fell when it died, and is there for forty years.
DeadWood trunk(double radius) {
    DeadWood wood;
    wood.id = 77;
    wood.length = 20.0;
    wood.radius = radius;
    wood.fell = wood.died = time_of(10);
    wood.gone = time_of(50);
    wood.decay = 0.04;
    return wood;
}

TEST(TreeGrowth, ThinWoodIsGoneBeforeThickWood) {
    EXPECT_DOUBLE_EQ(lasting(0.01), 0.5);
    EXPECT_DOUBLE_EQ(lasting(0.5), 1.0);
    for (double diameter = 0.0; diameter < 0.4; diameter += 0.01)
        EXPECT_LE(lasting(diameter), lasting(diameter + 0.01));
    const DeadWood thick = trunk(0.25), thin = trunk(0.07);
    EXPECT_DOUBLE_EQ(taper_at(thick, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(taper_at(thick, 20.0), 0.2);
    double before = 20.0;
    for (int year = 10; year <= 50; ++year) {
        const double length = length_at(thick, time_of(year));
        EXPECT_LE(length, before);
        before = length;
    }
    EXPECT_DOUBLE_EQ(length_at(thick, time_of(20)), 20.0);
    EXPECT_LT(length_at(thin, time_of(45)), 10.0);
    EXPECT_EQ(length_at(thick, thick.gone), 0.0);
    // What is thicker than 0.15 m is there to the end; a foot of 0.5 m tapers to a fifth in 20 m.
    EXPECT_NEAR(length_at(thick, thick.gone - 1), 17.5, 0.1);
    // Nothing of a trunk that is thin everywhere.
    EXPECT_NEAR(length_at(thin, thin.gone - 1), 0.0, 0.1);
}

TEST(TreeGrowth, TrunksAreShorterFromAMomentOn) {
    for (const double radius : {0.06, 0.12, 0.3}) {
        const DeadWood wood = trunk(radius);
        for (double along = 0.5; along < 20.0; along += 1.3) {
            const WorldTime moment = when_shorter(wood, along);
            EXPECT_LE(moment, wood.gone);
            EXPECT_LT(length_at(wood, moment), along);
            EXPECT_GE(length_at(wood, moment - 1), along);
        }
    }
}

TEST(TreeGrowth, TopsOfSnagsBreakOffAndStayShort) {
    DeadWood snag = trunk(0.3);
    snag.fell = time_of(22);
    EXPECT_DOUBLE_EQ(length_at(snag, snag.died), 20.0);
    EXPECT_LT(length_at(snag, time_of(20)), 20.0);
    EXPECT_LE(length_at(snag, snag.fell), length_at(snag, snag.fell - 1));
    DeadWood small = snag;
    small.length = 0.7;
    EXPECT_DOUBLE_EQ(length_at(small, time_of(20)), 0.7);
}

}  // namespace
}  // namespace sporeprint::tree_growth_test
