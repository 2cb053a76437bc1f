#include "core/world/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/random.h"
#include "core/problems.h"

namespace sporeprint::world_cover_test {
namespace {

double sum_of(const Cover& cover) {
    return cover.soil + cover.needles + cover.moss + cover.grass + cover.herb + cover.rock +
           cover.water + cover.all_leaves();
}

double least_of(const Cover& cover) {
    const double least = std::min(
        {cover.soil, cover.needles, cover.moss, cover.grass, cover.herb, cover.rock, cover.water});
    return std::min(least, *std::min_element(cover.leaves.begin(), cover.leaves.end()));
}

CoverConditions drawn(Random& random) {
    CoverConditions at;
    at.light = random.uniform();
    at.wetness = random.uniform();
    at.acidity = random.uniform();
    at.slope = 2.0 * random.uniform();
    at.stream = random.uniform();
    at.day = 1 + static_cast<int>(365.0 * random.uniform());
    for (std::size_t kind = 0; kind < 3; ++kind) at.fall[kind] = random.uniform();
    at.has_needles[2] = true;
    return at;
}

TEST(Cover, SharesSumToOne) {
    Random random(1, 0);
    for (int i = 0; i < 2000; ++i) {
        const Cover cover = cover_of(drawn(random));
        EXPECT_NEAR(sum_of(cover), 1.0, 1e-12);
        EXPECT_GE(least_of(cover), 0.0);
    }
}

TEST(Cover, IsWhatThePlaceIs) {
    CoverConditions wood;
    wood.light = 0.05;
    wood.wetness = 0.4;
    wood.day = 335;
    wood.fall[0] = 1.0;
    EXPECT_GT(cover_of(wood).leaves[0], 0.8) << "a closed wood after the leaves fell";
    EXPECT_LT(cover_of(wood).grass, 0.01);
    CoverConditions meadow;
    meadow.day = 200;
    EXPECT_GT(cover_of(meadow).grass, 0.85);
    EXPECT_EQ(cover_of(meadow).all_leaves(), 0.0);
    CoverConditions spruces = wood;
    spruces.has_needles[0] = true;
    EXPECT_GT(cover_of(spruces).needles, 0.5);
    EXPECT_EQ(cover_of(spruces).all_leaves(), 0.0);
    CoverConditions brook = wood;
    brook.stream = 1.0;
    EXPECT_EQ(cover_of(brook).water, 1.0);
    CoverConditions cliff = meadow;
    cliff.slope = 2.0;
    EXPECT_EQ(cover_of(cliff).rock, 1.0);
}

TEST(Cover, OfAWoodWhoseCrownsDoNotMeetIsHardlyGrass) {
    // Half of the light comes between crowns that are as wide as the circles of competition.
    CoverConditions wood;
    wood.light = 0.5;
    wood.wetness = 0.4;
    wood.day = 335;
    wood.fall[0] = 0.9;
    EXPECT_LT(cover_of(wood).grass, 0.05);
    EXPECT_GT(cover_of(wood).leaves[0], 0.8);
}

TEST(Cover, FollowsItsConditions) {
    Random random(2, 0);
    for (int i = 0; i < 300; ++i) {
        CoverConditions at = drawn(random);
        at.stream = at.slope = 0.0;
        CoverConditions wetter = at, lighter = at, more_acid = at;
        wetter.wetness = std::min(1.0, at.wetness + 0.1);
        EXPECT_GE(cover_of(wetter).moss, cover_of(at).moss);
        more_acid.acidity = std::min(1.0, at.acidity + 0.1);
        EXPECT_GE(cover_of(more_acid).moss, cover_of(at).moss);
        lighter.light = std::min(1.0, at.light + 0.1);
        EXPECT_GE(cover_of(lighter).grass, cover_of(at).grass);
    }
}

TEST(Cover, HasMoreLeavesInNovemberThanInSeptemberAndHerbsInSpring) {
    CoverConditions at;
    at.light = 0.15;
    at.wetness = 0.7;
    at.acidity = 0.2;
    at.fall[0] = 0.4;
    at.day = 250;
    const Cover september = cover_of(at);
    at.day = 335;
    const Cover november = cover_of(at);
    at.day = 125;
    const Cover may = cover_of(at);
    EXPECT_GT(november.leaves[0], 1.2 * september.leaves[0]);
    EXPECT_GT(may.herb, 2.0 * september.herb);
    EXPECT_EQ(november.herb, 0.0);
}

TEST(Litterfall, OfATreeIsTheAreaOfItsCrown) {
    for (const double radius : {1.0, 3.0, 5.0}) {
        constexpr double step = 0.05;
        double sum = 0.0;
        for (double y = -radius; y < radius; y += step)
            for (double x = -radius - 1.0; x < radius + most_litter_drift + 1.0; x += step)
                sum += litterfall(x + 0.5 * step, y + 0.5 * step, radius, 1.0, 0.0);
        const double area = 3.141592653589793 * radius * radius;
        EXPECT_GT(sum * step * step / area,
                  1.0 - std::exp(-most_litter_drift / litter_drift) - 1e-3);
        EXPECT_LT(sum * step * step / area, 1.001);
    }
}

TEST(Litterfall, LiesDownwindAndNotBeyondItsReach) {
    EXPECT_GT(litterfall(4.0, 0.0, 2.0, 1.0, 0.0), 0.0);
    EXPECT_EQ(litterfall(-2.01, 0.0, 2.0, 1.0, 0.0), 0.0);
    EXPECT_EQ(litterfall(0.0, 2.01, 2.0, 1.0, 0.0), 0.0);
    EXPECT_EQ(litterfall(17.01, 0.0, 2.0, 1.0, 0.0), 0.0);
    EXPECT_NEAR(litterfall(0.0, 4.0, 2.0, 0.0, 1.0), litterfall(4.0, 0.0, 2.0, 1.0, 0.0), 1e-15);
    EXPECT_LE(litterfall(1.9, 0.0, 5.0, 1.0, 0.0), 1.0);
}

TEST(Litterfall, OfAWoodIsFromCrownsThatMeet) {
    // Trees as far from each other as the circles by which they compete reach are a closed wood.
    std::vector<LitterSource> sources;
    for (int i = -10; i <= 10; ++i)
        for (int j = -10; j <= 10; ++j) sources.push_back({6.0 * i, 6.0 * j, 3.0, 1});
    double sum = 0.0, least = 1e9;
    for (double x = -3.0; x < 3.0; x += 0.5)
        for (double y = -3.0; y < 3.0; y += 0.5) {
            const auto fall = litterfall(sources, x, y, 0.6, 0.8);
            EXPECT_EQ(fall[0], 0.0);
            sum += fall[1] / 144.0;
            least = std::min(least, fall[1]);
        }
    EXPECT_NEAR(sum, 2.25 * 3.141592653589793 / 4.0, 0.05);
    EXPECT_GT(least, 0.5);
}

TEST(CoverField, IsLinearBetweenNodesAndSharesThemWithItsNeighbours) {
    const auto cover = [](double x, double y) {
        Cover at;
        at.soil = 0.5 + 0.01 * x + 0.02 * y;
        at.moss = 0.5 - 0.01 * x - 0.02 * y;
        return at;
    };
    const CoverField west = cover_field({-5.0, -5.0, 5.0, 5.0}, 0.75, cover),
                     east = cover_field({5.0, -5.0, 15.0, 5.0}, 0.75, cover);
    Random random(3, 0);
    for (int i = 0; i < 500; ++i) {
        const double x = random.uniform(-5.7, 5.7), y = random.uniform(-5.7, 5.7);
        EXPECT_NEAR(west.at(x, y).soil, 0.5 + 0.01 * x + 0.02 * y, 1e-12);
        EXPECT_NEAR(sum_of(west.at(x, y)), 1.0, 1e-12);
        const double beside = random.uniform(4.3, 5.7);
        EXPECT_EQ(west.at(beside, 0.5 * y), east.at(beside, 0.5 * y));
    }
}

TEST(CoverField, HasStepsThatAreHalfAMetreTimesAPowerOfTwo) {
    const WorldBox box{0.0, 0.0, 8.0, 8.0};
    for (const double step : {0.5, 1.0, 4.0}) EXPECT_GT(cover_lattice(box, 1.0, step).columns, 2);
    for (const double step : {0.25, 0.4, 0.8, 3.0})
        EXPECT_THROW(static_cast<void>(cover_lattice(box, 1.0, step)), InvalidInput) << step;
}

}  // namespace
}  // namespace sporeprint::world_cover_test
