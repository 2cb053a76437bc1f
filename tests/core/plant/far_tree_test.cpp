#include "core/plant/far_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/mesh/measure.h"
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
