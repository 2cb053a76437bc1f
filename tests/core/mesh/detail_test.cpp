#include "core/mesh/detail.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace sporeprint::mesh_detail_test {
namespace {

constexpr std::array<int Detail::*, 8> counts = {
    &Detail::stem_rings,  &Detail::hymenium_rings, &Detail::cap_rings,  &Detail::columns,
    &Detail::patch_sides, &Detail::patch_rings,    &Detail::veil_rings, &Detail::sac_rings};

std::vector<DetailLevel> all_levels() {
    std::vector<DetailLevel> levels;
    for (int lod = 0; lod + 1 < static_cast<int>(details.size()); ++lod)
        for (int eighths = 0; eighths < DetailLevel::steps; ++eighths)
            levels.emplace_back(lod, eighths);
    levels.emplace_back(static_cast<int>(details.size()) - 1);
    return levels;
}

TEST(DetailLevel, IsOrderedAndKnowsTheNearestWholeOne) {
    const std::vector<DetailLevel> levels = all_levels();
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        EXPECT_LT(levels[i], levels[i + 1]);
        EXPECT_DOUBLE_EQ(levels[i + 1].number() - levels[i].number(), 0.125);
    }
    EXPECT_EQ(DetailLevel(1, 3).nearest(), 1);
    EXPECT_EQ(DetailLevel(1, 4).nearest(), 2) << "half-way the cheaper one";
    EXPECT_EQ(DetailLevel(2).nearest(), 2);
    EXPECT_TRUE(DetailLevel(2).is_whole());
    EXPECT_FALSE(DetailLevel(2, 1).is_whole());
}

TEST(DetailLevel, OfAWholeLodHasItsCounts) {
    for (int lod = 0; lod < static_cast<int>(details.size()); ++lod)
        for (const auto count : counts)
            EXPECT_EQ(detail_of(lod).*count, details[static_cast<std::size_t>(lod)].*count) << lod;
    EXPECT_EQ(detail_of(farthest_lod).cap_rings, farthest_detail.cap_rings);
}

TEST(DetailLevel, CountsNeverRiseFromOneLevelToTheNext) {
    const std::vector<DetailLevel> levels = all_levels();
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
        const Detail finer = detail_of(levels[i]), coarser = detail_of(levels[i + 1]);
        for (const auto count : counts)
            EXPECT_LE(coarser.*count, finer.*count) << levels[i + 1].number();
        EXPECT_EQ(coarser.columns % 2, 0);
        EXPECT_TRUE(coarser.patch_sides == 0 || coarser.patch_sides >= 3);
        EXPECT_GT(coarser.patches, 0.0);
    }
}

TEST(DetailLevel, BetweenTwoValuesIsAGeometricProgression) {
    EXPECT_DOUBLE_EQ(between(6.0, 1.0, 2), 6.0);
    EXPECT_NEAR(between(100.0, 1.0, {0, 4}), 10.0, 1e-9);
    for (int i = 0; i + 2 < DetailLevel::steps; ++i)
        EXPECT_NEAR(between(60.0, 7.0, {1, i + 1}) / between(60.0, 7.0, {1, i}),
                    between(60.0, 7.0, {1, i + 2}) / between(60.0, 7.0, {1, i + 1}), 1e-12);
    EXPECT_NEAR(between(60.0, 7.0, {0, 7}) * std::pow(7.0 / 60.0, 0.125), 7.0, 1e-9);
}

}  // namespace
}  // namespace sporeprint::mesh_detail_test
