#include "core/render/draw_list.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/problems.h"
#include "tests/support/solids.h"

namespace sporeprint::render::render_draw_list_test {
namespace {

TEST(DrawList, NodesTurnScaleAndMoveTheirMeshesAsTheirParentsDo) {
    const Mesh mesh = ball(1.0F, {0.0F, 0.0F, 2.0F});
    GlbScene scene = scene_of(mesh);
    const double half = std::sqrt(0.5);
    // A quarter turn about +Y takes +Z to +X.
    scene.nodes[0].rotation = {0.0, half, 0.0, half};
    scene.nodes[0].scale = {2.0, 1.0, 1.0};
    scene.nodes.push_back({.name = "parent", .translation = {0.0, 5.0, 0.0}, .children = {0}});
    const DrawList list = draw_list(scene, in_turn);
    ASSERT_EQ(list.draws.size(), 1u);
    EXPECT_NEAR(glm::distance(list.draws[0].placement.point({0, 0, 2}), glm::vec3(2, 5, 0)), 0.0F,
                1e-6F);
    EXPECT_NEAR(list.box.min.x, 1.0F, 0.01F);
    EXPECT_NEAR(list.box.max.y, 6.0F, 0.01F);
    EXPECT_NEAR(list.box.max.z, 2.0F, 0.01F) << "stretched along its own x, which is -z now";
    EXPECT_EQ(list.triangles(), mesh.triangles());
}

TEST(DrawList, NormalsStayPerpendicularUnderUnevenScales) {
    const Mesh mesh = ball(1.0F, {});
    GlbScene scene = scene_of(mesh);
    scene.nodes[0].scale = {3.0, 1.0, 0.5};
    const Placement placement = draw_list(scene, in_turn).draws[0].placement;
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 1, 0)), along(1, -1, 0);
    EXPECT_NEAR(glm::dot(placement.of_normals * normal, placement.linear * along), 0.0F, 1e-6F);
}

TEST(DrawList, HiddenNodesAreLeftOutAndInstancesAreDrawnEach) {
    const Mesh mesh = ball(1.0F, {}, 8, 4);
    GlbScene scene = scene_of(mesh);
    scene.nodes[0].instances.resize(5);
    scene.nodes.push_back({.name = "far", .mesh = 0, .in_scene = false});
    EXPECT_EQ(draw_list(scene, in_turn).triangles(), 5 * mesh.triangles());
    scene.nodes[0].in_scene = false;
    EXPECT_THROW((void)draw_list(scene, in_turn), GenerationError);
}

}  // namespace
}  // namespace sporeprint::render::render_draw_list_test
