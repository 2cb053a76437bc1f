#include "core/plant/foliage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/math/principal_axes.h"
#include "core/mesh/measure.h"
#include "core/plant/leaf_image.h"
#include "core/plant/leaf_shell.h"
#include "core/plant/leaf_spray.h"
#include "tests/support/atlas.h"
#include "tests/support/meshes.h"

namespace sporeprint::plant_foliage_test {
namespace {

struct Preset {
    Tree tree;
    LeafStyle style;
    LeafShape leaf;
};

Preset preset_of(const std::string& id, std::uint32_t seed = 1) {
    const TreePreset& preset = *atlas().find_tree(id);
    return {grown_tree(preset.shape, seed), preset.leaves,
            atlas().find_leaf(preset.leaf.id)->shape};
}

LeafShape flat(LeafShape shape) {
    shape.curl_deg = shape.fold_deg = shape.wave = 0.0;
    return shape;
}

/// Returns how many times as long as broad a surface is, by the variances of its points.
double slenderness_of(const Mesh& mesh) {
    const PrincipalAxes axes = principal_axes(surface_moments(mesh).covariance);
    return std::sqrt(axes.variances[0] / axes.variances[1]);
}

TEST(FoliageLevels, EachHasAtMostTheLeavesAndTrianglesOfTheOneBefore) {
    for (std::size_t leaves = 0; leaves <= most_leaves; leaves = leaves * 5 / 4 + 1) {
        EXPECT_EQ(foliage_count(0, leaves), leaves);
        for (int lod = 0; lod < tree_lods; ++lod) {
            const std::size_t count = foliage_count(lod, leaves),
                              triangles = leaf_triangles(lod, leaves);
            EXPECT_LE(count, leaves);
            EXPECT_EQ(count == 0, leaves == 0);
            EXPECT_TRUE(std::set<std::size_t>({2, 4, 8, 12, 16}).contains(triangles)) << triangles;
            if (lod == 0) continue;
            EXPECT_LE(count, foliage_count(lod - 1, leaves)) << leaves;
            EXPECT_LE(count * triangles,
                      foliage_count(lod - 1, leaves) * leaf_triangles(lod - 1, leaves))
                << leaves << ' ' << lod;
        }
    }
}

TEST(FoliageLevels, VerticesOfALeafAreCountedWithoutIt) {
    for (const LeafPreset& preset : atlas().leaves())
        for (const std::size_t triangles : {2u, 4u, 8u, 12u, 16u}) {
            const Mesh leaf = foliage_leaf(preset.shape, triangles);
            EXPECT_EQ(leaf.positions.size(), leaf_vertices(triangles));
            EXPECT_EQ(leaf.triangles(), triangles);
        }
}

TEST(FoliageLevels, FinestLeavesAreValidAndHaveNoMoreVerticesThanCounted) {
    for (const LeafPreset& preset : atlas().leaves())
        for (const std::size_t triangles : {4u, 8u, 12u, 16u}) {
            SCOPED_TRACE(preset.id.string() + std::to_string(triangles));
            const Mesh leaf = finest_foliage_leaf(preset.shape, triangles);
            expect_valid(leaf);
            EXPECT_EQ(leaf.triangles(), triangles);
            EXPECT_LE(leaf.positions.size(), finest_leaf_vertices(triangles));
        }
}

TEST(GroupedLeaves, AsManyAsThereAreStayAsTheyAre) {
    const Preset shrub = preset_of("shrub");
    const Mesh leaf = foliage_leaf(flat(shrub.leaf), 4);
    const std::vector<PlacedLeaf> leaves = placed_leaves(shrub.tree, shrub.style, 1);
    const std::vector<PlacedLeaf> all = grouped(shrub.tree, leaves, leaf, leaf, leaves.size());
    ASSERT_EQ(all.size(), leaves.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].id, leaves[i].id);
        EXPECT_EQ(all[i].place, leaves[i].place);
    }
}

