#include "core/plant/tree_sway.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/support/orders.h"

namespace sporeprint::plant_tree_sway_test {
namespace {

/// Returns the distance of a point from a segment of a tree.
double distance_to(const Tree& tree, std::uint32_t edge, const glm::dvec3& point) {
    const glm::dvec3 from = tree.skeleton.nodes[tree.skeleton.segments[edge].from].place,
                     way = tree.skeleton.nodes[edge + 1].place - from;
    const double t = std::clamp(glm::dot(point - from, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::distance(point, from + t * way);
}

TEST(SwayOfTrees, SurfacesThatMeetMoveAlike) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, 3);
        const TreeSway sway(tree);
        for (std::uint32_t i = 1; i < tree.ramification.nodes.size(); ++i) {
            const std::uint32_t parent = tree.ramification.nodes[i].parent;
            const Skeleton::Node& joint = tree.skeleton.nodes[parent + 1];
            // The surfaces of both edges meet within a radius or so of their node.
            for (const glm::dvec3 aside : {glm::dvec3(0.0), joint.radius * tree.across[i],
                                           -joint.radius * tree.across[parent]}) {
                const Sway one = sway.at(joint.place + aside, i),
                           other = sway.at(joint.place + aside, parent);
                EXPECT_EQ(one.bend, other.bend) << i;
                EXPECT_EQ(one.phase, other.phase) << i;
            }
        }
    }
}

TEST(SwayOfTrees, TheFootStandsStillAndTwigsMoveMost) {
    for (const TreePreset& preset : tree_presets()) {
        SCOPED_TRACE(preset.id.string());
        const Tree tree = grown_tree(preset.shape, 3);
        const TreeSway sway(tree);
        const double foot = tree.skeleton.nodes[0].radius;
        for (int lod = 0; lod < tree_lods; ++lod) {
            const Bark bark = bark_of(tree, lod);
            ASSERT_EQ(bark.edges.size(), bark.mesh.positions.size());
            Mesh mesh = bark.mesh;
            mesh.sway = sway_of(bark, sway);
            for (const Sway& of : mesh.sway)
                EXPECT_TRUE(of.bend >= 0.0F && of.bend <= 1.0F && of.phase >= 0.0F &&
                            of.phase <= 1.0F && of.branch >= 0.0F && of.branch <= 1.0F);
            float most = 0.0F;
            for (std::size_t i = 0; i < mesh.sway.size(); ++i) {
                most = std::max(most, mesh.sway[i].bend);
                if (glm::length(glm::dvec3(mesh.positions[i])) <= foot) {
                    EXPECT_EQ(mesh.sway[i].bend, 0.0F);
                }
            }
            EXPECT_GT(most, lod == 0 ? 0.7F : 0.2F) << lod;
        }
    }
}

TEST(SwayOfTrees, VerticesOfBarkKnowTheirEdge) {
    const Tree tree = grown_tree(tree_preset("broadleaf")->shape, 1);
    const Bark bark = bark_of(tree, 0);
    for (std::size_t i = 0; i < bark.edges.size(); ++i) {
        // Edges in line with the next one have no nodes of their own and are labelled as it.
        double nearest = 1e9;
        std::uint32_t edge = bark.edges[i];
        for (int step = 0; step < 8 && edge != Ramification::none; ++step) {
            nearest =
                std::min(nearest, distance_to(tree, edge, glm::dvec3(bark.mesh.positions[i])) /
                                      tree.skeleton.nodes[edge + 1].radius);
            edge = tree.ramification.nodes[edge].parent;
        }
        ASSERT_LT(nearest, 3.0) << i;
    }
}

TEST(SwayOfTrees, LeavesFlutterMostAtTheirTips) {
    const LeafPreset& oak = *leaf_preset("oak");
    const std::vector<float> flutter = flutter_of(foliage_leaf(oak.shape));
    EXPECT_EQ(*std::max_element(flutter.begin(), flutter.end()), 1.0F);
    EXPECT_LT(*std::min_element(flutter.begin(), flutter.end()), 0.01F);
}

}  // namespace
}  // namespace sporeprint::plant_tree_sway_test
