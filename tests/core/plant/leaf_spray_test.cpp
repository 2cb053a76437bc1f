#include "core/plant/leaf_spray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/math/elementary.h"
#include "core/mesh/measure.h"
#include "core/plant/leaf_image.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_leaf_spray_test {
namespace {

constexpr int side = 256;

/// Returns the share of the card's triangle on which an image is opaque.
double opaque_share(const RawImages& images, const LeafPanel& panel) {
    double opaque = 0.0, all = 0.0;
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double along = (i + 0.5) / steps, across = 2.0 * (k + 0.5) / steps - 1.0;
            if (std::abs(across) > 1.0 - along) continue;
            const auto x = static_cast<std::size_t>((panel.middle + across * panel.half) * side),
                       y = static_cast<std::size_t>((panel.root - along * panel.length) * side);
            all += 1.0;
            opaque += images.alpha[y * side + x] >= 128 ? 1.0 : 0.0;
        }
    return opaque / all;
}

TEST(LeafSpray, SimpleLeavesThatAreNoNeedlesHaveThem) {
    for (const char* const leaf : {"beech", "birch", "oak", "maple", "ivy"})
        EXPECT_TRUE(shows_sprays(leaf_preset(leaf)->shape)) << leaf;
    for (const char* const leaf : {"needle", "shoot", "fern"})
        EXPECT_FALSE(shows_sprays(leaf_preset(leaf)->shape)) << leaf;
}

TEST(LeafSpray, LeavesStandOnTheirWoodWithinTheTriangleOfTheCard) {
    for (const LeafGroup spray : all_sprays)
        for (std::uint32_t seed = 1; seed <= 50; ++seed) {
            SCOPED_TRACE(std::string(name(spray)) + ' ' + std::to_string(seed));
            const double half = panel_of(spray).half_breadth;
            const SprayParts parts = parts_of(spray, seed);
            EXPECT_GE(parts.leaves.size(), spray == LeafGroup::twig ? 5U : 15U);
            for (const SprayLeaf& leaf : parts.leaves) {
                double away = 1.0;
                for (const SprayWood& wood : parts.wood) {
                    const glm::dvec2 way = wood.to - wood.from, at = leaf.root - wood.from;
                    const double t = std::clamp(glm::dot(at, way) / glm::dot(way, way), 0.0, 1.0);
                    away = std::min(away, glm::distance(at, t * way));
                }
                EXPECT_LT(away, 1e-9);
                // Deviations take the middle of a leaf at most a little beyond it.
                const SineCosine turn = sine_cosine(radians(leaf.angle_deg));
                const glm::dvec2 middle =
                    leaf.root + 0.5 * leaf.size * glm::dvec2(turn.sine, turn.cosine);
                EXPECT_LT(std::abs(middle.x) / half + middle.y, 1.05);
                EXPECT_GT(middle.y, -0.05);
            }
        }
}

TEST(LeafSpray, ItsImageCoversAboutTheStatedShareAndNothingBesideIt) {
    for (const LeafPreset& preset : leaf_presets()) {
        if (!shows_sprays(preset.shape)) continue;
        const RawImages images =
            leaf_images(preset.shape, preset.palette, 0.0, 1, side, LeafLayout::with_sprays);
        ASSERT_EQ(images.alpha.size(), std::size_t{side} * side);
        for (const LeafGroup spray : all_sprays) {
            SCOPED_TRACE(preset.id.string() + ' ' + name(spray));
            const LeafPanel& panel = panel_of(spray);
            const double share = opaque_share(images, panel);
            // Where leaves are before each other, less is covered; wood covers a little.
            EXPECT_LT(share, 1.25 * covered_share(preset.shape, spray));
            EXPECT_GT(share, 0.55 * covered_share(preset.shape, spray));
            for (const double half : {0.0, 0.5})
                for (const double along : {0.02, 0.5, 0.98})
                    for (const double across : {-1.02, 1.02}) {
                        const auto x = static_cast<std::size_t>(
                                       (half + panel.middle + across * panel.half) * side),
                                   y = static_cast<std::size_t>(
                                       (panel.root - along * panel.length) * side);
                        EXPECT_EQ(images.alpha[y * side + x], 0) << along << ' ' << across;
                    }
        }
    }
}

TEST(LeafSpray, TheLeafBesideItIsTheSameAsAlone) {
    for (const LeafPreset& preset : leaf_presets()) {
        if (!shows_sprays(preset.shape)) continue;
        const Lamina lamina =
            lamina_of(preset.shape.venation, leaf_steps(preset.shape.venation, 0));
        const LeafChart small = chart_of(lamina, LeafLayout::with_sprays), large = chart_of(lamina);
        EXPECT_LT(small.scale, 0.5 * large.scale);
        const RawImages both = leaf_images(preset.shape, preset.palette, 0.5, 1, side,
                                           LeafLayout::with_sprays),
                        alone = leaf_images(preset.shape, preset.palette, 0.5, 1, side);
        const auto mean_of = [](const RawImages& images, const LeafChart& chart) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < 400; ++i) {
                const glm::dvec2 at = chart.texture_point(
                    {0.15 * (i % 20 / 10.0 - 1.0), 0.25 + 0.02 * (i / 20.0)}, true);
                const std::uint8_t* const rgb =
                    &images.rgb[0][3 * (static_cast<std::size_t>(at.y * side) * side +
                                        static_cast<std::size_t>(at.x * side))];
                sum += glm::dvec3(rgb[0], rgb[1], rgb[2]) / 400.0;
            }
            return sum;
        };
        EXPECT_LT(glm::distance(mean_of(both, small), mean_of(alone, large)), 6.0)
            << preset.id.string();
    }
}

TEST(LeafSpray, ACardCoversAsMuchAsItsLeaf) {
    for (const LeafPreset& preset : leaf_presets())
        for (const std::size_t triangles : {2U, 4U, 8U, 12U, 16U})
            for (const LeafGroup group : all_sprays) {
                SCOPED_TRACE(preset.id.string() + ' ' + name(group) + std::to_string(triangles));
                LeafShape flat = preset.shape;
                flat.curl_deg = flat.fold_deg = flat.wave = 0.0;
                const GroupLeaf leaf = leaf_of_group(flat, triangles, group);
                expect_valid(leaf.mesh);
                EXPECT_EQ(leaf.mesh.triangles(), triangles);
                if (!shows_sprays(flat)) continue;
                const double area = 0.5 * surface_moments(leaf.mesh).area;
                // A fan has a thickness at its middle.
                EXPECT_NEAR(leaf.covered * area / lamina_area(flat), 1.0, 0.02);
                for (const std::size_t fine : {4U, 8U, 12U, 16U}) {
                    const Mesh finest = finest_foliage_leaf(preset.shape, fine, group);
                    expect_valid(finest);
                    EXPECT_EQ(finest.triangles(), fine);
                    EXPECT_LE(finest.positions.size(), finest_leaf_vertices(fine));
                }
            }
}

}  // namespace
}  // namespace sporeprint::plant_leaf_spray_test
