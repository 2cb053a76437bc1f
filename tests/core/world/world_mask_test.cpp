#include "core/world/world_mask.h"

#include <gtest/gtest.h>

namespace sporeprint::world_mask_test {
namespace {

constexpr std::int32_t metre = units_of_metre;

/// Returns a mask of 4 x 4 pixels of 64 m, each with a number of its own.
WorldMask mask() {
    WorldMask out{256, 4, {}};
    for (std::uint32_t i = 0; i < 16; ++i)
        out.values.push_back(static_cast<std::uint16_t>(i * 4369));
    return out;
}

double number_at(WorldPoint place) { return mask().at(place) * 15.0; }

TEST(WorldMask, HasItsFirstRowInTheNorth) {
    EXPECT_DOUBLE_EQ(number_at({-100 * metre, 100 * metre}), 0.0);
    EXPECT_DOUBLE_EQ(number_at({100 * metre, 100 * metre}), 3.0);
    EXPECT_DOUBLE_EQ(number_at({-100 * metre, -100 * metre}), 12.0);
    EXPECT_DOUBLE_EQ(number_at({100 * metre, -100 * metre}), 15.0);
}

TEST(WorldMask, HasOneValueInAPixelWithItsSouthernAndWesternBorders) {
    EXPECT_DOUBLE_EQ(number_at({0, 0}), 6.0);
    EXPECT_DOUBLE_EQ(number_at({64 * metre - 1, 64 * metre - 1}), 6.0);
    EXPECT_DOUBLE_EQ(number_at({64 * metre, 0}), 7.0);
    EXPECT_DOUBLE_EQ(number_at({-1, 0}), 5.0);
    EXPECT_DOUBLE_EQ(number_at({0, -1}), 10.0);
    EXPECT_DOUBLE_EQ(number_at({0, 64 * metre}), 2.0);
}

TEST(WorldMask, HasThePixelsOfItsRimBeyond) {
    EXPECT_DOUBLE_EQ(number_at({-5000 * metre, 5000 * metre}), 0.0);
    EXPECT_DOUBLE_EQ(number_at({128 * metre, -5000 * metre}), 15.0);
    EXPECT_DOUBLE_EQ(mask().over({200, 200, 300, 300}) * 15.0, 3.0);
}

TEST(WorldMask, HasTheMeanOfTheAreasInARectangle) {
    EXPECT_NEAR(mask().over({-128, -128, 128, 128}) * 15.0, 7.5, 1e-12);
    EXPECT_NEAR(mask().over({0, 0, 64, 64}) * 15.0, 6.0, 1e-12);
    // A quarter of it in pixel 6, the others in 5, 9 and 10.
    EXPECT_NEAR(mask().over({-32, -32, 32, 32}) * 15.0, 7.5, 1e-12);
    EXPECT_NEAR(mask().over({-16, 0, 48, 16}) * 15.0, 0.25 * 5.0 + 0.75 * 6.0, 1e-12);
    // Half of it is beyond the border.
    EXPECT_NEAR(mask().over({-192, 0, -64, 64}) * 15.0, 4.0, 1e-12);
}

TEST(WorldMask, HasTheMeanOfItsPlaces) {
    const WorldBox box{-70.0, -33.0, 90.0, 110.0};
    double sum = 0.0;
    constexpr int across = 160 * 4, down = 143 * 4;
    for (int row = 0; row < down; ++row)
        for (int column = 0; column < across; ++column)
            sum += mask().at({-70 * metre + column * metre / 4 + metre / 8,
                              -33 * metre + row * metre / 4 + metre / 8});
    EXPECT_NEAR(mask().over(box), sum / (across * down), 1e-9);
}

TEST(WorldMask, TakesNothingAwayIfItIsWhite) {
    const WorldMask white{1024, 3, std::vector<std::uint16_t>(9, 65535)};
    EXPECT_TRUE(white.is_full());
    EXPECT_FALSE(mask().is_full());
    EXPECT_EQ(white.at({123 * metre, -45 * metre}), 1.0);
    EXPECT_EQ(white.over({-3.7, 11.1, 900.0, 12.0}), 1.0);
}

TEST(WorldMask, HasTheTextOfItsValues) {
    WorldMask other = mask();
    EXPECT_EQ(text_of(other), text_of(mask()));
    other.values[7] ^= 1U;
    EXPECT_NE(text_of(other), text_of(mask()));
    // The same values in other rows.
    const WorldMask high{256, 1, {257}}, low{256, 1, {1}};
    EXPECT_NE(text_of(high), text_of(low));
    EXPECT_GT(mask().bytes(), 32U);
}

}  // namespace
}  // namespace sporeprint::world_mask_test
