#include "core/individual/mixed_random.h"

#include <gtest/gtest.h>

namespace sporeprint::mixed_random_test {
namespace {

TEST(MixedRandom, OfOneSeedIsRandom) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Random random(seed, 7, 3);
        MixedRandom alone({{seed, 1.0}}, 7, 3), first({{seed, 1.0}, {seed + 1, 0.0}}, 7, 3);
        for (int i = 0; i < 3; ++i) {
            const double one = random.uniform();
            EXPECT_EQ(alone.uniform(), one);
            EXPECT_EQ(first.uniform(), one);
            const double other = random.uniform(-2.0, 5.0);
            EXPECT_EQ(alone.uniform(-2.0, 5.0), other);
            EXPECT_EQ(first.uniform(-2.0, 5.0), other);
            const double third = random.symmetric();
            EXPECT_EQ(alone.symmetric(), third);
            EXPECT_EQ(first.symmetric(), third);
        }
    }
}

TEST(MixedRandom, IsTheWeightedMeanOfItsSeeds) {
    Random one(1, 7), other(2, 7);
    MixedRandom mixed({{1, 0.25}, {2, 0.75}}, 7);
    for (int i = 0; i < 100; ++i) {
        const double first = one.uniform(), second = other.uniform();
        EXPECT_NEAR(mixed.uniform(), 0.25 * first + 0.75 * second, 1e-12);
    }
}

}  // namespace
}  // namespace sporeprint::mixed_random_test
