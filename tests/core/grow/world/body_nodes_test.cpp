#include "core/grow/world/body_nodes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <deque>
#include <string>

#include "tests/support/atlas.h"
#include "tests/support/meshes.h"
#include "tests/support/orders.h"
#include "tests/support/plots.h"

namespace sporeprint::grow_body_nodes_test {
namespace {

/// The bodies of a small wood in a scene of their own.
struct Added {
    PlotBodies bodies;
    GlbScene scene;
    std::deque<Mesh> merged;
    BodyNodes nodes;

    explicit Added(BodyGrouping grouping) {
        const PlotContent content = small_wood().content();
        const FloorHeights floor(*content.ground, content.seed, content.micro, {});
        PlotOptions options;
        options.textures = Textures::none;
        ExecutionContext execution;
        execution.caches.morphs = cached_morphs();
        bodies =
            bodies_of(content, options, PlotFrame(content, floor), 10'000'000, atlas(), execution);
        FileOptions file;
        MaterialUrls urls;
        WorldMaterials materials(scene, Textures::none, file, urls, atlas(), execution);
        nodes = add_bodies(scene, materials, bodies, grouping, merged);
    }
    Added(const Added&) = delete;
    Added& operator=(const Added&) = delete;
    ~Added() = default;
};

TEST(BodyNodes, AreOneForEachBodyOrForEachShape) {
    const Added each(BodyGrouping::none), merged(BodyGrouping::merged),
        instanced(BodyGrouping::instanced);
    ASSERT_GT(each.bodies.bodies.size(), each.bodies.shapes.size());
    EXPECT_EQ(each.scene.nodes.size(), each.bodies.bodies.size());
    EXPECT_EQ(merged.scene.nodes.size(), each.bodies.shapes.size());
    EXPECT_EQ(instanced.scene.nodes.size(), each.bodies.shapes.size());
    for (const Added* added : {&each, &merged, &instanced}) {
        ASSERT_EQ(added->nodes.nodes.size(), added->bodies.bodies.size());
        for (std::size_t i = 0; i < added->nodes.nodes.size(); ++i) {
            const GlbNode& node = added->scene.nodes[added->nodes.nodes[i]];
            const std::string& shape = added->bodies.shapes[added->bodies.bodies[i].shape].name;
            EXPECT_TRUE(node.name.starts_with(shape)) << node.name << " for " << shape;
        }
    }
}

TEST(BodyNodes, CountTheSameTrianglesWithinTheSameBox) {
    const Added each(BodyGrouping::none), merged(BodyGrouping::merged),
        instanced(BodyGrouping::instanced);
    EXPECT_GT(each.nodes.triangles, 0U);
    EXPECT_EQ(each.nodes.triangles, merged.nodes.triangles);
    EXPECT_EQ(each.nodes.triangles, instanced.nodes.triangles);
    EXPECT_EQ(each.nodes.vertices, instanced.nodes.vertices);
    EXPECT_GT(merged.nodes.vertices, each.nodes.vertices);
    EXPECT_EQ(each.nodes.box.min, merged.nodes.box.min);
    EXPECT_EQ(each.nodes.box.max, instanced.nodes.box.max);
    Bounds box = bounds(merged.merged.front());
    for (const Mesh& mesh : merged.merged) box = united(box, bounds(mesh));
    EXPECT_EQ(box.min, merged.nodes.box.min);
    EXPECT_EQ(box.max, merged.nodes.box.max);
}

TEST(BodyNodes, AreNoneWithoutBodies) {
    GlbScene scene;
    FileOptions file;
    MaterialUrls urls;
    ExecutionContext execution;
    WorldMaterials materials(scene, Textures::none, file, urls, atlas(), execution);
    std::deque<Mesh> merged;
    const BodyNodes none = add_bodies(scene, materials, {}, BodyGrouping::none, merged);
    EXPECT_TRUE(none.nodes.empty());
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_EQ(none.triangles, 0U);
}

}  // namespace
}  // namespace sporeprint::grow_body_nodes_test
