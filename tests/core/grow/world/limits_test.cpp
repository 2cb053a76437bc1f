#include "core/grow/world/limits.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/worlds.h"

namespace sporeprint::grow_world_limits_test {
namespace {

const World& meadow() {
    static const World world = world_over_its_ground(small_world("meadow"));
    return world;
}

const ExecutionContext& services() {
    static const CachedParts cached;
    return cached.services;
}

TEST(WorldLimits, AllowThePlacesOfBodies) {
    const int year = 80;
    const std::vector<FruitBody> bodies =
        bodies_of_year(meadow(), {0, 0, 32, 32}, year, services());
    ASSERT_GT(bodies.size(), 10U);
    std::size_t checked = 0;
    for (std::size_t i = 0; i < bodies.size(); i += bodies.size() / 10) {
        const FruitBody& body = bodies[i];
        const int day = (body.emerged - time_of(year)) / ticks_of_day + 1;
        if (day < 1 || day > days_of_year) continue;  // of the year before
        const PlaceLimits limits = limits_in(meadow(), body.at, year, day, services());
        ASSERT_EQ(limits.species.size(), meadow().species.size());
        const Limits& own = limits.species[body.species];
        EXPECT_EQ(own[Condition::substrate], 1.0);
        EXPECT_GT(own[Condition::month], 0.0);
        ++checked;
    }
    EXPECT_GT(checked, 3U);
}

TEST(WorldLimits, NameTheSeasonInWinterAndTheMyceliumBetweenRings) {
    const PlaceLimits winter = limits_in(meadow(), {0, 0}, 80, 15, services());
    for (const Limits& limits : winter.species) EXPECT_LT(limits[limits.limiting()], 0.05);
    std::size_t without = 0;
    for (std::int32_t x = 0; x < 20; ++x) {
        const PlaceLimits limits =
            limits_in(meadow(), {x * units_of_metre, 5 * units_of_metre}, 80, 270, services());
        without += static_cast<std::size_t>(std::ranges::count_if(
            limits.species, [](const Limits& one) { return one[Condition::mycelium] == 0.0; }));
    }
    EXPECT_GT(without, 20U) << "most of a meadow has no mycelium of most species";
}

TEST(WorldLimits, AreThoseOfASunnyAndWetPlace) {
    const PlaceLimits limits = limits_in(meadow(), {0, 0}, 80, 270, services());
    EXPECT_GT(limits.site.light, 0.7);
    EXPECT_GE(limits.wetness, 0.0);
    EXPECT_LE(limits.wetness, 1.0);
    EXPECT_EQ(limits.site.acidity, meadow().params.soil.acidity);
}

}  // namespace
}  // namespace sporeprint::grow_world_limits_test
