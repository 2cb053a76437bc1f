#include "core/plant/leaf_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <thread>

#include "core/math/elementary.h"
#include "core/plant/leaf_shell.h"
#include "tests/support/atlas.h"
#include "tests/support/refusals.h"

namespace sporeprint::plant_leaf_image_test {
namespace {

constexpr int side = 128;

glm::dvec3 texel(const RawImages& images, std::size_t image, const glm::dvec2& at) {
    const auto x = static_cast<std::size_t>(at.x * side), y = static_cast<std::size_t>(at.y * side);
    const std::uint8_t* rgb = &images.rgb[image][3 * (y * side + x)];
    return glm::dvec3(rgb[0], rgb[1], rgb[2]) / 255.0;
}

TEST(LeafImage, ShowsThePaletteOnTheLamina) {
    for (const LeafPreset& preset : leaf_presets()) {
        SCOPED_TRACE(preset.id.string());
        const RawImages images = leaf_images(preset.shape, preset.palette, 0.0, 1, side);
        const Lamina lamina =
            lamina_of(preset.shape.venation, leaf_steps(preset.shape.venation, 0));
        const LeafChart chart = chart_of(lamina);
        const LaminaSampler reader(lamina);
        for (const bool upper : {true, false}) {
            // The centre of a texel.
            glm::dvec2 at = chart.texture_point({0.0, 0.45}, upper);
            at = (glm::floor(at * double{side}) + 0.5) / double{side};
            const glm::dvec3 seen = texel(images, 0, at);
            // The texel is the mean of sixteen points.
            glm::dvec3 wanted(0.0);
            for (int i = 0; i < 16; ++i) {
                const glm::dvec2 offset(i % 4 - 1.5, i / 4 - 1.5);
                bool face = false;
                const LaminaPlace place = reader.at(chart.place(at + offset / (4.0 * side), face));
                EXPECT_EQ(face, upper);
                wanted += leaf_colour(preset.palette, place, 0.0, upper) / 16.0;
            }
            // Blotches and the net change brightness by a quarter at most, which is an eighth of
            // the encoded value; below, needles have pale bands of pores.
            double half_breadth = 0.0;
            for (const glm::dvec2& place : border_of(lamina))
                half_breadth = std::max(half_breadth, place.x);
            const bool pores = !upper && half_breadth < 0.07;
            for (int k = 0; k < 3; ++k) {
                EXPECT_LT(seen[k], linear_to_srgb(wanted[k]) + (pores ? 0.3 : 0.13)) << upper;
                EXPECT_GT(seen[k], linear_to_srgb(wanted[k]) - 0.13) << upper;
            }
        }
    }
}

TEST(LeafImage, IsConstantOutsideTheLeafAndPaintedOnItsMargin) {
    const LeafPreset& maple = *leaf_preset("maple");
    const RawImages images = leaf_images(maple.shape, maple.palette, 0.5, 1, side);
    const Lamina lamina = lamina_of(maple.shape.venation, leaf_steps(maple.shape.venation, 0));
    const LeafChart chart = chart_of(lamina);
    LaminaPlace beyond;
    beyond.affinity = beyond.homothety = 1.0;
    beyond.from_main = 1e9;
    for (const bool upper : {true, false}) {
        const glm::dvec3 wanted = leaf_colour(maple.palette, beyond, 0.5, upper);
        // This is above the leaf.
        const glm::dvec2 away(upper ? 0.2 : 0.7, 0.05);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(texel(images, 0, away)[k], linear_to_srgb(wanted[k]), 0.004);
        EXPECT_EQ(texel(images, 1, away), glm::dvec3(128.0, 128.0, 255.0) / 255.0);
        // Texels beside the border are as bright as the leaf.
        std::size_t flat = 0, beside = 0;
        for (const glm::dvec2& place : border_of(lamina)) {
            const glm::dvec2 at = chart.texture_point(1.01 * place, upper);
            flat += texel(images, 0, at) == texel(images, 0, away);
            ++beside;
        }
        EXPECT_LT(flat, beside / 10);
    }
}

TEST(LeafImage, NormalsAreUnitVectorsThatLeanFromVeins) {
    const LeafPreset& birch = *leaf_preset("birch");
    const RawImages images = leaf_images(birch.shape, birch.palette, 0.0, 1, side);
    for (std::size_t i = 0; i < images.rgb[1].size(); i += 3) {
        const glm::dvec3 normal =
            2.0 * glm::dvec3(images.rgb[1][i], images.rgb[1][i + 1], images.rgb[1][i + 2]) / 255.0 -
            1.0;
        ASSERT_NEAR(glm::length(normal), 1.0, 0.02);
        ASSERT_GT(normal.z, 0.2);
    }
    // Right of the middle vein of the upper face, which is a groove, the normal leans to the left.
    const LeafChart chart =
        chart_of(lamina_of(birch.shape.venation, leaf_steps(birch.shape.venation, 0)));
    EXPECT_LT(texel(images, 1, chart.texture_point({0.01, 0.35}, true)).x, 0.48);
    EXPECT_GT(texel(images, 1, chart.texture_point({-0.01, 0.35}, true)).x, 0.52);
    EXPECT_GT(texel(images, 1, chart.texture_point({0.01, 0.35}, false)).x, 0.52);
}

TEST(LeafImage, IsTheSameWithAnyThreadsAndDiffersBetweenSeeds) {
    const LeafPreset& maple = *leaf_preset("maple");
    const RawImages one = leaf_images(maple.shape, maple.palette, 0.4, 1, 64);
    const Parallel in_threads = [](std::span<const std::function<void()>> pieces) {
        std::vector<std::thread> threads;
        for (const auto& piece : pieces) threads.emplace_back(piece);
        for (std::thread& thread : threads) thread.join();
    };
    EXPECT_EQ(one.rgb, leaf_images(maple.shape, maple.palette, 0.4, 1, 64, LeafLayout::alone, 0.0,
                                   in_threads)
                           .rgb);
    EXPECT_NE(one.rgb, leaf_images(maple.shape, maple.palette, 0.4, 2, 64).rgb);
}

TEST(LeafImage, TheNetIsPalerThanTheLaminaAndMarksAreBrown) {
    LeafPreset oak = *leaf_preset("oak");
    oak.shape.venation.net = oak.palette.marks = 0.0;
    const auto mean_of = [&] {
        const RawImages images = leaf_images(oak.shape, oak.palette, 0.0, 1, side);
        const LeafChart chart =
            chart_of(lamina_of(oak.shape.venation, leaf_steps(oak.shape.venation, 0)));
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 400; ++i)
            sum += texel(images, 0,
                         chart.texture_point({0.2 * (i % 20 / 10.0 - 1.0), 0.2 + 0.03 * (i / 20.0)},
                                             true)) /
                   400.0;
        return sum;
    };
    const glm::dvec3 plain = mean_of();
    oak.shape.venation.net = 1.0;
    const glm::dvec3 netted = mean_of();
    EXPECT_GT(netted.g, plain.g + 0.005);
    EXPECT_LT(netted.g, plain.g + 0.1);
    oak.palette.marks = 1.0;
    const glm::dvec3 marked = mean_of();
    EXPECT_LT(marked.g, netted.g - 0.005);
    EXPECT_GT(marked.r - marked.g, netted.r - netted.g);
}

TEST(LeafImage, OnlyNeedlesHaveAShootWithClearGaps) {
    for (const LeafPreset& preset : leaf_presets()) {
        SCOPED_TRACE(preset.id.string());
        const RawImages images = leaf_images(preset.shape, preset.palette, 0.0, 1, side);
        EXPECT_EQ(images.alpha.empty(), !has_shoot(preset.shape.venation));
        if (images.alpha.empty()) continue;
        ASSERT_EQ(images.alpha.size(), std::size_t{side} * side);
        const auto alpha = [&](double u, double v) {
            return images.alpha[static_cast<std::size_t>(v * side) * side +
                                static_cast<std::size_t>(u * side)];
        };
        // The lamina itself and the petiole are opaque, and so is the twig of the shoot.
        const LeafChart chart =
            chart_of(lamina_of(preset.shape.venation, leaf_steps(preset.shape.venation, 0)));
        for (const bool upper : {true, false}) {
            const glm::dvec2 middle = chart.texture_point({0.0, 0.5}, upper);
            EXPECT_EQ(alpha(middle.x, middle.y), 255);
            const double half = upper ? 0.0 : 0.5;
            for (const LeafPanel& panel : {shoot_panel, spray_panel}) {
                EXPECT_GT(alpha(half + panel.middle, panel.root - 0.3 * panel.length), 150);
                // Beside it nothing is drawn, so that smaller copies have no border.
                for (const double across : {-1.06, 1.06})
                    for (const double along : {0.05, 0.5, 0.95})
                        EXPECT_EQ(alpha(half + panel.middle + across * panel.half,
                                        panel.root - along * panel.length),
                                  0);
            }
        }
        const auto covered = [&](const LeafPanel& panel, double from, double to) {
            double sum = 0.0, all = 0.0;
            for (double along = from; along < to; along += 0.01)
                for (double across = -0.99; across < 1.0; across += 0.02, all += 255.0)
                    sum += alpha(panel.middle + across * panel.half,
                                 panel.root - along * panel.length);
            return sum / all;
        };
        EXPECT_GT(covered(shoot_panel, 0.01, 0.99), 0.4);
        EXPECT_LT(covered(shoot_panel, 0.01, 0.99), 0.8);
        // A spray is narrower at its tip.
        EXPECT_GT(covered(spray_panel, 0.2, 0.4), 0.3);
        EXPECT_LT(covered(spray_panel, 0.8, 0.99), 0.5 * covered(spray_panel, 0.2, 0.4));
    }
    EXPECT_TRUE(shows_shoots(leaf_preset("shoot")->shape));
    EXPECT_FALSE(shows_shoots(leaf_preset("needle")->shape)) << "It is a needle, not a shoot.";
    EXPECT_FALSE(shows_shoots(leaf_preset("fern")->shape));
}

TEST(LeafImage, SnowLiesOnUpperFacesOnly) {
    for (const LeafPreset& preset : leaf_presets()) {
        SCOPED_TRACE(preset.id.string());
        const LeafChart chart =
            chart_of(lamina_of(preset.shape.venation, leaf_steps(preset.shape.venation, 0)));
        const auto mean_of = [&](double snow, bool upper) {
            const RawImages images =
                leaf_images(preset.shape, preset.palette, 0.0, 1, side, LeafLayout::alone, snow);
            glm::dvec3 sum(0.0);
            for (int i = 0; i < 100; ++i)
                sum += texel(images, 0, chart.texture_point({0.0, 0.2 + 0.006 * i}, upper)) / 100.0;
            return sum;
        };
        const glm::dvec3 bare = mean_of(0.0, true), some = mean_of(0.5, true),
                         deep = mean_of(1.0, true);
        EXPECT_GT(some.b, bare.b + 0.05);
        EXPECT_GT(deep.b, some.b + 0.05);
        EXPECT_GT(deep.b, 0.8);
        EXPECT_EQ(mean_of(1.0, false), mean_of(0.0, false));
    }
}

TEST(LeafImage, InvalidRequestsAreRefused) {
    const LeafPreset& maple = *leaf_preset("maple");
    EXPECT_TRUE(names(refusal([&] { (void)leaf_images(maple.shape, maple.palette, 1.5, 1, 100); }),
                      "/side", "100"));
    EXPECT_TRUE(names(refusal([&] { (void)leaf_images(maple.shape, maple.palette, 1.5, 1, 64); }),
                      "/autumn", "outside"));
    EXPECT_TRUE(names(refusal([&] {
                          (void)leaf_images(maple.shape, maple.palette, 0.0, 1, 64,
                                            LeafLayout::alone, -0.1);
                      }),
                      "/snow", "outside"));
}

}  // namespace
}  // namespace sporeprint::plant_leaf_image_test
