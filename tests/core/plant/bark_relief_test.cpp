#include "core/plant/bark_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/refusals.h"

namespace sporeprint::plant_bark_relief_test {
namespace {

/// Returns the rise of bark at places of one line across.
std::vector<float> rise_across(Substrate kind, const std::vector<float>& across, float along) {
    const std::vector<float> height(across.size(), along);
    return bark_rise(kind, BarkNoise(kind, across, height));
}

TEST(BarkRelief, LiesBetweenTheDeepestFurrowAndTheHighestRidge) {
    std::vector<float> across;
    for (int i = 0; i <= 200; ++i) across.push_back(static_cast<float>(i) / 200.0F);
    for (const Substrate kind : all_woods) {
        EXPECT_GT(bark_depth(kind), 0.0) << name(kind);
        EXPECT_LE(bark_depth(kind), deepest_bark) << name(kind);
        float low = 1.0F, high = 0.0F;
        for (const float along : {0.0F, 0.31F, 0.7F, 3.2F})
            for (const float rise : rise_across(kind, across, along)) {
                low = std::min(low, rise);
                high = std::max(high, rise);
            }
        EXPECT_GE(low, 0.0F) << name(kind);
        EXPECT_LE(high, 1.0F) << name(kind);
        EXPECT_GT(high - low, 0.3F) << name(kind);
    }
}

TEST(BarkRelief, WrapsAcrossAndDoesNotDependOnItsNeighbours) {
    for (const Substrate kind : all_woods)
        for (const float along : {0.1F, 0.55F}) {
            const std::vector<float> ends = rise_across(kind, {0.0F, 0.4F, 1.0F}, along);
            EXPECT_NEAR(ends[0], ends[2], 1e-4F) << name(kind);
            EXPECT_EQ(ends[1], rise_across(kind, {0.4F}, along)[0]) << name(kind);
        }
}

TEST(BarkRelief, OfNoWoodIsRefused) {
    EXPECT_TRUE(names(refusal([] { (void)bark_depth(Substrate::none); }), "/substrate", "no wood"));
}

}  // namespace
}  // namespace sporeprint::plant_bark_relief_test
