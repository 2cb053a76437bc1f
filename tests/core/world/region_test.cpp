#include "core/world/region.h"

#include <gtest/gtest.h>

namespace sporeprint::region_test {
namespace {

constexpr std::int32_t metre = units_of_metre;

TEST(Region, OfABlockHasItsPlaces) {
    for (const CellIndex block : {CellIndex{0, 0}, CellIndex{-2, 1}}) {
        const Region region(block);
        for (const WorldPoint place :
             {WorldPoint{region.west, region.south}, WorldPoint{region.east - 1, region.north - 1},
              WorldPoint{region.west, region.north - 1}}) {
            EXPECT_EQ(block_at(place), block);
            EXPECT_TRUE(region.contains(place));
        }
        EXPECT_FALSE(region.contains({region.east, region.south}));
        EXPECT_FALSE(region.contains({region.west, region.north}));
        EXPECT_FALSE(region.contains({region.west - 1, region.south}));
    }
}

TEST(Region, GrowsByAtLeastTheDistance) {
    const Region region(-metre, 0, 3 * metre, 2 * metre);
    EXPECT_EQ(region.grown(0.0), region);
    EXPECT_EQ(region.grown(2.5),
              Region(-metre * 7 / 2, -metre * 5 / 2, metre * 11 / 2, metre * 9 / 2));
    EXPECT_EQ(region.grown(1e-9).west, region.west - 1);
}

}  // namespace
}  // namespace sporeprint::region_test
