#include "core/plant/far_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/images.h"
#include "core/mesh/measure.h"
#include "core/plant/leaf_image.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"
#include "tests/support/orders.h"

namespace sporeprint::plant_far_tree_test {
namespace {

constexpr std::array<std::size_t, far_lods> budgets = {400, 96, 24};

FarTree far_of(const TreePreset& preset, std::uint32_t seed, int level) {
    return far_tree(grown_tree(preset.shape, seed), preset.leaves,
                    leaf_preset(preset.leaf.id)->shape, seed, level);
}

TEST(FarTree, HasAboutTheStatedTriangles) {
    for (const TreePreset& preset : tree_presets())
        for (int level = 0; level < far_lods; ++level)
            for (const std::uint32_t seed : {1U, 2U, 3U}) {
                SCOPED_TRACE(preset.id.string() + ' ' + std::to_string(level));
                const FarTree far = far_of(preset, seed, level);
                const std::size_t triangles =
                    far.bark.mesh.triangles() +
                    far.foliage.leaves.size() * far.foliage.leaf.triangles();
                const std::size_t budget = budgets[static_cast<std::size_t>(level)];
                EXPECT_LE(triangles, budget);
                EXPECT_GE(10 * triangles, 8 * budget);
                const FarCount most = far_count(level, 1000);
                EXPECT_LE(triangles, most.triangles());
                EXPECT_EQ(far.foliage.leaf.triangles(), most.leaf_triangles);
                EXPECT_EQ(far.foliage.leaf.positions.size(), most.leaf_vertices);
                EXPECT_LE(far.bark.mesh.positions.size(), most.spikes * FarCount::spike_vertices);
            }
}

TEST(FarTree, IsOfClosedPieces) {
    for (const TreePreset& preset : tree_presets())
        for (int level = 0; level < far_lods; ++level) {
            SCOPED_TRACE(preset.id.string() + ' ' + std::to_string(level));
            const FarTree far = far_of(preset, 2, level);
            EXPECT_EQ(defects(far.bark.mesh), std::vector<std::string>());
            EXPECT_EQ(defects(merged_leaves(far.foliage.leaves, far.foliage.leaf)),
                      std::vector<std::string>());
            EXPECT_EQ(far.bark.edges.size(), far.bark.mesh.positions.size());
        }
}

// A clump shows less of the image than the width of a vein: no vein of its leaf is seen in its size.
TEST(FarTree, ClumpsShowOneColourOfTheirLeaf) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const FarTree far = far_of(preset, 1, 2);
        for (const bool upper : {true, false}) {
            glm::vec2 low(2.0F), high(-2.0F);
            for (const glm::vec2& at : far.foliage.leaf.texture_coordinates) {
                if ((at.x < 0.5F) != upper) continue;
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
            EXPECT_GT(high.x, low.x);
            EXPECT_LT(std::max(high.x - low.x, high.y - low.y), 0.02F);
        }
    }
}

/// Returns the colour of an image at a place, sRGB 0..255.
glm::dvec3 colour_at(const RawImages& images, glm::dvec2 at) {
    const auto texel = [&](double place) {
        return static_cast<std::size_t>(std::clamp(place, 0.0, 0.9999) * images.side);
    };
    const std::size_t i = 3 * (texel(at.y) * static_cast<std::size_t>(images.side) + texel(at.x));
    const Bytes& rgb = images.rgb[0];
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
}

TEST(FarTree, ClumpsHaveTheColourOfTheirLeafAlsoInAutumn) {
    for (const TreePreset& preset : tree_presets()) {
        const LeafPreset& leaf = *leaf_preset(preset.leaf.id);
        const Lamina lamina = lamina_of(leaf.shape.venation, leaf_steps(leaf.shape.venation, 0));
        const LeafLayout layout = layout_on_trees(leaf.shape);
        const LeafChart chart = chart_of(lamina, layout);
        const LaminaSampler sampler(lamina);
        const FarTree far = far_of(preset, 1, 2);
        glm::dvec2 clump(0.0);
        double corners = 0.0;
        for (const glm::vec2& at : far.foliage.leaf.texture_coordinates)
            if (at.x < 0.5F) {
                clump += glm::dvec2(at);
                corners += 1.0;
            }
        for (const double autumn : {0.0, 0.15, 0.25, 0.35, 0.5, 0.75}) {
            SCOPED_TRACE(preset.id.string() + ' ' + std::to_string(autumn));
            const RawImages images = leaf_images(leaf.shape, leaf.palette, autumn, 1, 128, layout);
            glm::dvec3 sum(0.0);
            double places = 0.0;
            for (int i = 0; i < 60; ++i)
                for (int k = 0; k < 60; ++k) {
                    const glm::dvec2 place(0.6 * (i + 0.5) / 60, (k + 0.5) / 60);
                    if (!sampler.at(place).inside) continue;
                    sum += colour_at(images, glm::dvec2(chart.texture_point(place, true)));
                    places += 1.0;
                }
            const glm::dvec3 found = colour_at(images, clump / corners), mean = sum / places;
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(found[channel], mean[channel], 36.0) << channel;
        }
    }
}

TEST(FarTree, OfABareTreeIsItsThickestBranches) {
    TreePreset bare = *tree_preset("broadleaf");
    bare.leaves.per_tip = 0;
    for (int level = 0; level < far_lods; ++level) {
        const FarTree far = far_of(bare, 1, level);
        EXPECT_TRUE(far.foliage.leaves.empty());
        EXPECT_EQ(far.bark.mesh.triangles(), budgets[static_cast<std::size_t>(level)]);
        EXPECT_EQ(far_count(level, 0).triangles(), budgets[static_cast<std::size_t>(level)]);
    }
}

}  // namespace
}  // namespace sporeprint::plant_far_tree_test
