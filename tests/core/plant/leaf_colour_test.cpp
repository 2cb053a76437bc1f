#include "core/plant/leaf_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/elementary.h"
#include "core/plant/leaf.h"
#include "tests/support/atlas.h"

namespace sporeprint::plant_leaf_colour_test {
namespace {

glm::dvec3 linear(const Colour& colour) {
    return {srgb_to_linear(colour.r / 255.0), srgb_to_linear(colour.g / 255.0),
            srgb_to_linear(colour.b / 255.0)};
}

// A place between veins, which shows the gradation alone.
LaminaPlace between(double affinity, double homothety) {
    LaminaPlace place;
    place.inside = true;
    place.affinity = affinity;
    place.homothety = homothety;
    place.from_main = place.from_side = 1.0;
    return place;
}

TEST(LeafColour, GradationsRiseFromZeroToOneMonotonically) {
    for (int i = 0; name(static_cast<GradationLaw>(i)); ++i) {
        const auto law = static_cast<GradationLaw>(i);
        EXPECT_EQ(gradation(law, 0.0), 0.0);
        EXPECT_EQ(gradation(law, 1.0), 1.0);
        for (double x = 0.0; x < 1.0; x += 0.01)
            EXPECT_LE(gradation(law, x), gradation(law, x + 0.01)) << name(law);
    }
    EXPECT_EQ(gradation(GradationLaw::linear, 0.3), 0.3);
    EXPECT_EQ(gradation(GradationLaw::late, 0.5), 0.125);
}

TEST(LeafColour, AffinityGoesFromTheMainVeinToTheBorderAndHomothetyToTheTip) {
    LeafPalette palette;
    palette.summer.affinity = palette.summer.homothety = GradationLaw::linear;
    palette.summer.homothety_share = 0.0;
    const LeafColours& summer = palette.summer;
    const auto expect_colour = [&](const LaminaPlace& place, const glm::dvec3& wanted) {
        EXPECT_LT(glm::distance(leaf_colour(palette, place, 0.0, true), wanted), 1e-12);
    };
    expect_colour(between(0.0, 0.2), linear(summer.inner));
    expect_colour(between(1.0, 0.2), linear(summer.border));
    expect_colour(between(0.5, 0.2), 0.5 * (linear(summer.inner) + linear(summer.border)));
    palette.summer.homothety_share = 1.0;
    expect_colour(between(0.3, 1.0), linear(summer.tip));
    LaminaPlace on_vein = between(0.0, 0.0);
    on_vein.from_main = 0.0;
    expect_colour(on_vein, linear(summer.vein));
}

TEST(LeafColour, LeavesThatUnfoldArePalerAndYellower) {
    for (const LeafPreset& preset : atlas().leaves()) {
        const std::string id = preset.id.string();
        const LeafColours& summer = preset.palette.summer;
        EXPECT_EQ(unfolding(summer, 0.0), summer) << id;
        const LeafColours young = unfolding(summer, 1.0), younger_half = unfolding(summer, 0.5);
        const glm::dvec3 before = linear(young.inner), half = linear(younger_half.inner),
                         after = linear(summer.inner);
        EXPECT_GT(before.g, half.g) << id;
        EXPECT_GT(half.g, after.g) << id;
        EXPECT_GT(before.r / before.g, after.r / after.g) << id;
        EXPECT_EQ(young.vein_width, summer.vein_width) << id;
    }
}

TEST(LeafColour, AutumnBeginsAtTheBorder) {
    const LeafPalette& palette = leaf_preset("maple")->palette;
    const glm::dvec3 inner = leaf_colour(palette, between(0.0, 0.0), 0.0, true);
    const glm::dvec3 outer = leaf_colour(palette, between(1.0, 1.0), 0.0, true);
    EXPECT_LT(glm::distance(inner, leaf_colour(palette, between(0.0, 0.0), 0.15, true)), 1e-12);
    EXPECT_GT(glm::distance(outer, leaf_colour(palette, between(1.0, 1.0), 0.15, true)), 0.01);
    // In full autumn colour and on the ground the whole leaf has turned.
    for (const double share : {0.0, 0.5, 1.0}) {
        LeafPalette turned;
        turned.summer = turned.turning = turned.fallen = palette.turning;
        EXPECT_LT(glm::distance(leaf_colour(palette, between(share, share), 0.5, true),
                                leaf_colour(turned, between(share, share), 0.5, true)),
                  1e-12);
        turned.summer = turned.turning = turned.fallen = palette.fallen;
        EXPECT_LT(glm::distance(leaf_colour(palette, between(share, share), 1.0, true),
                                leaf_colour(turned, between(share, share), 1.0, true)),
                  1e-12);
    }
}

TEST(LeafColour, ColoursStayInRange) {
    for (const LeafPreset& preset : leaf_presets())
        for (double autumn = 0.0; autumn <= 1.0; autumn += 0.05)
            for (double at = 0.0; at <= 1.0; at += 0.1)
                for (const bool upper : {true, false}) {
                    LaminaPlace place = between(at, 1.0 - at);
                    place.from_main = 0.01 * at;
                    place.from_side = 0.002;
                    place.along_side = at;
                    const glm::dvec3 colour = leaf_colour(preset.palette, place, autumn, upper);
                    for (int k = 0; k < 3; ++k) {
                        EXPECT_GE(colour[k], 0.0);
                        EXPECT_LE(colour[k], 1.0);
                    }
                }
}

TEST(LeafColour, LeavesTurnEarlierAndLaterThanTheirTree) {
    double sum = 0.0, low = 1.0, high = 0.0;
    for (std::uint32_t leaf = 0; leaf < 4000; ++leaf) {
        EXPECT_EQ(leaf_autumn(0.0, 1.0, 3, leaf), 0.0);
        EXPECT_EQ(leaf_autumn(1.0, 1.0, 3, leaf), 1.0);
        EXPECT_EQ(leaf_autumn(0.4, 0.0, 3, leaf), 0.4);
        const double own = leaf_autumn(0.5, 0.6, 3, leaf);
        sum += own;
        low = std::min(low, own);
        high = std::max(high, own);
    }
    // Uniform in 0.5 +- 0.3: the mean of 4,000 lies within five standard deviations of 0.0027.
    EXPECT_NEAR(sum / 4000.0, 0.5, 0.014);
    EXPECT_NEAR(low, 0.2, 0.01);
    EXPECT_NEAR(high, 0.8, 0.01);
}

}  // namespace
}  // namespace sporeprint::plant_leaf_colour_test