// A group covers at most what its leaves cover side by side.
TEST(GroupedLeaves, CoverLessThanTheyHaveTogether) {
    const Preset broadleaf = preset_of("broadleaf");
    const Mesh leaf = foliage_leaf(flat(broadleaf.leaf), 4);
    const std::vector<PlacedLeaf> leaves = placed_leaves(broadleaf.tree, broadleaf.style, 1);
    const double whole = area(merged_leaves(leaves, leaf));
    for (const std::size_t share : {2u, 4u, 16u, 64u}) {
        const std::size_t count = leaves.size() / share;
        const std::vector<PlacedLeaf> fewer = grouped(broadleaf.tree, leaves, leaf, leaf, count);
        ASSERT_EQ(fewer.size(), count);
        std::set<std::uint32_t> ids;
        for (const PlacedLeaf& one : fewer) {
            ids.insert(one.id);
            EXPECT_NEAR(glm::dot(one.along, one.up), 0.0, 1e-9);
            EXPECT_NEAR(glm::length(one.along), 1.0, 1e-9);
        }
        EXPECT_EQ(ids.size(), count);
        const double now = area(merged_leaves(fewer, leaf));
        EXPECT_LT(now, whole) << share;
        EXPECT_GT(now, 0.3 * whole) << share;
    }
}

// Leaves scattered over an ellipse that is twice as long as broad, all in one plane.
TEST(GroupedLeaves, LieInThePlaneOfTheirLeavesAlongTheirLongestAxis) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 1.0, -0.2)),
                     along = glm::normalize(glm::cross(up, glm::dvec3(0.0, 0.0, 1.0))),
                     side = glm::cross(up, along), middle(1.0, 2.0, 3.0);
    const Preset shrub = preset_of("shrub");
    const Mesh leaf = foliage_leaf(flat(shrub.leaf), 4);
    std::vector<PlacedLeaf> leaves;
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double angle = 2.4 * i, radius = std::sqrt((i + 0.5) / 400.0);
        PlacedLeaf one;
        one.up = up;
        one.along = std::cos(angle) * along + std::sin(angle) * side;
        one.place =
            middle + 2.0 * radius * std::cos(angle) * along + 1.0 * radius * std::sin(angle) * side;
        one.id = i;
        leaves.push_back(one);
    }
    const std::vector<PlacedLeaf> cover = grouped(shrub.tree, leaves, leaf, leaf, 1);
    ASSERT_EQ(cover.size(), 1u);
    EXPECT_NEAR(glm::dot(cover[0].up, up), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(cover[0].along, along)), 1.0, 1e-2);
    const Mesh mesh = merged_leaves(cover, leaf);
    const Bounds box = bounds(mesh);
    EXPECT_LT(glm::length(glm::dvec3(0.5F * (box.min + box.max)) - middle), 0.5);
    EXPECT_NEAR(slenderness_of(mesh), 2.0, 0.2);
    EXPECT_LT(area(mesh), 2.0 * area(merged_leaves(leaves, leaf)));
}

TEST(GroupedLeaves, InARowBecomeOneThatIsNoStripe) {
    const Preset shrub = preset_of("shrub");
    const Mesh leaf = foliage_leaf(flat(shrub.leaf), 4);
    std::vector<PlacedLeaf> leaves(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        leaves[i].id = i;
        leaves[i].place = {100.0 * i, 0.0, 0.0};
    }
    const std::vector<PlacedLeaf> cover = grouped(shrub.tree, leaves, leaf, leaf, 1);
    ASSERT_EQ(cover.size(), 1u);
    EXPECT_NEAR(std::abs(cover[0].along.x), 1.0, 1e-3);
    EXPECT_NEAR(slenderness_of(merged_leaves(cover, leaf)), 6.0, 1e-2);
    EXPECT_LE(area(merged_leaves(cover, leaf)), 1.001 * area(merged_leaves(leaves, leaf)));
}

// Pairs of leaves, far from each other: each pair becomes one leaf, in whatever order they stand.
TEST(GroupedLeaves, AreClosestNeighbours) {
    const Preset shrub = preset_of("shrub");
    const Mesh leaf = foliage_leaf(flat(shrub.leaf), 4), cover = foliage_leaf(flat(shrub.leaf), 2);
    std::vector<PlacedLeaf> leaves(40);
    for (std::uint32_t i = 0; i < 40; ++i) {
        leaves[i].id = i;
        leaves[i].place = {3.0 * (i % 20), 0.0, i < 20 ? 0.0 : 0.3};
    }
    for (const double share : {1.0, 1.5}) {
        const std::vector<PlacedLeaf> pairs = grouped(shrub.tree, leaves, leaf, cover, 20, share);
        ASSERT_EQ(pairs.size(), 20u);
        for (std::uint32_t i = 0; i < 20; ++i) {
            const SurfaceMoments pair = surface_moments(merged_leaves({&pairs[i], 1}, cover)),
                                 one = surface_moments(merged_leaves({&leaves[i], 1}, leaf));
            EXPECT_NEAR(pair.middle.x, one.middle.x, 1e-4);
            EXPECT_NEAR(pair.middle.z, one.middle.z + 0.15, 1e-4);
            EXPECT_GT(pair.area, share * one.area);
            EXPECT_LT(pair.area, 2.001 * share * one.area);
        }
    }
}

