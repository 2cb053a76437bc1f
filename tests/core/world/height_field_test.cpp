#include "core/world/height_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/math/noise.h"
#include "core/problems.h"

namespace sporeprint::world_height_field_test {
namespace {

TEST(HeightField, GridsReachBeyondTheExtentByAnEighthOnEachSide) {
    for (const int extent : {256, 1024, 4096}) {
        const Grid grid = world_grid(extent);
        EXPECT_EQ(grid.side, 513);
        EXPECT_EQ(grid.place(0), -0.625 * extent);
        EXPECT_EQ(grid.place(256), 0.0) << "the centre of the world is a node";
        EXPECT_EQ(grid.place(512), 0.625 * extent);
    }
}

// So many places and features are looked at that chance moves the range by a few percent. The sum of
// octaves has tails that are slightly shorter than those of a normal distribution.
TEST(HeightField, NineteenOfTwentyPlacesLieWithinTheRelief) {
    for (const double roughness : {0.3, 0.47, 0.7}) {
        std::vector<double> all;
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            const HeightFunction function(
                {.relief = 100.0, .feature = 50.0, .roughness = roughness}, seed);
            std::vector<float> x, y;
            for (int i = 0; i < 100; ++i)
                for (int j = 0; j < 100; ++j) {
                    x.push_back(static_cast<float>(i * 37 - 1850));
                    y.push_back(static_cast<float>(j * 37 - 1850));
                }
            std::vector<double> heights(x.size());
            function.heights(x, y, heights);
            all.insert(all.end(), heights.begin(), heights.end());
        }
        std::sort(all.begin(), all.end());
        const auto quantile = [&](double share) {
            return all[static_cast<std::size_t>(share * static_cast<double>(all.size()))];
        };
        EXPECT_NEAR(quantile(0.9773) - quantile(0.0227), 100.0, 5.0) << roughness;
        EXPECT_NEAR(quantile(0.5), 0.0, 1.5);
        EXPECT_GT(quantile(0.9773), -1.5 * quantile(0.0227)) << "valleys are flatter than ridges";
    }
}

TEST(HeightField, ReliefScalesHeightsLinearly) {
    const std::vector<std::int32_t> low = heights_of({.relief = 60.0}, 3, 1024);
    const std::vector<std::int32_t> high = heights_of({.relief = 180.0}, 3, 1024);
    for (std::size_t i = 0; i < low.size(); ++i)
        ASSERT_LE(std::abs(high[i] - 3 * low[i]), 2) << "three times the rounding, and its own";
}

TEST(HeightField, ReliefZeroIsLevelGround) {
    for (const std::int32_t height : heights_of({.relief = 0.0}, 3, 256)) ASSERT_EQ(height, 0);
}

// A feature twice as large is the same ground, seen twice as large: coordinates that are powers of
// two apart have the same bits.
TEST(HeightField, FeatureScalesPlacesLinearly) {
    const HeightFunction fine({.feature = 200.0}, 5), coarse({.feature = 400.0}, 5);
    std::vector<float> x, y, doubled_x, doubled_y;
    for (int i = 0; i < 1000; ++i) {
        x.push_back(static_cast<float>(i) - 500.0F);
        y.push_back(static_cast<float>(i * i % 701) - 350.0F);
        doubled_x.push_back(2.0F * x.back());
        doubled_y.push_back(2.0F * y.back());
    }
    std::vector<double> a(x.size()), b(x.size());
    fine.heights(x, y, a);
    coarse.heights(doubled_x, doubled_y, b);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-3);
}

TEST(HeightField, OtherExtentsShareTheHeightsOfSharedPlaces) {
    const TerrainParams params{.relief = 300.0, .feature = 120.0};
    const std::vector<std::int32_t> small = heights_of(params, 7, 256);
    const std::vector<std::int32_t> middle = heights_of(params, 7, 1024);
    const std::vector<std::int32_t> large = heights_of(params, 7, 4096);
    const Grid grid = world_grid(256);
    int shared = 0;
    for (int j = 0; j < 513; ++j)
        for (int i = 0; i < 513; ++i) {
            // The cells of each extent are four times those of the one before.
            const int east = i - 256, north = j - 256;
            if (east % 4 != 0 || north % 4 != 0) continue;
            ASSERT_EQ(small[grid.index(i, j)], middle[grid.index(256 + east / 4, 256 + north / 4)]);
            ++shared;
            if (east % 16 != 0 || north % 16 != 0) continue;
            ASSERT_EQ(small[grid.index(i, j)],
                      large[grid.index(256 + east / 16, 256 + north / 16)]);
        }
    EXPECT_EQ(shared, 129 * 129);
}

