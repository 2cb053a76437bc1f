#include "core/math/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace sporeprint::math_random_test {
namespace {

using Block = std::array<std::uint32_t, 4>;

TEST(Random, PhiloxMatchesThePublishedTestVectors) {
    // These are Random123's kat_vectors for philox4x32-10.
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, AStreamIsTheConcatenationOfItsBlocks) {
    Random random(42, 5, 9);
    for (std::uint32_t block = 0; block < 3; ++block)
        for (const std::uint32_t word : philox({9, block, 0, 0}, {42, 5}))
            EXPECT_EQ(random.bits(), word);
}

TEST(Random, StreamsDifferBySeedPurposeAndObject) {
    std::set<std::uint64_t> firsts;
    for (std::uint32_t seed = 0; seed < 8; ++seed)
        for (std::uint32_t purpose = 0; purpose < 8; ++purpose)
            for (std::uint32_t object = 0; object < 8; ++object) {
                Random random(seed, purpose, object);
                const std::uint64_t high = random.bits();
                const std::uint64_t low = random.bits();
                firsts.insert(high << 32 | low);
            }
    EXPECT_EQ(firsts.size(), 512u);
}

TEST(Random, CellsHaveStreamsOfTheirOwn) {
    Random whole(1, 2, 3), middle(1, 2, 3, {0, 0});
    EXPECT_EQ(whole.bits(), middle.bits());
    std::set<std::uint32_t> seen;
    for (std::int32_t y = -2; y <= 2; ++y)
        for (std::int32_t x = -2; x <= 2; ++x) seen.insert(Random(1, 2, 3, {x, y}).bits());
    EXPECT_EQ(seen.size(), 25U);
}

TEST(Random, UniformDrawsAreUniform) {
    Random random(1, 2);
    std::array<int, 64> buckets{};
    constexpr int draws = 1 << 16;
    for (int i = 0; i < draws; ++i) {
        const double u = random.uniform();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        ++buckets[static_cast<std::size_t>(u * 64.0)];
    }
    double chi_square = 0.0;
    const double expected = draws / 64.0;
    for (const int count : buckets)
        chi_square += (count - expected) * (count - expected) / expected;
    // With 63 degrees of freedom 0.1 % of random streams lie above 104, and this stream is always
    // the same.
    EXPECT_LT(chi_square, 104.0);
    EXPECT_GT(chi_square, 30.0);
}

TEST(Random, DrawsFromARangeStayInside) {
    Random random(1, 3);
    for (int i = 0; i < 10000; ++i) {
        const double x = random.uniform(-3.0, 0.5);
        EXPECT_GE(x, -3.0);
        EXPECT_LT(x, 0.5);
        const double y = random.symmetric();
        EXPECT_GE(y, -1.0);
        EXPECT_LT(y, 1.0);
    }
}

TEST(Random, NormalDrawsHaveMeanZeroAndDeviationOne) {
    Random random(1, 4);
    constexpr int draws = 40000;
    double sum = 0.0, squares = 0.0, fourths = 0.0;
    for (int i = 0; i < draws; ++i) {
        const double x = random.normal();
        ASSERT_LT(std::abs(x), 6.0);
        sum += x;
        squares += x * x;
        fourths += x * x * x * x;
    }
    EXPECT_NEAR(sum / draws, 0.0, 0.015);      // 3 / sqrt(draws)
    EXPECT_NEAR(squares / draws, 1.0, 0.022);  // 3 sqrt(2 / draws)
    EXPECT_NEAR(fourths / draws, 2.9, 0.15);   // twelve uniforms: 3 - 6 / (5 * 12)
}

}  // namespace
}  // namespace sporeprint::math_random_test