TEST(FoliageOfATree, HasTheCountAndTheLeafOfItsLevel) {
    for (const TreePreset& preset : atlas().trees()) {
        const Preset one = preset_of(preset.id.string());
        const std::size_t all = placed_leaves(one.tree, one.style, 1).size();
        for (int lod = 0; lod < tree_lods; ++lod) {
            const Foliage foliage = foliage_of(one.tree, one.style, one.leaf, 1, lod);
            EXPECT_EQ(foliage.leaves.size(), foliage_count(lod, all)) << preset.id.string();
            if (all > 0) {
                EXPECT_EQ(foliage.leaf.triangles(), leaf_triangles(lod, all));
            }
        }
    }
}

// Branches in place of leaves have the places of leaves, and cover as much.
TEST(FoliageOfATree, SpraysCoverWhatLeavesCover) {
    for (const TreePreset& preset : atlas().trees()) {
        const Preset one = preset_of(preset.id.string());
        LeafStyle branches = one.style;
        branches.leaf_group = LeafGroup::branch;
        for (int lod = 0; lod < tree_lods; ++lod) {
            SCOPED_TRACE(preset.id.string() + ' ' + std::to_string(lod));
            const Foliage leaves = foliage_of(one.tree, one.style, one.leaf, 1, lod),
                          sprays = foliage_of(one.tree, branches, one.leaf, 1, lod);
            ASSERT_EQ(leaves.leaves.size(), sprays.leaves.size());
            if (leaves.leaves.empty()) continue;
            EXPECT_EQ(leaves.leaf.triangles(), sprays.leaf.triangles());
            if (shows_shoots(one.leaf)) continue;
            if (!shows_sprays(one.leaf)) {
                EXPECT_EQ(leaves.leaf.positions, sprays.leaf.positions);
                continue;
            }
            EXPECT_EQ(sprays.group, lod == 0 ? LeafGroup::leaf : LeafGroup::branch);
            if (lod == 0) continue;
            const auto covered = [](const Foliage& of) {
                double area = 0.0;
                for (const PlacedLeaf& leaf : of.leaves)
                    area += leaf.size * leaf.size * leaf.breadth;
                return area * surface_moments(of.leaf).area * of.covered;
            };
            EXPECT_NEAR(covered(sprays) / covered(leaves), 1.0, 0.06);
        }
    }
}

TEST(FoliageOfATree, ShootsOfNeedlesHaveSpraysOfShoots) {
    const Preset spruce = preset_of("spruce");
    LeafStyle branches = spruce.style;
    branches.leaf_group = LeafGroup::branch;
    const auto least_u = [&](const LeafStyle& style, int lod) {
        float least = 1.0F;
        for (const glm::vec2& at :
             foliage_of(spruce.tree, style, spruce.leaf, 1, lod).leaf.texture_coordinates)
            least = std::min(least, at.x);
        return static_cast<double>(least);
    };
    const auto left_of = [](const LeafPanel& panel) { return panel.middle - panel.half; };
    EXPECT_NEAR(least_u(spruce.style, 0), left_of(shoot_panel), 1e-6);
    for (const int lod : {0, 3}) EXPECT_NEAR(least_u(branches, lod), left_of(spray_panel), 1e-6);
}

TEST(FoliageOfATree, ATreeWithoutLeavesHasNone) {
    const Preset shrub = preset_of("shrub");
    LeafStyle bare = shrub.style;
    bare.per_tip = 0;
    for (int lod = 0; lod < tree_lods; ++lod)
        EXPECT_TRUE(foliage_of(shrub.tree, bare, shrub.leaf, 1, lod).leaves.empty());
}

}  // namespace
}  // namespace sporeprint::plant_foliage_test