TEST(HeightField, OtherSeedsAreOtherWorlds) {
    const std::vector<std::int32_t> one = heights_of({.feature = 100.0}, 1, 1024);
    for (const std::uint32_t seed : {0U, 2U, 4294967295U}) {
        const std::vector<std::int32_t> other = heights_of({.feature = 100.0}, seed, 1024);
        double product = 0.0, square = 0.0;
        for (std::size_t i = 0; i < one.size(); ++i) {
            product += static_cast<double>(one[i]) * other[i];
            square += static_cast<double>(one[i]) * one[i];
        }
        EXPECT_LT(std::abs(product / square), 0.3) << "not correlated: about 160 features";
    }
}

TEST(HeightField, IsTheSameWithEveryInstructionSet) {
    const std::vector<std::int32_t> first = heights_of({}, 11, 4096);
    for (const std::string& name : simd_names()) {
        force_simd(name);
        EXPECT_EQ(heights_of({}, 11, 4096), first) << name;
    }
    force_simd("auto");
}

// Neither a lattice nor an axis shows: differences along rows, along columns and along both diagonals
// are equally large in the mean of many seeds.
TEST(HeightField, HasNoPreferredDirection) {
    double along_row = 0.0, along_column = 0.0, rising = 0.0, falling = 0.0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const HeightFunction function({.feature = 60.0}, seed);
        std::vector<float> x, y;
        constexpr int side = 60;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                x.push_back(static_cast<float>(i * 21));
                y.push_back(static_cast<float>(j * 21));
            }
        std::vector<double> at(x.size());
        const auto differences = [&](float east, float north) {
            std::vector<float> other_x = x, other_y = y;
            for (float& one : other_x) one += east;
            for (float& one : other_y) one += north;
            std::vector<double> beside(x.size());
            function.heights(x, y, at);
            function.heights(other_x, other_y, beside);
            double sum = 0.0;
            for (std::size_t i = 0; i < at.size(); ++i)
                sum += (at[i] - beside[i]) * (at[i] - beside[i]);
            return sum;
        };
        along_row += differences(5.0F, 0.0F);
        along_column += differences(0.0F, 5.0F);
        rising += differences(3.5355339F, 3.5355339F);
        falling += differences(3.5355339F, -3.5355339F);
    }
    EXPECT_NEAR(along_column / along_row, 1.0, 0.06);
    EXPECT_NEAR(rising / along_row, 1.0, 0.06);
    EXPECT_NEAR(falling / along_row, 1.0, 0.06);
}

TEST(HeightField, HeightsAreRoundedToTheNearestUnit) {
    EXPECT_EQ(quantised_height(1.0), 1024);
    EXPECT_EQ(quantised_height(-1.0), -1024);
    EXPECT_EQ(quantised_height(0.49 / 1024.0), 0);
    EXPECT_EQ(quantised_height(-0.49 / 1024.0), 0);
    EXPECT_EQ(quantised_height(-0.51 / 1024.0), -1);
}

TEST(HeightField, RefusesWhatItCannotMake) {
    EXPECT_THROW(static_cast<void>(world_grid(512)), InvalidInput);
    EXPECT_THROW(static_cast<void>(heights_of({.relief = -1.0}, 1, 256)), InvalidInput);
    EXPECT_THROW(static_cast<void>(HeightFunction({.feature = std::nan("")}, 1)), InvalidInput);
    const HeightFunction function({}, 1);
    std::vector<float> three(3), four(4);
    std::vector<double> out(3);
    EXPECT_THROW(function.heights(three, four, out), InvalidInput);
}

}  // namespace
}  // namespace sporeprint::world_height_field_test
