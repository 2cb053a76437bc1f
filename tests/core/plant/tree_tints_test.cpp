#include "core/plant/tree_tints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <vector>

#include "tests/support/orders.h"

namespace sporeprint::plant_tree_tints_test {
namespace {

constexpr std::uint32_t seed = 3;

double distance(const glm::vec3& a, const glm::vec3& b) {
    return static_cast<double>(glm::distance(a, b));
}

TEST(TreeTints, AreFactorsOfTheBaseColourAtEverySpread) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, seed);
        for (const double spread : {0.0, 0.5, 1.0}) {
            const TreeTints tints(tree, spread, seed);
            for (const PlacedLeaf& leaf : placed_leaves(tree, preset.leaves, seed)) {
                const glm::vec3 tint = tints.of_leaf(leaf);
                EXPECT_TRUE(glm::all(glm::greaterThan(tint, glm::vec3(0.0F))));
                EXPECT_TRUE(glm::all(glm::lessThanEqual(tint, glm::vec3(1.0F))));
                if (spread == 0.0) {
                    EXPECT_EQ(tint, glm::vec3(1.0F));
                }
            }
        }
    }
}

TEST(TreeTints, SurfacesThatMeetAreAlike) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, seed);
        const TreeTints tints(tree, 1.0, seed);
        for (std::uint32_t i = 1; i < tree.ramification.nodes.size(); ++i) {
            const std::uint32_t parent = tree.ramification.nodes[i].parent;
            const glm::dvec3 joint = tree.skeleton.nodes[parent + 1].place;
            EXPECT_LT(distance(tints.of_bark(joint, i), tints.of_bark(joint, parent)), 1e-5) << i;
        }
    }
}

// Leaves of one main branch are more alike than those of the whole crown.
TEST(TreeTints, BranchesDifferMoreThanTheirLeaves) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, seed);
        const TreeTints tints(tree, 0.5, seed);
        const std::vector<PlacedLeaf> leaves = placed_leaves(tree, preset.leaves, seed);
        std::map<std::uint32_t, std::vector<glm::vec3>> by_twig;
        std::vector<glm::vec3> all;
        for (const PlacedLeaf& leaf : leaves) {
            all.push_back(tints.of_leaf(leaf));
            by_twig[leaf.twig].push_back(all.back());
        }
        const auto squares = [](const std::vector<glm::vec3>& of) {
            glm::dvec3 middle(0.0);
            for (const glm::vec3& one : of)
                middle += glm::dvec3(one) / static_cast<double>(of.size());
            double sum = 0.0;
            for (const glm::vec3& one : of) {
                const glm::dvec3 way = glm::dvec3(one) - middle;
                sum += glm::dot(way, way);
            }
            return sum;
        };
        double within = 0.0;
        for (const auto& [twig, some] : by_twig) within += squares(some);
        EXPECT_LT(within, 0.4 * squares(all));
        EXPECT_GT(squares(all) / static_cast<double>(all.size()), 0.002) << "a flat green";
    }
}

// Common levels of detail show the same tints at the same places.
TEST(TreeTints, AreThoseOfThePlaceAtEveryLevel) {
    const TreePreset& preset = *tree_preset("broadleaf");
    const Tree tree = grown_tree(preset.shape, seed);
    const TreeTints tints(tree, 0.5, seed);
    for (int lod = 0; lod < tree_lods; ++lod) {
        const Bark bark = bark_of(tree, lod);
        const std::vector<glm::vec3> of = tints_of(bark, tints);
        ASSERT_EQ(of.size(), bark.mesh.positions.size());
        for (std::size_t i = 0; i < of.size(); ++i)
            EXPECT_EQ(of[i], tints.of_bark(glm::dvec3(bark.mesh.positions[i]), bark.edges[i]));
    }
    EXPECT_NE(TreeTints(tree, 0.5, seed + 1).of_leaf(placed_leaves(tree, preset.leaves, seed)[0]),
              tints.of_leaf(placed_leaves(tree, preset.leaves, seed)[0]))
        << "another seed has other hues";
}

}  // namespace
}  // namespace sporeprint::plant_tree_tints_test
